//! Numbers to bytes and back. It does not know what they mean.

use super::Damage;

/// Bytes that grow.
#[derive(Debug, Default)]
pub(super) struct Writer {
    pub(super) bytes: Vec<u8>,
}

impl Writer {
    pub(super) fn flag(&mut self, value: bool) {
        self.bytes.push(u8::from(value));
    }

    pub(super) fn count(&mut self, value: u64) {
        self.bytes.extend_from_slice(&value.to_le_bytes());
    }

    pub(super) fn size(&mut self, value: usize) {
        self.count(value as u64);
    }

    pub(super) fn checksum(&mut self, value: u32) {
        self.bytes.extend_from_slice(&value.to_le_bytes());
    }

    pub(super) fn number(&mut self, value: f64) {
        self.bytes.extend_from_slice(&value.to_le_bytes());
    }

    pub(super) fn numbers(&mut self, values: &[f64]) {
        self.bytes.reserve(8 * values.len());
        for &value in values {
            self.number(value);
        }
    }

    pub(super) fn text(&mut self, text: &str) {
        self.size(text.len());
        self.bytes.extend_from_slice(text.as_bytes());
    }

    /// Whether there is a value, and then the value.
    pub(super) fn optional<T>(&mut self, value: Option<T>, write: impl FnOnce(&mut Self, T)) {
        self.flag(value.is_some());
        if let Some(value) = value {
            write(self, value);
        }
    }
}

/// Bytes that are read from the front. Never reads or allocates beyond them.
#[derive(Debug)]
pub(super) struct Reader<'a> {
    rest: &'a [u8],
}

impl<'a> Reader<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { rest: bytes }
    }

    fn take(&mut self, n: usize) -> Result<&'a [u8], Damage> {
        let missing = || Damage::Contents(format!("{n} bytes wanted, {} left", self.rest.len()));
        let (taken, rest) = self.rest.split_at_checked(n).ok_or_else(missing)?;
        self.rest = rest;
        Ok(taken)
    }

    fn array<const N: usize>(&mut self) -> Result<[u8; N], Damage> {
        let taken = self.take(N)?;
        Ok(taken.try_into().expect("as many bytes as were asked for"))
    }

    pub(super) fn flag(&mut self) -> Result<bool, Damage> {
        match self.array::<1>()? {
            [0] => Ok(false),
            [1] => Ok(true),
            [other] => Err(Damage::Contents(format!("a flag is 0 or 1, found {other}"))),
        }
    }

    pub(super) fn count(&mut self) -> Result<u64, Damage> {
        self.array().map(u64::from_le_bytes)
    }

    pub(super) fn size(&mut self) -> Result<usize, Damage> {
        let count = self.count()?;
        usize::try_from(count)
            .map_err(|_| Damage::Contents(format!("{count} is more than memory can hold")))
    }

    pub(super) fn checksum(&mut self) -> Result<u32, Damage> {
        self.array().map(u32::from_le_bytes)
    }

    pub(super) fn number(&mut self) -> Result<f64, Damage> {
        self.array().map(f64::from_le_bytes)
    }

    /// As many numbers as there is room for in `values`.
    pub(super) fn numbers(&mut self, values: &mut [f64]) -> Result<(), Damage> {
        let bytes = self.take(8 * values.len())?;
        for (value, bytes) in values.iter_mut().zip(bytes.chunks_exact(8)) {
            let bytes = bytes.try_into().expect("chunks of eight bytes");
            *value = f64::from_le_bytes(bytes);
        }
        Ok(())
    }

    pub(super) fn text(&mut self) -> Result<String, Damage> {
        let length = self.size()?;
        let bytes = self.take(length)?.to_vec();
        String::from_utf8(bytes).map_err(|error| Damage::Contents(error.to_string()))
    }

    pub(super) fn optional<T>(
        &mut self,
        read: impl FnOnce(&mut Self) -> Result<T, Damage>,
    ) -> Result<Option<T>, Damage> {
        self.flag()?.then(|| read(self)).transpose()
    }

    /// As many values as a count says, each of at least `least` bytes, so that a count that is too
    /// large is found before anything is allocated for it.
    pub(super) fn list<T>(
        &mut self,
        least: usize,
        mut read: impl FnMut(&mut Self) -> Result<T, Damage>,
    ) -> Result<Vec<T>, Damage> {
        let count = self.size()?;
        if count > self.rest.len() / least {
            let left = self.rest.len();
            return Err(Damage::Contents(format!("{count} values in {left} bytes")));
        }
        (0..count).map(|_| read(self)).collect()
    }

    /// Refuses unread bytes.
    pub(super) fn end(&self) -> Result<(), Damage> {
        match self.rest.len() {
            0 => Ok(()),
            left => Err(Damage::Contents(format!("{left} bytes too many"))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Bits come back, signed zeros and what is no number included.
    #[test]
    fn what_is_written_is_read() {
        let mut writer = Writer::default();
        writer.flag(true);
        writer.count(u64::MAX);
        writer.numbers(&[-0.0, f64::NAN, 1.0 / 3.0]);
        writer.text("phi \u{3c6}");
        writer.optional(None, Writer::number);
        writer.optional(Some(2.5), Writer::number);
        let mut reader = Reader::new(&writer.bytes);
        assert!(reader.flag().unwrap());
        assert_eq!(reader.count().unwrap(), u64::MAX);
        let mut numbers = [0.0; 3];
        reader.numbers(&mut numbers).unwrap();
        let bits = [-0.0, f64::NAN, 1.0 / 3.0].map(f64::to_bits);
        assert_eq!(numbers.map(f64::to_bits), bits);
        assert_eq!(reader.text().unwrap(), "phi \u{3c6}");
        assert_eq!(reader.optional(Reader::number).unwrap(), None);
        assert_eq!(reader.optional(Reader::number).unwrap(), Some(2.5));
        assert!(reader.end().is_ok());
    }

    /// Lengths that promise more than there is: refused, and nothing is allocated for them.
    #[test]
    fn promises_are_not_believed() {
        let mut writer = Writer::default();
        writer.count(1 << 60);
        for read in [
            |reader: &mut Reader<'_>| reader.text().map(drop),
            |reader: &mut Reader<'_>| reader.list(8, Reader::number).map(drop),
        ] {
            let error = read(&mut Reader::new(&writer.bytes)).unwrap_err();
            assert!(matches!(error, Damage::Contents(_)), "{error}");
        }
        assert!(Reader::new(&[2]).flag().is_err());
        assert!(Reader::new(&[1]).end().is_err());
    }
}
