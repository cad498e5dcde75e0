//! Numbers that Appendix B derives from Table 4's.

use super::{Holds, Known};
use crate::figures::report::{Origin, Row};
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
/// Shares by which B1, S3 and B3 may be off in Table 4.
const BENDING: f64 = 0.04;
const STRETCHING: f64 = 0.05;
const TWISTING: f64 = 0.12;

/// What follows from the rigidities; nothing if they are not all there.
pub(super) fn rigidities(known: &Known<'_>) -> Vec<Row> {
    let names = ["b1", "s3", "b3_min", "b3_max", "persistence_length_um"];
    let [
        Some(b1),
        Some(s3),
        Some(b3_min),
        Some(b3_max),
        Some(persistence),
    ] = names.map(|name| known.get(name))
    else {
        return Vec::new();
    };
    let mut all = vec![young(known, b1), ratio(known, b1, s3)];
    let row = |name: &str, unit, ours, note: &str| Row::measured(known.id, name, unit, ours, note);
    let note = "mean of the largest B3 in under- and in over-twist, the constant of Figures 4 to 8";
    let mean = row("b3_mean", "pN nm^2", 0.5 * (b3_min + b3_max), note);
    all.push(mean.against(1.3e4, TWISTING * 1.3e4));
    all.extend(printed(known));
    let (least, most) = MEASURED_UM;
    let note = format!(
        "measured persistence lengths are {least} to {most} um; B1/kBT, from the smaller on"
    );
    let mut within = known.claim(
        "persistence",
        "um",
        persistence,
        Holds::AtLeast(least),
        note,
    );
    within.pass = Some((least..=most).contains(&persistence));
    all.push(within);
    all
}

fn inertia() -> f64 {
    rod::CROSS_SECTION_AREA.powi(2) / (4.0 * PI)
}

fn young(known: &Known<'_>, b1: f64) -> Row {
    let note = "B1 over A^2/4pi with A = 38.5 nm^2; tolerance: that of B1, and half a digit";
    let row = Row::measured(known.id, "young_modulus", "pN/nm^2", b1 / inertia(), note);
    row.against(YOUNG, BENDING * YOUNG + 5.0)
}

fn ratio(known: &Known<'_>, b1: f64, s3: f64) -> Row {
    let stretching = b1 / inertia() * rod::CROSS_SECTION_AREA;
    let note = "S3 over E A with E from B1; tolerance: those of S3 and B1, and half a digit";
    let row = Row::measured(known.id, "s3_over_ea", "", s3 / stretching, note);
    row.against(STIFFER, (STRETCHING + BENDING) * STIFFER + 0.05)
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
        .against(1.3e4, 500.0),
        row(
            "printed/s1",
            "pN",
            STIFFER * 4.0 / 3.0 * shear_modulus * area,
            "2.7 x 4 G A/3 with G = E / 2(1 + nu), all as printed; tolerance: half a digit",
        )
        .against(1.6e4, 500.0),
        row(
            "rigidity_scale",
            "",
            monomer::RIGIDITY_SCALE,
            "factor on the interfaces' published rigidities; 9.8/7.0",
        )
        .against(1.4, 1e-9)
        .of(Origin::Parameter),
    ]
}
