//! Responses of cells as rows of a table.

use actin_cosserat::PotentialJet;
use actin_draw::report::write_atomically;
use actin_paper::cells::strain;
use actin_sim::ellipsoid::{CellResponse, SixMatrix, SixVector};
use std::path::Path;

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Row {
    /// Curvature (rad/nm), twist (rad/nm), shear, stretch, angle between curvature and shear (deg).
    pub(super) strain: [f64; 5],
    /// Stretch relative to the free filament of the same twist with its [shortening](actin_paper::cells::shortening).
    pub(super) extension: f64,
    /// Energy per length (pN).
    pub(super) energy: f64,
    /// Torque (pN nm) and force (pN); the shear is along the first axis.
    pub(super) loads: SixVector,
    /// Derivatives of the loads with respect to the strains.
    pub(super) tangent: SixMatrix,
    /// Standard errors of the loads; zero without thermal motion.
    pub(super) errors: SixVector,
}

fn header() -> Vec<String> {
    let mut names: Vec<String> = [
        "kappa_perp_per_nm",
        "kappa_3_per_nm",
        "gamma",
        "sigma_3",
        "angle_deg",
        "extension",
        "energy_pn",
        "m1_pn_nm",
        "m2_pn_nm",
        "m3_pn_nm",
        "n1_pn",
        "n2_pn",
        "n3_pn",
    ]
    .map(str::to_owned)
    .to_vec();
    let errors: Vec<String> = names[7..].iter().map(|n| format!("{n}_error")).collect();
    names.extend(upper().map(|(i, j)| format!("t{}{}", i + 1, j + 1)));
    names.extend(errors);
    names
}

pub(super) fn upper() -> impl Iterator<Item = (usize, usize)> {
    (0..6).flat_map(|i| (i..6).map(move |j| (i, j)))
}

impl Row {
    pub(super) fn new(strain: [f64; 5], extension: f64, response: &CellResponse) -> Self {
        Self {
            strain,
            extension,
            energy: response.energy,
            loads: response.loads,
            tangent: response.tangent,
            errors: SixVector::zeros(),
        }
    }

    pub(super) fn jet(&self) -> PotentialJet {
        PotentialJet {
            energy: self.energy,
            loads: self.loads,
            tangent: self.tangent,
        }
    }

    pub(super) fn six(&self) -> SixVector {
        let [curvature, twist, shear, stretch, angle] = self.strain;
        strain([curvature, twist, shear, stretch, angle.to_radians()])
    }

    /// Returns the smallest eigenvalue of the tangent (pN). Curvatures are scaled by the radius of gyration of the
    /// cross-section, 1 nm.
    pub(super) fn least_stiffness(&self) -> f64 {
        self.tangent.symmetric_eigenvalues().min()
    }

    fn numbers(&self) -> Vec<f64> {
        let first = self.strain.iter().chain([&self.extension, &self.energy]);
        let mut all: Vec<f64> = first.chain(self.loads.iter()).copied().collect();
        all.extend(upper().map(|place| self.tangent[place]));
        all.extend(self.errors.iter());
        all
    }

    fn read(numbers: &[f64]) -> Option<Self> {
        let mut tangent = SixMatrix::zeros();
        for ((i, j), value) in upper().zip(numbers.get(13..34)?) {
            tangent[(i, j)] = *value;
            tangent[(j, i)] = *value;
        }
        Some(Self {
            strain: numbers.get(0..5)?.try_into().ok()?,
            extension: *numbers.get(5)?,
            energy: *numbers.get(6)?,
            loads: SixVector::from_column_slice(numbers.get(7..13)?),
            tangent,
            errors: SixVector::from_column_slice(numbers.get(34..40)?),
        })
    }
}

/// Reads the rows of a file with the same key and, if given, `count` rows. Otherwise computes and writes them.
pub(super) fn cached(
    path: &Path,
    key: &str,
    count: Option<usize>,
    compute: impl FnOnce() -> Result<Vec<Row>, String>,
) -> Result<Vec<Row>, String> {
    let is_whole = |rows: &Vec<Row>| count.is_none_or(|count| rows.len() == count);
    if let Some(rows) = read(path, key).filter(is_whole) {
        return Ok(rows);
    }
    let rows = compute()?;
    write(path, key, &rows)?;
    Ok(rows)
}

pub(super) fn write(path: &Path, key: &str, rows: &[Row]) -> Result<(), String> {
    let mut text = format!("# {key}\n{}\n", header().join(","));
    for row in rows {
        let numbers: Vec<String> = row.numbers().iter().map(|x| format!("{x:e}")).collect();
        text.push_str(&numbers.join(","));
        text.push('\n');
    }
    write_atomically(path, &text)
}

fn read(path: &Path, key: &str) -> Option<Vec<Row>> {
    let text = std::fs::read_to_string(path).ok()?;
    let (first, table) = text.split_once('\n')?;
    if first != format!("# {key}") {
        return None;
    }
    let parse = |line: &str| {
        let numbers: Option<Vec<f64>> = line.split(',').map(|x| x.parse().ok()).collect();
        Row::read(&numbers?)
    };
    table.lines().skip(1).map(parse).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_come_back() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("slice.csv");
        let row = Row {
            strain: [0.1, -0.2, 1.0 / 3.0, 1e-17, 45.0],
            extension: -2e-3,
            energy: 0.7,
            loads: SixVector::from_fn(|i, _| (i as f64).sin()),
            tangent: SixMatrix::from_fn(|i, j| ((i + j) as f64).cos()),
            errors: SixVector::from_fn(|i, _| 0.1 * i as f64),
        };
        write(&path, "key", std::slice::from_ref(&row)).unwrap();
        assert_eq!(read(&path, "key"), Some(vec![row]));
        assert_eq!(read(&path, "other"), None);
    }
}
