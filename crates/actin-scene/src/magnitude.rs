//! Permitted magnitudes of the numbers of a scene. Within them, products of a few numbers neither overflow nor
//! underflow.

use super::tree::{Kind, SceneValue};
use super::{Scene, SceneProblem};

const LARGEST: f64 = 1e60;

const SMALLEST: f64 = 1e-60;

/// Refuses finite numbers outside the permitted magnitudes.
pub(super) fn check(scene: &Scene) -> Result<(), SceneProblem> {
    walk(&scene.to_value(), "")
}

fn walk(value: &SceneValue, path: &str) -> Result<(), SceneProblem> {
    if let Kind::Number(number) = value.kind
        && number.is_finite()
    {
        return within(path, number);
    }
    let mut children = value.children().iter().enumerate();
    children.try_for_each(|(i, child)| match child.key() {
        None => walk(child, &format!("{path}[{i}]")),
        Some(key) if path.is_empty() => walk(child, key),
        Some(key) => walk(child, &format!("{path}.{key}")),
    })
}

fn within(path: &str, number: f64) -> Result<(), SceneProblem> {
    if number == 0.0 || (SMALLEST..=LARGEST).contains(&number.abs()) {
        return Ok(());
    }
    let rule = format!("numbers are 0 or have magnitudes from {SMALLEST:e} to {LARGEST:e}");
    Err(SceneProblem::new(path, format!("{number:?}"), rule))
}
