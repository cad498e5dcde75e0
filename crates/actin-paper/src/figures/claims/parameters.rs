//! Numbers that Appendix B derives from Table 4's.

use super::{Holds, Known};
use actin_draw::report::{Origin, Row};
use actin_sim::{ellipsoid_constants as monomer, rod_constants as rod};
use std::f64::consts::PI;

/// Young's modulus of Appendix B (pN/nm^2).
const YOUNG: f64 = 330.0;
/// Factor by which stretching is stiffer than E A.
const STIFFER: f64 = 2.7;
/// Poisson's ratio of Table 2.
const POISSON: f64 = 0.4;
/// Persistence lengths that are measured (um).
const MEASURED_UM: (f64, f64) = (8.0, 20.0);

/// What follows from the rigidities; nothing if they are not all there.
pub(super) fn rigidities(known: &Known<'_>) -> Vec<Row> {
    let names = ["b1", "s3", "b3_min", "b3_max"];
    let rigidities = names.map(|name| Some((known.get(name)?, known.get(&format!("{name}/sd"))?)));
    let [Some(b1), Some(s3), Some(b3_min), Some(b3_max)] = rigidities else {
        return Vec::new();
    };
    let mut all = vec![young(known, b1), ratio(known, b1, s3)];
    let row = |name: &str, unit, ours, note: &str| Row::measured(known.id, name, unit, ours, note);
    let note = "mean of the largest B3 in under- and in over-twist, the constant of Figures 4 to 8; \
                tolerance: half a digit, and twice the mean of their sd";
    let mean = row("b3_mean", "pN nm^2", 0.5 * (b3_min.0 + b3_max.0), note);
    all.push(mean.against_printed("1.3e4", 0.5 * (b3_min.1 + b3_max.1)));
    all.extend(printed(known));
    let lengths = [
        ("persistence", "persistence_length_um", "B1/kBT"),
        (
            "persistence_thermal",
            "persistence_length_um/thermal",
            "from thermal motion",
        ),
    ];
    all.extend(
        lengths
            .into_iter()
            .filter_map(|(claim, name, how)| measured(known, claim, name, how)),
    );
    all
}

/// A persistence length is in the range that the paper cites.
fn measured(known: &Known<'_>, claim: &str, name: &str, how: &str) -> Option<Row> {
    let (least, most) = MEASURED_UM;
    let note = format!(
        "measured persistence lengths are {least} to {most} um; {how}, from the smaller on and up to the \
         larger"
    );
    let length = known.get(name)?;
    let mut within = known.claim(claim, "um", length, Holds::AtLeast(least), note);
    within.pass = Some((least..=most).contains(&length));
    Some(within)
}

fn inertia() -> f64 {
    rod::CROSS_SECTION_AREA.powi(2) / (4.0 * PI)
}

/// From `(mean, sd)` of B1.
fn young(known: &Known<'_>, (b1, sd): (f64, f64)) -> Row {
    let note =
        "B1 over A^2/4pi with A = 38.5 nm^2; tolerance: half a digit, and twice the sd of B1";
    let row = Row::measured(known.id, "young_modulus", "pN/nm^2", b1 / inertia(), note);
    row.against_printed("330", sd / inertia())
}

/// From `(mean, sd)` of B1 and S3.
fn ratio(known: &Known<'_>, b1: (f64, f64), s3: (f64, f64)) -> Row {
    let ratio = s3.0 / (b1.0 / inertia() * rod::CROSS_SECTION_AREA);
    let sd = ratio * (b1.1 / b1.0).hypot(s3.1 / s3.0);
    let note = "S3 over E A with E from B1; tolerance: half a digit, and twice the sd of the ratio";
    let row = Row::measured(known.id, "s3_over_ea", "", ratio, note);
    row.against_printed("2.7", sd)
}

/// Numbers of Appendix B that follow from others of it.
fn printed(known: &Known<'_>) -> [Row; 3] {
    let area = rod::CROSS_SECTION_AREA;
    let shear_modulus = YOUNG / (2.0 * (1.0 + POISSON));
    let row = |name: &str, unit, ours, note: &str| Row::measured(known.id, name, unit, ours, note);
    [
        row(
            "printed/ea",
            "pN",
            YOUNG * area,
            "E A with the printed E = 330 pN/nm^2 and A = 38.5 nm^2; tolerance: half a digit",
        )
        .derived("1.3e4"),
        row(
            "printed/s1",
            "pN",
            STIFFER * 4.0 / 3.0 * shear_modulus * area,
            "2.7 x 4 G A/3 with G = E / 2(1 + nu), all as printed; tolerance: half a digit",
        )
        .derived("1.6e4"),
        row(
            "rigidity_scale",
            "",
            monomer::RIGIDITY_SCALE,
            "factor on the interfaces' published rigidities; 9.8/7.0; copied",
        )
        .beside(1.4, Origin::Parameter),
    ]
}
