//! Reading and writing scenes as RON.

use super::outline::place;
use super::{RodLaw, RodLaws, Scene, SceneError, SceneProblem, brackets, locate, syntax};
use super::{validate::validate, written::Written};
use ron::error::{Error as RonError, SpannedError};
use ron::extensions::Extensions;
use ron::ser::PrettyConfig;
use serde::de::DeserializeOwned;

/// Suffixes that keys carry for their units; a suffix stands before those that it ends with.
const UNIT_SUFFIXES: [&str; 10] = [
    "_mpa_s", "_ms", "_per_ns", "_per_nm", "_nm", "_nm2", "_pn", "_ns", "_deg", "_ag",
];

/// Longest word that is compared with those that are known.
const LONGEST_KEY: usize = 100;

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
    /// The text of a scene from the bytes of its file, which are UTF-8.
    ///
    /// # Errors
    /// The first byte that is not, with its line and column.
    pub fn text(bytes: Vec<u8>) -> Result<String, SceneError> {
        String::from_utf8(bytes).map_err(|error| {
            let good = error.utf8_error().valid_up_to();
            let bytes = error.as_bytes();
            let before = String::from_utf8_lossy(&bytes[..good]);
            let before = locate::without_mark(&before);
            let line = before.matches('\n').count() + 1;
            let column = before.chars().rev().take_while(|&c| c != '\n').count() + 1;
            let hint = match bytes {
                [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => "; the file begins as UTF-16 does",
                _ => "",
            };
            let byte = bytes[good];
            let message = format!(
                "byte {byte:#04x} is not UTF-8, in which scenes are written{hint}: save the file as UTF-8"
            );
            SceneError::new((line, column), &message)
        })
    }

    /// Reads and validates a scene; a byte-order mark before it is skipped.
    ///
    /// # Errors
    /// Text that is no RON, an unknown or missing key, or a value against the rules, each with
    /// line and column.
    pub fn from_ron(text: &str) -> Result<Self, SceneError> {
        let (scene, problem) = Self::read(text)?;
        problem.map_or(Ok(scene), |problem| Err(SceneError::locate(&problem, text)))
    }

    /// Reads a scene, which its rules may refuse.
    pub(super) fn read(text: &str) -> Result<(Self, Option<SceneProblem>), SceneError> {
        let written: Written = read_ron(text, "Scene")?;
        let scene = Self::try_from(written).map_err(|p| SceneError::locate(&p, text))?;
        let problem = validate(&scene).err();
        Ok((scene, problem))
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

/// Reads what a RON text describes, strictly, as scenes are read; `name` is that of the outermost
/// structure. A byte-order mark is skipped.
///
/// # Errors
/// Text that is no RON, an unknown or missing key, a value of another type, each with line and column.
pub fn read_ron<T: DeserializeOwned>(text: &str, name: &str) -> Result<T, SceneError> {
    let text = locate::without_mark(text);
    read_refusing(text, text, name).map_err(|refusal| refusal.error)
}

/// What RON does not take.
pub(super) struct Refusal {
    pub(super) error: SceneError,
    /// The key that is missing, if one is.
    pub(super) missing: Option<String>,
    /// Whether there is no text or a bracket is missing, so that nothing behind it can be judged.
    pub(super) is_of_brackets: bool,
    /// Whether it is a key without which the text means what it should.
    pub(super) is_needless: bool,
}

/// Reads `left`, which has everything where `text` has it.
pub(super) fn read_refusing<T: DeserializeOwned>(
    left: &str,
    text: &str,
    name: &str,
) -> Result<T, Refusal> {
    let is_nothing = |line: &str| line.trim().is_empty() || line.trim().starts_with("//");
    if text.lines().all(is_nothing) {
        let file = name.to_lowercase();
        let message = format!("the {file} is empty: it must begin with {name}(");
        return Err(Refusal {
            error: SceneError::new((1, 1), &message),
            missing: None,
            is_of_brackets: true,
            is_needless: false,
        });
    }
    options().from_str(left).map_err(|error| {
        let brackets = brackets::mistake(text);
        let missing = match &error.code {
            RonError::MissingStructField { field, .. } => Some((*field).to_owned()),
            _ => None,
        };
        let is_needless = matches!(
            error.code,
            RonError::NoSuchStructField { .. } | RonError::DuplicateStructField { .. }
        );
        Refusal {
            missing,
            is_of_brackets: brackets.is_some()
                || matches!(error.code, RonError::Eof | RonError::TrailingCharacters),
            is_needless,
            error: brackets.unwrap_or_else(|| explain(&error, text, name)),
        }
    })
}

fn options() -> ron::Options {
    ron::Options::default()
        .with_default_extension(Extensions::IMPLICIT_SOME)
        .with_default_extension(Extensions::UNWRAP_VARIANT_NEWTYPES)
}

/// RON's error with its place, in the words of a scene.
fn explain(error: &SpannedError, text: &str, name: &str) -> SceneError {
    let (mut line, mut column) = (error.span.start.line, error.span.start.col);
    if error.code == RonError::TrailingCharacters {
        (line, column) = next_character(text, (line, column));
    }
    let message = in_words(&error.code, &name.to_lowercase()).unwrap_or_else(|| {
        let path = locate::path_at(text, (line, column));
        let colon = if path.is_empty() { "" } else { ": " };
        let advice = syntax::advice(&error.code, text.split_at(place(text, (line, column))));
        let what = advice.unwrap_or_else(|| error.code.to_string());
        format!("{path}{colon}{what}")
    });
    SceneError {
        meant: meant(&error.code),
        ..SceneError::new((line, column), &message)
    }
}

/// The key or choice that is close to one which is not known.
pub(super) fn meant(error: &RonError) -> Option<String> {
    let (RonError::NoSuchStructField {
        expected, found, ..
    }
    | RonError::NoSuchEnumVariant {
        expected, found, ..
    }) = error
    else {
        return None;
    };
    if found.len() > LONGEST_KEY {
        return None;
    }
    if let Some(key) = key_of_unit(expected, found) {
        return Some(key.to_owned());
    }
    // One slip for every three letters.
    let most = (found.chars().count() / 3).max(1);
    let near = expected.iter().map(|&key| {
        let distance = strsim::damerau_levenshtein(&key.to_lowercase(), &found.to_lowercase());
        (distance, key)
    });
    let (distance, key) = near.min_by_key(|(distance, _)| *distance)?;
    (distance <= most).then(|| key.to_owned())
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
pub(super) fn in_words(error: &RonError, file: &str) -> Option<String> {
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
        RonError::TrailingCharacters => format!("unexpected text after the {file}"),
        RonError::Eof => {
            format!("the text ends before the {file} does: a bracket is not closed")
        }
        _ => return None,
    })
}

/// Where `found` is an expected key with another unit or none, says which unit the key has.
fn unit_hint(expected: &[&'static str], found: &str) -> Option<String> {
    let key = key_of_unit(expected, found);
    key.map(|key| format!("the unit is part of the key, write {key}"))
}

/// The key that is `found` with another unit or none.
fn key_of_unit(expected: &[&'static str], found: &str) -> Option<&'static str> {
    let is_meant = |key: &&&str| {
        let stem = stem(key);
        let rest = found.strip_prefix(stem);
        stem != **key && rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('_'))
    };
    let meant = expected.iter().filter(is_meant);
    meant.max_by_key(|key| key.len()).copied()
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

    const SCENE: &str = "Scene(
    title: \"\u{3c6}\",
    filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 30.0)]),
    clamps: [Clamp(end: Start)],
    task: Equilibrium(),
)";

    /// Editors write a mark that they do not show: it is skipped, and columns are those they show.
    #[test]
    fn a_byte_order_mark_is_skipped() {
        let marked = format!("\u{feff}{SCENE}");
        assert_eq!(Scene::from_ron(&marked), Scene::from_ron(SCENE));
        assert!(Scene::from_ron(SCENE).is_ok());
        for spoilt in [
            SCENE.replacen("Scene(", "Scene(path: 1,", 1),
            SCENE.replacen("Scene(", "Scene(filament: Filament(sections: []),", 1),
            SCENE.replacen("title", "name", 1),
            "// nothing".into(),
        ] {
            let error = Scene::from_ron(&spoilt).unwrap_err();
            let marked = Scene::from_ron(&format!("\u{feff}{spoilt}"));
            assert_eq!(marked.unwrap_err(), error);
        }
        let problem = SceneProblem::new("task", "", "is placed");
        let of = |text: &str| SceneError::locate(&problem, text);
        let one_line = SCENE.replace('\n', " ");
        assert_eq!(of(&format!("\u{feff}{one_line}")), of(&one_line));
    }

    /// Line and column of the first byte that is no UTF-8, in characters; the mark takes none.
    #[test]
    fn text_that_is_not_utf8_has_a_place() {
        let place = |bytes: &[u8]| {
            let error = Scene::text(bytes.to_vec()).unwrap_err();
            (error.line, error.column)
        };
        assert_eq!(Scene::text(SCENE.into()).unwrap(), SCENE);
        assert_eq!(place(b"\xff"), (1, 1));
        assert_eq!(place(b"\xef\xbb\xbfab\xe9"), (1, 3));
        assert_eq!(place(b"Scene(\n  // \xc3\xa9t\xe9\n"), (2, 8));
        // Cut off within a character.
        assert_eq!(place(b"a\n\xc3"), (2, 1));
        let latin = Scene::text(b"// \xe9t".to_vec()).unwrap_err().to_string();
        assert!(latin.starts_with("1:4: byte 0xe9 is not UTF-8"), "{latin}");
        let wide = Scene::text(vec![0xff, 0xfe, b'S', 0]).unwrap_err();
        assert!(wide.message.contains("UTF-16"), "{wide}");
    }

    /// A key of a megabyte is cut wherever it stands in the message; the known keys are still told.
    #[test]
    fn a_key_of_a_megabyte_is_cut() {
        let key = "k".repeat(1 << 20);
        for (from, to) in [
            ("title", key.clone()),
            ("Equilibrium", key.clone()),
            ("to_nm: 30.0", format!("to_nm: {key}")),
            ("to_nm: 30.0", format!("{key}: (a: 1.0)")),
            ("\"\u{3c6}\"", format!("({key}: \"{key}\")")),
            ("Equilibrium()", format!("\"{}\"", "a b ".repeat(1 << 18))),
        ] {
            let text = SCENE.replacen(from, &to, 1);
            let error = Scene::from_ron(&text).unwrap_err();
            assert!(error.message.len() < 3000, "{} bytes", error.message.len());
        }
        let error = Scene::from_ron(&SCENE.replacen("title", &key, 1)).unwrap_err();
        assert!(error.message.contains("known are title, "), "{error}");
    }

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
