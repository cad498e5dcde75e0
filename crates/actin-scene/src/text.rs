//! The text of a scene, and values that keys of it are given from outside.

use super::locate::{path_at, without_mark};
use super::outline::{Outline, Step, line_and_column, place, steps};
use super::{Scene, SceneError, SceneProblem, mistakes};
use ron::value::RawValue;
use std::fmt;
use std::ops::Range;
use std::str::FromStr;

/// A value for a key of a scene, both as text: `filament.rod.law=Constant`.
///
/// The key is a path of keys and, in brackets, indices of lists and vectors; names of choices are no part
/// of it (`task.duration_ns`). The value is RON.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Override {
    /// Path of the key, such as `loads[0].force_pn[2]`.
    pub key: String,
    /// Value in RON.
    pub value: String,
}

impl FromStr for Override {
    type Err = String;

    /// Reads `key=value`.
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
        let error = RawValue::from_ron(&value).err();
        error.map_or(Ok(Self { key, value }), |error| {
            Err(format!("its value is not RON: {}", error.code))
        })
    }
}

/// Whether a text is keys with dots between them, and indices in brackets.
fn is_path(key: &str) -> bool {
    let is_key = |word: &str| {
        word.starts_with(|c: char| c.is_alphabetic() || c == '_')
            && word.chars().all(|c| c.is_alphanumeric() || c == '_')
    };
    key.split('.').all(|step| {
        let (word, mut indices) = step.split_at(step.find('[').unwrap_or(step.len()));
        while let Some((index, rest)) = indices.strip_prefix('[').and_then(|i| i.split_once(']')) {
            if index.parse::<usize>().is_err() {
                return false;
            }
            indices = rest;
        }
        is_key(word) && indices.is_empty()
    })
}

impl fmt::Display for Override {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}={}", self.key, self.value)
    }
}

/// Where a byte of a text comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Origin {
    /// From a place of the text as written.
    Written(usize),
    /// From an override, by its index.
    Set(usize),
}

/// The text of a scene with overrides applied, which knows where each of its bytes comes from: what is
/// wrong is placed in the text as written, or names the override.
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
/// assert!(error.starts_with("filament.sections[0].to_nm=-1.0: filament.sections[0].to_nm = -1.0: a section"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct SceneText {
    written: String,
    text: String,
    origins: Vec<Origin>,
    overrides: Vec<Override>,
}

impl SceneText {
    /// The text as written.
    pub fn new(text: &str) -> Self {
        let written = without_mark(text).to_owned();
        Self {
            text: written.clone(),
            origins: (0..written.len()).map(Origin::Written).collect(),
            overrides: Vec::new(),
            written,
        }
    }

    /// The text with all overrides.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The text without them.
    pub fn written(&self) -> &str {
        &self.written
    }

    /// Gives a key a value, whether the text has the key or not. Later overrides win.
    ///
    /// # Errors
    /// A key that cannot be: in what has no keys, or beyond the end of a list. Whether the scene knows the
    /// key, and what it may be, is found when the scene is read.
    pub fn set(&mut self, one: Override) -> Result<(), SceneError> {
        let edit = self.edit(&one);
        let (range, inserted) = edit.map_err(|message| SceneError {
            set: Some(one.to_string()),
            ..SceneError::new((1, 1), &message)
        })?;
        let origin = Origin::Set(self.overrides.len());
        let from = std::iter::repeat_n(origin, inserted.len());
        self.origins.splice(range.clone(), from);
        self.text.replace_range(range, &inserted);
        self.overrides.push(one);
        Ok(())
    }

    /// Replaces what is written in ascending ranges, each by something that comes from the same place.
    pub(super) fn replace(&mut self, parts: &[(Range<usize>, String)]) {
        let (mut text, mut origins, mut done) = (String::new(), Vec::new(), 0);
        for (range, inserted) in parts {
            text.extend([&self.text[done..range.start], inserted]);
            origins.extend(&self.origins[done..range.start]);
            let origin = self.origins[range.start];
            origins.extend(std::iter::repeat_n(origin, inserted.len()));
            done = range.end;
        }
        text.push_str(&self.text[done..]);
        origins.extend(&self.origins[done..]);
        (self.text, self.origins) = (text, origins);
    }

