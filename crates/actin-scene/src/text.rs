//! Text of a scene, and overrides of its keys.

use super::deserialize::{DeserializeError, deserialize};
use super::parse::{Parsed, parse, word};
use super::position::{line_and_column, place, without_mark};
use super::scene_file::SceneFile;
use super::tree::{Kind, SceneValue, Source, print};
use super::{ParseReport, Scene, SceneError, SceneProblem, brackets, trace, validate};
use serde::de::DeserializeOwned;
use std::borrow::Cow;
use std::fmt;
use std::ops::Range;
use std::path::Path;
use std::str::FromStr;

/// Depth up to which structures of a printed scene have one line for each key.
pub(super) const SCENE_DEPTH: usize = 6;

const MOST: usize = 20;

/// Maximum number of bytes read to find mistakes: each mistake requires reading the whole text.
const MOST_BYTES: usize = 2_000_000;

/// Value for a key of a scene as text: `filament.rod.law=Constant`.
///
/// The key is a path of keys and indices of lists and vectors, without names of choices (`task.duration_ns`).
/// `[*]` stands for all elements of a list. The value is RON.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Override {
    /// Path of the key, such as `loads[0].force_pn[2]` or `linkers[*].stiffness_pn_per_nm`.
    pub key: String,
    /// Value in RON.
    pub value: String,
}

impl FromStr for Override {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (key, value) = text
            .split_once('=')
            .ok_or("must be KEY=VALUE, as in filament.rod.law=Constant")?;
        let (key, value) = (key.trim().to_owned(), value.trim().to_owned());
        if !is_path(&key) {
            return Err(format!(
                "{key:?} is not the path of a key, as loads[0].force_pn[2] is"
            ));
        }
        let one = Self { key, value };
        one.parsed().map(|_| one.clone())
    }
}

fn is_path(key: &str) -> bool {
    let is_key = |word: &str| {
        word.starts_with(|c: char| c.is_alphabetic() || c == '_')
            && word.chars().all(|c| c.is_alphanumeric() || c == '_')
    };
    key.split('.').all(|step| {
        let (word, mut indices) = step.split_at(step.find('[').unwrap_or(step.len()));
        while let Some((index, rest)) = indices.strip_prefix('[').and_then(|i| i.split_once(']')) {
            if index != "*" && index.parse::<usize>().is_err() {
                return false;
            }
            indices = rest;
        }
        is_key(word) && indices.is_empty()
    })
}

impl Override {
    fn parsed(&self) -> Result<SceneValue, String> {
        let Parsed {
            root,
            mistakes,
            brackets,
        } = parse(&self.value, "value");
        let refused = |what: &str| Err(format!("its value is not RON: {what}"));
        match mistakes.first() {
            _ if self.value.is_empty() => refused("there is no value"),
            _ if brackets.are_mistaken() => refused("a bracket is not closed, or closes nothing"),
            Some((_, mistake)) => refused(mistake),
            None if root.kind == Kind::Invalid => refused("a value is expected"),
            None => Ok(root),
        }
    }
}

impl fmt::Display for Override {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}={}", self.key, self.value)
    }
}

/// The text of a scene as a tree of values, with overrides: a mistake is placed in the text as written, or names the
/// override.
///
/// ```
/// use actin_scene::SceneText;
/// let mut text = SceneText::new(
///     "Scene(
///     filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 40.0)]),
///     clamps: [Clamp(end: Start)],
///     task: Equilibrium(),
/// )",
/// );
/// text.set("filament.rod.law=Fitted".parse()?)?;
/// text.set("filament.sections[0].to_nm=-1.0".parse()?)?;
/// let error = text.scene().unwrap_err().to_string();
/// assert!(error.starts_with("filament.sections[0].to_nm=-1.0: filament.sections[0].to_nm = -1.0: must"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct SceneText {
    written: String,
    name: String,
    parsed: Parsed,
    overrides: Vec<Override>,
    /// `true` after overrides or after reading points from files.
    is_changed: bool,
}

impl SceneText {
    /// Parses the text of a scene.
    pub fn new(text: &str) -> Self {
        Self::named(text, "Scene")
    }

    pub(super) fn named(text: &str, name: &str) -> Self {
        let written = without_mark(text).to_owned();
        Self {
            parsed: parse(&written, &name.to_lowercase()),
            name: name.to_owned(),
            overrides: Vec::new(),
            is_changed: false,
            written,
        }
    }

    /// Returns the keys and values of the text with all overrides and points of files.
    pub fn value(&self) -> &SceneValue {
        &self.parsed.root
    }

