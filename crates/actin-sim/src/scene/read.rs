//! Reading and writing scenes as RON.

use super::{Problem, RodLaw, RodLaws, Scene, SceneError, locate};
use super::{validate::validate, written::Written};
use ron::error::{Error as RonError, SpannedError};
use ron::extensions::Extensions;
use ron::ser::PrettyConfig;

/// Suffixes that keys carry for their units; a suffix stands before those that it ends with.
const UNIT_SUFFIXES: [&str; 8] = [
    "_per_ns", "_per_nm", "_nm", "_nm2", "_pn", "_ns", "_deg", "_ag",
];

impl RodLaws {
    /// The laws as a scene writes them after `law:`.
    ///
    /// # Panics
    /// Never: laws hold numbers and names alone.
    pub fn to_ron(&self) -> String {
        let law = RodLaw::Laws(Box::new(self.clone()));
        let config = PrettyConfig::new().depth_limit(4).compact_arrays(true);
        options()
            .to_string_pretty(&law, config)
            .expect("laws hold numbers and names only, which RON can write")
    }
}

impl Scene {
    /// Reads and validates a scene.
    ///
    /// # Errors
    /// Text that is no RON, an unknown or missing key, or a value against the rules, each with
    /// line and column.
    pub fn from_ron(text: &str) -> Result<Self, SceneError> {
        let is_nothing = |line: &str| line.trim().is_empty() || line.trim().starts_with("//");
        if text.lines().all(is_nothing) {
            return Err(SceneError {
                line: 1,
                column: 1,
                message: "the scene is empty: it must begin with Scene(".into(),
            });
        }
        let written: Written = options()
            .from_str(text)
            .map_err(|error| explain(&error, text))?;
        let read = || {
            let scene = Self::try_from(written)?;
            validate(&scene)?;
            Ok(scene)
        };
        read().map_err(|problem: Problem| SceneError::locate(&problem, text))
    }

    /// The scene as RON with every default written out.
    ///
    /// # Panics
    /// Never: scenes hold only what RON can write.
    pub fn to_ron(&self) -> String {
        let config = PrettyConfig::new()
            .struct_names(true)
            .depth_limit(6)
            .compact_arrays(true);
        options()
            .to_string_pretty(self, config)
            .expect("scenes hold numbers, names and lists only, which RON can write")
    }
}

fn options() -> ron::Options {
    ron::Options::default()
        .with_default_extension(Extensions::IMPLICIT_SOME)
        .with_default_extension(Extensions::UNWRAP_VARIANT_NEWTYPES)
}

/// RON's error with its place, in the words of a scene.
fn explain(error: &SpannedError, text: &str) -> SceneError {
    let (mut line, mut column) = (error.span.start.line, error.span.start.col);
    if error.code == RonError::TrailingCharacters {
        (line, column) = next_character(text, (line, column));
    }
    let message = in_words(&error.code).unwrap_or_else(|| {
        let path = locate::path_at(text, (line, column));
        let colon = if path.is_empty() { "" } else { ": " };
        format!("{path}{colon}{}", error.code)
    });
    SceneError {
        line,
        column,
        message,
    }
}

/// The first place from here on that is not white.
fn next_character(text: &str, (line, column): (usize, usize)) -> (usize, usize) {
    let place = text
        .lines()
        .zip(1..)
        .skip(line - 1)
        .find_map(|(content, at)| {
            let from = if at == line { column - 1 } else { 0 };
            let mut characters = content.chars().zip(1..).skip(from);
            let (_, found) = characters.find(|(c, _)| !c.is_whitespace())?;
            Some((at, found))
        });
    place.unwrap_or((line, column))
}

/// Errors that name what they are about; none for those that do not.
fn in_words(error: &RonError) -> Option<String> {
    let of = |outer: &Option<String>| outer.as_ref().map_or(String::new(), |o| format!(" in {o}"));
    Some(match error {
        RonError::NoSuchStructField {
            expected,
            found,
            outer,
        } => {
            let hint = unit_hint(expected, found);
            let hint = hint.unwrap_or_else(|| format!("known are {}", expected.join(", ")));
            format!("unknown key {found}{}: {hint}", of(outer))
        }
        RonError::MissingStructField { field, outer } => {
            format!("missing key {field}{}", of(outer))
        }
        RonError::DuplicateStructField { field, outer } => {
            format!("key {field} is written twice{}", of(outer))
        }
        RonError::NoSuchEnumVariant {
            expected,
            found,
            outer,
        } => {
            let kind = outer.as_deref().unwrap_or("choice");
            format!("unknown {kind} {found}: known are {}", expected.join(", "))
        }
        RonError::TrailingCharacters => "there is text behind the scene".into(),
        RonError::Eof => "the text ends before the scene does: a bracket is not closed".into(),
        _ => return None,
    })
}

/// Where `found` is an expected key with another unit or none, says which unit the key has.
fn unit_hint(expected: &[&'static str], found: &str) -> Option<String> {
    let is_meant = |key: &&&str| {
        let stem = stem(key);
        let rest = found.strip_prefix(stem);
        stem != **key && rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('_'))
    };
    let key = expected.iter().filter(is_meant).max_by_key(|key| key.len());
    key.map(|key| format!("the unit is part of the key, write {key}"))
}

/// A key without its unit.
fn stem(key: &str) -> &str {
    let shorter = UNIT_SUFFIXES
        .iter()
        .find_map(|suffix| key.strip_suffix(suffix));
    shorter.map_or(key, stem)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The unit may be several suffixes long; a key without a unit is never suggested.
    #[test]
    fn a_mistaken_unit_is_recognised() {
        assert_eq!(
            stem("longitudinal_rigidity_pn_per_nm"),
            "longitudinal_rigidity"
        );
        assert_eq!(stem("translational_per_ns"), "translational");
        assert_eq!(stem("bend_pn_nm2"), "bend");
        let keys = ["from_nm", "to_nm", "segments", "force_pn", "turn_deg"];
        let hint = |found| unit_hint(&keys, found);
        let to_nm = Some("the unit is part of the key, write to_nm".into());
        assert_eq!((hint("to_um"), hint("to")), (to_nm.clone(), to_nm));
        assert!(hint("turn_rad").unwrap().ends_with("turn_deg"));
        assert_eq!(
            (hint("segments_nm"), hint("total"), hint("")),
            (None, None, None)
        );
    }
}
