//! Tip forces from 1e-12 to 1e6 pN, segments from 0.1 nm to 1 µm, very short bonds, and ratios of rigidity between
//! monomers and rod up to 1e6.

use super::row::{CaseResult, Expected, Row, correct};
use super::scenes::{self, Parts};
use super::steps::limit;
use actin_sim::Integrator;

const BEND: f64 = 3.9e4;
const SHEAR: f64 = 1.6e4;
const STRETCH: f64 = 3.4e4;

const ROD: &str = "Rod(from_nm: 0.0, to_nm: 100.0, segments: 10)";
const MONOMERS: &str = "Ellipsoids(from_nm: 0.0, to_nm: 30.0)";

/// Forces (pN), from below round-off to far outside the model.
const FORCES: [f64; 11] = [
    1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2, 1.0, 1e2, 1e4, 1e5, 1e6,
];

const DIRECTIONS: [(&str, &str, [f64; 3]); 6] = [
    ("across the rod", ROD, [1.0, 0.0, 0.0]),
    ("along the rod", ROD, [0.0, 0.0, 1.0]),
    ("against the rod", ROD, [0.0, 0.0, -1.0]),
    ("across monomers", MONOMERS, [1.0, 0.0, 0.0]),
    ("along monomers", MONOMERS, [0.0, 0.0, 1.0]),
    ("against monomers", MONOMERS, [0.0, 0.0, -1.0]),
];

/// All forces on both models. Results are correct from 1e-8 to 1e2 pN, and for transverse forces on
/// the rod from 1e-12 pN. Smaller forces are refused because of round-off. Results above 1e4 pN are
/// outside the model or saddles.
pub(super) fn forces() -> Vec<Row> {
    let row = |force: f64, (case, sections, direction): (&str, &str, [f64; 3])| {
        let tried = match case {
            "across the rod" => across(force),
            "along the rod" => along(force),
            _ => balanced(sections, direction.map(|x| x * force), 1e-4 + 1e-10 / force),
        };
        let is_across = case == "across the rod";
        let beyond: &[&str] = if is_across {
            &["model does not apply", "ends on a saddle", "no equilibrium"]
        } else {
            &["model does not apply", "ends on a saddle"]
        };
        let expected = match force {
            f if f >= 1e5 => Expected::Fails(beyond),
            f if f >= 1e4 => Expected::CorrectOrFails(beyond),
            f if f < 1e-8 && !is_across => Expected::Sound,
            _ => Expected::Correct,
        };
        Row::new("force", format!("{case}, {force:.0e} pN"), tried).expecting(expected)
    };
    let rows = FORCES
        .into_iter()
        .flat_map(|force| DIRECTIONS.map(|d| row(force, d)));
    rows.collect()
}

/// Returns the compliance (nm/pN) of a cantilever of `n` segments of length `l` (nm) for small deflections.
///
/// ```text
/// kappa_k = F (n - k) l / B     rotation between frames k - 1 and k over l, or l/2 at the clamp
/// n l / S                       shear compliance
/// ```
fn chain_compliance(n: u32, l: f64) -> f64 {
    let (mut angle, mut deflection) = (0.0, 0.0);
    for k in 0..n {
        let joint = if k == 0 { 0.5 * l } else { l };
        angle += f64::from(n - k) * l * joint / BEND;
        deflection += l * angle;
    }
    deflection + f64::from(n) * l / SHEAR
}

fn deflection(sections: &str, segments: u32, l: f64, force: f64) -> CaseResult {
    let ran = Parts::pulled(sections, [force, 0.0, 0.0]).run()?;
    let exact = force * chain_compliance(segments, l);
    let error = (ran.tip_displacement().x / exact - 1.0).abs();
    correct("deflection of the linear chain", error, 1e-5)
}

/// Transverse force on the rod. Up to 1e-4 pN the deflection is compared with linear theory, whose relative error is
/// the square of the angle, 1e-10. For larger forces the reaction of the clamp is compared.
fn across(force: f64) -> CaseResult {
    if force > 1e-4 {
        return balanced(ROD, [force, 0.0, 0.0], 1e-5);
    }
    deflection(ROD, 10, 10.0, force)
}

fn along(force: f64) -> CaseResult {
    let ran = Parts::pulled(ROD, [0.0, 0.0, force]).run()?;
    let exact = 100.0 * force / STRETCH;
    let error = ran.tip_displacement().z / exact - 1.0;
    // Positions of 100 nm have round-off of 1e-14 nm, which is the whole extension at 1e-11 pN.
    let rounding = 1e-13 / exact;
    let what = "extension F L / S3, beside round-off of places";
    correct(what, (error.abs() - rounding).max(0.0), 1e-5)
}

/// Compares the reaction of the clamp with the load. The bound is the tolerance, 1e-6 of the force,
/// for about a dozen bodies with lever arms of a few nm, plus round-off of 1e-10 pN.
fn balanced(sections: &str, force: [f64; 3], bound: f64) -> CaseResult {
    let mut ran = Parts::pulled(sections, force).run()?;
    correct("reaction of the wall", ran.imbalance(), bound)
}

