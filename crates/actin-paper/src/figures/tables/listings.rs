//! Tables 3 and 5 as CSV: every kind with its scatter, and every filament with its evidence.

use super::ensemble::{Ensemble, Kind, value};
use crate::measure::TwistPoint;
use crate::published::{Entry, Table};
use actin_draw::report::write_csv;
use std::path::Path;

const ENSEMBLE_HEADER: [&str; 17] = [
    "anchors",
    "bonds",
    "way",
    "direction",
    "phi_deg",
    "kappa3_rad_per_nm",
    "paper_calls_it",
    "paper",
    "mean",
    "sd",
    "low",
    "high",
    "paper_minus_mean_over_sd",
    "samplings",
    "saddles",
    "neutral",
    "off_the_branch",
];

/// Writes both listings of a table.
pub(super) fn write(
    table: Table,
    ensemble: &Ensemble,
    entries: &[Entry],
    out: &Path,
) -> Result<(), String> {
    let kinds = ensemble.kinds();
    let rows = kinds.iter().flat_map(|&kind| {
        let row = move |entry| ensemble_row(table, ensemble, kind, entry);
        entries.iter().map(row)
    });
    let name = format!("{}.csv", table.id());
    write_csv(out, &name, &ENSEMBLE_HEADER, rows)?;
    let mut rows = Vec::new();
    for &kind in &kinds {
        for entry in entries {
            let points = ensemble.points(kind, entry);
            rows.extend(
                points
                    .iter()
                    .map(|(seed, p)| point_row(table, kind, *seed, p)),
            );
        }
    }
    let name = format!("{}_samplings.csv", table.id());
    write_csv(out, &name, &point_header(table), rows)
}

/// A kind at an entry, paper beside ours.
fn ensemble_row(table: Table, ensemble: &Ensemble, kind: Kind, entry: &Entry) -> Vec<String> {
    let s = ensemble.sample(kind, entry, table);
    let doubts = ensemble.doubts(kind, std::slice::from_ref(entry));
    let verdict = if entry.is_reliable() {
        "reliable"
    } else {
        "unreliable"
    };
    let mut row = kind_cells(kind).to_vec();
    row.extend([
        entry.direction().to_owned(),
        entry.phi_deg.to_string(),
        entry.curvature.to_string(),
        verdict.to_owned(),
    ]);
    let numbers = [entry.value, s.mean, s.sd, s.low, s.high];
    row.extend(numbers.map(|x| format!("{x:.6e}")));
    // The mean filament has no scatter.
    row.push(if s.count > 1 {
        format!("{:.2}", (entry.value - s.mean) / s.sd)
    } else {
        String::new()
    });
    let counts = [
        s.count,
        doubts.saddles,
        doubts.neutral,
        doubts.off_the_branch,
    ];
    row.extend(counts.map(|n| n.to_string()));
    row
}

fn kind_cells(kind: Kind) -> [String; 3] {
    [
        kind.anchors_name().to_owned(),
        kind.bonds.to_string(),
        kind.way().to_owned(),
    ]
}

fn point_header(table: Table) -> [&'static str; 14] {
    [
        "anchors",
        "bonds",
        "way",
        "seed",
        "turn_deg",
        "kappa3_rad_per_nm",
        "torque_pn_nm",
        table.quantity(),
        "residual_pn",
        "residual_pn_nm",
        "negative_eigenvalues",
        "unresolved_eigenvalues",
        "saddles_left",
        "jumps",
    ]
}

/// A filament at an angle.
fn point_row(table: Table, kind: Kind, seed: u64, point: &TwistPoint) -> Vec<String> {
    let e = &point.evidence;
    let mut row = kind_cells(kind).to_vec();
    row.extend([
        seed.to_string(),
        format!("{:.6}", point.turn_deg),
        format!("{:.6}", point.curvature_rad_per_nm),
        format!("{:.6e}", point.torque_pn_nm),
        format!("{:.6e}", value(point, table)),
        format!("{:.1e}", e.residual_force_pn),
        format!("{:.1e}", e.residual_torque_pn_nm),
    ]);
    let counts = [
        e.certificate.negative,
        e.certificate.unresolved,
        e.saddles_left,
        e.jumps,
    ];
    row.extend(counts.map(|n| n.to_string()));
    row
}
