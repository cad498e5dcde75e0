//! The outline of a scene's text: which keys and list elements it has, and where.
//!
//! A reader of its own that knows just enough of RON (brackets, keys, strings, comments) to say where
//! `filament.sections[1].to_nm` stands. It never refuses a text: that is for RON to do.

use std::ops::Range;

/// Most brackets within each other; RON's own limit.
pub(super) const MOST_DEPTH: usize = 128;

/// One step of a path: a key of a structure or an index of a list.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Step {
    Key(String),
    Index(usize),
}

/// The steps of a path such as `filament.sections[1].to_nm`.
pub(super) fn steps(path: &str) -> Vec<Step> {
    path.split(['.', '['])
        .map(|step| match step.strip_suffix(']') {
            Some(index) => index.parse().map_or(Step::Key(index.into()), Step::Index),
            None => Step::Key(step.into()),
        })
        .collect()
}

/// A key with its value, or an element without a key. Places are bytes of the text.
#[derive(Clone, Debug)]
pub(super) struct Node {
    pub(super) parent: Option<usize>,
    pub(super) key: Option<String>,
    /// How many elements of the same bracket come before it.
    pub(super) index: usize,
    /// Where the key begins, or the element without one.
    pub(super) start: usize,
    /// The value, with the name before its bracket.
    pub(super) value: Range<usize>,
    /// The comma or bracket that ends it, or the end of the text.
    pub(super) until: usize,
    /// Kind and place of the bracket of the value.
    pub(super) open: Option<(char, usize)>,
    /// The bracket that closes it.
    pub(super) close: Option<usize>,
    /// The nodes in its bracket, in order.
    pub(super) children: Vec<usize>,
}

/// A closing bracket that closes nothing, or another bracket than the last that is open.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Misfit {
    pub(super) at: usize,
    /// The node whose bracket is open there, if one is.
    pub(super) open: Option<usize>,
}

/// All nodes of a text, each behind its parent.
#[derive(Debug)]
pub(super) struct Outline {
    pub(super) nodes: Vec<Node>,
    /// The nodes in no bracket, in order.
    roots: Vec<usize>,
    /// The first bracket that does not fit.
    pub(super) misfit: Option<Misfit>,
    /// The first bracket beyond [`MOST_DEPTH`], where reading stopped.
    pub(super) too_deep: Option<usize>,
}

impl Outline {
    /// That of a text without a byte-order mark.
    pub(super) fn of(text: &str) -> Self {
        let mut reader = Reader {
            text,
            at: 0,
            nodes: Vec::new(),
            roots: Vec::new(),
            levels: Vec::new(),
            current: None,
            misfit: None,
            too_deep: None,
        };
        reader.scan();
        Self {
            nodes: reader.nodes,
            roots: reader.roots,
            misfit: reader.misfit,
            too_deep: reader.too_deep,
        }
    }

    /// The step that leads from the parent of a node to it; none through `Some(...)` and the like.
    pub(super) fn step(&self, node: usize) -> Option<Step> {
        let node = &self.nodes[node];
        match (&node.key, self.kind_around(node)) {
            (_, Some('[')) => Some(Step::Index(node.index)),
            (Some(key), _) => Some(Step::Key(key.clone())),
            (None, _) => None,
        }
    }

    fn kind_around(&self, node: &Node) -> Option<char> {
        Some(self.nodes[node.parent?].open?.0)
    }

    /// The node itself, or what it holds behind `Some(...)` and the names of choices.
    pub(super) fn innermost(&self, mut node: usize) -> usize {
        loop {
            let is_list = self.nodes[node].open.is_some_and(|open| open.0 == '[');
            match self.children(Some(node))[..] {
                [only]
                    if !is_list
                        && self.nodes[only].key.is_none()
                        && self.nodes[only].open.is_some() =>
                {
                    node = only;
                }
                _ => return node,
            }
        }
    }

    /// The nodes in the bracket of a node; at the top those that are in none.
    pub(super) fn children(&self, parent: Option<usize>) -> &[usize] {
        parent.map_or(&self.roots, |parent| &self.nodes[parent].children)
    }

    /// The node that a step leads to from another one. `Some(...)`, the name of a choice and the top
    /// take no step; numbers of a vector have indices.
    pub(super) fn below(&self, node: Option<usize>, step: &Step) -> Option<usize> {
        let host = node.or_else(|| self.roots.first().copied())?;
        let mut children = self.children(Some(self.innermost(host))).iter().copied();
        children.find(|&child| {
            let child = &self.nodes[child];
            match step {
                Step::Key(key) => child.key.as_ref() == Some(key),
                Step::Index(index) => child.key.is_none() && child.index == *index,
            }
        })
    }

