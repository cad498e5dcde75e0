//! The law `Homogenised` of rods fitted to the grid: what each term brings, and how it does on strains and
//! bonds that entered nothing.

use super::axes::Axes;
use super::filament::{self, PERIOD, mean, strain, twisted};
use super::rows::Row;
use crate::Tell;
use actin_cosserat::{EnergyAndLoads, Homogenised, HomogenisedForm, Term};
use actin_fit::{Mat, Observations, fit_linear};
use actin_sim::ellipsoid::Cell;
use rayon::prelude::*;
use std::fmt::Write as _;
use std::path::Path;

/// Largest curvature (rad/nm) and shear, least extension, of the points that are fitted.
const RANGE: (f64, f64, f64) = (0.0101, 0.0151, -6e-4);
/// Nodes beyond the twists of the grid, where slopes of the couple alone say anything (rad/nm).
const OUTER: f64 = 0.06;
/// Points that are fitted, about.
const POINTS: usize = 3000;
/// What counts as a difference of 1: a share of the value, and energy (pN), couple (pN nm), shear force and
/// tension (pN).
const SHARE: f64 = 0.05;
const FLOORS: [f64; 4] = [0.02, 3.0, 0.3, 2.0];
/// Other strains of the mean filament, and of each drawn one.
const OTHERS: u64 = 400;
const OF_DRAWN: u64 = 60;

/// Terms in the order in which they are tried.
const STEPS: [(&str, &[Term]); 9] = [
    (
        "twist, stretch, bending",
        &[Term::Twist, Term::Stretch, Term::Bend],
    ),
    ("shear", &[Term::Shear]),
    (
        "shear under tension",
        &[Term::StretchShear, Term::ShearTwice],
    ),
    ("bend-shear coupling", &[Term::Coupling]),
    (
        "bending shifts the axis",
        &[Term::BendRoot, Term::StretchBend],
    ),
    (
        "compression",
        &[Term::Compression, Term::TensionBend, Term::TensionShear],
    ),
    ("bending with tension squared", &[Term::StretchTwiceBend]),
    ("bending with shear", &[Term::BendShear]),
    (
        "coupling with both",
        &[Term::BendCoupling, Term::ShearCoupling],
    ),
];

/// Fits, prints and writes.
pub(super) fn run(
    out: &Path,
    axes: &Axes,
    grid: &[Row],
    samplings: u64,
    tell: Tell<'_>,
) -> Result<(), String> {
    let cell = mean()?;
    let form = form(&cell, axes, grid)?;
    let (fitted, outside): (Vec<&Row>, Vec<&Row>) = grid.iter().partition(|row| is_in_range(row));
    let (law, mut table) = stepwise(&form, &fitted)?;
    let others = other_rows(&cell, axes, 1, OTHERS)?;
    let mut drawn = Vec::new();
    for seed in 1..=samplings {
        let cell = filament::drawn(seed, 2 * PERIOD)?;
        drawn.extend(other_rows(&cell, axes, seed, OF_DRAWN)?);
    }
    let cases = [
        ("other strains", others.iter().collect()),
        ("drawn bonds", drawn.iter().collect()),
        ("beyond the range", outside),
    ];
    for (name, rows) in cases {
        let residuals = Residuals::of(&law, rows);
        let _ = writeln!(table, "| {name} | {}", residuals.printed());
    }
    table.push_str(&by_twist(&law, axes, &fitted));
    tell(format_args!("{table}"));
    let write = |file: &str, text: String| {
        let path = out.join(file);
        std::fs::write(&path, text).map_err(|e| format!("{}: {e}", path.display()))
    };
    write("law.md", table)?;
    write("law.csv", coefficients(&law))
}

/// The law with all terms, and a table of what each step brings.
fn stepwise(form: &HomogenisedForm, rows: &[&Row]) -> Result<(Homogenised, String), String> {
    let training = thinned(rows);
    let mut table = String::from(
        "| terms | energy | couple | twisting couple | shear force | tension | tangent | positive |\n",
    );
    let _ = writeln!(table, "| --- |{}", " ---: |".repeat(7));
    let mut terms: Vec<Term> = Vec::new();
    let mut law = None;
    for (name, more) in STEPS {
        terms.extend(more);
        let found = fit(form, &terms, &training)?;
        let residuals = Residuals::of(&found, rows.iter().copied());
        let _ = writeln!(table, "| + {name} | {}", residuals.printed());
        law = Some(found);
    }
    Ok((law.ok_or("no terms")?, table))
}

/// Whether a point is fitted.
fn is_in_range(row: &Row) -> bool {
    let (curvature, shear, extension) = RANGE;
    row.strain[0] <= curvature && row.strain[2] <= shear && row.extension >= extension
}

