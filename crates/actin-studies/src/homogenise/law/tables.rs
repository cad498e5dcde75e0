//! Tables of the errors of a law.

use super::super::region::Region;
use super::super::rows::Row;
use super::RANGE;
use super::weights::strain_sums;
use actin_cosserat::Homogenised;
use actin_sim::ellipsoid::SixVector;
use std::fmt::Write as _;

/// Number of independent strains at which the tangent is checked.
const LOOKS: u64 = 20_000;

/// Kinds of cells under loads, in the order of the table.
const KINDS: [&str; 6] = [
    "pulled",
    "neither",
    "pushed",
    "sheared",
    "strongly sheared",
    "strongly bent",
];
/// Shear from which cells within the range are listed apart.
const SHEARED: f64 = 0.015;

fn kind(row: &Row) -> &'static str {
    let [curvature, _, shear, ..] = row.strain;
    let kind = match row.loads[5] {
        _ if curvature > RANGE.curvature => 5,
        _ if shear > RANGE.shear => 4,
        _ if shear > SHEARED => 3,
        n if n > 0.1 => 0,
        n if n < -0.1 => 2,
        _ => 1,
    };
    KINDS[kind]
}

/// Returns the relative excess of strains of the law under given loads, for validation cells: median, which cancels
/// differences between sampled bonds, and 90th percentile of the magnitude.
pub(super) fn under_loads(law: &Homogenised, rows: &[Row]) -> String {
    let mut table = String::from("\n| cells | number | bending | twist | shear | stretch |\n");
    let _ = writeln!(table, "| --- |{}", " ---: |".repeat(5));
    for name in KINDS {
        let here: Vec<[f64; 4]> = rows
            .iter()
            .filter(|row| kind(row) == name)
            .map(|row| more(law, row))
            .collect();
        let column = |k: usize| {
            let sorted = |of: fn(f64) -> f64| {
                let mut all: Vec<f64> = here.iter().map(|more| 100.0 * of(more[k])).collect();
                all.sort_by(f64::total_cmp);
                all
            };
            let (signed, sizes) = (sorted(f64::from), sorted(f64::abs));
            format!(
                "{:+.1}, {:.1} %",
                signed[here.len() / 2],
                sizes[here.len() * 9 / 10]
            )
        };
        if !here.is_empty() {
            let columns = [0, 1, 2, 3].map(column).join(" | ");
            let _ = writeln!(table, "| {name} | {} | {columns} |", here.len());
        }
    }
    table
}

fn more(law: &Homogenised, row: &Row) -> [f64; 4] {
    let off = row.loads - law.loads(&row.six());
    let sums = strain_sums(row);
    let by = |k: usize| sums[k].dot(&off);
    let [_, twist, _, stretch, angle] = row.strain;
    let (sin, cos) = angle.to_radians().sin_cos();
    [
        cos * by(0) + sin * by(1),
        by(2) * twist.signum(),
        by(3),
        by(5) * stretch.signum(),
    ]
}

/// Counts independent strains with a positive tangent, within the range and within twice the range.
/// Counts strained cells for which the tangents of cell and law are positive.
pub(super) fn stability(law: &Homogenised, cells: &[Row]) -> String {
    let mut text = String::new();
    let twice = |x: f64| 2.0 * x;
    let sizes = [RANGE.curvature, RANGE.twist, RANGE.shear];
    let beyond = Region::new(sizes.map(twice), RANGE.extension.map(twice));
    for (name, region) in [("the range", RANGE), ("twice the range", beyond)] {
        let strains = region.strains(law.form(), LOOKS, LOOKS);
        let least = |strain: &SixVector| law.tangent(strain).symmetric_eigenvalues().min();
        let least: Vec<f64> = strains.iter().map(least).collect();
        let positive = least.iter().filter(|x| **x > 0.0).count();
        let _ = writeln!(
            text,
            "\nwithin {name}: tangent positive at {positive} of {LOOKS} strains, least eigenvalue {:.1} pN",
            least.iter().copied().fold(f64::INFINITY, f64::min)
        );
    }
    let is_stable = |row: &&Row| row.least_stiffness() > 0.0;
    let of_cells = cells.iter().filter(is_stable).count();
    let of_both = cells.iter().filter(is_stable);
    let of_both = of_both.filter(|row| law.tangent(&row.six()).symmetric_eigenvalues().min() > 0.0);
    let _ = writeln!(
        text,
        "\nof {} strained cells {of_cells} have a positive tangent, of these the law at {}",
        cells.len(),
        of_both.count()
    );
    text
}
