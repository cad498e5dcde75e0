//! Forces on the tip from 1e-12 to 1e6 pN, across and along, on both models.

use super::row::{Outcome, Row};
use super::scenes::{Parts, either};

/// A rod of 100 nm in 10 segments, under its own rigidities.
const ROD: &str = "Rod(from_nm: 0.0, to_nm: 100.0, segments: 10)";
/// Its length (nm), segments, bending, shearing and stretching rigidity (pN nm^2, pN).
const LENGTH: f64 = 100.0;
const SEGMENTS: u32 = 10;
const BEND: f64 = 3.9e4;
const SHEAR: f64 = 1.6e4;
const STRETCH: f64 = 3.4e4;

/// Monomers over 30 nm.
const MONOMERS: &str = "Ellipsoids(from_nm: 0.0, to_nm: 30.0)";

/// The forces (pN).
pub(super) const FORCES: [f64; 11] = [
    1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2, 1.0, 1e2, 1e4, 1e5, 1e6,
];

/// Deflection over force (nm/pN) of a chain of `n` segments of `l` nm on a wall, small: frame k
/// turns from the one before by the couple `F (n - k) l` over the rigidity of what joins them,
/// half a segment long at the wall; `n l / S` is the shear.
pub(super) fn chain_compliance(n: u32, l: f64, bend: f64, shear: f64) -> f64 {
    let (mut angle, mut deflection) = (0.0, 0.0);
    for k in 0..n {
        let joint = if k == 0 { 0.5 * l } else { l };
        angle += f64::from(n - k) * l * joint / bend;
        deflection += l * angle;
    }
    deflection + f64::from(n) * l / shear
}

/// All forces on both models.
pub(super) fn rows() -> Vec<Row> {
    let mut rows = Vec::new();
    for force in FORCES {
        let mut push = |case: &str, outcome| {
            rows.push(Row::new(
                "force",
                format!("{case}, {force:.0e} pN"),
                outcome,
            ));
        };
        push("across the rod", either(across(force)));
        push("along the rod", either(along(force)));
        push("against the rod", either(against(ROD, force)));
        push("across monomers", either(monomers([force, 0.0, 0.0])));
        push("along monomers", either(monomers([0.0, 0.0, force])));
        push("against monomers", either(against(MONOMERS, force)));
    }
    rows
}

/// Up to 1e-4 pN, deflections of 1e-7 of the length, the deflection is that of small motion to
/// the square of the angle, 1e-10; above, the wall bears the load.
fn across(force: f64) -> Result<Outcome, Outcome> {
    let mut ran = Parts::pulled(ROD, [force, 0.0, 0.0]).run()?;
    if force > 1e-4 {
        let error = ran.imbalance();
        return Ok(Outcome::correct("reaction of the wall", error, 1e-5));
    }
    let l = LENGTH / f64::from(SEGMENTS);
    let exact = force * chain_compliance(SEGMENTS, l, BEND, SHEAR);
    let error = (ran.tip_displacement().x / exact - 1.0).abs();
    Ok(Outcome::correct(
        "deflection of the linear chain",
        error,
        1e-5,
    ))
}

/// The law is linear: `L F / S3` at any tension.
fn along(force: f64) -> Result<Outcome, Outcome> {
    let ran = Parts::pulled(ROD, [0.0, 0.0, force]).run()?;
    let exact = LENGTH * force / STRETCH;
    let error = ran.tip_displacement().z / exact - 1.0;
    // Places of 100 nm are known to 1e-14 nm, which is the whole extension at 1e-11 pN.
    let rounding = 1e-13 / exact;
    Ok(Outcome::correct(
        "extension F L / S3, beside round-off of places",
        (error.abs() - rounding).max(0.0),
        1e-5,
    ))
}

/// The tolerance, 1e-6 of the force at each of some dozen bodies and a few nm of arm; rounding of
/// places leaves up to 1e-10 pN of it.
fn bound(force: f64) -> f64 {
    1e-4 + 1e-10 / force
}

fn monomers([x, y, z]: [f64; 3]) -> Result<Outcome, Outcome> {
    let mut ran = Parts::pulled(MONOMERS, [x, y, z]).run()?;
    let force = x.hypot(y).hypot(z);
    Ok(Outcome::correct(
        "reaction of the wall",
        ran.imbalance(),
        bound(force),
    ))
}

fn against(sections: &str, force: f64) -> Result<Outcome, Outcome> {
    let mut ran = Parts::pulled(sections, [0.0, 0.0, -force]).run()?;
    Ok(Outcome::correct(
        "reaction of the wall",
        ran.imbalance(),
        bound(force),
    ))
}
