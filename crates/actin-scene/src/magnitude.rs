//! The magnitudes that numbers of a scene may have.
//!
//! Between them products of a few numbers neither overflow nor vanish, so that what is wrong is the
//! number that a scene wrote and not what became of it. What is not finite has rules of its own.

use super::{Scene, SceneProblem, SceneValue};

/// Largest magnitude of a number: of such a stiffness over the smallest mass, the square of the
/// frequency is 1e120.
const LARGEST: f64 = 1e60;

/// Smallest magnitude of a number that is not zero.
const SMALLEST: f64 = 1e-60;

/// Refuses the first number that is too large or too small to compute with.
pub(super) fn check(scene: &Scene) -> Result<(), SceneProblem> {
    walk(&scene.to_value(), "")
}

/// Goes through a structure whose key is `path`.
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

/// The path of a key; names of variants, such as `Rod`, are no part of it.
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