    /// Returns the text without overrides.
    pub fn written(&self) -> &str {
        &self.written
    }

    /// Returns the text with all overrides and points of files.
    pub fn text(&self) -> String {
        if self.is_changed {
            print(&self.parsed.root, SCENE_DEPTH)
        } else {
            self.written.clone()
        }
    }

    /// Sets or adds a key. Later overrides replace earlier ones.
    ///
    /// # Errors
    /// If the path leads through a value without keys or beyond the end of a list. Unknown keys and invalid
    /// values are errors of [`scene`](Self::scene).
    pub fn set(&mut self, one: Override) -> Result<(), SceneError> {
        let value = one.parsed().and_then(|mut value| {
            value.place.source = Source::Override(self.overrides.len());
            let set = self.parsed.root.set(&one.key, value);
            set.map_err(|problem| problem.rule)
        });
        value.map_err(|message| SceneError {
            set: Some(one.to_string()),
            ..SceneError::new((1, 1), &message)
        })?;
        self.overrides.push(one);
        self.is_changed = true;
        Ok(())
    }

    /// Replaces every `Points(file: ...)` by the points of the file, and the directory of `start` by its absolute
    /// path. Paths are relative to `folder`.
    ///
    /// # Errors
    /// A file that cannot be read, or an invalid row, located at the key of the file.
    pub fn resolve_paths(&mut self, folder: &Path) -> Result<(), SceneError> {
        let before = self.parsed.root.clone();
        let read = trace::resolve_paths(&mut self.parsed.root, folder);
        self.is_changed |= self.parsed.root != before;
        read.map_err(|problem| self.locate(&problem))
    }

    /// Returns the scene.
    ///
    /// # Errors
    /// As [`Scene::from_ron`], with the position in the text without overrides or the override that causes the
    /// error.
    pub fn scene(&self) -> Result<Scene, SceneError> {
        let (scene, refusal) = self.read()?;
        refusal.map_or(Ok(scene), Err)
    }

    /// Returns the scene and the first violated rule, if any.
    ///
    /// # Errors
    /// A text that is not a scene.
    pub fn read(&self) -> Result<(Scene, Option<SceneError>), SceneError> {
        let written = self.readings::<SceneFile>().into_result()?;
        let scene = self
            .generated(written)
            .map_err(|mut all| all.swap_remove(0))?;
        let problem = self.problems(&scene).into_iter().next();
        Ok((scene, problem))
    }

    /// Returns independent mistakes in the order of the text; none for a valid scene. At most 20 errors of
    /// reading and 20 violated rules are returned, and fewer for texts longer than 100 kB.
    ///
    /// The first is the error of [`scene`](Self::scene).
    pub fn mistakes(&self) -> Vec<SceneError> {
        let ParseReport { value, mistakes } = self.readings::<SceneFile>();
        let problems = match value.map(|written| self.generated(written)) {
            Some(Ok(scene)) => self.problems(&scene),
            Some(Err(problems)) => problems,
            None => Vec::new(),
        };
        let mut all: Vec<_> = mistakes.into_iter().chain(problems).collect();
        all.sort_by_key(|error| (error.line, error.column));
        all.dedup();
        all
    }

    /// Returns the scene, or violated rules in the order of the text.
    fn generated(&self, written: SceneFile) -> Result<Scene, Vec<SceneError>> {
        let problems = written.problems_of_generated(MOST);
        if !problems.is_empty() {
            return Err(self.in_order(&problems));
        }
        written
            .generate()
            .map_err(|problem| vec![self.locate(&problem)])
    }

    /// Returns violated rules in the order of the text.
    fn problems(&self, scene: &Scene) -> Vec<SceneError> {
        self.in_order(&validate::problems(scene, MOST).found)
    }

    fn in_order(&self, problems: &[SceneProblem]) -> Vec<SceneError> {
        let mut located: Vec<_> = problems
            .iter()
            .map(|problem| self.locate(problem))
            .collect();
        located.sort_by_key(|error| (error.line, error.column));
        located.truncate(self.most());
        located
    }

    fn most(&self) -> usize {
        (MOST_BYTES / self.written.len().max(1)).clamp(1, MOST)
    }

