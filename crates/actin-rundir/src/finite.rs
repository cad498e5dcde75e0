//! Checks that values are finite.

use crate::RunDirectoryError;

/// Checks `values` of an array of `shape`, with the last index fastest.
pub(crate) fn ensure_finite(
    file: &str,
    quantity: &str,
    shape: &[usize],
    values: impl IntoIterator<Item = f64>,
) -> Result<(), RunDirectoryError> {
    match values.into_iter().enumerate().find(|(_, v)| !v.is_finite()) {
        None => Ok(()),
        Some((flat, value)) => Err(RunDirectoryError::NotFinite {
            file: file.to_owned(),
            quantity: quantity.to_owned(),
            index: unravel(flat, shape),
            value,
        }),
    }
}

/// Checks the values of record `i` in a `quantity` whose first index is the record.
pub(crate) fn ensure_finite_in(
    (file, quantity): (&str, &str),
    i: usize,
    shape: &[usize],
    values: impl IntoIterator<Item = f64>,
) -> Result<(), RunDirectoryError> {
    let checked = ensure_finite(file, quantity, shape, values);
    checked.map_err(|mut error| {
        if let RunDirectoryError::NotFinite { index, .. } = &mut error {
            index.insert(0, i);
        }
        error
    })
}

/// Index in an array of `shape` of the value at the flat index `flat`.
fn unravel(flat: usize, shape: &[usize]) -> Vec<usize> {
    let mut rest = flat;
    let mut index: Vec<usize> = shape
        .iter()
        .rev()
        .map(|&n| {
            let i = rest % n;
            rest /= n;
            i
        })
        .collect();
    index.reverse();
    index
}

#[cfg(test)]
mod tests {
    use super::*;

    /// In an array of shape [2, 3, 4], value 17 has the index [1, 1, 1]; the reverse order gives
    /// [1, 1, 2].
    #[test]
    fn the_first_bad_value_is_named_with_its_index() {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut values = vec![1.0; 24];
            values[17] = bad;
            values[20] = bad;
            let error = ensure_finite("a.npz", "x_nm", &[2, 3, 4], values).unwrap_err();
            let RunDirectoryError::NotFinite { index, .. } = &error else {
                panic!("{error}");
            };
            assert_eq!(index, &[1, 1, 1]);
            assert!(error.to_string().starts_with("a.npz: x_nm[1, 1, 1] is "));
        }
    }

    #[test]
    fn a_single_number_has_no_index() {
        let error = ensure_finite("a.json", "wall_s", &[], [f64::NAN]).unwrap_err();
        assert!(error.to_string().starts_with("a.json: wall_s is NaN:"));
        assert!(ensure_finite("a.json", "wall_s", &[], [0.0]).is_ok());
    }
}