/// So many of the rows that they are fitted in seconds, spread evenly: every so many of them would leave out
/// values of the axes.
fn thinned<'a>(rows: &[&'a Row]) -> Vec<&'a Row> {
    let share = POINTS as f64 / rows.len() as f64;
    let kept = rows
        .iter()
        .zip(1..)
        .filter(|&(_, k)| evenly::<1>(k)[0] < share);
    kept.map(|(row, _)| *row).collect()
}

/// The form with the twists of the grid and one beyond on each side.
fn form(cell: &Cell, axes: &Axes, grid: &[Row]) -> Result<HomogenisedForm, String> {
    let natural = |twist: f64| {
        let found = grid
            .iter()
            .find(|row| row.strain[1].total_cmp(&twist).is_eq());
        match found {
            Some(row) => Ok(row.strain[3] - row.extension),
            None => twisted(cell, twist).map(|response| response.strain[5]),
        }
    };
    let mut nodes = vec![-OUTER];
    nodes.extend(&axes.twist);
    nodes.push(OUTER);
    let lengths: Vec<f64> = nodes
        .iter()
        .map(|&twist| natural(twist))
        .collect::<Result<_, _>>()?;
    HomogenisedForm::new(&nodes, &lengths).map_err(|e| e.to_string())
}

/// Energy and loads in one list.
fn numbers((energy, loads): &EnergyAndLoads) -> [f64; 7] {
    [
        *energy, loads[0], loads[1], loads[2], loads[3], loads[4], loads[5],
    ]
}

/// What counts as a difference of 1 in each of the numbers of a row.
fn deviations(row: &Row) -> [f64; 7] {
    let [energy, couple, force, tension] = FLOORS;
    let m = couple + SHARE * row.loads.fixed_rows::<2>(0).norm();
    let m3 = couple + SHARE * row.loads[2].abs();
    let n = force + SHARE * row.loads.fixed_rows::<2>(3).norm();
    let n3 = tension + SHARE * row.loads[5].abs();
    [energy + SHARE * row.energy, m, m, m3, n, n, n3]
}

/// The coefficients of the terms that fit best; the others are zero.
fn fit(form: &HomogenisedForm, terms: &[Term], rows: &[&Row]) -> Result<Homogenised, String> {
    let nodes = form.nodes().len();
    let columns = nodes * terms.len();
    let mut design = Mat::zeros(7 * rows.len(), columns);
    let (mut values, mut sizes) = (Vec::new(), Vec::new());
    for (i, row) in rows.iter().enumerate() {
        let strain = row.six();
        for (k, &term) in terms.iter().enumerate() {
            for (node, unit) in form.units(term, &strain).iter().enumerate() {
                for (q, number) in numbers(unit).into_iter().enumerate() {
                    design[(7 * i + q, nodes * k + node)] = number;
                }
            }
        }
        values.extend(numbers(&(row.energy, row.loads)));
        sizes.extend(deviations(row));
    }
    let observations = Observations::new(&values)
        .and_then(|o| o.with_deviations(&sizes))
        .map_err(|e| e.to_string())?;
    let found = fit_linear(design.as_ref(), &observations).map_err(|e| e.to_string())?;
    let coefficient = |term: Term, node: usize| {
        let place = terms.iter().position(|other| *other == term);
        place.map_or(0.0, |k| found.parameters[nodes * k + node])
    };
    Homogenised::new(form.clone(), coefficient).map_err(|e| e.to_string())
}

/// Root mean squares of the differences between a law and rows, in units of what counts as 1.
struct Residuals {
    numbers: [f64; 7],
    /// Of entries of the tangent over the roots of the rows' diagonal ones.
    tangent: f64,
    /// Share of the points where the tangent of the law is positive.
    positive: f64,
}

impl Residuals {
    fn of<'a>(law: &Homogenised, rows: impl IntoIterator<Item = &'a Row>) -> Self {
        let mut sums = [0.0; 7];
        let (mut tangents, mut entries, mut positive, mut count) = (0.0, 0.0, 0.0, 0.0);
        for row in rows {
            let strain = row.six();
            let law_numbers = numbers(&(law.energy_density(&strain), law.loads(&strain)));
            let ours = numbers(&(row.energy, row.loads));
            for (q, size) in deviations(row).into_iter().enumerate() {
                sums[q] += ((law_numbers[q] - ours[q]) / size).powi(2);
            }
            let tangent = law.tangent(&strain);
            let is_firm = (0..6).all(|k| row.tangent[(k, k)] > FIRM[k]);
            for (i, j) in (0..6)
                .flat_map(|i| (0..6).map(move |j| (i, j)))
                .filter(|_| is_firm)
            {
                let size = (row.tangent[(i, i)] * row.tangent[(j, j)]).sqrt();
                tangents += ((tangent[(i, j)] - row.tangent[(i, j)]) / size).powi(2);
                entries += 1.0;
            }
            positive += f64::from(u8::from(tangent.symmetric_eigenvalues().min() > 0.0));
            count += 1.0;
        }
        Self {
            numbers: sums.map(|sum: f64| (sum / count).sqrt()),
            tangent: (tangents / f64::max(entries, 1.0)).sqrt(),
            positive: positive / count,
        }
    }

    fn printed(&self) -> String {
        let [w, m1, m2, m3, n1, n2, n3] = self.numbers;
        let both = |a: f64, b: f64| (0.5 * (a * a + b * b)).sqrt();
        format!(
            "{w:.2} | {:.2} | {m3:.2} | {:.2} | {n3:.2} | {:.3} | {:.1} % |",
            both(m1, m2),
            both(n1, n2),
            self.tangent,
            100.0 * self.positive
        )
    }
}