    /// Reads a type and finds all mistakes. Refused values are removed and the rest is read again. A key with a
    /// refused value does not count as missing.
    pub(super) fn readings<T: DeserializeOwned>(&self) -> ParseReport<T> {
        if let Some(mistake) = self.mistake_of_whole() {
            let (value, mistakes) = (None, vec![mistake]);
            return ParseReport { value, mistakes };
        }
        let mut tree = Cow::Borrowed(&self.parsed.root);
        let mut mistakes = self.mistakes_between_values();
        let mut is_whole = mistakes.is_empty();
        let mut value = None;
        let is_read = !self.parsed.brackets.has_text_after;
        for _ in 0..self.most() * usize::from(is_read) {
            match deserialize(&tree, &self.written) {
                Ok(read) => {
                    value = Some(read).filter(|_| is_whole);
                    break;
                }
                Err(refusal) => {
                    is_whole &= refusal.is_needless();
                    self.note(&tree, &refusal, &mut mistakes);
                    let indices = tree.without_components(refusal.indices());
                    if indices.is_empty() {
                        break;
                    }
                    tree.to_mut().at_mut(&indices).refuse(&refusal);
                }
            }
        }
        mistakes.sort_by_key(|(at, _)| *at);
        let mistakes = mistakes.into_iter().map(|(_, mistake)| mistake).collect();
        ParseReport { value, mistakes }
    }

    fn mistakes_between_values(&self) -> Vec<(usize, SceneError)> {
        let root = &self.parsed.root;
        let mistakes = self.parsed.mistakes.iter();
        let placed = mistakes.map(|(at, message)| {
            let path = root.path(&root.indices_at(*at));
            (*at, self.error(*at, &path, message))
        });
        placed.collect()
    }

    /// Adds a refusal, unless it follows from another mistake.
    fn note(
        &self,
        tree: &SceneValue,
        refusal: &DeserializeError,
        mistakes: &mut Vec<(usize, SceneError)>,
    ) {
        let node = tree.at(&refusal.indices());
        let is_refused =
            |value: &SceneValue| value.kind == Kind::Removed && value.key() == refusal.missing();
        if refusal.missing().is_some() && node.children().iter().any(is_refused) {
            return;
        }
        let place = &node.place;
        if place.is_mistaken {
            // The text after the value belongs to the same mistake.
            mistakes.retain(|(at, _)| !(place.start..place.until).contains(at));
        }
        mistakes.push((refusal.at.unwrap_or_default(), self.refused(tree, refusal)));
    }

    /// Returns a mistake that prevents reading the rest of the text.
    fn mistake_of_whole(&self) -> Option<SceneError> {
        let file = self.name.to_lowercase();
        let is_blank = |line: &str| line.trim().is_empty() || line.trim().starts_with("//");
        if self.written.lines().all(is_blank) {
            let message = format!("the {file} is empty: it must begin with {}(", self.name);
            return Some(SceneError::new((1, 1), &message));
        }
        brackets::mistake(&self.written, &file, &self.parsed)
    }

    fn error(&self, at: usize, path: &str, message: &str) -> SceneError {
        let colon = if path.is_empty() { "" } else { ": " };
        let place = line_and_column(&self.written, at);
        SceneError::new(place, &format!("{path}{colon}{message}"))
    }

    fn refused(&self, tree: &SceneValue, refusal: &DeserializeError) -> SceneError {
        let indices = refusal.indices();
        let path = if refusal.is_complete() {
            String::new()
        } else {
            tree.path(&indices)
        };
        let mut error = self.error(refusal.at.unwrap_or_default(), &path, &refusal.to_string());
        error.suggestion = refusal.suggestion();
        error.set = self.blamed(tree, &indices);
        error
    }

    fn blamed(&self, tree: &SceneValue, indices: &[usize]) -> Option<String> {
        match tree.at(indices).place.source {
            Source::Override(set) => Some(self.overrides[set].to_string()),
            _ => None,
        }
    }

    /// Returns the bytes of the text without overrides to underline for a mistake: the key with its value, the
    /// value, or a character, on one line.
    pub fn span(&self, error: &SceneError) -> Range<usize> {
        let text = &self.written;
        let at = place(text, (error.line, error.column));
        let root = &self.parsed.root;
        let indices = root.indices_at(at);
        let value = &root.at(&indices).place.value;
        let first = text[at..].chars().next().map_or(0, char::len_utf8);
        let end = if indices.is_empty() || at >= value.end {
            at + word(&text[at..]).len().max(first)
        } else {
            value.end
        };
        let line_end = text[at..].find('\n').map_or(text.len(), |line| at + line);
        at..end.min(line_end)
    }

