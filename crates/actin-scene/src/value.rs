//! Scenes as values of other languages: dictionaries, lists, numbers and names in the place of RON.
//!
//! Keys, choices and rules are those of the text of a scene; a mistake names the path of its key. How a value is read
//! is in `value/reader.rs`, how a scene becomes one in `value/writer.rs`.

mod reader;
mod writer;

use super::outline::{Step, steps};
use super::shape::Shape;
use super::trace::points;
use super::{Scene, SceneProblem, validate::validate, written::Written};
use reader::Refusal;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// A scene, or a part of one, as a value.
///
/// | in RON | here |
/// |---|---|
/// | `(from_nm: 0.0)` with or without a name | `Keys` |
/// | `Ellipsoids(from_nm: 0.0)`, a choice with keys | `Keys` of one, whose key is the name |
/// | `Start`, a choice without | `Text` |
/// | `[1.0, 2.0]`, `(1.0, 2.0, 3.0)` | `List` |
/// | a key that may be left out, left out | `None`, or no key |
#[derive(Clone, Debug, PartialEq)]
pub enum SceneValue {
    /// Nothing.
    None,
    /// A truth value.
    Bool(bool),
    /// A whole number, which stands for other numbers too.
    Whole(i128),
    /// A number.
    Number(f64),
    /// A text, or the name of a choice.
    Text(String),
    /// A list or a vector.
    List(Vec<SceneValue>),
    /// Values under their keys, in order.
    Keys(Vec<(String, SceneValue)>),
}

impl SceneValue {
    /// Gives a key a value, whether it is there or not. The path is that of an [`Override`](super::Override): keys, and
    /// indices of lists in brackets, without names of choices.
    ///
    /// ```
    /// use actin_scene::SceneValue::{Keys, Text, Whole};
    /// let rod = Keys(vec![("to_nm".into(), Whole(40))]);
    /// let mut all = Keys(vec![("section".into(), Keys(vec![("Rod".into(), rod)]))]);
    /// all.set("section.to_nm", Whole(80))?;
    /// let rod = Keys(vec![("to_nm".into(), Whole(80))]);
    /// assert_eq!(all, Keys(vec![("section".into(), Keys(vec![("Rod".into(), rod)]))]));
    /// assert!(all.set("section[3]", Text("a".into())).is_err());
    /// # Ok::<(), actin_scene::SceneProblem>(())
    /// ```
    ///
    /// # Errors
    /// A key in what has none, an index beyond the end of a list.
    pub fn set(&mut self, path: &str, value: Self) -> Result<(), SceneProblem> {
        let refused = |rule: &str| SceneProblem::new(path, "", rule);
        let mut here = self;
        for step in steps(path) {
            here = match (here.innermost(&step), step) {
                (Self::Keys(all), Step::Key(key)) => {
                    let place = all.iter().position(|(known, _)| *known == key);
                    let place = place.unwrap_or_else(|| {
                        all.push((key, Self::Keys(Vec::new())));
                        all.len() - 1
                    });
                    &mut all[place].1
                }
                (Self::List(all), Step::Index(index)) => {
                    let count = all.len();
                    let rule = format!("there is no element {index}, but {count} from 0 on");
                    all.get_mut(index).ok_or_else(|| refused(&rule))?
                }
                (_, Step::Key(key)) => {
                    return Err(refused(&format!("{key} is in what has no keys")));
                }
                (_, Step::Index(_)) => return Err(refused("an index is in what is no list")),
            };
        }
        *here = value;
        Ok(())
    }

    /// What a step goes on from: what a choice holds, unless the step names the choice.
    fn innermost(&mut self, step: &Step) -> &mut Self {
        let is_choice = |name: &str| name.starts_with(|c: char| c.is_ascii_uppercase());
        let is_other = |name: &str| *step != Step::Key(name.to_owned());
        let is_choice = matches!(
            self,
            Self::Keys(one) if one.len() == 1 && is_choice(&one[0].0) && is_other(&one[0].0)
        );
        if !is_choice {
            return self;
        }
        match self {
            Self::Keys(one) => &mut one[0].1,
            value => value,
        }
    }
}

impl Scene {
    /// Reads and validates a scene as [`from_ron`](Self::from_ron) does its text. Files of points are looked for in
    /// `folder`; without one they are refused.
    ///
    /// ```
    /// use actin_scene::{Scene, SceneValue};
    /// let text = "Scene(
    ///     filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 40.0)]),
    ///     clamps: [Clamp(end: Start)],
    ///     task: Equilibrium(),
    /// )";
    /// let scene = Scene::from_ron(text)?;
    /// assert_eq!(Scene::from_value(&scene.to_value(), None)?, scene);
    /// let none = SceneValue::Keys(vec![("filamnt".into(), SceneValue::None)]);
    /// let problem = Scene::from_value(&none, None).unwrap_err();
    /// assert_eq!(problem.key, "filamnt");
    /// assert!(problem.rule.ends_with("did you mean filament?"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// An unknown or missing key, a value of another type, or one against the rules.
    pub fn from_value(value: &SceneValue, folder: Option<&Path>) -> Result<Self, SceneProblem> {
        let written = Written::deserialize(value).map_err(|refusal| problem(&refusal))?;
        let mut scene = Self::try_from(written)?;
        if let Some(folder) = folder {
            scene.read_points(folder)?;
        }
        validate(&scene).map(|()| scene)
    }