    /// The node of a path, if it is written; otherwise the last written one above it, with the number of
    /// steps that lead there.
    pub(super) fn follow(&self, path: &[Step]) -> (Option<usize>, usize) {
        let mut here = None;
        for (taken, step) in path.iter().enumerate() {
            match self.below(here, step) {
                Some(node) => here = Some(node),
                None => return (here, taken),
            }
        }
        (here, path.len())
    }

    /// The path of a node in words.
    pub(super) fn path(&self, node: usize) -> String {
        let mut steps = Vec::new();
        let mut here = Some(node);
        while let Some(node) = here {
            steps.extend(self.step(node));
            here = self.nodes[node].parent;
        }
        let mut path = String::new();
        for step in steps.iter().rev() {
            match step {
                Step::Key(key) if path.is_empty() => path.clone_from(key),
                Step::Key(key) => path.extend([".", key]),
                Step::Index(index) => path.extend(["[", &index.to_string(), "]"]),
            }
        }
        path
    }

    /// The innermost node that begins at or before a place and is not ended before it.
    pub(super) fn at(&self, place: usize) -> Option<usize> {
        let holds = |node: &Node| node.start <= place && place < node.until;
        self.nodes.iter().rposition(holds)
    }
}

/// Line and column (in characters) of a place, from 1.
pub(super) fn line_and_column(text: &str, at: usize) -> (usize, usize) {
    let before = &text[..at.min(text.len())];
    let line = before.matches('\n').count() + 1;
    let column = before.chars().rev().take_while(|&c| c != '\n').count() + 1;
    (line, column)
}

/// The place of a line and column; the end of a line or of the text where they lie beyond it.
pub(super) fn place(text: &str, (line, column): (usize, usize)) -> usize {
    let mut start = 0;
    for (number, content) in (1..).zip(text.split_inclusive('\n')) {
        if number == line {
            let content = content.trim_end_matches('\n');
            let mut characters = content.char_indices().map(|(at, _)| at);
            return start + characters.nth(column - 1).unwrap_or(content.len());
        }
        start += content.len();
    }
    text.len()
}

struct Reader<'a> {
    text: &'a str,
    at: usize,
    nodes: Vec<Node>,
    roots: Vec<usize>,
    /// Nodes whose brackets are open.
    levels: Vec<usize>,
    /// The node that is being read.
    current: Option<usize>,
    misfit: Option<Misfit>,
    too_deep: Option<usize>,
}

