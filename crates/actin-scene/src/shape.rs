//! Initial shape of a filament and its validation.

use super::curve::Curve;
use super::rules::{check_curvature, show};
use super::{Filament, SceneProblem};
use actin_cosserat::constants::cross_section_radius;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Curve along which a filament is built. It is the initial shape, not the rest shape: a filament with straight
/// sections is bent along the curve, without stretch or shear, and starts under stress.
///
/// Cross-sections follow the curve (parallel transport), from `roll_deg` at the start, and have the rest twist of
/// the sections.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum Shape {
    /// Arc of a circle that starts along `direction`; shorter than the full circle.
    Arc {
        /// Radius of the circle; greater than the radius of the filament, 3.5 nm.
        radius_nm: f64,
        /// Azimuth of the centre of the circle, defined as for linkers; finite.
        #[serde(default)]
        azimuth_deg: f64,
    },
    /// Helix with an axis along `direction`.
    Helix {
        /// Radius of the helix; positive.
        radius_nm: f64,
        /// Rise per turn; negative for a left-handed helix. Adjacent turns are at least a filament diameter, 7
        /// nm, apart.
        pitch_nm: f64,
        /// Azimuth of the helix axis relative to the start of the filament; finite.
        #[serde(default)]
        azimuth_deg: f64,
    },
    /// Natural cubic spline through points, with chord length as parameter. It starts at the first point and
    /// ends at the length of the filament. `at_nm`, `direction` and `roll_deg` move the curve like a filament
    /// along lab z from the origin. By default points are positions in the lab frame.
    Points {
        /// Points; finite, at least two, adjacent points different. The curve must be at least as long as the
        /// filament.
        #[serde(default)]
        nm: Vec<[f64; 3]>,
        /// CSV file with the points, instead of `nm`: x, y and z (nm) in each row, after at most one row of
        /// headings. The path is relative to the scene file, or to the working directory for a scene from
        /// standard input. The scene in a run directory contains the points.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        file: Option<String>,
    },
    /// Rest shape: rods with their rest curvature, monomers straight.
    AtRest,
}

/// Relative tolerance of the length of a curve through points, for rounded coordinates.
const SHORT: f64 = 1e-6;

pub(super) fn check(filament: &Filament) -> Result<(), SceneProblem> {
    let Some(shape) = &filament.shape else {
        return Ok(());
    };
    if filament.sections.is_empty() {
        return Ok(());
    }
    let length = filament.length_nm();
    match shape {
        Shape::Arc { radius_nm, .. } => {
            let key = "filament.shape.radius_nm";
            check_curvature(key, show(radius_nm), radius_nm.recip())?;
            check_open(key, show(radius_nm), (length, TAU * radius_nm))?;
        }
        Shape::Helix {
            radius_nm,
            pitch_nm,
            ..
        } => check_helix(length, *radius_nm, *pitch_nm)?,
        Shape::Points { nm, file } => check_points(nm, file.as_deref())?,
        Shape::AtRest => {}
    }
    check_curve(filament, shape, length)
}

fn check_open(key: &str, value: String, (length, whole): (f64, f64)) -> Result<(), SceneProblem> {
    if length < whole {
        return Ok(());
    }
    let rule = format!(
        "the filament of {length:?} nm closes the circle of {whole:.1} nm: closed filaments are not supported"
    );
    Err(SceneProblem::new(key, value, rule))
}

fn check_helix(length: f64, radius: f64, pitch: f64) -> Result<(), SceneProblem> {
    let rise = pitch / TAU;
    let squared = radius * radius + rise * rise;
    let (key, value) = ("filament.shape.radius_nm", show(radius));
    check_curvature(key, value, radius / squared)?;
    let diameter = 2.0 * cross_section_radius();
    let distance = pitch.abs() * radius / squared.sqrt();
    if length >= TAU * squared.sqrt() && distance < diameter {
        let rule = format!(
            "neighbouring turns are {distance:.1} nm apart, less than the filament's diameter of {diameter:.1} nm"
        );
        let key = "filament.shape.pitch_nm";
        return Err(SceneProblem::new(key, show(pitch), rule));
    }
    Ok(())
}

fn check_points(nm: &[[f64; 3]], file: Option<&str>) -> Result<(), SceneProblem> {
    let key = "filament.shape.nm";
    if let Some(file) = file {
        let rule = "cannot be read without a scene file: write the points as nm";
        return Err(SceneProblem::new("filament.shape.file", show(file), rule));
    }
    if nm.len() < 2 {
        let rule = format!("there are {} points: a curve needs at least two", nm.len());
        return Err(SceneProblem::new(key, "", rule));
    }
    for (i, point) in nm.iter().enumerate() {
        let is_before =
            |other: &[f64; 3]| other.iter().zip(point).all(|(a, b)| (a - b).abs() <= 0.0);
        if i > 0 && is_before(&nm[i - 1]) {
            let rule = "equals the previous point: write different points";
            return Err(SceneProblem::new(format!("{key}[{i}]"), show(point), rule));
        }
    }
    Ok(())
}

/// Checks the length and curvature of the curve, and that it is not closed.
fn check_curve(filament: &Filament, shape: &Shape, length: f64) -> Result<(), SceneProblem> {
    let curve = Curve::new(filament, &filament.boundaries());
    let key = match shape {
        Shape::Points { .. } => "filament.shape.nm",
        _ => "filament.shape",
    };
    if let Some(whole) = curve
        .length()
        .filter(|whole| *whole < length * (1.0 - SHORT))
    {
        let what = if (whole * 1e3 >= length * (1.0 - SHORT)) && whole * 1e2 < length {
            "the points must be in nm, not in um"
        } else {
            "add points"
        };
        let rule =
            format!("the curve is {whole:.3} nm long, but the filament {length:?} nm: {what}");
        return Err(SceneProblem::new(key, "", rule));
    }
    let (s_nm, curvature) = curve.largest_curvature(length);
    let value = format!("curvature {curvature:.3} per nm at s = {s_nm:.1} nm");
    check_curvature(key, value, curvature)?;
    let diameter = 2.0 * cross_section_radius();
    let [from, to] = [0.0, length].map(|s| curve.at(s).0);
    let gap = (to - from).norm();
    if gap < diameter && length > 2.0 * diameter {
        let rule = format!(
            "the ends are {gap:.1} nm apart, less than the filament's diameter of {diameter:.1} nm: closed \
             filaments are not supported"
        );
        return Err(SceneProblem::new(key, "", rule));
    }
    Ok(())
}
