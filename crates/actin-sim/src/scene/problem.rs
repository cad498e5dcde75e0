//! What is wrong with a scene, and where.

use super::locate;
use std::fmt;

/// A value that a scene may not have: the key, the value and the rule it breaks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// Path of the key, such as `filament.sections[1].to_nm`.
    pub key: String,
    /// The value as read; empty if the key stands for a structure.
    pub value: String,
    /// What a value has to satisfy.
    pub rule: String,
}

impl Problem {
    /// A problem with the value of `key`.
    pub fn new(key: impl Into<String>, value: impl fmt::Display, rule: impl Into<String>) -> Self {
        Self {
            key: key.into(),
            value: value.to_string(),
            rule: rule.into(),
        }
    }

    /// The same with `filament`, which its key begins with, under another key.
    pub(crate) fn with_filament(self, key: &str) -> Self {
        match self.key.strip_prefix("filament") {
            Some(rest) if rest.is_empty() || rest.starts_with('.') => Self {
                key: format!("{key}{rest}"),
                ..self
            },
            _ => self,
        }
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.key)?;
        if !self.value.is_empty() {
            write!(f, " = {}", self.value)?;
        }
        write!(f, ": {}", self.rule)
    }
}

impl std::error::Error for Problem {}

/// A scene that was refused, with the place in its text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneError {
    /// Line, counted from 1.
    pub line: usize,
    /// Column in characters, counted from 1.
    pub column: usize,
    /// What is wrong.
    pub message: String,
}

impl SceneError {
    /// Places a problem in the text of its scene: at its key, or at the innermost key above it
    /// that is written there.
    pub fn locate(problem: &Problem, text: &str) -> Self {
        // Filament 0 of a scene may stand in a list of one.
        let is_listed =
            !locate::is_written(text, "filament") && locate::is_written(text, "filaments");
        let problem = if is_listed {
            problem.clone().with_filament("filaments[0]")
        } else {
            problem.clone()
        };
        let (line, column) = locate::position(text, &problem.key);
        Self {
            line,
            column,
            message: problem.to_string(),
        }
    }
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: {}", self.line, self.column, self.message)
    }
}

impl std::error::Error for SceneError {}