    /// The scene as a value with every default; what is left out is no key.
    ///
    /// # Panics
    /// Never: scenes hold only what values can.
    pub fn to_value(&self) -> SceneValue {
        let written = Written::from(self.clone());
        written
            .serialize(writer::Writer)
            .expect("scenes hold numbers, names and lists only")
    }

    /// Takes the points of shapes from their files.
    fn read_points(&mut self, folder: &Path) -> Result<(), SceneProblem> {
        let keys: Vec<String> = (0..=self.further.len())
            .map(|i| self.filament_key(i))
            .collect();
        for (filament, key) in self.filaments_mut().zip(keys) {
            let Some(Shape::Points { nm, file }) = &mut filament.shape else {
                continue;
            };
            if let Some(name) = file.take_if(|_| nm.is_empty()) {
                *nm = points(&folder.join(&name)).map_err(|rule| {
                    SceneProblem::new(format!("{key}.shape.file"), format!("{name:?}"), rule)
                })?;
            }
        }
        Ok(())
    }
}

/// A refusal in the words of a scene.
fn problem(refusal: &Refusal) -> SceneProblem {
    SceneProblem::new(refusal.path(), "", refusal.rule())
}

#[cfg(test)]
mod tests {
    use super::*;
    use SceneValue::{Keys, List, Text, Whole};

    fn keys(all: &[(&str, SceneValue)]) -> SceneValue {
        let owned = all
            .iter()
            .map(|(key, value)| ((*key).to_owned(), value.clone()));
        Keys(owned.collect())
    }

    fn scene_with(section: SceneValue) -> SceneValue {
        keys(&[
            ("filament", keys(&[("sections", List(vec![section]))])),
            ("task", keys(&[("Equilibrium", keys(&[]))])),
        ])
    }

    fn refused(section: SceneValue) -> (String, String) {
        let problem = Scene::from_value(&scene_with(section), None).unwrap_err();
        (problem.key, problem.rule)
    }

    /// Every scene of the repository comes back as it was, whatever it is made of.
    #[test]
    fn all_scenes_go_there_and_back() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios");
        let mut folders = vec![folder];
        let mut number = 0;
        while let Some(folder) = folders.pop() {
            for entry in std::fs::read_dir(folder).unwrap() {
                let path = entry.unwrap().path();
                if path.is_dir() {
                    folders.push(path);
                    continue;
                }
                let Ok(text) = std::fs::read_to_string(&path) else {
                    continue;
                };
                if let Ok(scene) = Scene::from_ron(&text) {
                    assert_eq!(
                        Scene::from_value(&scene.to_value(), None),
                        Ok(scene),
                        "{path:?}"
                    );
                    number += 1;
                }
            }
        }
        assert!(number > 10, "{number} scenes");
    }

    /// Each mistake under its path, in the words that the text of a scene has for it.
    #[test]
    fn mistakes_name_their_keys() {
        let rod = |key: &str, value| keys(&[("Rod", keys(&[("from_nm", Whole(0)), (key, value)]))]);
        let (key, rule) = refused(rod("to", Whole(40)));
        assert_eq!(key, "filament.sections[0].to");
        assert!(
            rule.contains("the unit is part of the key, write to_nm"),
            "{rule}"
        );
        let (key, rule) = refused(rod("to_nm", Text("far".into())));
        assert_eq!(key, "filament.sections[0].to_nm");
        assert!(rule.contains("\"far\"") && rule.contains("f64"), "{rule}");
        let (key, rule) = refused(keys(&[("Rope", keys(&[]))]));
        assert_eq!(key, "filament.sections[0]");
        assert!(rule.contains("unknown Section Rope: known are"), "{rule}");
        let (key, rule) = refused(keys(&[("Rod", keys(&[("from_nm", Whole(0))]))]));
        assert_eq!(key, "filament.sections[0]");
        assert!(rule.contains("missing key to_nm"), "{rule}");
        let (key, rule) = refused(rod("to_nm", Whole(-40)));
        assert_eq!(key, "filament.sections[0].to_nm");
        assert!(rule.contains("a section's length is positive"), "{rule}");
    }

    /// Vectors have as many numbers as they have, choices with keys are written as such.
    #[test]
    fn forms_are_those_of_the_text() {
        let mut scene = scene_with(keys(&[(
            "Rod",
            keys(&[("from_nm", Whole(0)), ("to_nm", Whole(40))]),
        )]));
        let Keys(all) = &mut scene else {
            unreachable!()
        };
        let force = List(vec![Whole(1); 4]);
        let load = keys(&[(
            "EndForce",
            keys(&[("end", Text("End".into())), ("force_pn", force)]),
        )]);
        all.push(("loads".into(), List(vec![load])));
        let problem = Scene::from_value(&scene, None).unwrap_err();
        assert_eq!(problem.key, "loads[0].force_pn");
        assert!(problem.rule.contains("4 elements"), "{problem}");
        let Keys(all) = &mut scene else {
            unreachable!()
        };
        all.pop();
        all[1].1 = Text("Equilibrium".into());
        let problem = Scene::from_value(&scene, None).unwrap_err();
        assert_eq!(problem.key, "task");
        assert!(problem.rule.contains("{\"Equilibrium\": {}}"), "{problem}");
    }
}