const LENGTHS: [f64; 5] = [0.1, 1.0, 10.0, 100.0, 1000.0];
const SEGMENTS: u32 = 20;

/// Deflection and stable time step for each length of segments. The tip angle of 1e-4 rad causes a
/// relative error of 1e-8. The estimated frequency of a chain may be 2e-4 too low.
pub(super) fn segments() -> Vec<Row> {
    let rows = LENGTHS.into_iter().flat_map(|l| {
        let length = f64::from(SEGMENTS) * l;
        let rod = format!("Rod(from_nm: 0.0, to_nm: {length:?}, segments: {SEGMENTS})");
        let bent = deflection(&rod, SEGMENTS, l, 1e-4 * BEND / (length * length));
        let stepped = scenes::free(&rod)
            .and_then(|mut system| limit(&mut system, Integrator::PositionVerlet, 2e-3));
        [
            Row::new("segment", format!("{l} nm, deflection"), bent),
            Row::new("segment", format!("{l} nm, stable step"), stepped),
        ]
    });
    rows.collect()
}

/// Largest lengths of lateral and longitudinal bonds (nm). The gap between surfaces allows the first two pairs only.
const BONDS: [([f64; 2], Expected); 5] = [
    ([1.6, 2.2], Expected::Correct),
    ([0.5, 1.0], Expected::Correct),
    ([0.2, 0.6], Expected::Refused),
    ([0.1, 0.3], Expected::Refused),
    ([1e-3, 1e-3], Expected::Refused),
];

pub(super) fn bonds() -> Vec<Row> {
    let short = |lateral: f64, longitudinal: f64| {
        let text = format!(
            "Scene(
            filament: Filament(
                sections: [Ellipsoids(from_nm: 0.0, to_nm: 20.0)],
                monomers: Monomers(
                    anchors: Independent, lateral_bonds: 16, lateral_max_bond_nm: {lateral:?},
                    longitudinal_bonds: 16, longitudinal_max_bond_nm: {longitudinal:?},
                ),
            ),
            clamps: [Clamp(end: Start)],
            loads: [EndForce(end: End, force_pn: (1.0, 0.0, 0.0))],
            task: Equilibrium(),
        )"
        );
        correct(
            "reaction of the wall",
            scenes::run(&text)?.imbalance(),
            1e-5,
        )
    };
    let row = |([lateral, longitudinal], expected): ([f64; 2], Expected)| {
        let case = format!("at most {lateral} and {longitudinal} nm");
        Row::new("bond length", case, short(lateral, longitudinal)).expecting(expected)
    };
    BONDS.map(row).to_vec()
}

const FACTORS: [f64; 7] = [1e-6, 1e-4, 1e-2, 1.0, 1e2, 1e4, 1e6];

pub(super) fn contrast() -> Vec<Row> {
    let rows = FACTORS.into_iter().flat_map(|factor| {
        let case = |what: &str| format!("rod {factor:.0e} times as stiff, {what}");
        [
            Row::new("contrast", case("statics"), contrast_balance(factor)),
            Row::new("contrast", case("stable step"), contrast_limit(factor)),
        ]
    });
    rows.collect()
}

fn stiff(factor: f64, force: f64, task: impl Into<String>) -> Parts {
    let [s, stretch, b, twist] = [SHEAR, STRETCH, BEND, 1.3e4].map(|x| x * factor);
    Parts {
        models: format!(
            "rod: RodModel(law: Constant, material: Rigidities(
                shear_pn: ({s:?}, {s:?}, {stretch:?}), bend_pn_nm2: ({b:?}, {b:?}, {twist:?}))),"
        ),
        ..Parts::new(
            "Ellipsoids(from_nm: 0.0, to_nm: 20.0), Rod(from_nm: 20.0, to_nm: 60.0, segments: 4)",
            format!(
                "clamps: [Clamp(end: Start)],
                 loads: [EndForce(end: End, force_pn: ({force:?}, 0.0, 0.0))],"
            ),
            task,
        )
    }
}

/// Compares the reaction under a force that bends the softer part by a few degrees. The bound is
/// the tolerance summed over two dozen bodies.
fn contrast_balance(factor: f64) -> CaseResult {
    let tolerance = 1e-7 * factor.min(1.0);
    let torque = 10.0 * tolerance;
    let task = format!("Equilibrium(force_pn: {tolerance:?}, torque_pn_nm: {torque:?})");
    let mut ran = stiff(factor, 0.1 * factor.min(1.0), task).run()?;
    correct("reaction of the wall", ran.imbalance(), 1e-4)
}

fn contrast_limit(factor: f64) -> CaseResult {
    let mut assembly = stiff(factor, 0.0, "Dynamics(duration_ns: 1e-6)").build()?;
    limit(&mut assembly.system, Integrator::Pefrl, 2e-3)
}
