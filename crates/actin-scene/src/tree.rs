//! Tree of values of texts and dictionaries, with the position of each value.

mod print;

pub(super) use print::print;

use super::SceneProblem;
use std::fmt;
use std::ops::Range;

/// Scene or part of a scene as a tree of values.
///
/// | RON | dictionaries | kind |
/// |---|---|---|
/// | `(from_nm: 0.0)`, `Filament(..)` | keys with values | `Group` |
/// | `Ellipsoids(from_nm: 0.0)`, a choice with keys | one key, the name | `Group` with this name |
/// | `Start`, a choice without keys | a string | `Name` or `Text` |
/// | `[1.0, 2.0]` | a list | `List` |
/// | `(1.0, 2.0, 3.0)` | a list | `Group` without keys, `List` |
#[derive(Clone, Debug)]
pub struct SceneValue {
    pub(crate) key: Option<String>,
    pub(crate) kind: Kind,
    pub(crate) place: TextSpan,
}

/// Kind of a value.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    /// Absent value of an optional key.
    None,
    /// Boolean.
    Bool(bool),
    /// Integer.
    Whole(i128),
    /// Floating-point number.
    Number(f64),
    /// String in quotation marks.
    Text(String),
    /// Word without quotation marks: a choice without keys.
    Name(String),
    /// Values in square brackets.
    List(Vec<SceneValue>),
    /// Values with keys, or a vector, after an optional name.
    Group(Option<String>, Vec<SceneValue>),
    /// Text that is not a value.
    Invalid,
    /// Value that has been refused.
    Removed,
}

/// Origin of a value. Values in memory, in JSON and in YAML have strings for choices and lists for vectors.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Source {
    #[default]
    Memory,
    /// JSON or YAML.
    Json,
    Ron,
    Override(usize),
}

/// Position of a value in its text (bytes).
#[derive(Clone, Debug, Default)]
pub(crate) struct TextSpan {
    pub(crate) source: Source,
    pub(crate) start: usize,
    /// Range of the value, including the name before its bracket.
    pub(crate) value: Range<usize>,
    /// Comma or bracket after the value, or the end of the text.
    pub(crate) until: usize,
    /// `true` if unexpected text follows the value.
    pub(crate) is_mistaken: bool,
    pub(crate) open: Option<usize>,
    pub(crate) close: Option<usize>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Step {
    Key(String),
    Index(usize),
}

/// Parses a path such as `filament.sections[1].to_nm`.
pub(crate) fn steps(path: &str) -> Vec<Step> {
    path.split(['.', '['])
        .map(|step| match step.strip_suffix(']') {
            Some(index) => index.parse().map_or(Step::Key(index.into()), Step::Index),
            None => Step::Key(step.into()),
        })
        .collect()
}

/// Compares keys and values, not positions.
impl PartialEq for SceneValue {
    fn eq(&self, other: &Self) -> bool {
        self.key == other.key && self.kind == other.kind
    }
}

impl From<Kind> for SceneValue {
    fn from(kind: Kind) -> Self {
        let place = TextSpan::default();
        let key = None;
        Self { key, kind, place }
    }
}

/// Index of all elements of a list in a path.
const ALL: &str = "[*]";

impl SceneValue {
    /// Creates a dictionary. A single key that begins with a capital letter is the name of a choice.
    pub fn keys(entries: Vec<(String, Self)>) -> Self {
        let named = entries.into_iter().map(|(key, value)| value.with_key(key));
        Kind::Group(None, named.collect()).choice().into()
    }

    pub(crate) fn with_key(self, key: impl Into<String>) -> Self {
        let key = Some(key.into());
        Self { key, ..self }
    }

    /// Removes the key `$schema`, which editors read.
    pub(crate) fn remove_schema(&mut self) {
        if let Kind::Group(None, values) = &mut self.kind {
            values.retain(|value| value.key() != Some("$schema"));
        }
    }

    /// Returns the kind of the value.
    pub fn kind(&self) -> &Kind {
        &self.kind
    }

    /// Returns the key of the value in its dictionary.
    pub fn key(&self) -> Option<&str> {
        self.key.as_deref()
    }

    /// Returns the values in its bracket.
    pub(crate) fn children(&self) -> &[Self] {
        match &self.kind {
            Kind::List(values) | Kind::Group(_, values) => values,
            _ => &[],
        }
    }

