//! Segments from 0.1 nm to 1 um, and bonds that shrink towards no length.

use super::forces::chain_compliance;
use super::row::{Outcome, Row};
use super::scenes::{Parts, either};
use super::stability::{Limits, limits};
use actin_sim::Integrator;

const SEGMENTS: u32 = 20;
const BEND: f64 = 3.9e4;
const SHEAR: f64 = 1.6e4;

/// Lengths of segments (nm).
const LENGTHS: [f64; 5] = [0.1, 1.0, 10.0, 100.0, 1000.0];

/// Segments in statics and in the estimate of the time step.
pub(super) fn segments() -> Vec<Row> {
    let mut rows = Vec::new();
    for l in LENGTHS {
        let deflection = either(deflection(l));
        rows.push(Row::new(
            "segment",
            format!("{l} nm, deflection"),
            deflection,
        ));
        let limit = either(limit(l));
        rows.push(Row::new("segment", format!("{l} nm, stable step"), limit));
    }
    rows
}

fn rod(l: f64) -> String {
    let length = f64::from(SEGMENTS) * l;
    format!("Rod(from_nm: 0.0, to_nm: {length:?}, segments: {SEGMENTS})")
}

/// A force that turns the tip by 1e-4 rad: what is left out of the linear chain is 1e-8 of it.
fn deflection(l: f64) -> Result<Outcome, Outcome> {
    let length = f64::from(SEGMENTS) * l;
    let force = 1e-4 * BEND / (length * length);
    let ran = Parts::pulled(&rod(l), [force, 0.0, 0.0]).run()?;
    let exact = force * chain_compliance(SEGMENTS, l, BEND, SHEAR);
    let error = (ran.tip_displacement().x / exact - 1.0).abs();
    Ok(Outcome::correct(
        "deflection of the linear chain",
        error,
        1e-5,
    ))
}

fn limit(l: f64) -> Result<Outcome, Outcome> {
    let parts = Parts {
        sections: rod(l),
        task: "Dynamics(duration_ns: 1.0)".into(),
        ..Parts::default()
    };
    let mut assembly = parts.build()?;
    let Limits {
        predicted,
        measured,
    } = limits(&mut assembly.system, Integrator::PositionVerlet);
    let error = (measured / predicted - 1.0).abs();
    // The spectrum of a chain is densest at its upper end: its estimate may be 2e-4 low.
    let what = "measured limit against predicted";
    Ok(Outcome::correct(what, error, 2e-3))
}

/// Largest length of lateral and longitudinal bonds (nm), from the default down.
const BONDS: [[f64; 2]; 5] = [[1.6, 2.2], [0.5, 1.0], [0.2, 0.6], [0.1, 0.3], [1e-3, 1e-3]];

/// Bonds that must be short: those that the surfaces allow.
pub(super) fn bonds() -> Vec<Row> {
    let row = |[lateral, longitudinal]: [f64; 2]| {
        let case = format!("at most {lateral} and {longitudinal} nm");
        Row::new(
            "bond length",
            case,
            either(short_bonds(lateral, longitudinal)),
        )
    };
    BONDS.map(row).to_vec()
}

fn short_bonds(lateral: f64, longitudinal: f64) -> Result<Outcome, Outcome> {
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
    let mut ran = super::scenes::run(&text)?;
    Ok(Outcome::correct(
        "reaction of the wall",
        ran.imbalance(),
        1e-5,
    ))
}
