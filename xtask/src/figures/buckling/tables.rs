//! The tables behind the rows and pictures: every equilibrium with its certificate, and every
//! centre line that is drawn.

use super::lists::Plan;
use super::outcome::Outcome;
use super::results::Results;
use super::rows::artefact;
use crate::figures::report::write_csv;
use std::path::Path;

const COLUMNS: [&str; 23] = [
    "rods",
    "clamp",
    "bonds_per_interface",
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
    "rod_nm",
];

/// Writes `figN.csv` and `figN_centre_lines.csv`.
pub(super) fn write(plan: &Plan, results: &Results, out: &Path) -> Result<(), String> {
    let id = artefact(plan.figure);
    let all = results.outcomes.iter().map(columns);
    write_csv(out, &format!("{id}.csv"), &COLUMNS, all)?;
    let drawn = results.outcomes.iter().filter(|o| o.case.seed == 0);
    let points = drawn.flat_map(|o| {
        let [rods, clamp, bonds, turn, case] = identity(o);
        let key = [rods, clamp, bonds, turn, case, o.case.start.name()];
        o.measured.centre_line.iter().map(move |p| {
            let mut row = key.to_vec();
            row.extend(p.map(number));
            row
        })
    });
    let header = [
        "rods",
        "clamp",
        "bonds_per_interface",
        "turn_deg",
        "case",
        "start",
        "x_nm",
        "y_nm",
        "z_nm",
    ];
    write_csv(out, &format!("{id}_centre_lines.csv"), &header, points)
}

fn identity(o: &Outcome) -> [String; 5] {
    let rods = if o.case.group.extended {
        "extended"
    } else {
        "constant"
    };
    [
        rods.into(),
        format!("{:?}", o.case.group.hold),
        o.case.group.bonds.to_string(),
        o.case.turn_deg.to_string(),
        o.case.resolved.name(),
    ]
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
    row.extend([
        m.beyond_per_nm.map_or(String::new(), number),
        o.is_stable().to_string(),
        o.negative.to_string(),
        o.unresolved.to_string(),
        number(o.residual.0),
        number(o.residual.1),
        o.iterations.to_string(),
        o.points.to_string(),
        number(o.case.resolved.rod_nm()),
    ]);
    row
}

fn number(x: f64) -> String {
    format!("{x:.9e}")
}