impl Reader<'_> {
    fn rest(&self) -> &str {
        &self.text[self.at..]
    }

    fn scan(&mut self) {
        while let Some(c) = self.rest().chars().next() {
            let start = self.at;
            match c {
                _ if c.is_whitespace() || c == ':' => self.at += c.len_utf8(),
                '/' if self.rest().starts_with("//") => self.skip_to("\n"),
                '/' if self.rest().starts_with("/*") => self.skip_block_comment(),
                ',' => {
                    self.at += 1;
                    self.end(start);
                }
                '(' | '[' | '{' => self.open(c),
                ')' | ']' | '}' => self.close(c),
                '"' => self.token(Self::skip_string),
                'r' if self.is_raw_string() => self.token(Self::skip_raw_string),
                _ if c.is_alphabetic() || c == '_' => self.word(),
                _ => self.token(|reader| reader.at += c.len_utf8()),
            }
        }
        let end = self.text.len();
        self.end(end);
        for node in std::mem::take(&mut self.levels) {
            self.nodes[node].value.end = end;
            self.nodes[node].until = end;
        }
    }

    /// Begins a node, where none is being read.
    fn begin(&mut self) -> usize {
        if let Some(node) = self.current {
            return node;
        }
        let node = self.nodes.len();
        let parent = self.levels.last().copied();
        let siblings = match parent {
            None => &mut self.roots,
            Some(parent) => &mut self.nodes[parent].children,
        };
        let index = siblings.len();
        siblings.push(node);
        self.nodes.push(Node {
            parent,
            key: None,
            index,
            start: self.at,
            value: self.at..self.at,
            until: self.text.len(),
            open: None,
            close: None,
            children: Vec::new(),
        });
        self.current = Some(node);
        node
    }

    /// Ends the node that is being read.
    fn end(&mut self, until: usize) {
        if let Some(node) = self.current.take() {
            self.nodes[node].until = until;
        }
    }

    /// Reads something that belongs to a value.
    fn token(&mut self, read: impl FnOnce(&mut Self)) {
        let node = self.begin();
        let start = self.at;
        read(self);
        let value = &mut self.nodes[node].value;
        if value.start == value.end {
            value.start = start;
        }
        value.end = self.at;
    }

    /// A word that a colon follows is a key; any other (a variant, a number's exponent) is not.
    fn word(&mut self) {
        let rest = self.rest();
        let is_part = |c: char| c.is_alphanumeric() || c == '_';
        let length = rest.find(|c| !is_part(c)).unwrap_or(rest.len());
        let word = rest[..length].to_owned();
        let behind = rest[length..].trim_start();
        if !behind.starts_with(':') || self.levels.is_empty() {
            return self.token(|reader| reader.at += length);
        }
        // A comma was forgotten: another key begins another node.
        self.end(self.at);
        let node = self.begin();
        self.at += length;
        self.nodes[node].key = Some(word);
        self.nodes[node].value = self.at..self.at;
    }

    fn open(&mut self, kind: char) {
        let at = self.at;
        if self.levels.len() == MOST_DEPTH {
            self.too_deep = Some(at);
            self.at = self.text.len();
            return;
        }
        self.token(|reader| reader.at += 1);
        let node = self.current.take().expect("a token belongs to a node");
        self.nodes[node].open = Some((kind, at));
        self.levels.push(node);
    }

    /// Closes the last bracket of this kind, and leaves those within it unclosed; the last of all where there
    /// is none of this kind.
    fn close(&mut self, kind: char) {
        let at = self.at;
        self.end(at);
        self.at += 1;
        let opening = match kind {
            ')' => '(',
            ']' => '[',
            _ => '{',
        };
        let last = self.levels.last().copied();
        let is_meant = |level: &usize| {
            self.nodes[*level]
                .open
                .is_some_and(|open| open.0 == opening)
        };
        let meant = self.levels.iter().rposition(is_meant);
        if meant.is_none_or(|meant| meant + 1 < self.levels.len()) {
            self.misfit.get_or_insert(Misfit { at, open: last });
        }
        let closed = meant.or(self.levels.len().checked_sub(1));
        let Some(closed) = closed else {
            return;
        };
        let levels = self.levels.split_off(closed);
        for &node in &levels[1..] {
            self.nodes[node].value.end = at;
            self.nodes[node].until = at;
        }
        let node = levels[0];
        self.nodes[node].close = Some(at);
        self.nodes[node].value.end = self.at;
        self.current = Some(node);
    }

    /// Skips the next `mark` and everything before it.
    fn skip_to(&mut self, mark: &str) {
        let found = self.rest().find(mark);
        self.at = found.map_or(self.text.len(), |found| self.at + found + mark.len());
    }

    fn skip_block_comment(&mut self) {
        self.at += 2;
        let mut depth = 1;
        while depth > 0 && self.at < self.text.len() {
            let next = self.rest().find(['*', '/']).unwrap_or(self.rest().len());
            self.at += next;
            let step = match self.rest().as_bytes() {
                [b'*', b'/', ..] => -1,
                [b'/', b'*', ..] => 1,
                _ => 0,
            };
            depth += step;
            self.at = (self.at + if step == 0 { 1 } else { 2 }).min(self.text.len());
        }
    }

    fn skip_string(&mut self) {
        let mut characters = self.rest().char_indices().skip(1);
        let mut end = self.text.len();
        while let Some((at, c)) = characters.next() {
            match c {
                '\\' => drop(characters.next()),
                '"' => {
                    end = self.at + at + 1;
                    break;
                }
                _ => {}
            }
        }
        self.at = end;
    }

    fn is_raw_string(&self) -> bool {
        let behind = self.rest()[1..].trim_start_matches('#');
        behind.starts_with('"')
    }

    fn skip_raw_string(&mut self) {
        let marks = self.rest()[1..].len() - self.rest()[1..].trim_start_matches('#').len();
        self.at += 2 + marks;
        self.skip_to(&format!("\"{}", "#".repeat(marks)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Reading stops at brackets within each other that RON would not read: each bracket is a node, and the work for
    /// the path of a node grows with its depth.
    #[test]
    fn deep_brackets_end_the_outline() {
        for bracket in ["(", "[", "{", "(a: "] {
            let outline = Outline::of(&bracket.repeat(250_000));
            // The key before the bracket that is too deep is a node.
            let nodes = MOST_DEPTH + usize::from(bracket.contains(':'));
            assert_eq!(outline.nodes.len(), nodes);
            assert_eq!(outline.too_deep, Some(MOST_DEPTH * bracket.len()));
        }
        let flat = Outline::of(&format!("Scene(a: [{}])", "b(), ".repeat(1000)));
        assert_eq!((flat.nodes.len(), flat.too_deep), (1002, None));
        assert_eq!(flat.children(Some(1)).len(), 1000);
    }
}
