//! Mean loads and tangent on a grid of strains, slice by slice, with standard errors.
//!
//! A slice is the file of one twist. One that is there, computed with the same parameters, temperature and axes, is
//! not computed again.

use super::super::rows::{self, Row};
use super::heat;
use super::natural::natural;
use actin_paper::cells::{self, strain};
use actin_sim::ellipsoid::{Cell, Control, Displacements, EllipsoidParameters, Heat, HeatResponse};
use rayon::prelude::*;
use std::path::{Path, PathBuf};

/// Raised when results of the same parameters change.
const VERSION: u32 = 1;
/// Streams of a slice, and slices of a set of axes at most.
const STREAMS: u64 = 1 << 20;
const SLICES: u64 = 1 << 10;

/// Strains, and how many samples each has.
#[derive(Clone, Debug, PartialEq)]
struct HeatAxes {
    /// `kappa_3` (rad/nm).
    twist: Vec<f64>,
    /// `sigma_3` beyond that of the free filament of the same twist at the temperature.
    extension: Vec<f64>,
    /// Curvature (rad/nm), shear, angle between them (deg).
    bent: Vec<[f64; 3]>,
    samples: usize,
}

/// A point with the standard errors of its loads.
pub(super) struct HeatRow {
    pub(super) row: Row,
    pub(super) errors: [f64; 6],
}

impl HeatAxes {
    /// Those of the study, or fewer.
    fn new(quick: bool) -> Self {
        if quick {
            return Self {
                twist: vec![-0.02, 0.0, 0.02],
                extension: vec![0.0, 1.5e-3],
                bent: vec![
                    [0.0, 0.0, 0.0],
                    [0.01, 0.0, 0.0],
                    [0.0, 0.015, 0.0],
                    [5e-3, 7.5e-3, 0.0],
                ],
                samples: 1000,
            };
        }
        let half = [3e-3, 7e-3, 0.013, 0.021, 0.033, 0.048];
        let both = half.iter().flat_map(|x| [*x, -x]);
        Self {
            twist: [0.0].into_iter().chain(both).collect(),
            extension: vec![-2e-3, 5e-4, 3e-3],
            bent: vec![
                [0.0, 0.0, 0.0],
                [5e-3, 0.0, 0.0],
                [0.01, 0.0, 0.0],
                [0.0, 7.5e-3, 0.0],
                [0.0, 0.015, 0.0],
                [5e-3, 7.5e-3, 0.0],
                [5e-3, 7.5e-3, 90.0],
                [5e-3, 7.5e-3, 180.0],
                [0.01, 7.5e-3, 45.0],
                [5e-3, 0.015, 135.0],
                [0.01, 0.015, 0.0],
                [0.01, 0.015, 180.0],
            ],
            samples: 2400,
        }
    }

    /// Strains that short segments of a rod reach by their thermal motion: shear varies by 0.02 in 10 nm, stretch by 5e-3.
    fn wide(quick: bool) -> Self {
        let half: &[f64] = if quick { &[] } else { &[7e-3, 0.021] };
        let both = half.iter().flat_map(|x| [*x, -x]);
        Self {
            twist: [0.0].into_iter().chain(both).collect(),
            extension: vec![-8e-3, 5e-4, 8e-3],
            bent: vec![
                [0.0, 0.0, 0.0],
                [0.01, 0.0, 0.0],
                [0.0, 0.015, 0.0],
                [0.0, 0.03, 0.0],
                [0.0, 0.05, 0.0],
                [0.01, 0.03, 0.0],
                [0.01, 0.03, 90.0],
                [0.01, 0.03, 180.0],
            ],
            samples: if quick { 1000 } else { 2400 },
        }
    }

    fn points(&self) -> usize {
        self.extension.len() * self.bent.len()
    }
}

/// Computes what is missing, and writes and returns all rows.
pub(super) fn compute(out: &Path, kt: f64, quick: bool) -> Result<Vec<HeatRow>, String> {
    let folder = out.join("heat");
    std::fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let cell = cells::mean()?;
    let sets = [
        ("slice", HeatAxes::new(quick)),
        ("wide", HeatAxes::wide(quick)),
    ];
    let mut all = Vec::new();
    for ((name, axes), set) in sets.iter().zip(0..) {
        let path = |slice: usize| folder.join(format!("{name}-{slice:02}.csv"));
        all.extend(slices(&cell, kt, axes, set, path)?);
    }
    write(&out.join("heat.csv"), &format!("kT {kt} pN nm"), &all)?;
    let largest = |k: usize| all.iter().map(|row| row.errors[k]).fold(0.0, f64::max);
    let positive = all.iter().filter(|row| row.row.least_stiffness() > 0.0);
    println!(
        "heat: {} points, tangent positive at {}; largest standard errors {:.1?} (pN nm, pN)",
        all.len(),
        positive.count(),
        std::array::from_fn::<f64, 6, _>(largest)
    );
    Ok(all)
}

/// All points of a set of axes.
fn slices(
    cell: &Cell,
    kt: f64,
    axes: &HeatAxes,
    set: u64,
    path: impl Fn(usize) -> PathBuf,
) -> Result<Vec<HeatRow>, String> {
    let parameters = EllipsoidParameters::default();
    let mut all = Vec::new();
    // One after another: the points of each are computed side by side.
    for (i, twist) in axes.twist.iter().enumerate() {
        let key = format!("version {VERSION}, {parameters:?}, kT {kt}, {axes:?}, {twist}");
        let kept = read(&path(i), &key).filter(|rows| rows.len() == axes.points());
        let rows = if let Some(rows) = kept {
            rows
        } else {
            let first = STREAMS * (SLICES * set + i as u64 + 1);
            let rows = slice(cell, kt, axes, i, first)?;
            write(&path(i), &key, &rows)?;
            rows
        };
        all.extend(rows);
    }
    Ok(all)
}