    /// Returns the path of the key or list element of a mistake: empty outside all keys, and the key of the
    /// override that causes the mistake.
    pub fn key(&self, error: &SceneError) -> String {
        if let Some((key, _)) = error.set.as_ref().and_then(|set| set.split_once('=')) {
            return key.to_owned();
        }
        let at = place(&self.written, (error.line, error.column));
        let root = &self.parsed.root;
        root.path(&root.indices_at(at))
    }

    /// Locates a problem: at its key or the innermost written parent, or in the override that set one of them.
    pub fn locate(&self, problem: &SceneProblem) -> SceneError {
        let problem = &self.with_generating_key(problem);
        let root = &self.parsed.root;
        let steps = root.resolved(&problem.key);
        let indices = root.follow(&steps);
        let is_written = indices.len() == steps.len();
        let inner = (is_written && !problem.value.is_empty())
            .then(|| last_override(root.at(&indices)))
            .flatten();
        let indices = root.without_components(indices);
        let set = match inner {
            Some(set) => Some(self.overrides[set].to_string()),
            None => self.blamed(root, &indices),
        };
        let mut start = 0;
        if !indices.is_empty() {
            start = root.at(&indices).place.start;
        }
        let mut shown = problem.clone();
        if self.is_listed(&problem.key) {
            shown = shown.with_filament("filaments[0]");
        }
        let error = SceneError::new(line_and_column(&self.written, start), &shown.to_string());
        SceneError { set, ..error }
    }

    /// Replaces the key of a generated filament or linker by the key that generates it.
    fn with_generating_key(&self, problem: &SceneProblem) -> SceneProblem {
        let mut bodies = ["filament", "linkers["].iter();
        let is_body = bodies.any(|list| problem.key.starts_with(list));
        let generators = ["arrangements", "linker_sets", "crosslinkers"];
        let generates = |key| !self.parsed.root.follow(&super::tree::steps(key)).is_empty();
        let written = (is_body && generators.into_iter().any(generates))
            .then(|| self.readings::<SceneFile>().value)
            .flatten();
        let key = written.and_then(|written| written.generating_key(&problem.key));
        let key = key.unwrap_or_else(|| problem.key.clone());
        SceneProblem {
            key,
            ..problem.clone()
        }
    }

    /// Returns `true` for keys of filament 0 if it is written in a list.
    fn is_listed(&self, key: &str) -> bool {
        let resolved = self.parsed.root.resolved(key);
        resolved.len() > super::tree::steps(key).len()
    }
}

fn last_override(node: &SceneValue) -> Option<usize> {
    let own = match node.place.source {
        Source::Override(set) => Some(set),
        _ => None,
    };
    node.children()
        .iter()
        .map(last_override)
        .fold(own, Option::max)
}

