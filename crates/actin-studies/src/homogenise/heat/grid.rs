//! Thermal mean loads and tangents on a grid of strains, with standard errors.
//!
//! Each slice, with one twist, is a file. A file with the same parameters, temperature and axes is reused.

use super::super::rows::{self, Row};
use super::heat;
use super::natural::natural;
use actin_paper::cells::{self, strain};
use actin_sim::ellipsoid::{Cell, Control, Displacements, EllipsoidParameters, Heat, HeatResponse};
use rayon::prelude::*;
use std::path::{Path, PathBuf};

/// Changed when results for the same parameters change.
const VERSION: u32 = 2;
/// Number of random streams of a slice, and largest number of slices of a set of axes.
const STREAMS: u64 = 1 << 20;
const SLICES: u64 = 1 << 10;

/// Curvature (rad/nm), shear, and angle between them (deg) of each point with bending and shear.
type BendingGrid<const N: usize> = [[f64; N]; 3];

const BENT: BendingGrid<12> = [
    [
        0.0, 5e-3, 0.01, 0.0, 0.0, 5e-3, 5e-3, 5e-3, 0.01, 5e-3, 0.01, 0.01,
    ],
    [
        0.0, 0.0, 0.0, 7.5e-3, 0.015, 7.5e-3, 7.5e-3, 7.5e-3, 7.5e-3, 0.015, 0.015, 0.015,
    ],
    [
        0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 90.0, 180.0, 45.0, 135.0, 0.0, 180.0,
    ],
];
/// Strains due to thermal motion of short rod segments: in 10 nm, shear varies by 0.02 and stretch by 5e-3.
const WIDE: BendingGrid<8> = [
    [0.0, 0.01, 0.0, 0.0, 0.0, 0.01, 0.01, 0.01],
    [0.0, 0.0, 0.015, 0.03, 0.05, 0.03, 0.03, 0.03],
    [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 90.0, 180.0],
];
const QUICK: BendingGrid<4> = [[0.0, 0.01, 0.0, 5e-3], [0.0, 0.0, 0.015, 7.5e-3], [0.0; 4]];

#[derive(Clone, Debug, PartialEq)]
struct HeatAxes {
    twist: Vec<f64>,
    /// Stretch `sigma_3` relative to the free filament of the same twist and temperature.
    extension: Vec<f64>,
    bent: Vec<[f64; 3]>,
    samples: usize,
}

impl HeatAxes {
    /// Creates axes from positive twists, to which opposite twists and zero are added.
    fn new<const N: usize>(
        half: &[f64],
        extension: &[f64],
        bent: &BendingGrid<N>,
        quick: bool,
    ) -> Self {
        let both = half.iter().flat_map(|x| [*x, -x]);
        Self {
            twist: [0.0].into_iter().chain(both).collect(),
            extension: extension.to_vec(),
            bent: (0..N).map(|k| bent.map(|values| values[k])).collect(),
            samples: if quick { 1000 } else { 2400 },
        }
    }

    fn sets(quick: bool) -> [(&'static str, Self); 2] {
        let wide = [-8e-3, 5e-4, 8e-3];
        if quick {
            let slice = Self::new(&[0.02], &[0.0, 1.5e-3], &QUICK, quick);
            return [
                ("slice", slice),
                ("wide", Self::new(&[], &wide, &WIDE, quick)),
            ];
        }
        let half = [3e-3, 7e-3, 0.013, 0.021, 0.033, 0.048];
        let slice = Self::new(&half, &[-2e-3, 5e-4, 3e-3], &BENT, quick);
        let wide = Self::new(&[7e-3, 0.021], &wide, &WIDE, quick);
        [("slice", slice), ("wide", wide)]
    }

    fn points(&self) -> usize {
        self.extension.len() * self.bent.len()
    }
}

pub(super) fn compute(out: &Path, kt: f64, quick: bool) -> Result<Vec<Row>, String> {
    let folder = out.join("heat");
    std::fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let cell = cells::mean()?;
    let mut all = Vec::new();
    for ((name, axes), set) in HeatAxes::sets(quick).iter().zip(0..) {
        let path = |slice: usize| folder.join(format!("{name}-{slice:02}.csv"));
        all.extend(slices(&cell, kt, axes, set, path)?);
    }
    rows::write(&out.join("heat.csv"), &format!("kT {kt} pN nm"), &all)?;
    let largest = |k: usize| all.iter().map(|row| row.errors[k]).fold(0.0, f64::max);
    let positive = all.iter().filter(|row| row.least_stiffness() > 0.0);
    println!(
        "heat: {} points, tangent positive at {}; largest standard errors {:.1?} (pN nm, pN)",
        all.len(),
        positive.count(),
        std::array::from_fn::<f64, 6, _>(largest)
    );
    Ok(all)
}

fn slices(
    cell: &Cell,
    kt: f64,
    axes: &HeatAxes,
    set: u64,
    path: impl Fn(usize) -> PathBuf,
) -> Result<Vec<Row>, String> {
    let parameters = EllipsoidParameters::default();
    let mut all = Vec::new();
    // Slices are sequential, since the points of each are computed in parallel.
    for (i, twist) in axes.twist.iter().enumerate() {
        let key = format!("version {VERSION}, {parameters:?}, kT {kt}, {axes:?}, {twist}");
        let first = STREAMS * (SLICES * set + i as u64 + 1);
        let rows = rows::cached(&path(i), &key, Some(axes.points()), || {
            slice(cell, kt, axes, i, first)
        })?;
        all.extend(rows);
    }
    Ok(all)
}

fn slice(
    cell: &Cell,
    kt: f64,
    axes: &HeatAxes,
    number: usize,
    first: u64,
) -> Result<Vec<Row>, String> {
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
        Ok(row(point, extension, &response))
    });
    let rows = rows.collect::<Result<Vec<Row>, String>>()?;
    println!(
        "twist {twist} /nm: free filament stretched by {:.5}, {} points",
        natural.stretch,
        rows.len()
    );
    Ok(rows)
}

fn sample(
    cell: &Cell,
    point: [f64; 5],
    straight: &Displacements,
    heat: &Heat,
) -> Result<HeatResponse, String> {
    let [curvature, twist, shear, stretch, angle] = point;
    let strain = strain([curvature, twist, shear, stretch, angle.to_radians()]);
    // A relaxed state is closer to typical states than the straight state.
    let relaxed = cell.relax(&strain, Some(straight));
    let start = relaxed.as_ref().map_or(straight, |r| &r.displacements);
    let controls = std::array::from_fn(|k| Control::Strain(strain[k]));
    cell.sample(&controls, heat, Some((&strain, start)))
        .map_err(|e| e.to_string())
}

fn row(strain: [f64; 5], extension: f64, response: &HeatResponse) -> Row {
    Row {
        strain,
        extension,
        // A free energy would require a path; the loads contain the same information.
        energy: f64::NAN,
        loads: response.loads,
        tangent: response.tangent,
        errors: response.loads_error,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
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
                .map(|row| row.loads)
                .collect::<Vec<_>>()
        };
        assert_eq!(with(1), with(3));
    }
}