    /// The scene that the text describes.
    ///
    /// # Errors
    /// As [`Scene::from_ron`], with the place in the text as written or the override to blame.
    pub fn scene(&self) -> Result<Scene, SceneError> {
        let (scene, refusal) = self.read()?;
        refusal.map_or(Ok(scene), Err)
    }

    /// The same of a text whose values the rules of a scene may refuse, and why they do.
    ///
    /// # Errors
    /// A text that is no scene.
    pub fn read(&self) -> Result<(Scene, Option<SceneError>), SceneError> {
        let read = Scene::read(&self.text).map_err(|error| self.placed(error));
        read.map(|(scene, problem)| (scene, problem.map(|problem| self.locate(&problem))))
    }

    /// The mistakes of the text, as far as one does not hide another; none of a scene that is read. Of a text with
    /// many the first 20 that cannot be read and the first 20 broken rules, and fewer if it has more than 100 kB.
    ///
    /// The first is that of [`scene`](Self::scene), or stands before it in the text.
    pub fn mistakes(&self) -> Vec<SceneError> {
        let (errors, problems) = mistakes::all(&self.text);
        let errors = errors.into_iter().map(|error| self.placed(error));
        let problems = problems.iter().map(|problem| self.locate(problem));
        let mut all: Vec<_> = errors.chain(problems).collect();
        all.sort_by_key(|error| (error.line, error.column));
        all.dedup();
        all
    }

    /// What to underline of a mistake, in bytes of the text as written: the key with its value, the value, or
    /// a character; on one line.
    pub fn span(&self, error: &SceneError) -> Range<usize> {
        let text = &self.written;
        let at = place(text, (error.line, error.column));
        let outline = Outline::of(text);
        let node = outline.at(at).map(|node| &outline.nodes[node]);
        let end = match node {
            Some(node) if at < node.value.end => node.value.end,
            _ => at + text[at..].chars().next().map_or(0, char::len_utf8),
        };
        let line_end = text[at..].find('\n').map_or(text.len(), |line| at + line);
        at..end.min(line_end)
    }

    /// Path of the key or list element that a mistake is about; empty outside of all, and the key of the override
    /// where one is to blame.
    pub fn key(&self, error: &SceneError) -> String {
        match error.set.as_ref().and_then(|set| set.split_once('=')) {
            Some((key, _)) => key.to_owned(),
            None => path_at(&self.written, (error.line, error.column)),
        }
    }

    /// Places a problem: in an override that sets its key, or something above or below it, or in the text.
    pub fn locate(&self, problem: &SceneProblem) -> SceneError {
        let key = self.resolved(&problem.key);
        let mut overrides = self.overrides.iter().rev();
        let is_meant = |one: &&Override| {
            let set = self.resolved(&one.key);
            is_within(&key, &set) || (!problem.value.is_empty() && is_within(&set, &key))
        };
        let blamed = overrides.find(is_meant).map(Override::to_string);
        let error = SceneError::locate(problem, &self.text);
        match blamed {
            None => self.placed(error),
            set => SceneError { set, ..error },
        }
    }

    /// An error of the text with overrides, with its place in the text as written.
    pub(super) fn placed(&self, error: SceneError) -> SceneError {
        let at = place(&self.text, (error.line, error.column));
        let mut before = self.origins[..at.min(self.origins.len())].iter().rev();
        let (line, column) = match self.origins.get(at) {
            Some(&Origin::Written(at)) => line_and_column(&self.written, at),
            Some(&Origin::Set(set)) => {
                let last = before.find_map(|origin| match origin {
                    Origin::Written(at) => Some(*at),
                    Origin::Set(_) => None,
                });
                let (line, column) = line_and_column(&self.written, last.unwrap_or_default());
                let set = Some(self.overrides[set].to_string());
                return SceneError {
                    line,
                    column,
                    set,
                    ..error
                };
            }
            None => line_and_column(&self.written, self.written.len()),
        };
        SceneError {
            line,
            column,
            ..error
        }
    }

