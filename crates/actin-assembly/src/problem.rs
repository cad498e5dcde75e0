//! Problems of scenes from errors of other crates.

use crate::scene::SceneProblem;
use std::fmt::Display;

/// Returns a conversion of errors into problems of a scene at a key, for `map_err`.
pub fn problem_at<E: Display>(key: impl Into<String>) -> impl Fn(E) -> SceneProblem {
    let key = key.into();
    move |error| SceneProblem::new(key.clone(), "", error.to_string())
}
