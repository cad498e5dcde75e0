//! Conversion of scenes from and to text and values.

use super::deserialize::deserialize;
use super::position::{line_and_column, without_mark};
use super::text::SCENE_DEPTH;
use super::tree::print;
use super::{ParseReport, RodLaw, RodLaws, Scene, SceneError, SceneProblem, SceneText, SceneValue};
use super::{scene_file::SceneFile, serialize, trace, validate::validate};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::path::Path;

impl RodLaws {
    /// Returns the laws as RON, as written after `law:` in a scene.
    pub fn to_ron(&self) -> String {
        let law = RodLaw::Laws(Box::new(self.clone()));
        print(&serialize::to_value(&law, false), 4)
    }
}

impl Scene {
    /// Decodes the bytes of a scene file as UTF-8.
    ///
    /// # Errors
    /// The first invalid byte, with line and column.
    pub fn text(bytes: Vec<u8>) -> Result<String, SceneError> {
        String::from_utf8(bytes).map_err(|error| {
            let good = error.utf8_error().valid_up_to();
            let bytes = error.as_bytes();
            let before = String::from_utf8_lossy(&bytes[..good]);
            let before = without_mark(&before);
            let hint = match bytes {
                [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => "; the file seems to be UTF-16",
                _ => "",
            };
            let byte = bytes[good];
            let message = format!("byte {byte:#04x} is not UTF-8{hint}: save the file as UTF-8");
            SceneError::new(line_and_column(before, before.len()), &message)
        })
    }

    /// Reads and validates a scene file like [`from_ron`](Self::from_ron). Paths in it are relative to its folder.
    ///
    /// # Errors
    /// A file that cannot be read, or as [`from_ron`](Self::from_ron), with the path.
    pub fn from_path(path: impl AsRef<Path>) -> Result<Self, SceneError> {
        let path = path.as_ref();
        let read = || {
            let unread = |error| SceneError::new((0, 0), &format!("cannot be read: {error}"));
            let text = Self::text(std::fs::read(path).map_err(unread)?)?;
            let mut text = SceneText::new(&text);
            text.resolve_paths(path.parent().unwrap_or(Path::new("")))?;
            text.scene()
        };
        read().map_err(|error| SceneError {
            file: Some(path.into()),
            ..error
        })
    }

    /// Reads and validates a scene. A byte-order mark is skipped. A text that begins with `{` is JSON, and
    /// a text that begins with a key is YAML.
    ///
    /// # Errors
    /// Invalid RON, JSON or YAML, an unknown or missing key, or an invalid value, each with line and column.
    pub fn from_ron(text: &str) -> Result<Self, SceneError> {
        SceneText::new(text).scene()
    }

    /// Returns the scene as RON with all defaults.
    pub fn to_ron(&self) -> String {
        to_ron(self, SCENE_DEPTH)
    }

    /// Reads and validates a scene like [`from_ron`](Self::from_ron). Files of points are relative to `folder`;
    /// without a folder they are refused.
    ///
    /// ```
    /// use actin_scene::{Scene, SceneKind, SceneValue};
    /// let text = "Scene(
    ///     filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 40.0)]),
    ///     clamps: [Clamp(end: Start)],
    ///     task: Equilibrium(),
    /// )";
    /// let scene = Scene::from_ron(text)?;
    /// assert_eq!(Scene::from_value(&scene.to_value(), None)?, scene);
    /// let none = SceneValue::keys(vec![("filamnt".into(), SceneKind::None.into())]);
    /// let problem = Scene::from_value(&none, None).unwrap_err();
    /// assert_eq!(problem.key, "filamnt");
    /// assert!(problem.rule.ends_with("did you mean filament?"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// An unknown or missing key, a value of another type, or an invalid value.
    pub fn from_value(value: &SceneValue, folder: Option<&Path>) -> Result<Self, SceneProblem> {
        let mut value = value.clone();
        value.remove_schema();
        if let Some(folder) = folder {
            trace::resolve_paths(&mut value, folder)?;
        }
        let written: SceneFile = deserialize(&value, "").map_err(|refusal| {
            let rule = match refusal.suggestion() {
                Some(suggestion) => format!("{refusal}; did you mean {suggestion}?"),
                None => refusal.to_string(),
            };
            SceneProblem::new(value.path(&refusal.indices()), "", rule)
        })?;
        let scene = Self::try_from(written)?;
        validate(&scene).map(|()| scene)
    }

    /// Returns the scene as a value with all defaults. Options that are `None` have no key.
    pub fn to_value(&self) -> SceneValue {
        serialize::to_value(self, false)
    }
}

/// Returns a value as RON. Structures at a depth below `depth` have one line for each key.
pub fn to_ron<T: Serialize>(value: &T, depth: usize) -> String {
    print(&serialize::to_value(value, true), depth)
}

/// Reads a structure from RON; `name` is its name. Unknown keys are refused, and a byte-order mark is skipped.
///
/// # Errors
/// Invalid RON, an unknown or missing key, or a value of another type, each with line and column.
pub fn read_ron<T: DeserializeOwned>(text: &str, name: &str) -> Result<T, SceneError> {
    SceneText::named(text, name).readings().into_result()
}

/// Reads a structure like [`read_ron`], and returns up to 20 mistakes instead of only the first. Texts longer
/// than 100 kB have fewer.
pub fn read_all<T: DeserializeOwned>(text: &str, name: &str) -> ParseReport<T> {
    SceneText::named(text, name).readings()
}

impl SceneError {
    /// Locates a problem in the text of its scene: at its key, or at the innermost written parent.
    pub fn locate(problem: &SceneProblem, text: &str) -> Self {
        SceneText::new(text).locate(problem)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SceneKind as Kind;

    const SCENE: &str = "Scene(
    title: \"\u{3c6}\",
    filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 30.0)]),
    clamps: [Clamp(end: Start)],
    task: Equilibrium(),
)";

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
        assert_eq!(place(b"a\n\xc3"), (2, 1));
        let latin = Scene::text(b"// \xe9t".to_vec()).unwrap_err().to_string();
        assert!(latin.starts_with("1:4: byte 0xe9 is not UTF-8"), "{latin}");
        let wide = Scene::text(vec![0xff, 0xfe, b'S', 0]).unwrap_err();
        assert!(wide.message.contains("UTF-16"), "{wide}");
    }

    #[test]
    fn errors_of_files_have_their_path() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("scene.ron");
        let refused = || Scene::from_path(&path).unwrap_err().to_string();
        let place = format!("{}: cannot be read", path.display());
        assert!(refused().starts_with(&place), "{}", refused());
        std::fs::write(&path, SCENE.replace("title", "name")).unwrap();
        let place = format!("{}:2:5: unknown key", path.display());
        assert!(refused().starts_with(&place), "{}", refused());
        std::fs::write(&path, SCENE).unwrap();
        assert_eq!(Scene::from_path(&path), Scene::from_ron(SCENE));
    }

    #[test]
    fn a_name_alone_has_all_defaults() {
        let scene = Scene::from_ron(SCENE).unwrap();
        let alone = |text: &str| Scene::from_ron(text).map_err(|error| error.to_string());
        let ron = SCENE.replace("Equilibrium()", "Equilibrium");
        let keys =
            "filament: {sections: [{Rod: {from_nm: 0, to_nm: 30}}]}\nclamps: [{end: Start}]\n";
        let yaml = format!("title: \u{3c6}\n{keys}task: Equilibrium\n");
        let mut value = scene.to_value();
        value
            .set("task", Kind::Text("Equilibrium".into()).into())
            .unwrap();
        assert_eq!(alone(&ron).as_ref(), Ok(&scene));
        assert_eq!(alone(&yaml).as_ref(), Ok(&scene));
        assert_eq!(Scene::from_value(&value, None).as_ref(), Ok(&scene));
        let mut text = SceneText::new(&ron);
        text.set("task.lowest_eigenvalue=true".parse().unwrap())
            .unwrap();
        assert!(text.scene().is_ok());
        for (name, message) in [
            ("Dynamics", "5:19: missing key `duration_ns` in Dynamics"),
            ("Fitted", "5:11: unknown Task Fitted"),
        ] {
            let found =
                alone(&ron.replace("task: Equilibrium", &format!("task: {name}"))).unwrap_err();
            assert!(found.starts_with(message), "{found}");
        }
    }

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
        assert!(error.message.contains("expected one of title, "), "{error}");
    }
}
