//! Encoding of values in the `postcard` format, which preserves all bits of numbers.

use crate::Damage;
use serde::{Deserialize, Serialize};

pub(super) fn encode<T: Serialize>(value: &T, bytes: Vec<u8>) -> Vec<u8> {
    postcard::to_extend(value, bytes).expect("numbers, texts and lists of them can be encoded")
}

/// Decodes a value and returns it with the remaining bytes.
pub(super) fn decode<'a, T: Deserialize<'a>>(bytes: &'a [u8]) -> Result<(T, &'a [u8]), Damage> {
    postcard::take_from_bytes(bytes).map_err(|error| Damage::Contents(error.to_string()))
}

/// Decodes a value that uses all bytes.
pub(super) fn decode_all<'a, T: Deserialize<'a>>(bytes: &'a [u8]) -> Result<T, Damage> {
    match decode(bytes)? {
        (value, []) => Ok(value),
        (_, rest) => Err(Damage::Contents(format!("{} bytes too many", rest.len()))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_survive_the_round_trip() {
        let numbers = vec![-0.0, f64::NAN, -f64::NAN, 5e-324, 1.0 / 3.0];
        let bytes = encode(&numbers, Vec::new());
        let back: Vec<f64> = decode_all(&bytes).unwrap();
        let bits = |numbers: &[f64]| numbers.iter().map(|n| n.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&back), bits(&numbers));
        let mut longer = bytes.clone();
        longer.push(0);
        let error = decode_all::<Vec<f64>>(&longer).unwrap_err();
        assert!(error.to_string().contains("1 bytes too many"), "{error}");
    }

    /// Lengths are checked before memory is allocated.
    #[test]
    fn lengths_beyond_the_contents_are_refused() {
        let bytes = encode(&(1_u64 << 60), Vec::new());
        assert!(decode_all::<Vec<f64>>(&bytes).is_err());
        assert!(decode_all::<String>(&bytes).is_err());
    }
}