/// All points of one twist; streams from `first` on are theirs.
fn slice(
    cell: &Cell,
    kt: f64,
    axes: &HeatAxes,
    number: usize,
    first: u64,
) -> Result<Vec<HeatRow>, String> {
    let twist = axes.twist[number];
    let natural = natural(cell, kt, Some(twist), first)?;
    let places = axes.extension.iter().flat_map(|&extension| {
        let with = move |&bent: &[f64; 3]| (extension, bent);
        axes.bent.iter().map(with)
    });
    let jobs: Vec<(u64, (f64, [f64; 3]))> = (first + 100..).zip(places).collect();
    let rows = jobs.into_par_iter().map(|(stream, (extension, bent))| {
        let [curvature, shear, angle] = bent;
        let point = [curvature, twist, shear, natural.stretch + extension, angle];
        let heat = heat(kt, axes.samples, stream);
        let response = sample(cell, point, &natural.displacements, &heat)?;
        Ok(HeatRow::new(point, extension, &response))
    });
    let rows = rows.collect::<Result<Vec<HeatRow>, String>>()?;
    println!(
        "twist {twist} /nm: free filament stretched by {:.5}, {} points",
        natural.stretch,
        rows.len()
    );
    Ok(rows)
}

/// The response at a point.
fn sample(
    cell: &Cell,
    point: [f64; 5],
    straight: &Displacements,
    heat: &Heat,
) -> Result<HeatResponse, String> {
    let [curvature, twist, shear, stretch, angle] = point;
    let strain = strain([curvature, twist, shear, stretch, angle.to_radians()]);
    // A relaxed state is nearer to the typical ones than that of the straight filament.
    let relaxed = cell.relax(&strain, Some(straight));
    let start = relaxed.as_ref().map_or(straight, |r| &r.displacements);
    let controls = std::array::from_fn(|k| Control::Strain(strain[k]));
    cell.sample(&controls, heat, Some((&strain, start)))
        .map_err(|e| e.to_string())
}

impl HeatRow {
    fn new(point: [f64; 5], extension: f64, response: &HeatResponse) -> Self {
        Self {
            row: Row {
                strain: point,
                extension,
                // Free energies need a path; loads say as much.
                energy: f64::NAN,
                loads: response.loads,
                tangent: response.tangent,
            },
            errors: response.loads_error.into(),
        }
    }
}

/// Names of the columns: those of the grid of relaxed cells, then the standard errors of the loads.
fn header() -> Vec<String> {
    let mut names = rows::header();
    let errors: Vec<String> = names[7..13]
        .iter()
        .map(|name| format!("{name}_error"))
        .collect();
    names.extend(errors);
    names
}

fn write(path: &Path, key: &str, rows: &[HeatRow]) -> Result<(), String> {
    let numbers = rows.iter().map(|one| {
        let mut numbers = one.row.numbers();
        numbers.extend(one.errors);
        numbers
    });
    rows::write_numbers(path, key, &header(), numbers)
}

fn read(path: &Path, key: &str) -> Option<Vec<HeatRow>> {
    let parse = |numbers: Vec<f64>| {
        Some(HeatRow {
            row: Row::read(&numbers)?,
            errors: numbers.get(34..40)?.try_into().ok()?,
        })
    };
    rows::read_numbers(path, key)?
        .into_iter()
        .map(parse)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use actin_sim::ellipsoid::{SixMatrix, SixVector};

    /// Rows come back with their errors; of other axes there are none.
    #[test]
    fn rows_with_errors_come_back() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("slice.csv");
        let one = HeatRow {
            row: Row {
                strain: [0.1, -0.2, 1.0 / 3.0, 1e-17, 45.0],
                extension: -2e-3,
                energy: 0.0,
                loads: SixVector::from_fn(|i, _| (i as f64).sin()),
                tangent: SixMatrix::from_fn(|i, j| ((i + j) as f64).cos()),
            },
            errors: [0.1, 0.2, 0.3, 0.4, 0.5, 0.6],
        };
        write(&path, "key", std::slice::from_ref(&one)).unwrap();
        let back = read(&path, "key").unwrap();
        assert_eq!((back[0].row.clone(), back[0].errors), (one.row, one.errors));
        assert!(read(&path, "other").is_none());
    }

    /// A slice is the same on one thread and on many, from the first or alone: its motion is keyed by its points.
    #[test]
    fn slices_do_not_depend_on_threads() {
        let cell = cells::mean().unwrap();
        let axes = HeatAxes {
            twist: vec![0.0, 0.01],
            extension: vec![0.0],
            bent: vec![[0.0, 0.0, 0.0], [0.01, 0.0, 0.0], [0.0, 0.01, 0.0]],
            samples: 40,
        };
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            let rows = pool
                .build()
                .unwrap()
                .install(|| slice(&cell, 4.114, &axes, 1, 0));
            rows.unwrap()
                .into_iter()
                .map(|row| row.row.loads)
                .collect::<Vec<_>>()
        };
        assert_eq!(with(1), with(3));
    }
}
