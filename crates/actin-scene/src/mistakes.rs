//! Every mistake of a scene's text, not only the first.
//!
//! What RON refuses is noted and blanked out, with as many blanks as it has characters, so that all that is
//! left keeps its place and is read again. What is refused only since something else was blanked is not told.

use super::locate::without_mark;
use super::outline::{Outline, line_and_column, place};
use super::read::{Refusal, read_refusing};
use super::written::Written;
use super::{Scene, SceneError, SceneProblem, validate};
use serde::de::DeserializeOwned;

/// Most mistakes that are looked for.
const MOST: usize = 20;

/// Most bytes that are read to find mistakes: each takes a reading of the whole text.
const MOST_BYTES: usize = 2_000_000;

/// Number of mistakes that are looked for in a text: fewer in a long one.
fn most(text: &str) -> usize {
    (MOST_BYTES / text.len().max(1)).clamp(1, MOST)
}

/// What is wrong with a text: what cannot be read, and the rules that are broken, in the order of the text and
/// of the rules; 20 of either at most, and fewer in a text of more than 100 kB.
///
/// Rules are checked where all of the text means something: those of numbers first, those of the whole scene
/// if numbers break none.
pub(super) fn all(text: &str) -> (Vec<SceneError>, Vec<SceneProblem>) {
    let Readings { value, mistakes } = read_all::<Written>(text, "Scene");
    let problems = match value.map(Scene::try_from) {
        Some(Ok(scene)) => validate::problems(&scene, most(text)),
        Some(Err(problem)) => vec![problem],
        None => Vec::new(),
    };
    (mistakes, problems)
}

/// What a text describes, and every mistake in it.
#[derive(Clone, Debug)]
pub struct Readings<T> {
    /// What it describes, without keys that are not known; none where a mistake leaves it without meaning.
    pub value: Option<T>,
    /// What cannot be read, in the order of the text, as far as one does not hide another.
    pub mistakes: Vec<SceneError>,
}

/// Reads what a RON text describes as [`read_ron`](super::read_ron) does, and finds every mistake, not only the
/// first.
pub fn read_all<T: DeserializeOwned>(text: &str, name: &str) -> Readings<T> {
    let text = without_mark(text);
    let mut search = Search {
        text,
        name,
        left: text.to_owned(),
        blanked: Vec::new(),
        found: Vec::new(),
        is_whole: true,
    };
    let value = search.read().filter(|_| search.is_whole);
    Readings {
        value,
        mistakes: search.found,
    }
}

struct Search<'a> {
    text: &'a str,
    /// Name of the outermost structure.
    name: &'a str,
    /// The text with all that was refused blanked out.
    left: String,
    /// Paths of what was.
    blanked: Vec<String>,
    found: Vec<SceneError>,
    /// Whether what is left means what the text means, but for keys that are not known.
    is_whole: bool,
}

impl Search<'_> {
    /// Reads until nothing more is refused; what is left, if that can be read.
    fn read<T: DeserializeOwned>(&mut self) -> Option<T> {
        for _ in 0..most(self.text) {
            match read_refusing(&self.left, self.text, self.name) {
                Ok(value) => return Some(value),
                Err(refusal) => self.note(refusal)?,
            }
        }
        None
    }

    /// Notes a refusal and blanks it out; none if that leaves nothing.
    fn note(&mut self, refusal: Refusal) -> Option<()> {
        let Refusal {
            error,
            missing,
            is_of_brackets,
            is_needless,
        } = refusal;
        let at = (error.line, error.column);
        let outline = Outline::of(&self.left);
        let node = key_at(&outline, place(&self.left, at));
        let path = node.map_or_else(String::new, |node| self.path_at(outline.nodes[node].start));
        let is_consequence = missing.is_some_and(|key| {
            let key = if path.is_empty() {
                key
            } else {
                format!("{path}.{key}")
            };
            self.blanked.contains(&key)
        });
        if let Some(meant) = &error.meant {
            // Not missing, only misspelled.
            let above = path.rfind('.').map_or("", |dot| &path[..=dot]);
            self.blanked.push(format!("{above}{meant}"));
        }
        if !is_consequence {
            self.found.push(error);
        }
        self.is_whole &= is_needless;
        let node = node.filter(|_| !is_of_brackets)?;
        let (start, until) = (outline.nodes[node].start, outline.nodes[node].until);
        self.blanked.push(path);
        let comma = usize::from(self.left[until..].starts_with(','));
        let blank = |c: char| if c == '\n' { c } else { ' ' };
        let blanks: String = self.left[start..until + comma].chars().map(blank).collect();
        self.left.replace_range(start..until + comma, &blanks);
        Some(())
    }

    /// The path of what begins at a place of what is left, with the indices that elements have in the whole
    /// text.
    fn path_at(&self, start: usize) -> String {
        let whole = Outline::of(self.text);
        let at = place(self.text, line_and_column(&self.left, start));
        key_at(&whole, at).map_or_else(String::new, |node| whole.path(node))
    }
}

