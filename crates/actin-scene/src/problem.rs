//! What is wrong with a scene, and where.

use super::locate;
use std::borrow::Cow;
use std::fmt;

/// A value that a scene may not have: the key, the value and the rule it breaks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneProblem {
    /// Path of the key, such as `filament.sections[1].to_nm`.
    pub key: String,
    /// The value as read; empty if the key stands for a structure.
    pub value: String,
    /// What a value has to satisfy.
    pub rule: String,
}

impl SceneProblem {
    /// A problem with the value of `key`.
    pub fn new(key: impl Into<String>, value: impl fmt::Display, rule: impl Into<String>) -> Self {
        Self {
            key: key.into(),
            value: value.to_string(),
            rule: rule.into(),
        }
    }

    /// The same problem with the beginning `filament` of its key replaced by `key`.
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

/// A scene that was refused, with the place in its text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneError {
    /// Line, counted from 1.
    pub line: usize,
    /// Column in characters, counted from 1.
    pub column: usize,
    /// The override that is to blame, as `key=value`; none where the text is.
    pub set: Option<String>,
    /// The key or choice that was probably meant, where one is close.
    pub meant: Option<String>,
    /// What is wrong.
    pub message: String,
}

/// Most characters of a word in a message, more than any key of a scene has with its path.
const LONGEST_WORD: usize = 100;

/// Most characters of a message, more than any list of known keys has.
const LONGEST_MESSAGE: usize = 2000;

impl SceneError {
    /// An error at a place. What the text has made longer than anybody reads is cut.
    pub(super) fn new((line, column): (usize, usize), message: &str) -> Self {
        let words = message.split_inclusive(char::is_whitespace);
        let message: String = words
            .flat_map(|word| {
                let (word, space) = word.split_at(word.trim_end().len());
                [cut(word, LONGEST_WORD), space.into()]
            })
            .collect();
        Self {
            line,
            column,
            set: None,
            meant: None,
            message: cut(&message, LONGEST_MESSAGE).into_owned(),
        }
    }

    /// Places a problem in the text of its scene: at its key, or at the innermost key above it
    /// that is written there.
    pub fn locate(problem: &SceneProblem, text: &str) -> Self {
        // Filament 0 of a scene may stand in a list of one.
        let is_listed =
            !locate::is_written(text, "filament") && locate::is_written(text, "filaments");
        let problem = if is_listed {
            problem.clone().with_filament("filaments[0]")
        } else {
            problem.clone()
        };
        let place = locate::position(text, &problem.key);
        Self::new(place, &problem.to_string())
    }
}

/// The beginning of a text that is longer than `most` characters, with the number of all.
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
        match &self.set {
            None => write!(f, "{}:{}: {}", self.line, self.column, self.message),
            Some(set) => write!(f, "{set}: {}", self.message),
        }
    }
}

impl std::error::Error for SceneError {}

#[cfg(test)]
mod tests {
    use super::*;

    /// A key of a megabyte, and a megabyte of short words: the message says how long they were, and
    /// keeps what stands behind a key. Characters are counted, not bytes.
    #[test]
    fn what_nobody_reads_is_cut() {
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
