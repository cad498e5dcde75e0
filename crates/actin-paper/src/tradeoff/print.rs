//! The short table of a scene, and the rows that `actin check` learns from.

use super::row::Row;
use super::study::names;
use crate::Tell;
use actin_sim::advice::Measured;
use std::path::Path;

/// Prints the rows of one scene, fastest first.
pub(super) fn table(rows: &[Row], tell: Tell<'_>) {
    let Some(first) = rows.first() else {
        return;
    };
    heading(first, tell);
    let mut sorted: Vec<&Row> = rows.iter().collect();
    let cost = |row: &Row| row.time_motion.unwrap_or(f64::INFINITY);
    sorted.sort_by(|a, b| cost(a).total_cmp(&cost(b)));
    for row in sorted {
        line(row, tell);
    }
}

fn heading(first: &Row, tell: Tell<'_>) {
    tell(format_args!(
        "{}: sd over filaments of 64 drawn bonds in %: displacement {}, energy {}, force {}, torque {}, local {}",
        first.scene,
        percent(first.scatter_displacement),
        percent(first.scatter_energy),
        percent(first.scatter_force),
        percent(first.scatter_torque),
        percent(first.scatter_local),
    ));
    let columns = [
        "cost", "motion", "x drawn", "statics", "steps", "evals", "displ.", "energy", "force",
        "torque", "local",
    ];
    let columns = columns.map(|name| format!("{name:>9}")).concat();
    tell(format_args!("{:>34}{columns} (rms errors, %)", "setting"));
}

fn line(row: &Row, tell: Tell<'_>) {
    let number =
        |value: Option<f64>, digits: usize| value.map_or("-".into(), |v| format!("{v:.digits$}"));
    let columns = [
        number(row.cost_motion, 4),
        number(row.time_motion, 4),
        number(row.drawn_over_time, 1),
        number(row.time_relative, 3),
        number(row.newton_steps, 1),
        number(row.force_evaluations, 0),
        percent(row.error_displacement),
        percent(row.error_energy),
        percent(row.error_force),
        percent(row.error_torque),
        percent(row.error_local),
    ];
    let columns = columns.map(|column| format!("{column:>9}")).concat();
    let front = if row.on_front { " *" } else { "" };
    let trouble = match (row.doubtful, row.failed) {
        (0, 0) => String::new(),
        (n, 0) => format!(" ({n} not certified)"),
        (n, failed) => format!(" ({n} not certified, {failed} without equilibrium)"),
    };
    tell(format_args!("{:>34}{columns}{front}{trouble}", row.setting));
}

fn percent(value: Option<f64>) -> String {
    let of = |v: f64| match v {
        0.0 => "0".to_owned(),
        v if v < 1e-4 => format!("{:.0e}", 100.0 * v),
        v => format!("{:.2}", 100.0 * v),
    };
    value.map_or("-".to_owned(), of)
}

/// Writes `advice.csv`: what `crates/actin-sim/src/advice/measured.csv` is a copy of.
pub(super) fn write_advice(rows: &[Row], out: &Path) -> Result<(), String> {
    let path = out.join("advice.csv");
    let mut csv = csv::Writer::from_path(&path).map_err(|e| format!("{}: {e}", path.display()))?;
    for row in advice(rows) {
        csv.serialize(row).map_err(|e| e.to_string())?;
    }
    csv.flush().map_err(|e| e.to_string())
}

/// The rows of equilibria, as a table of the library.
pub(super) fn advice(rows: &[Row]) -> Vec<Measured> {
    let of_scenes = rows
        .iter()
        .filter(|row| names().contains(&row.scene.as_str()));
    let measured = of_scenes.filter(|row| row.factor != "reference" && !row.rigid_segments);
    measured
        .map(|row| Measured {
            scene: row.scene.clone(),
            monomers_nm: row.monomers_nm.clone(),
            law: row.law.clone(),
            segment_nm: row.segment_nm,
            bonds: row.bonds_per_interface,
            weight: row.weight.clone(),
            attached: row.attached,
            azimuths: row.azimuths,
            displacement: rounded(row.error_displacement),
            energy: rounded(row.error_energy),
            force: rounded(row.error_force),
            torque: rounded(row.error_torque),
            local: rounded(row.error_local),
            scatter: rounded(row.scatter_displacement),
        })
        .collect()
}

/// Four digits after the point: errors are expected to a percent, at best.
fn rounded(value: Option<f64>) -> Option<f64> {
    value.map(|v| (v * 1e4).round() / 1e4)
}