/// The innermost key or list element at a place.
fn key_at(outline: &Outline, at: usize) -> Option<usize> {
    let mut node = outline.at(at);
    while let Some(inner) = node.filter(|&node| outline.step(node).is_none()) {
        node = outline.nodes[inner].parent;
    }
    node
}

#[cfg(test)]
mod tests {
    use super::all;
    use crate::Scene;

    const SCENE: &str = "Scene(
    filament: Filament(
        sections: [Ellipsoids(from_nm: 0.0, to_nm: 80.0), Rod(from_nm: 80.0, to_nm: 160.0)],
    ),
    clamps: [Clamp(end: Start)],
    loads: [EndForce(end: End, force_pn: (-2.0, 0.0, 0.0))],
    task: Equilibrium(force_pn: 1e-6),
)";

    /// Any two mistakes in different places are both found, each in the words that it has alone; whichever is in
    /// the text first is the one that is told first of all.
    #[test]
    fn of_two_mistakes_neither_hides_the_other() {
        assert_eq!(all(SCENE), (Vec::new(), Vec::new()));
        let mistakes = [
            ("to_nm: 80.0", "two_nm: 80.0"),
            ("80.0, to_nm: 160.0", "80.0"),
            ("end: Start", "end: Begin"),
            ("-2.0, 0.0", "-2.0, x"),
            ("Equilibrium(", "Equilibrium(largest_stop: 1.0, "),
        ];
        let of = |text: &str| -> Vec<String> {
            let (errors, problems) = all(text);
            assert!(problems.is_empty(), "{problems:?}");
            errors.iter().map(|error| error.message.clone()).collect()
        };
        for (i, (from, to)) in mistakes.iter().enumerate() {
            let one = SCENE.replacen(from, to, 1);
            let first = of(&one);
            assert_eq!(first, [Scene::from_ron(&one).unwrap_err().message]);
            for (from, to) in &mistakes[i + 1..] {
                let second = of(&SCENE.replacen(from, to, 1));
                let both = of(&one.replacen(from, to, 1));
                assert_eq!(both, [&first[..], &second].concat(), "{from}");
            }
        }
    }

    /// Of 5000 clamps at one end 20 are told; of a text of a megabyte as many mistakes as two readings show.
    #[test]
    fn of_many_mistakes_the_first_are_found() {
        let many = |what: &str, count: usize| {
            let clamps = vec![what; count].join(", ");
            SCENE.replace("[Clamp(end: Start)]", &format!("[{clamps}]"))
        };
        let (errors, problems) = all(&many("Clamp(end: Start)", 5000));
        assert_eq!((errors.len(), problems.len()), (0, 20));
        assert_eq!(problems[0].key, "clamps[1].end");
        // Every second reading finds that a blanked key is missing.
        let (errors, _) = all(&many("Clamp(end: Begin)", 1000));
        assert_eq!(errors.len(), 10);
        let (errors, _) = all(&many("Clamp(end: Begin)", 60_000));
        assert_eq!(errors.len(), 1);
        let (errors, _) = all(&"(".repeat(200_000));
        assert_eq!(errors.len(), 1);
        let expected = "1:129: brackets are nested more than 128 deep here";
        assert_eq!(errors[0].to_string(), expected);
    }

    /// Broken rules of numbers are found together; those of the whole scene where there are none.
    #[test]
    fn broken_rules_are_found_together() {
        let keys = |text: &str| -> Vec<String> {
            all(text).1.into_iter().map(|problem| problem.key).collect()
        };
        let spoilt = SCENE
            .replace("160.0", "60.0")
            .replace("-2.0", "inf")
            .replace("1e-6", "-1.0");
        let expected = [
            "filament.sections[1].to_nm",
            "loads[0].force_pn",
            "task.force_pn",
        ];
        assert_eq!(keys(&spoilt), expected);
        assert_eq!(keys(&SCENE.replace("1e-6", "1.5")), ["task.force_pn"]);
        assert_eq!(keys(&SCENE.replace("[Clamp(end: Start)]", "[]")).len(), 1);
    }
}
