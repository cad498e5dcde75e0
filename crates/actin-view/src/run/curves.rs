//! Columns of `energies.csv` and `observables.csv` as curves over time or path parameter.

use super::thin;
use std::path::Path;

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Curve {
    /// Name in the file.
    pub name: String,
    /// Time (ns) or path parameter of each row.
    pub at: Vec<f64>,
    /// NaN for an empty cell.
    pub values: Vec<f64>,
}

/// Reads a CSV file whose first column is the time or path parameter.
///
/// # Errors
/// If the file cannot be read, or a cell is not a number.
pub(super) fn read(path: &Path) -> Result<Vec<Curve>, String> {
    let mut reader = csv::Reader::from_path(path).map_err(|error| error.to_string())?;
    let names = reader.headers().map_err(|error| error.to_string())?;
    let names: Vec<String> = names.iter().map(str::to_owned).collect();
    let mut columns = vec![Vec::new(); names.len()];
    for (row, record) in reader.records().enumerate() {
        let record = record.map_err(|error| error.to_string())?;
        for ((cell, column), name) in record.iter().zip(&mut columns).zip(&names) {
            let value = if cell.is_empty() {
                f64::NAN
            } else {
                let no_number = |_| format!("row {}, {name}: {cell:?} is not a number", row + 1);
                cell.parse().map_err(no_number)?
            };
            column.push(value);
        }
    }
    Ok(of_columns(names, columns))
}

/// Converts columns; the first is the time or path parameter.
pub(super) fn of_columns(names: Vec<String>, columns: Vec<Vec<f64>>) -> Vec<Curve> {
    let mut columns = columns.into_iter();
    let at = columns.next().unwrap_or_default();
    let named = names.into_iter().skip(1).zip(columns);
    named
        .map(|(name, values)| Curve {
            name,
            at: at.clone(),
            values,
        })
        .collect()
}

/// Selects at most `rows` evenly spaced rows, and removes curves that are zero.
pub(super) fn thinned(curves: Vec<Curve>, rows: usize) -> Vec<Curve> {
    let says = |curve: &Curve| curve.values.iter().any(|v| !v.is_nan() && *v != 0.0);
    let thin = |curve: Curve| {
        let which = thin::evenly(curve.at.len(), rows);
        Curve {
            at: which.iter().map(|&i| curve.at[i]).collect(),
            values: which.iter().map(|&i| curve.values[i]).collect(),
            name: curve.name,
        }
    };
    curves.into_iter().filter(says).map(thin).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_become_curves() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.csv");
        std::fs::write(&path, "time_ns,a,b\n0.0,1.0,0.0\n1.5,,0.0\n2.0,3.0,0.0\n").unwrap();
        let curves = read(&path).unwrap();
        assert_eq!(curves[0].name, "a");
        assert_eq!(curves[1].at, [0.0, 1.5, 2.0]);
        assert!(curves[0].values[1].is_nan());
        assert_eq!(curves[0].values[2..], [3.0]);
        let shown = thinned(curves, 2);
        assert_eq!(
            (shown.len(), shown[0].at.as_slice()),
            (1, [0.0, 2.0].as_slice())
        );
        std::fs::write(&path, "time_ns,a\n0.0,x\n").unwrap();
        assert_eq!(read(&path).unwrap_err(), "row 1, a: \"x\" is not a number");
    }
}
