//! Value of a text with all mistakes in it.

use super::SceneError;

/// Value of a text, and all mistakes in it.
#[derive(Clone, Debug)]
pub struct ParseReport<T> {
    /// Value without unknown keys; `None` if it cannot be determined.
    pub value: Option<T>,
    /// Independent mistakes in the order of the text.
    pub mistakes: Vec<SceneError>,
}

impl<T> ParseReport<T> {
    pub(super) fn into_result(self) -> Result<T, SceneError> {
        match (self.value, self.mistakes.into_iter().next()) {
            (Some(value), None) => Ok(value),
            (_, Some(mistake)) => Err(mistake),
            (None, None) => unreachable!("a text without a value has a mistake"),
        }
    }
}