/// Diagonal entries of the tangent (pN nm^2, pN) below which a state counts as one of no stiffness, where
/// relative differences say nothing.
const FIRM: [f64; 6] = [1e3, 1e3, 500.0, 30.0, 30.0, 1e3];

/// The `k`-th of a sequence of points that fill the unit cube evenly.
///
/// # Source
/// M. Roberts, The unreasonable effectiveness of quasirandom sequences (2018): an additive recurrence with the
/// powers of the root of `x^(N+1) = x + 1`.
fn evenly<const N: usize>(k: u64) -> [f64; N] {
    let mut root: f64 = 1.5;
    for _ in 0..60 {
        root = (1.0 + root).powf(1.0 / (N as f64 + 1.0));
    }
    let mut step = 1.0;
    std::array::from_fn(|_| {
        step /= root;
        (0.5 + k as f64 * step).fract()
    })
}

/// Strains within the range that are no points of the grid, others for each `seed`.
fn other_rows(cell: &Cell, axes: &Axes, seed: u64, count: u64) -> Result<Vec<Row>, String> {
    let last = |values: &[f64]| values[values.len() - 1];
    let (curvature, shear, _) = RANGE;
    let (twist, stretch) = (last(&axes.twist), last(&axes.extension).min(3e-3));
    let draw = |k: u64| {
        let [a, b, c, d, e] = evenly(k);
        // Small twists and extensions are more common than large ones.
        let side: f64 = 2.0 * b - 1.0;
        let point = [
            curvature * a,
            twist * side * side * side,
            shear * c,
            0.0,
            360.0 * d,
        ];
        (point, stretch * e * e)
    };
    let first = seed * count + 1;
    let points: Vec<([f64; 5], f64)> = (first..first + count).map(draw).collect();
    let mean = mean()?;
    let row = |&(mut point, extension): &([f64; 5], f64)| {
        let natural = twisted(&mean, point[1])?;
        point[3] = natural.strain[5] + extension;
        let own = twisted(cell, point[1])?;
        let [k, twist, shear, stretch, angle] = point;
        let strain = strain([k, twist, shear, stretch, angle.to_radians()]);
        let response = cell
            .relax(&strain, Some(&own.displacements))
            .map_err(|e| e.to_string())?;
        Ok(Row::new(point, extension, &response))
    };
    points.par_iter().map(row).collect()
}

/// Residuals at each twist, and where the tangents of cell and law are not positive.
fn by_twist(law: &Homogenised, axes: &Axes, rows: &[&Row]) -> String {
    let mut table = String::from(
        "\n| twist (rad/nm) | energy | couple | twisting couple | shear force | tension | tangent | positive \
         | cell positive |\n",
    );
    let _ = writeln!(table, "| ---: |{}", " ---: |".repeat(8));
    for twist in &axes.twist {
        let here = rows
            .iter()
            .filter(|row| row.strain[1].total_cmp(twist).is_eq());
        let here: Vec<&Row> = here.copied().collect();
        let firm = here
            .iter()
            .filter(|row| row.least_stiffness() > 0.0)
            .count();
        let _ = writeln!(
            table,
            "| {twist} | {} {:.1} % |",
            Residuals::of(law, here.iter().copied()).printed(),
            100.0 * firm as f64 / here.len() as f64
        );
    }
    table
}

/// The law as a table: natural lengths, then one row per node with all coefficients.
fn coefficients(law: &Homogenised) -> String {
    let mut text = String::from("twist_per_nm,natural_stretch");
    for term in Term::ALL {
        let _ = write!(text, ",{term:?}");
    }
    text.push('\n');
    let nodes = law.form().nodes();
    for (k, &twist) in nodes.iter().enumerate() {
        let _ = write!(text, "{twist},{:e}", law.form().natural_stretch(twist));
        for term in Term::ALL {
            let _ = write!(text, ",{:e}", law.coefficient(term, k));
        }
        text.push('\n');
    }
    text
}