    pub(crate) fn children_mut(&mut self) -> &mut [Self] {
        match &mut self.kind {
            Kind::List(values) | Kind::Group(_, values) => values,
            _ => &mut [],
        }
    }

    fn push(&mut self, value: Self) {
        if let Kind::List(values) | Kind::Group(_, values) = &mut self.kind {
            values.push(value);
        }
    }

    pub(crate) fn is_list(&self) -> bool {
        matches!(self.kind, Kind::List(_))
    }

    /// Returns `true` for values with strings for choices and lists for vectors.
    pub(crate) fn is_dictionary(&self) -> bool {
        matches!(self.place.source, Source::Memory | Source::Json)
    }

    fn child(&self, step: &Step) -> Option<usize> {
        let mut children = self.children().iter().enumerate();
        let found = children.find(|(i, child)| match step {
            Step::Key(key) => child.key.as_ref() == Some(key),
            Step::Index(index) => child.key.is_none() && i == index,
        });
        found.map(|(i, _)| i)
    }

    /// Indices of children along a path, up to the last existing one.
    pub(crate) fn follow(&self, path: &[Step]) -> Vec<usize> {
        let (mut node, mut taken) = (self, Vec::new());
        for step in path {
            let Some(child) = node.child(step) else {
                break;
            };
            taken.push(child);
            node = &node.children()[child];
        }
        taken
    }

    /// Parses a path. A single filament is `filament` or `filaments[0]`, as in the tree.
    pub(crate) fn resolved(&self, path: &str) -> Vec<Step> {
        let mut path = steps(path);
        let has = |key: &str| self.child(&Step::Key(key.into())).is_some();
        let [alone, all] = ["filament", "filaments"].map(|key| Step::Key(key.into()));
        if path[0] == alone && !has("filament") && has("filaments") {
            path.splice(..1, [all, Step::Index(0)]);
        } else if path.starts_with(&[all.clone(), Step::Index(0)])
            && !has("filaments")
            && has("filament")
        {
            path.splice(..2, [alone]);
        }
        path
    }

    /// Returns the value at a path of indices.
    pub(crate) fn at(&self, indices: &[usize]) -> &Self {
        indices.iter().fold(self, |node, i| &node.children()[*i])
    }

    pub(crate) fn at_mut(&mut self, indices: &[usize]) -> &mut Self {
        let mut node = self;
        for i in indices {
            node = &mut node.children_mut()[*i];
        }
        node
    }

    /// Returns the indices that lead to the innermost value at a position.
    pub(crate) fn indices_at(&self, place: usize) -> Vec<usize> {
        let holds = |child: &Self| child.place.start <= place && place < child.place.until;
        let (mut node, mut indices) = (self, Vec::new());
        while let Some(child) = node.children().iter().position(holds) {
            indices.push(child);
            node = &node.children()[child];
        }
        indices
    }

    /// Path of the value at indices of children, such as `filament.sections[1].to_nm`.
    pub(crate) fn path(&self, indices: &[usize]) -> String {
        let (mut node, mut path) = (self, String::new());
        for i in indices {
            let child = &node.children()[*i];
            match &child.key {
                _ if node.is_list() => path.extend(["[", &i.to_string(), "]"]),
                Some(key) if path.is_empty() => path.clone_from(key),
                Some(key) => path.extend([".", key]),
                None => {}
            }
            node = child;
        }
        path
    }

    /// Indices of the innermost value with a key or list index, without vector components.
    pub(crate) fn without_components(&self, mut indices: Vec<usize>) -> Vec<usize> {
        while let Some((last, above)) = indices.split_last() {
            let parent = self.at(above);
            if parent.is_list() || parent.children()[*last].key.is_some() {
                break;
            }
            indices.pop();
        }
        indices
    }

