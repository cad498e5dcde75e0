//! The tables behind the rows and pictures: every equilibrium with its certificate, and every
//! centre line that is drawn.

use super::lists::Plan;
use super::outcome::{Evidence, Outcome};
use super::results::Results;
use actin_draw::report::write_csv;
use std::path::Path;

const COLUMNS: [&str; 26] = [
    "rods",
    "clamp",
    "junction",
    "bonds",
    "turn_deg",
    "case",
    "seed",
    "start",
    "height_nm",
    "couple_pn_nm",
    "force_pn",
    "energy_pn_nm",
    "link_turns",
    "twist_turns",
    "writhe",
    "beyond_data_per_nm",
    "stable",
    "negative_eigenvalues",
    "unresolved_eigenvalues",
    "residual_pn",
    "residual_pn_nm",
    "newton_iterations",
    "equilibria_on_path",
    "time_ns",
    "force_evaluations",
    "rod_nm",
];

/// Writes `figN.csv` and `figN_centre_lines.csv`.
pub(super) fn write(plan: &Plan, results: &Results, out: &Path) -> Result<(), String> {
    let id = plan.figure.id();
    let all = results.outcomes.iter().map(columns);
    write_csv(out, &format!("{id}.csv"), &COLUMNS, all)?;
    let drawn = results.outcomes.iter().filter(|o| o.case.seed == 0);
    let points = drawn.flat_map(|o| {
        let mut key = identity(o).to_vec();
        key.push(o.case.start.name());
        o.measured.centre_line.iter().map(move |p| {
            let mut row = key.clone();
            row.extend(p.map(number));
            row
        })
    });
    let header = [
        "rods", "clamp", "junction", "bonds", "turn_deg", "case", "start", "x_nm", "y_nm", "z_nm",
    ];
    write_csv(out, &format!("{id}_centre_lines.csv"), &header, points)
}

fn identity(o: &Outcome) -> [String; 6] {
    let group = o.case.group;
    [
        group.rods.name().into(),
        format!("{:?}", group.hold),
        format!("{:?}", group.weight),
        if group.mean { "weighted" } else { "drawn" }.into(),
        o.case.turn_deg.to_string(),
        o.case.resolved.name(),
    ]
}

/// Counts of the certificate and of its search, then time and work of a motion; empty where there are none.
fn evidence(o: &Outcome) -> ([String; 2], [String; 4]) {
    let none = String::new;
    match o.evidence {
        Evidence::Certificate {
            negative,
            unresolved,
            iterations,
            points,
        } => (
            [negative, unresolved].map(|n| n.to_string()),
            [iterations.to_string(), points.to_string(), none(), none()],
        ),
        Evidence::Motion {
            time_ns,
            force_evaluations,
        } => (
            [none(), none()],
            [
                none(),
                none(),
                number(time_ns),
                force_evaluations.to_string(),
            ],
        ),
    }
}

/// One outcome under [`COLUMNS`].
fn columns(o: &Outcome) -> Vec<String> {
    let m = &o.measured;
    let mut row = identity(o).to_vec();
    row.extend([o.case.seed.to_string(), o.case.start.name()]);
    row.extend(
        [
            m.height_nm,
            m.couple_pn_nm,
            m.force_pn,
            m.energy_pn_nm,
            m.link_turns,
            m.twist_turns,
            m.writhe,
        ]
        .map(number),
    );
    let (certificate, effort) = evidence(o);
    row.extend([
        m.beyond_per_nm.map_or(String::new(), number),
        o.is_stable().to_string(),
    ]);
    row.extend(certificate);
    row.extend([o.residual.0, o.residual.1].map(number));
    row.extend(effort);
    row.push(number(o.case.resolved.rod_nm()));
    row
}

fn number(x: f64) -> String {
    format!("{x:.9e}")
}
