//! The tables behind the rows and pictures of Figure 4.

use super::case::Result4;
use actin_draw::report::write_csv;
use std::path::Path;

/// Writes the tables behind the pictures.
pub(super) fn write(results: &[Result4], out: &Path) -> Result<(), String> {
    let table = |keep: fn(&Result4) -> &Vec<[f64; 3]>| -> Vec<Vec<String>> {
        let rows = results.iter().flat_map(|r| {
            let path = r.case.path();
            keep(r).iter().map(move |p| (path.clone(), *p))
        });
        rows.map(|(path, [x, y, z])| vec![path, number(x), number(y), number(z)])
            .collect()
    };
    let header = ["case", "x_nm", "y_nm", "z_nm"];
    let lines = table(|r| &r.centre_line);
    write_csv(out, "fig4_centre_lines.csv", &header, lines)?;
    write_csv(out, "fig4_monomers.csv", &header, table(|r| &r.monomers))?;
    let energies = results.iter().flat_map(|r| {
        let path = r.case.path();
        let rows = r.energy.iter();
        rows.map(move |(t, e)| vec![path.clone(), number(*t), number(*e)])
    });
    let header = ["case", "time_ns", "energy_pn_nm"];
    write_csv(out, "fig4_energy.csv", &header, energies)?;
    write_csv(out, "fig4.csv", &COLUMNS, results.iter().map(columns))
}

const COLUMNS: [&str; 7] = [
    "case",
    "tip_drop_nm",
    "energy_pn_nm",
    "residual_pn",
    "residual_pn_nm",
    "time_ns",
    "force_evaluations",
];

/// One result under [`COLUMNS`].
fn columns(r: &Result4) -> Vec<String> {
    vec![
        r.case.path(),
        number(r.tip_drop_nm),
        number(r.elastic_pn_nm()),
        number(r.residual.0),
        number(r.residual.1),
        number(r.time_ns),
        r.force_evaluations.to_string(),
    ]
}

fn number(x: f64) -> String {
    format!("{x:.9e}")
}
