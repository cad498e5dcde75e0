//! Curves over values of both signs, with one path from rest for each sign.

use super::MeasureError;
use super::follow::{PathPoint, follow};
use actin_mechanics::{Loads, State, Vector3};
use actin_sim::{Assembly, Reaction};
use actin_sim::{End, Scene};

/// Points of a protocol, in ascending order of the prescribed value or in the requested order.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve<P> {
    /// Length between the clamped points, or from the clamped point to the tip, at rest (nm).
    pub length_nm: f64,
    /// Measured points.
    pub points: Vec<P>,
    /// Values without an equilibrium.
    pub unreached: Vec<MissingEquilibrium>,
}

/// A value without an equilibrium.
#[derive(Clone, Debug, PartialEq)]
pub struct MissingEquilibrium {
    /// The value, in the unit of the protocol.
    pub value: f64,
    /// Reason for the end of the path.
    pub reason: String,
}

/// Measures at all `values` along one path for each sign, in order of magnitude.
///
/// `scene` makes the scene with one stage per value; `read` reads a point from a stop.
pub(super) fn sweep<P>(
    name: &'static str,
    values: &[f64],
    scene: impl Fn(&[f64]) -> Scene,
    read: impl Fn(&Assembly, f64, &PathPoint) -> P,
) -> Result<Curve<P>, MeasureError> {
    check(name, values)?;
    let sorted = |positive: bool| {
        let mut chosen: Vec<f64> = values.to_vec();
        chosen.retain(|value| (*value > 0.0) == positive);
        chosen.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
        chosen
    };
    let mut curve: Option<Curve<P>> = None;
    for positive in [false, true] {
        let values = sorted(positive);
        if values.is_empty() {
            continue;
        }
        let mut next = leg(&values, &scene, &read)?;
        if !positive {
            next.points.reverse();
        }
        match &mut curve {
            None => curve = Some(next),
            Some(curve) => {
                curve.points.append(&mut next.points);
                curve.unreached.append(&mut next.unreached);
            }
        }
    }
    Ok(curve.expect("there is a value, and it is not zero"))
}

/// Measures at `values` along one path, in the given order.
pub(super) fn in_order<P>(
    name: &'static str,
    values: &[f64],
    scene: impl Fn(&[f64]) -> Scene,
    read: impl Fn(&Assembly, f64, &PathPoint) -> P,
) -> Result<Curve<P>, MeasureError> {
    check(name, values)?;
    leg(values, &scene, &read)
}

fn leg<P>(
    values: &[f64],
    scene: &impl Fn(&[f64]) -> Scene,
    read: &impl Fn(&Assembly, f64, &PathPoint) -> P,
) -> Result<Curve<P>, MeasureError> {
    let course = follow(&scene(values))?;
    let stops = values.iter().zip(&course.stops);
    let reason = course.ended.map(|ended| ended.to_string());
    let missing = values[course.stops.len()..].iter();
    Ok(Curve {
        length_nm: course.assembly.length_nm(),
        points: stops
            .map(|(&value, stop)| read(&course.assembly, value, stop))
            .collect(),
        unreached: missing
            .map(|&value| MissingEquilibrium {
                value,
                reason: reason.clone().unwrap_or_default(),
            })
            .collect(),
    })
}

pub(super) fn check(name: &'static str, values: &[f64]) -> Result<(), MeasureError> {
    let bad = values.iter().find(|v| !v.is_finite() || **v == 0.0);
    match bad {
        Some(&value) => Err(MeasureError::Value {
            name,
            value,
            rule: "finite and not zero, since a secant is undefined at zero",
        }),
        None if values.is_empty() => Err(MeasureError::Value {
            name,
            value: f64::NAN,
            rule: "at least one value",
        }),
        None => Ok(()),
    }
}

/// Checks that a constant value is finite; zero is valid.
pub(super) fn check_finite(name: &'static str, value: f64) -> Result<(), MeasureError> {
    if value.is_finite() {
        return Ok(());
    }
    Err(MeasureError::Value {
        name,
        value,
        rule: "finite",
    })
}

/// The transverse direction at an azimuth (lab frame).
pub(super) fn across(azimuth_deg: f64) -> Vector3 {
    let (sin, cos) = azimuth_deg.to_radians().sin_cos();
    Vector3::new(cos, sin, 0.0)
}

/// Force and torque on the filament at a held end.
pub(crate) fn reaction(assembly: &Assembly, state: &State, end: End) -> Reaction {
    let mut loads = Loads::zeros(state);
    for interaction in assembly.system.interactions() {
        interaction.add_loads(state, &mut loads);
    }
    let clamp = assembly.clamps.iter().find(|clamp| clamp.end == end);
    clamp
        .expect("the protocol holds this end")
        .reaction(state, &loads)
}

/// Displacement of the clamped point at the far end from rest (nm, lab frame).
pub(crate) fn far_end_shift(assembly: &Assembly, state: &State) -> Vector3 {
    let clamp = assembly.clamps.iter().find(|clamp| clamp.end == End::End);
    let clamp = clamp.expect("the protocol holds this end");
    clamp.point_nm(state) - clamp.point_nm(&assembly.rest)
}
