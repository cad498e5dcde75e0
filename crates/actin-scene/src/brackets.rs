//! Location of missing brackets.
//!
//! After a missing bracket, the parser fails later than at the mistake. More reliable signs are a key in a
//! list, an element without a key among keys, and indentation.

use super::SceneError;
use super::parse::{MOST_DEPTH, Parsed, word};
use super::position::line_and_column;
use super::tree::SceneValue;

pub(super) fn mistake(text: &str, file: &str, parsed: &Parsed) -> Option<SceneError> {
    let brackets = parsed.brackets;
    let error =
        |at: usize, message: &str| Some(SceneError::new(line_and_column(text, at), message));
    if let Some(at) = brackets.too_deep {
        let message = format!("brackets are nested more than {MOST_DEPTH} deep here");
        return error(at, &message);
    }
    if let Some(at) = brackets.unclosed_text {
        return error(
            at,
            "a text begins here and does not end: a quotation mark is missing",
        );
    }
    let is_broken = brackets.misfit.is_some() || brackets.is_unclosed;
    if !is_broken && !brackets.has_listed_key {
        return None;
    }
    let signs = Signs {
        text,
        root: &parsed.root,
        is_broken,
    };
    let misfit = brackets.misfit.map(|(at, open)| (open, at));
    match signs.suspect(&parsed.root).or(misfit) {
        Some((open, at)) => Some(signs.describe(open, at)),
        None => error(
            text.trim_end().len(),
            &format!("unexpected end of the {file}: a bracket is not closed"),
        ),
    }
}

struct Signs<'a> {
    text: &'a str,
    root: &'a SceneValue,
    is_broken: bool,
}

impl Signs<'_> {
    /// Last bracket that seems unclosed, and the position before which its closing bracket is missing.
    fn suspect(&self, node: &SceneValue) -> Option<(usize, usize)> {
        let mut inner = node.children().iter().rev();
        let within = inner.find_map(|child| self.suspect(child));
        within.or_else(|| Some((node.place.open?, self.missing_before(node)?)))
    }

    fn missing_before(&self, node: &SceneValue) -> Option<usize> {
        let open = node.place.open?;
        let has_keys = node.children().first()?.key.is_some();
        let is_strange = |child: &&SceneValue| {
            let is_key = child.key.is_some();
            let is_of_another = if node.is_list() {
                is_key
            } else {
                self.is_broken && has_keys != is_key
            };
            is_of_another || self.is_outdented(child.place.start, open, true)
        };
        let strange = node.children().iter().find(is_strange);
        let close = || {
            node.place
                .close
                .filter(|close| self.is_outdented(*close, open, false))
        };
        strange.map(|child| child.place.start).or_else(close)
    }

    /// Returns `true` at the start of a later line than a bracket, with less indentation or, if `equal`, the same.
    fn is_outdented(&self, at: usize, open: usize, equal: bool) -> bool {
        let line = |at: usize| self.text[..at].rfind('\n').map_or(0, |end| end + 1);
        let indent = |at: usize| {
            let rest = &self.text[line(at)..];
            rest.len() - rest.trim_start_matches([' ', '\t']).len()
        };
        let is_first = at == line(at) + indent(at);
        self.is_broken
            && is_first
            && line(at) > line(open)
            && (indent(at) < indent(open) || equal && indent(at) == indent(open))
    }

    fn describe(&self, open: usize, at: usize) -> SceneError {
        let kind = &self.text[open..=open];
        let closing = match kind {
            "(" => ')',
            "[" => ']',
            _ => '}',
        };
        let rest = &self.text[at..];
        let first = rest.chars().next().map_or(0, char::len_utf8);
        let before = &rest[..word(rest).len().max(first)];
        let of = match self.root.path(&self.root.indices_at(open)) {
            path if path.is_empty() => path,
            path => format!(" of {path}"),
        };
        let (line, column) = line_and_column(self.text, open);
        let message = format!(
            "a {closing} is missing before {before}: the {kind}{of} at {line}:{column} is not closed"
        );
        SceneError::new(line_and_column(self.text, at), &message)
    }
}
