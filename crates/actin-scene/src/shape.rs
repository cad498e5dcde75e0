//! The shape in which a filament is built, and its rules. The curve that it stands for is in `curve.rs`,
//! files of points in `trace.rs`.

use super::curve::Curve;
use super::rules::{check_curvature, finite, positive, radius_nm, show};
use super::{Filament, SceneProblem};
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// The curve along which a filament is built. It is its initial shape, not that at rest: a filament whose
/// sections are straight at rest is bent along it, without stretch or shear, and begins under stress.
///
/// Cross-sections go along the curve without twist (parallel transport), from `roll_deg` at the start; along
/// `AtRest` they have the twist of the rods at rest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub enum Shape {
    /// Part of a circle that begins along `direction`; less than all of it.
    Arc {
        /// Its radius; greater than that of the filament, 3.5 nm.
        radius_nm: f64,
        /// Azimuth towards which it bends, counted as those of linkers; finite.
        #[serde(default)]
        azimuth_deg: f64,
    },
    /// A helix whose axis is along `direction`.
    Helix {
        /// Its radius; positive.
        radius_nm: f64,
        /// Rise in a turn, negative where it is left-handed; neighbouring turns are a filament's
        /// diameter, 7 nm, apart or further.
        pitch_nm: f64,
        /// Azimuth of its axis seen from the start; finite.
        #[serde(default)]
        azimuth_deg: f64,
    },
    /// A smooth curve through points, from the first on as far as the filament is long: a natural cubic
    /// spline over the lengths of its chords. `at_nm`, `direction` and `roll_deg` move it as they move a
    /// filament along lab z from the origin: by default points are places in the lab.
    Points {
        /// The points, at least two; finite, neighbours at different places, the curve at least as long
        /// as the filament.
        #[serde(default)]
        nm: Vec<[f64; 3]>,
        /// Instead of `nm` a CSV file with x, y and z (nm) of a point in each row, behind at most one row of
        /// headings. Its path is relative to the file of the scene or, of a scene from standard input, to
        /// the working directory. The scene of a run directory has the points.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        file: Option<String>,
    },
    /// The shape at rest: rods as curved and twisted as they are `altered`, monomers straight.
    AtRest,
}

/// Share of the length by which a curve through points may be too short: what digits of points leave open.
const SHORT: f64 = 1e-6;

/// Checks the shape of a filament.
pub(super) fn check(filament: &Filament) -> Result<(), SceneProblem> {
    let Some(shape) = &filament.shape else {
        return Ok(());
    };
    if filament.sections.is_empty() {
        return Ok(());
    }
    let key = |name: &str| format!("filament.shape.{name}");
    let length = filament.length_nm();
    match shape {
        Shape::Arc {
            radius_nm,
            azimuth_deg,
        } => {
            positive(&key("radius_nm"), *radius_nm)?;
            finite(&key("azimuth_deg"), *azimuth_deg)?;
            check_curvature(&key("radius_nm"), show(radius_nm), radius_nm.recip())?;
            check_open(
                &key("radius_nm"),
                show(radius_nm),
                (length, TAU * radius_nm),
            )?;
        }
        Shape::Helix {
            radius_nm,
            pitch_nm,
            azimuth_deg,
        } => {
            positive(&key("radius_nm"), *radius_nm)?;
            finite(&key("pitch_nm"), *pitch_nm)?;
            finite(&key("azimuth_deg"), *azimuth_deg)?;
            check_helix(length, *radius_nm, *pitch_nm)?;
        }
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
    let diameter = 2.0 * radius_nm();
    let distance = pitch.abs() * radius / squared.sqrt();
    if length >= TAU * squared.sqrt() && distance < diameter {
        let rule = format!(
            "neighbouring turns are {distance:.1} nm apart, less than the filament's diameter of {diameter:.1} nm"
        );
        return Err(SceneProblem::new(
            "filament.shape.pitch_nm",
            show(pitch),
            rule,
        ));
    }
    Ok(())
}

fn check_points(nm: &[[f64; 3]], file: Option<&str>) -> Result<(), SceneProblem> {
    let key = "filament.shape.nm";
    if let Some(file) = file {
        let rule = "is not read: a file of points is found beside the file of a scene; a text alone has \
                    the points as nm";
        return Err(SceneProblem::new("filament.shape.file", show(file), rule));
    }
    if nm.len() < 2 {
        let rule = format!("there are {} points: a curve needs at least two", nm.len());
        return Err(SceneProblem::new(key, "", rule));
    }
    for (i, point) in nm.iter().enumerate() {
        super::rules::all_finite(&format!("{key}[{i}]"), *point)?;
        let is_before =
            |other: &[f64; 3]| other.iter().zip(point).all(|(a, b)| (a - b).abs() <= 0.0);
        if i > 0 && is_before(&nm[i - 1]) {
            let rule = "is the point before it: neighbouring points are at different places";
            return Err(SceneProblem::new(format!("{key}[{i}]"), show(point), rule));
        }
    }
    Ok(())
}

/// What only the curve shows: its length, its curvature, and whether its ends meet.
fn check_curve(filament: &Filament, shape: &Shape, length: f64) -> Result<(), SceneProblem> {
    let curve = Curve::of(filament, &filament.boundaries());
    let key = match shape {
        Shape::Points { .. } => "filament.shape.nm",
        _ => "filament.shape",
    };
    if let Some(whole) = curve
        .length()
        .filter(|whole| *whole < length * (1.0 - SHORT))
    {
        // Points in micrometres are as good as any but for a factor.
        let what = if (whole * 1e3 >= length * (1.0 - SHORT)) && whole * 1e2 < length {
            "are the points in um? They are read in nm"
        } else {
            "it needs more points"
        };
        let rule =
            format!("the curve is {whole:.3} nm long, and the filament {length:?} nm: {what}");
        return Err(SceneProblem::new(key, "", rule));
    }
    let (s_nm, curvature) = curve.largest_curvature(length);
    let value = format!("curvature {curvature:.3} per nm at s = {s_nm:.1} nm");
    check_curvature(key, value, curvature)?;
    let diameter = 2.0 * radius_nm();
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