    /// A key as the text writes it: filament 0 may stand alone or in a list.
    fn resolved(&self, key: &str) -> String {
        let outline = Outline::of(&self.text);
        let is_written = |key: &str| outline.follow(&steps(key)).1 == 1;
        let other = |from: &str, to: &str| {
            let rest = key.strip_prefix(from)?;
            let is_whole = rest.is_empty() || rest.starts_with('.');
            (is_whole && !is_written(from.trim_end_matches("[0]"))).then(|| format!("{to}{rest}"))
        };
        let listed = is_written("filaments").then(|| other("filament", "filaments[0]"));
        let alone = is_written("filament").then(|| other("filaments[0]", "filament"));
        let resolved = listed.flatten().or(alone.flatten());
        resolved.unwrap_or_else(|| key.to_owned())
    }

    /// What to put where, so that a key has a value.
    fn edit(&self, one: &Override) -> Result<(Range<usize>, String), String> {
        let outline = Outline::of(&self.text);
        let path = steps(&self.resolved(&one.key));
        let (node, taken) = outline.follow(&path);
        let nodes = &outline.nodes;
        if taken == path.len()
            && let Some(node) = node
        {
            return Ok((nodes[node].value.clone(), one.value.clone()));
        }
        let host = node.or_else(|| outline.children(None).first().copied());
        let host = host.ok_or("the text has no scene")?;
        let host = outline.innermost(host);
        let inserted = || entry(&path[taken..], &one.value);
        let value = &self.text[nodes[host].value.clone()];
        let name = match outline.path(host) {
            path if path.is_empty() => "the scene".to_owned(),
            path => path,
        };
        let elements = outline.children(Some(host));
        match (nodes[host].open.map(|open| open.0), &path[taken]) {
            (None, Step::Key(_)) if value == "None" => {
                return Ok((nodes[host].value.clone(), format!("({})", inserted()?)));
            }
            (None, _) => return Err(format!("{name} is {value}, which has no keys")),
            (Some('['), Step::Key(_)) => {
                return Err(format!("{name} is a list: write {name}[0]"));
            }
            (Some('['), &Step::Index(index)) if index > elements.len() => {
                let count = elements.len();
                return Err(format!("{name} has {count} elements, counted from 0"));
            }
            (Some('['), _) | (_, Step::Key(_)) => {}
            (Some(_), Step::Index(_)) => return Err(format!("{name} is not a list")),
        }
        let (at, comma) = match (elements.last(), nodes[host].open) {
            (Some(&last), _) => (nodes[last].value.end, ", "),
            (None, open) => (open.map_or(nodes[host].start, |(_, at)| at + 1), ""),
        };
        Ok((at..at, format!("{comma}{}", inserted()?)))
    }
}

/// What is written for steps that a text does not have, in the bracket of the last that it has.
fn entry(path: &[Step], value: &str) -> Result<String, String> {
    let Some((first, rest)) = path.split_first() else {
        return Ok(value.to_owned());
    };
    let inside = entry(rest, value)?;
    let inside = match rest.first() {
        None => inside,
        Some(Step::Key(_)) => format!("({inside})"),
        Some(Step::Index(0)) => format!("[{inside}]"),
        Some(Step::Index(_)) => return Err("a new list begins with [0]".into()),
    };
    Ok(match first {
        Step::Key(key) => format!("{key}: {inside}"),
        Step::Index(_) => inside,
    })
}

