//! Rules of single numbers and vectors of a scene.

use super::problem::Problems;
use super::tree::{Kind, SceneValue};
use super::{SceneProblem, rules::show};

const LARGEST: f64 = 1e60;

const SMALLEST: f64 = 1e-60;

#[derive(Clone, Copy)]
enum NumberRule {
    /// Rule of a constitutive law, which the law checks itself.
    Law,
    Finite,
    Positive,
    NonNegative,
    /// Vector that is not zero.
    Direction,
}

/// Returns the rule of the numbers at `key` of the structure at the key `parent`.
fn rule(parent: &str, key: &str) -> NumberRule {
    match (parent, key) {
        ("bend" | "over" | "shear" | "stretch" | "twist" | "twist_stretch" | "under", _) => {
            NumberRule::Law
        }
        ("linkers" | "linker_sets" | "crosslinkers" | "to" | "site", "radius_nm")
        | ("sections", "from_nm")
        | ("task", "temperature_k")
        | (
            _,
            "apart_nm"
            | "averaging_ns"
            | "box_nm"
            | "burn_in_ns"
            | "least_reach_nm"
            | "min_bond_nm"
            | "rest_length_nm"
            | "rotational_per_ns"
            | "stagger_nm"
            | "tilt_pn_nm"
            | "translational_per_ns"
            | "twist_pn_nm",
        ) => NumberRule::NonNegative,
        ("arrangements", "shift_nm")
        | (_, "across" | "along" | "axis" | "direction" | "normal") => NumberRule::Direction,
        ("task", "duration_ns" | "force_pn" | "torque_pn_nm")
        | ("stop", "force_pn" | "torque_pn_nm" | "kinetic_pn_nm")
        | ("breaks" | "unbinds" | "catch", "force_pn")
        | ("factor", "duration_ns")
        | (
            _,
            "amplitude_nm"
            | "attach_per_ns"
            | "bend_pn_nm2"
            | "bend_pn_nm_per_rad"
            | "bend_rigidity_factor"
            | "bind_per_ns"
            | "cell_nm"
            | "duration_ms"
            | "largest_step"
            | "lag_ns"
            | "lateral_max_bond_nm"
            | "lateral_rigidity_factor"
            | "lateral_rigidity_pn_per_nm"
            | "least_ns"
            | "length_nm"
            | "lengths_nm"
            | "longitudinal_max_bond_nm"
            | "longitudinal_rigidity_factor"
            | "longitudinal_rigidity_pn_per_nm"
            | "mass_ag"
            | "mass_factor"
            | "over_nm"
            | "per_filament"
            | "period_ns"
            | "radius_nm"
            | "rate_per_ns"
            | "reach_nm"
            | "record_every_ns"
            | "rise_nm"
            | "sampled_ns"
            | "semi_axes_nm"
            | "shear_pn"
            | "shear_rigidity_factor"
            | "site_spacing_nm"
            | "size_nm"
            | "smallest_step"
            | "spacing_nm"
            | "stall_pn"
            | "step_safety"
            | "stiffness_pn_per_nm"
            | "stretch_rigidity_factor"
            | "temperature_k"
            | "time_step_ns"
            | "twist_pn_nm_per_rad"
            | "twist_rigidity_factor"
            | "viscosity_mpa_s",
        ) => NumberRule::Positive,
        _ => NumberRule::Finite,
    }
}

/// Checks all numbers of a scene or of a scene file.
pub(super) fn check(scene: &SceneValue, problems: &mut Problems) {
    walk(scene, "", ["", ""], problems);
}

/// Checks the numbers at `path`, whose last two keys are `keys`.
fn walk(value: &SceneValue, path: &str, keys: [&str; 2], problems: &mut Problems) {
    if let Some(numbers) = numbers(value) {
        return problems.note(check_numbers(path, &numbers, rule(keys[0], keys[1])));
    }
    for (i, child) in value.children().iter().enumerate() {
        match child.key() {
            None => walk(child, &format!("{path}[{i}]"), keys, problems),
            Some(key) if path.is_empty() => walk(child, key, ["", key], problems),
            Some(key) => walk(child, &format!("{path}.{key}"), [keys[1], key], problems),
        }
    }
}

/// Returns a number or the components of a vector.
fn numbers(value: &SceneValue) -> Option<Vec<f64>> {
    match &value.kind {
        Kind::Number(number) => Some(vec![*number]),
        Kind::Group(None, parts) if !parts.is_empty() => {
            let number = |part: &SceneValue| match part.kind {
                Kind::Number(number) if part.key.is_none() => Some(number),
                _ => None,
            };
            parts.iter().map(number).collect()
        }
        _ => None,
    }
}

fn check_numbers(path: &str, numbers: &[f64], rule: NumberRule) -> Result<(), SceneProblem> {
    let all = |is_valid: fn(f64) -> bool| numbers.iter().all(|x| x.is_finite() && is_valid(*x));
    let each = if numbers.len() > 1 { "each " } else { "" };
    let rule = match rule {
        NumberRule::Positive if !all(|x| x > 0.0) => {
            format!("{each}must be finite and greater than 0")
        }
        NumberRule::NonNegative if !all(|x| x >= 0.0) => {
            format!("{each}must be finite and not negative")
        }
        NumberRule::Direction if all(|x| x == 0.0) => "must not be zero".to_owned(),
        NumberRule::Law => return check_magnitudes(path, numbers),
        _ if !all(|_| true) => "must be finite".to_owned(),
        _ => return check_magnitudes(path, numbers),
    };
    let value = match numbers {
        [number] => show(number),
        _ => show(numbers),
    };
    Err(SceneProblem::new(path, value, rule))
}

/// Refuses magnitudes for which products of a few numbers may overflow or underflow.
fn check_magnitudes(path: &str, numbers: &[f64]) -> Result<(), SceneProblem> {
    let is_extreme =
        |x: &f64| x.is_finite() && *x != 0.0 && !(SMALLEST..=LARGEST).contains(&x.abs());
    let Some(i) = numbers.iter().position(is_extreme) else {
        return Ok(());
    };
    let index = (numbers.len() > 1).then(|| format!("[{i}]"));
    let path = format!("{path}{}", index.unwrap_or_default());
    let rule = format!("numbers are 0 or have magnitudes from {SMALLEST:e} to {LARGEST:e}");
    Err(SceneProblem::new(path, show(numbers[i]), rule))
}