    /// Sets or adds a key, with `[*]` in all elements of a list. [`Override`](super::Override) describes paths.
    ///
    /// ```
    /// use actin_scene::{SceneKind::Whole, SceneValue};
    /// let keys = |name: &str, value| SceneValue::keys(vec![(name.into(), value)]);
    /// let all = |to_nm| keys("section", keys("Rod", keys("to_nm", to_nm)));
    /// let mut scene = all(Whole(40).into());
    /// scene.set("section.to_nm", Whole(80).into())?;
    /// assert_eq!(scene, all(Whole(80).into()));
    /// assert!(scene.set("section[3]", Whole(1).into()).is_err());
    /// assert!(scene.set("section[*]", Whole(1).into()).is_err());
    /// # Ok::<(), actin_scene::SceneProblem>(())
    /// ```
    ///
    /// # Errors
    /// If the path leads through a value without keys or beyond the end of a list, or if `[*]` does not follow a
    /// list with elements.
    pub fn set(&mut self, path: &str, value: Self) -> Result<(), SceneProblem> {
        let Some((list, rest)) = path.split_once(ALL) else {
            return self.set_one(path, value);
        };
        let steps = self.resolved(list);
        let indices = self.follow(&steps);
        let found = self.at(&indices);
        let count = found.children().len();
        if indices.len() < steps.len() || !found.is_list() || count == 0 {
            let rule = format!("{list} must be a list with elements for {ALL}");
            return Err(SceneProblem::new(path, "", rule));
        }
        (0..count).try_for_each(|i| self.set(&format!("{list}[{i}]{rest}"), value.clone()))
    }

    fn set_one(&mut self, path: &str, value: Self) -> Result<(), SceneProblem> {
        let refused = |rule: String| SceneProblem::new(path, "", rule);
        let steps = self.resolved(path);
        let indices = self.follow(&steps);
        let name = match self.path(&indices) {
            name if name.is_empty() => "the scene".to_owned(),
            name => name,
        };
        let host = self.at_mut(&indices);
        let steps = &steps[indices.len()..];
        let mut value = value;
        value.move_to(&TextSpan {
            source: value.place.source,
            ..host.place.clone()
        });
        let Some((first, inner)) = steps.split_first() else {
            let key = host.key.take();
            *host = Self { key, ..value };
            return Ok(());
        };
        if let Step::Key(_) = first {
            host.kind = match std::mem::replace(&mut host.kind, Kind::None) {
                Kind::None => Kind::Group(None, Vec::new()),
                Kind::Name(name) | Kind::Text(name) => {
                    host.place.source = value.place.source;
                    Kind::Group(Some(name), Vec::new())
                }
                other => other,
            };
        }
        host.check_step(first, &name, &value).map_err(refused)?;
        let value = nested(inner, value).map_err(refused)?;
        host.push(match first {
            Step::Key(key) => value.with_key(key),
            Step::Index(_) => value,
        });
        Ok(())
    }

    fn check_step(&self, step: &Step, name: &str, child: &Self) -> Result<(), String> {
        let count = self.children().len();
        // An element can be appended only to a list of a text.
        let most = count - usize::from(child.is_dictionary() && count > 0);
        Err(match (&self.kind, step) {
            (Kind::List(_), Step::Index(index)) if *index > most => {
                format!("{name} has {count} elements, counted from 0")
            }
            (Kind::List(_), Step::Key(_)) => format!("{name} is a list: write {name}[0]"),
            (Kind::Group(..), Step::Index(_)) => format!("{name} is not a list"),
            (Kind::List(_) | Kind::Group(..), _) => return Ok(()),
            _ => format!("{name} is {self}, which has no keys"),
        })
    }

    pub(crate) fn move_to(&mut self, place: &TextSpan) {
        self.place = place.clone();
        for child in self.children_mut() {
            child.move_to(place);
        }
    }
}

fn nested(steps: &[Step], value: SceneValue) -> Result<SceneValue, String> {
    let Some((first, rest)) = steps.split_first() else {
        return Ok(value);
    };
    let place = value.place.clone();
    let inner = nested(rest, value)?;
    let kind = match first {
        Step::Key(key) => Kind::Group(None, vec![inner.with_key(key)]),
        Step::Index(0) => Kind::List(vec![inner]),
        Step::Index(_) => return Err("a new list begins with [0]".into()),
    };
    let key = None;
    Ok(SceneValue { key, kind, place })
}

impl Kind {
    pub(crate) fn choice(self) -> Self {
        match self {
            Self::Group(None, mut only)
                if only.len() == 1
                    && only[0]
                        .key()
                        .is_some_and(|key| key.starts_with(char::is_uppercase))
                    && matches!(only[0].kind, Self::Group(None, _)) =>
            {
                let SceneValue { key, kind, .. } = only.remove(0);
                let Self::Group(_, values) = kind else {
                    unreachable!("it is a group");
                };
                Self::Group(key, values)
            }
            other => other,
        }
    }
}

/// Formats the value as RON on one line.
impl fmt::Display for SceneValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&print(self, 0))
    }
}