/// Whether `key` is `above` or lies below it.
fn is_within(key: &str, above: &str) -> bool {
    let rest = key.strip_prefix(above);
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
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

    const LAW: &str = "filament: Filament(rod: (law: Fitted), ";

    type Same = (
        &'static str,
        &'static [&'static str],
        (&'static str, &'static str),
    );

    /// A text, overrides, and what is written in place of what by a text that says the same.
    const SAME: &[Same] = &[
        (
            SCENE,
            &["filament.sections[0].to_nm=40.0"],
            ("30.0", "40.0"),
        ),
        (
            SCENE,
            &["filament.rod.law=Fitted"],
            ("filament: Filament(", LAW),
        ),
        (
            SCENE,
            &["filaments[0].rod.law=Fitted"],
            ("filament: Filament(", LAW),
        ),
        (
            LISTED,
            &["filament.rod.law=Fitted"],
            ("filament: Filament(", LAW),
        ),
        (
            SCENE,
            &["task.force_pn=1e-8"],
            ("Equilibrium()", "Equilibrium(force_pn: 1e-8)"),
        ),
        (SCENE, &["loads[0].force_pn[1]=7.0"], ("2.0", "7.0")),
        (
            SCENE,
            &["loads[1]=EndForce(end: End, force_pn: (0.0, 0.0, 1.0))"],
            (
                "3.0)),]",
                "3.0)), EndForce(end: End, force_pn: (0.0, 0.0, 1.0))]",
            ),
        ),
        (
            SCENE,
            &["path[0].set[0]=Shift(end: Start, shift_nm: (1.0, 0.0, 0.0))"],
            (
                "task:",
                "path: [Stage(set: [Shift(end: Start, shift_nm: (1.0, 0.0, 0.0))])], task:",
            ),
        ),
        (
            SCENE,
            &["filament.rod.law=Constant", "filament.rod.law=Fitted"],
            ("filament: Filament(", LAW),
        ),
    ];

    /// Overrides give the scene whose text says the same: values in place, new keys at any depth, in an
    /// empty bracket, components of vectors, new elements, filament 0 in a list and alone, a later
    /// override of what an earlier one has written.
    #[test]
    fn overrides_say_what_the_text_would() {
        for &(text, overrides, (from, to)) in SAME {
            let expected = Scene::from_ron(&SCENE.replacen(from, to, 1)).unwrap();
            assert_eq!(with(text, overrides).unwrap(), expected, "{overrides:?}");
        }
    }

    /// The override is named, whether its key, its value or a rule is to blame; what is wrong with the text
    /// has its place there.
    #[test]
    fn errors_name_the_override_or_the_place() {
        let error = |text: &str, one: &str| with(text, &[one]).unwrap_err().to_string();
        for (one, message) in [
            ("filament.rod.lav=Fitted", "unknown key lav in RodModel"),
            ("filament.rod.law=Fittet", "unknown RodLaw Fittet"),
            (
                "filament.sections=Adaptive(length_nm: 60.0, want: Tip(error: 0.1, eror: 0.1))",
                "unknown key eror in Tip",
            ),
            (
                "task.error_of=Curvature(at_nm: 5.0, at: 6.0)",
                "unknown key at in Curvature",
            ),
            ("task.force_pn=zero", "task.force_pn: "),
            (
                "loads[0].force_pn[1]=inf",
                "loads[0].force_pn = [1.0, inf, 3.0]: must be finite",
            ),
            ("loads[4].force_pn[1]=1.0", "loads has 1 elements"),
            ("loads.force_pn=1.0", "loads is a list"),
            (
                "clamps[0].end.x=1",
                "clamps[0].end is Start, which has no keys",
            ),
            ("task[1]=3", "task is not a list"),
        ] {
            let found = error(SCENE, one);
            assert!(found.starts_with(&format!("{one}: {message}")), "{found}");
        }
        let spoilt = SCENE.replace("clamps", "clumps");
        let found = error(&spoilt, "filament.rod.law=Fitted");
        assert!(found.starts_with("3:5: unknown key clumps"), "{found}");
        let negative = SCENE.replace("30.0", "-30.0");
        let found = error(&negative, "filament.rod.law=Fitted");
        assert!(
            found.starts_with("2:53: filament.sections[0].to_nm"),
            "{found}"
        );
    }

    #[test]
    fn what_is_no_override_is_refused() {
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
}
