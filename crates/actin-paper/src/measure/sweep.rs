//! Curves over values of both signs, with one path from rest for each sign.

use super::follow::{PathPoint, follow};
use super::{MeasureError, Specimen};
use actin_mechanics::{Loads, State, Vector3};
use actin_sim::{Assembly, End, FreeTranslation, Load, Reaction, Scene, Setting, Stage};

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

/// Ends and load of a protocol.
pub(super) struct Protocol<'a> {
    specimen: &'a Specimen,
    /// Translation of the clamped far end; `None` for a free end.
    far_end: Option<FreeTranslation>,
    /// Direction of load 0, a force of 1 pN on the far end that a setting scales.
    force: Option<Vector3>,
}

impl<'a> Protocol<'a> {
    pub(super) fn new(
        specimen: &'a Specimen,
        far_end: Option<FreeTranslation>,
        force: Option<Vector3>,
    ) -> Self {
        Self {
            specimen,
            far_end,
            force,
        }
    }

    fn scene(&self, path: Vec<Stage>) -> Scene {
        let loads = self
            .force
            .map(|force| Load::end_force(End::End, force))
            .into_iter()
            .collect();
        self.specimen.scene(self.far_end, loads, path)
    }

    /// Resolved length of the specimen (nm), which can differ from the requested length.
    pub(super) fn length_nm(&self) -> Result<f64, MeasureError> {
        Ok(Assembly::build(&self.scene(Vec::new()))?.length_nm())
    }

    /// Measures at all values along one path for each sign, in order of magnitude.
    ///
    /// `settings` gives the controls of a value; `read` reads a point from a stop.
    pub(super) fn sweep<P>(
        &self,
        name: &'static str,
        values: &[f64],
        settings: impl Fn(f64) -> Vec<Setting>,
        read: impl Fn(&Assembly, f64, &PathPoint) -> P,
    ) -> Result<Curve<P>, MeasureError> {
        check(name, values)?;
        let (positive, negative): (Vec<f64>, Vec<f64>) =
            values.iter().partition(|value| **value > 0.0);
        let mut curve = Curve {
            length_nm: 0.0,
            points: Vec::new(),
            unreached: Vec::new(),
        };
        for mut values in [negative, positive] {
            if values.is_empty() {
                continue;
            }
            values.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
            let mut next = self.along(&values, &settings, &read)?;
            if values[0] < 0.0 {
                next.points.reverse();
            }
            curve.length_nm = next.length_nm;
            curve.points.append(&mut next.points);
            curve.unreached.append(&mut next.unreached);
        }
        Ok(curve)
    }

    /// Measures at `values` along one path, in the given order.
    fn along<P>(
        &self,
        values: &[f64],
        settings: impl Fn(f64) -> Vec<Setting>,
        read: impl Fn(&Assembly, f64, &PathPoint) -> P,
    ) -> Result<Curve<P>, MeasureError> {
        let path = values.iter().map(|&value| Stage::new(settings(value)));
        let course = follow(&self.scene(path.collect()))?;
        let stops = values.iter().zip(&course.stops);
        let points = stops.map(|(&value, stop)| read(&course.assembly, value, stop));
        let reason = course.ended.map(|ended| ended.to_string());
        let reason = reason.unwrap_or_default();
        let missing = values[course.stops.len()..].iter();
        let missing = missing.map(|&value| MissingEquilibrium {
            value,
            reason: reason.clone(),
        });
        Ok(Curve {
            length_nm: course.assembly.length_nm(),
            points: points.collect(),
            unreached: missing.collect(),
        })
    }
}

/// Setting of the force of a protocol (pN).
pub(super) fn force(factor: f64) -> Setting {
    Setting::LoadFactor { load: 0, factor }
}

fn check(name: &'static str, values: &[f64]) -> Result<(), MeasureError> {
    let bad = values.iter().find(|v| !v.is_finite() || **v == 0.0);
    let (value, rule) = match bad {
        Some(&value) => (
            value,
            "finite and not zero, since a secant is undefined at zero",
        ),
        None if values.is_empty() => (f64::NAN, "at least one value"),
        None => return Ok(()),
    };
    Err(MeasureError::Value { name, value, rule })
}

/// Checks that a constant value is finite; zero is valid.
pub(super) fn check_finite(name: &'static str, value: f64) -> Result<(), MeasureError> {
    let rule = "finite";
    let refused = || MeasureError::Value { name, value, rule };
    value.is_finite().then_some(()).ok_or_else(refused)
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
