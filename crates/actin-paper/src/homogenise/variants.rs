//! What must not matter: size of the cell, what ties it to its axis, number of samplings.

use super::filament::{self, PERIOD, strain, twisted};
use super::scatter::{STATES, State, of_drawn};
use crate::Tell;
use actin_sim::ellipsoid::{Cell, CellResponse, EllipsoidParameters, Hold};
use rayon::prelude::*;
use std::fmt::Write as _;
use std::path::Path;

/// Prints and writes the table: the largest differences of energy and loads over some states.
pub(super) fn run(out: &Path, samplings: u64, tell: Tell<'_>) -> Result<(), String> {
    let of = |monomers, hold| filament::of(EllipsoidParameters::default(), monomers, hold);
    let base = responses(&of(PERIOD, Hold::Means)?, 0.0)?;
    let variants = [
        ("cell of 26", of(2 * PERIOD, Hold::Means)?, 0.0),
        ("cell of 52", of(4 * PERIOD, Hold::Means)?, 0.0),
        ("hold AxisPoints", of(PERIOD, Hold::AxisPoints)?, 0.0),
        ("hold Places", of(PERIOD, Hold::Places)?, 0.0),
        ("turned by 10 deg", of(PERIOD, Hold::Means)?, 10.0),
        ("turned by 45 deg", of(PERIOD, Hold::Means)?, 45.0),
        ("turned by 90 deg", of(PERIOD, Hold::Means)?, 90.0),
    ];
    let mut table = String::from("| variant |");
    for state in &STATES {
        let _ = write!(table, " {} |", state.name);
    }
    let _ = writeln!(table, "\n| --- |{}", " ---: |".repeat(STATES.len()));
    let rows = variants.par_iter().map(|(name, cell, turn)| {
        let varied = responses(cell, *turn)?;
        let mut row = format!("| {name}, energy, loads |");
        for (a, b) in base.iter().zip(&varied) {
            let energy = (b.energy / a.energy - 1.0).abs();
            let _ = write!(row, " {energy:.0e}, {:.0e} |", of_loads(a, b, *turn));
        }
        Ok(row + "\n")
    });
    for row in rows.collect::<Result<Vec<String>, String>>()? {
        table.push_str(&row);
    }
    table.push_str(&many_samplings(samplings, &base)?);
    tell(format_args!("{table}"));
    let path = out.join("variants.md");
    std::fs::write(&path, table).map_err(|e| format!("{}: {e}", path.display()))
}

/// Responses in all states, turned about the axis.
fn responses(cell: &Cell, turn_deg: f64) -> Result<Vec<CellResponse>, String> {
    STATES
        .iter()
        .map(|state| state.relax(cell, turn_deg))
        .collect()
}

/// Largest difference of a load as a share of the largest of its kind.
fn of_loads(a: &CellResponse, b: &CellResponse, turn_deg: f64) -> f64 {
    let (sin, cos) = turn_deg.to_radians().sin_cos();
    let mut turned = b.loads;
    for k in [0, 3] {
        turned[k] = cos * b.loads[k] + sin * b.loads[k + 1];
        turned[k + 1] = cos * b.loads[k + 1] - sin * b.loads[k];
    }
    let difference = turned - a.loads;
    let share = |k| difference.rows(k, 3).amax() / a.loads.rows(k, 3).amax().max(1e-3);
    f64::max(share(0), share(3))
}

/// Means over drawn bonds, of some and of twice as many samplings.
fn many_samplings(samplings: u64, base: &[CellResponse]) -> Result<String, String> {
    let all = of_drawn(2 * samplings, 2 * PERIOD)?;
    let mut text = String::new();
    for some in [&all[..all.len() / 2], &all[..]] {
        let count = some.len();
        let _ = write!(
            text,
            "| mean energy of {count} samplings of drawn bonds, cell of 26 |"
        );
        for (k, mean) in base.iter().enumerate() {
            let drawn: f64 = some.iter().map(|one| one[k].energy).sum();
            let share = drawn / count as f64 / mean.energy - 1.0;
            let _ = write!(text, " {share:+.4} |");
        }
        text.push('\n');
    }
    Ok(text)
}

impl State {
    /// The response of a cell, whose strain is turned about the axis first.
    pub(super) fn relax(&self, cell: &Cell, turn_deg: f64) -> Result<CellResponse, String> {
        let [curvature, twist, shear, extension, angle] = self.strain;
        let natural = twisted(cell, twist)?;
        let stretch = natural.strain[5] + extension;
        let plain = strain([curvature, twist, shear, stretch, angle.to_radians()]);
        let (sin, cos) = turn_deg.to_radians().sin_cos();
        let mut strain = plain;
        for k in [0, 3] {
            strain[k] = cos * plain[k] - sin * plain[k + 1];
            strain[k + 1] = sin * plain[k] + cos * plain[k + 1];
        }
        cell.relax(&strain, Some(&natural.displacements))
            .map_err(|e| e.to_string())
    }
}
