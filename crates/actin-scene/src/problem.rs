//! Errors of scenes and their positions.

use std::borrow::Cow;
use std::fmt;
use std::path::PathBuf;

/// Value that breaks a rule of scenes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneProblem {
    /// Path of the key, such as `filament.sections[1].to_nm`.
    pub key: String,
    /// Value as read; empty for a structure.
    pub value: String,
    /// Violated rule, with a remedy.
    pub rule: String,
}

impl SceneProblem {
    /// Creates a problem with the value of `key`.
    pub fn new(key: impl Into<String>, value: impl fmt::Display, rule: impl Into<String>) -> Self {
        Self {
            key: key.into(),
            value: value.to_string(),
            rule: rule.into(),
        }
    }

    /// Replaces the first component `filament` of the key.
    #[must_use]
    pub fn with_filament(self, key: &str) -> Self {
        match self.key.strip_prefix("filament") {
            Some(rest) if rest.is_empty() || rest.starts_with('.') => Self {
                key: format!("{key}{rest}"),
                ..self
            },
            _ => self,
        }
    }
}

impl fmt::Display for SceneProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.key)?;
        if !self.value.is_empty() {
            write!(f, " = {}", self.value)?;
        }
        write!(f, ": {}", self.rule)
    }
}

impl std::error::Error for SceneProblem {}

/// Problems of a scene: the first `most`, one for each key.
pub(super) struct Problems {
    pub(super) found: Vec<SceneProblem>,
    most: usize,
}

impl Problems {
    pub(super) fn new(most: usize) -> Self {
        let found = Vec::new();
        Self { found, most }
    }

    /// Adds the problem of a check that failed.
    pub(super) fn note(&mut self, checked: Result<(), SceneProblem>) {
        let problem = checked.err().filter(|_| self.found.len() < self.most);
        let is_new = |problem: &SceneProblem| self.found.iter().all(|p| p.key != problem.key);
        let new = problem.filter(is_new);
        self.found.extend(new);
    }

    /// Checks a rule of the value at `key`, unless a number in it is invalid.
    pub(super) fn check(&mut self, key: &str, rule: impl FnOnce() -> Result<(), SceneProblem>) {
        let is_full = self.found.len() >= self.most;
        if !is_full && !self.found.iter().any(|p| p.key.starts_with(key)) {
            self.note(rule());
        }
    }

    /// Returns the first problem as an error.
    pub(super) fn into_result(self) -> Result<(), SceneProblem> {
        self.found.into_iter().next().map_or(Ok(()), Err)
    }
}

/// Error of a scene with its position in the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneError {
    /// File, if the scene was read from a path.
    pub file: Option<PathBuf>,
    /// Line, counted from 1; 0 if the file cannot be read.
    pub line: usize,
    /// Column in characters, counted from 1.
    pub column: usize,
    /// Override that causes the error, as `key=value`; `None` if the text causes it.
    pub set: Option<String>,
    /// Closest known key or choice, if any.
    pub suggestion: Option<String>,
    /// Description of the error.
    pub message: String,
}

/// Maximum length of a word in a message (characters). All valid keys with their paths are shorter.
const LONGEST_WORD: usize = 100;

/// Maximum length of a message (characters). All lists of known keys are shorter.
const LONGEST_MESSAGE: usize = 2000;

impl SceneError {
    /// Creates an error at a line and column. Overlong words and messages are cut.
    pub(super) fn new((line, column): (usize, usize), message: &str) -> Self {
        let words = message.split_inclusive(char::is_whitespace);
        let message: String = words
            .flat_map(|word| {
                let (word, space) = word.split_at(word.trim_end().len());
                [cut(word, LONGEST_WORD), space.into()]
            })
            .collect();
        Self {
            file: None,
            line,
            column,
            set: None,
            suggestion: None,
            message: cut(&message, LONGEST_MESSAGE).into_owned(),
        }
    }
}

fn cut(text: &str, most: usize) -> Cow<'_, str> {
    match text.char_indices().nth(most) {
        None => text.into(),
        Some((end, _)) => {
            let (start, all) = (&text[..end], text.chars().count());
            format!("{start}... ({all} characters)").into()
        }
    }
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(file) = &self.file {
            write!(f, "{}:", file.display())?;
            if self.line == 0 {
                return write!(f, " {}", self.message);
            }
        }
        match &self.set {
            None => write!(f, "{}:{}: {}", self.line, self.column, self.message),
            Some(set) => write!(f, "{set}: {}", self.message),
        }
    }
}

impl std::error::Error for SceneError {}

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn overlong_messages_are_cut() {
        let message = |text: &str| SceneError::new((1, 1), text).message;
        assert_eq!(message("unknown key a: write b"), "unknown key a: write b");
        let key = "\u{e9}".repeat(1 << 20);
        let long = message(&format!("unknown key {key}: write b"));
        assert!(long.starts_with("unknown key \u{e9}\u{e9}"), "{long}");
        assert!(long.ends_with("... (1048577 characters) write b"), "{long}");
        assert!(long.chars().count() < 200);
        let words = message(&"a b ".repeat(1 << 18));
        assert!(words.ends_with("... (1048576 characters)"), "{words}");
        assert!(words.len() < 2100);
    }
}