impl SceneValue {
    fn refuse(&mut self, refusal: &DeserializeError) {
        self.kind = Kind::Removed;
        if refusal.is_needless() {
            self.key = refusal.suggestion().or(self.key.take());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCENE: &str = "Scene(
    filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 30.0)]), // one
    clamps: [Clamp(end: Start)],
    loads: [EndForce(end: End, force_pn: (1.0, 2.0, 3.0)),],
    task: Equilibrium(),
)";

    fn with(text: &str, overrides: &[&str]) -> Result<Scene, SceneError> {
        let mut text = SceneText::new(text);
        for one in overrides {
            text.set(one.parse().unwrap())?;
        }
        text.scene()
    }

    const LISTED: &str = "Scene(
    filaments: [Filament(sections: [Rod(from_nm: 0.0, to_nm: 30.0)])],
    clamps: [Clamp(end: Start)],
    loads: [EndForce(end: End, force_pn: (1.0, 2.0, 3.0)),],
    task: Equilibrium(),
)";

    /// Overrides, separated by semicolons, and the replacement in [`SCENE`] of the same meaning.
    const SAME: &str = "\
        filament.sections[0].to_nm=40.0 => 30.0 => 40.0
        filament.rod.law=Fitted => Filament( => Filament(rod: (law: Fitted),
        filaments[0].rod.law=Fitted => Filament( => Filament(rod: (law: Fitted),
        filament.rod.law=Constant; filament.rod.law=Fitted => Filament( => Filament(rod: (law: Fitted),
        task.force_pn=1e-8 => Equilibrium() => Equilibrium(force_pn: 1e-8)
        loads[0].force_pn[1]=7.0 => 2.0 => 7.0
        loads[1]=EndForce(end: End, force_pn: (0.0, 0.0, 1.0)) => 3.0)), => 3.0)), EndForce(end: End, force_pn: (0.0, 0.0, 1.0))
        path[0].set[0]=Shift(end: Start, shift_nm: (1.0, 0.0, 0.0)) => task: => path: [Stage(set: [Shift(end: Start, shift_nm: (1.0, 0.0, 0.0))])], task:";

    #[test]
    fn overrides_are_equivalent_to_changes_of_the_text() {
        for line in SAME.lines() {
            let parts: Vec<&str> = line.trim().split(" => ").collect();
            let overrides: Vec<&str> = parts[0].split("; ").collect();
            let expected = Scene::from_ron(&SCENE.replacen(parts[1], parts[2], 1)).unwrap();
            assert_eq!(with(SCENE, &overrides).unwrap(), expected, "{line}");
        }
        let law = SCENE.replacen("Filament(", "Filament(rod: (law: Fitted), ", 1);
        let listed = with(LISTED, &["filament.rod.law=Fitted"]);
        assert_eq!(listed, Scene::from_ron(&law));
    }

    /// Errors of overrides name the override; errors of the text have a position.
    #[test]
    fn errors_name_the_override_or_the_place() {
        let error = |text: &str, one: &str| with(text, &[one]).unwrap_err().to_string();
        #[rustfmt::skip]
        let cases = [
            ("filament.rod.lav=Fitted", "unknown key `lav` in RodModel"),
            ("filament.rod.law=Fittet", "unknown RodLaw Fittet"),
            (
                "filament.sections=Adaptive(length_nm: 60.0, want: Tip(error: 0.1, eror: 0.1))",
                "unknown key `eror` in Tip",
            ),
            ("task.error_of=Curvature(at_nm: 5.0, at: 6.0)", "unknown key `at` in Curvature"),
            ("task.force_pn=zero", "task.force_pn: "),
            ("loads[0].force_pn[1]=inf", "loads[0].force_pn = [1.0, inf, 3.0]: must be finite"),
            ("loads[4].force_pn[1]=1.0", "loads has 1 elements"),
            ("loads.force_pn=1.0", "loads is a list"),
            ("clamps[0].end.x=1", "clamps[0].end: Start has no keys: write it without brackets"),
            ("task[1]=3", "task is not a list"),
        ];
        for (one, message) in cases {
            let found = error(SCENE, one);
            assert!(found.starts_with(&format!("{one}: {message}")), "{found}");
        }
        let spoilt = SCENE.replace("clamps", "clumps");
        let found = error(&spoilt, "filament.rod.law=Fitted");
        assert!(found.starts_with("3:5: unknown key `clumps`"), "{found}");
        let negative = SCENE.replace("30.0", "-30.0");
        let found = error(&negative, "filament.rod.law=Fitted");
        assert!(
            found.starts_with("2:53: filament.sections[0].to_nm"),
            "{found}"
        );
    }

    #[test]
    fn invalid_overrides_are_refused() {
        for text in [
            "", "a", "=1", "a=", "a=(", "a=1, b=2", "a..b=1", "a[x]=1", "a[0=1", "a b=1",
        ] {
            assert!(text.parse::<Override>().is_err(), "{text}");
        }
        let one: Override = "a.b[0][1].c = Some((x: \"=\"))".parse().unwrap();
        assert_eq!(
            (one.key.as_str(), one.value.as_str()),
            ("a.b[0][1].c", "Some((x: \"=\"))")
        );
    }

    #[test]
    fn all_elements_of_a_list_are_set() {
        let scene = with(SCENE, &["loads[*].force_pn[*]=4.0"]);
        let rule = scene.unwrap_err().to_string();
        assert!(
            rule.contains("loads[0].force_pn must be a list with elements"),
            "{rule}"
        );
        let two = SCENE.replace(
            "force_pn: (1.0, 2.0, 3.0)),",
            "force_pn: (1.0, 2.0, 3.0)), EndForce(end: End, force_pn: (0.0, 0.0, 1.0)),",
        );
        let scene = with(&two, &["loads[*].force_pn[2]=4.0"]).unwrap();
        for load in &scene.loads {
            let crate::Load::EndForce { force_pn, .. } = load else {
                panic!("all loads are end forces: {load:?}")
            };
            assert!((force_pn[2] - 4.0).abs() < 1e-15);
        }
        let refused = with(SCENE, &["linkers[*].stiffness_pn_per_nm=1.0"]);
        let rule = refused.unwrap_err().to_string();
        assert!(
            rule.contains("linkers must be a list with elements for [*]"),
            "{rule}"
        );
    }
}
