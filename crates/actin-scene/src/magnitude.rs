//! Permitted magnitudes of the numbers of a scene.
//!
//! Within them products of a few numbers neither overflow nor underflow. Numbers that are not finite have separate
//! rules.

use super::{Scene, SceneProblem, SceneValue};

/// Largest magnitude. Divided by the smallest mass, such a stiffness is a squared frequency of 1e120.
const LARGEST: f64 = 1e60;

/// Smallest magnitude of a nonzero number.
const SMALLEST: f64 = 1e-60;

/// Refuses numbers outside the permitted magnitudes.
pub(super) fn check(scene: &Scene) -> Result<(), SceneProblem> {
    walk(&scene.to_value(), "")
}

/// Checks all numbers below the key `path`.
fn walk(value: &SceneValue, path: &str) -> Result<(), SceneProblem> {
    match value {
        SceneValue::Number(number) if number.is_finite() => within(path, *number),
        SceneValue::List(items) => items
            .iter()
            .enumerate()
            .try_for_each(|(i, item)| walk(item, &format!("{path}[{i}]"))),
        SceneValue::Keys(fields) => fields
            .iter()
            .try_for_each(|(key, field)| walk(field, &below(path, key))),
        _ => Ok(()),
    }
}

/// Path of a key, without the names of variants such as `Rod`.
fn below(path: &str, key: &str) -> String {
    let is_variant = key.starts_with(char::is_uppercase);
    match (path.is_empty(), is_variant) {
        (_, true) => path.to_owned(),
        (true, false) => key.to_owned(),
        (false, false) => format!("{path}.{key}"),
    }
}

fn within(path: &str, number: f64) -> Result<(), SceneProblem> {
    if number == 0.0 || (SMALLEST..=LARGEST).contains(&number.abs()) {
        return Ok(());
    }
    let rule = format!("numbers are 0 or have magnitudes from {SMALLEST:e} to {LARGEST:e}");
    Err(SceneProblem::new(path, format!("{number:?}"), rule))
}
