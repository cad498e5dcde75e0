//! Where a bracket is missing.
//!
//! Every bracket behind a missing one closes another than was meant, so the place where the text stops making
//! sense is not the place to mend. Better signs are a key in a list, an element without a key among keys, and
//! lines that are not indented as what they belong to.

use super::SceneError;
use super::outline::{MOST_DEPTH, Misfit, Outline, line_and_column};

/// The mistake in the brackets of a text that is no RON; none where they say nothing.
pub(super) fn mistake(text: &str) -> Option<SceneError> {
    let outline = Outline::of(text);
    if let Some(at) = outline.too_deep {
        let message = format!("brackets are nested more than {MOST_DEPTH} deep here");
        return Some(SceneError::new(line_and_column(text, at), &message));
    }
    let signs = Signs {
        text,
        outline: &outline,
        lines: lines(text),
    };
    if let Some(Misfit { at, open: None }) = outline.misfit {
        let closing = &text[at..=at];
        let message = format!("this {closing} closes nothing");
        return Some(SceneError::new(line_and_column(text, at), &message));
    }
    let is_broken =
        outline.misfit.is_some() || outline.nodes.iter().any(|n| is_unclosed(n.open, n.close));
    let nodes = 0..outline.nodes.len();
    let suspect = nodes.rev().find_map(|node| {
        let at = signs.missing_before(node, is_broken)?;
        Some((node, at))
    });
    let misfit = outline
        .misfit
        .and_then(|misfit| Some((misfit.open?, misfit.at)));
    let (node, at) = suspect.or(misfit)?;
    Some(signs.describe(node, at))
}

fn is_unclosed(open: Option<(char, usize)>, close: Option<usize>) -> bool {
    open.is_some() && close.is_none()
}

struct Signs<'a> {
    text: &'a str,
    outline: &'a Outline,
    lines: Vec<Line>,
}

/// A line of the text.
struct Line {
    /// Its first byte.
    start: usize,
    /// Blanks at its beginning.
    indent: usize,
    /// Its first byte that is not white.
    begin: usize,
}

fn lines(text: &str) -> Vec<Line> {
    let mut start = 0;
    let line = |content: &str| {
        let line = Line {
            start,
            indent: content.len() - content.trim_start_matches([' ', '\t']).len(),
            begin: start + content.len() - content.trim_start().len(),
        };
        start += content.len();
        line
    };
    text.split_inclusive('\n').map(line).collect()
}

impl Signs<'_> {
    /// What a closing bracket of this node is missing before, if one seems to be.
    fn missing_before(&self, node: usize, is_broken: bool) -> Option<usize> {
        let (kind, open) = self.outline.nodes[node].open?;
        let children = self.outline.children(Some(node));
        let has_keys = children
            .first()
            .is_some_and(|&first| self.outline.nodes[first].key.is_some());
        let indent = self.indent(open);
        let is_strange = |&&child: &&usize| {
            let child = &self.outline.nodes[child];
            let is_key = child.key.is_some();
            let is_of_another = match kind {
                '[' => is_key,
                _ => is_broken && has_keys != is_key,
            };
            let is_outdented = is_broken
                && self.begins_line(child.start)
                && self.line(child.start) > self.line(open)
                && self.indent(child.start) <= indent;
            is_of_another || is_outdented
        };
        let strange = children.iter().find(is_strange);
        let strange = strange.map(|&child| self.outline.nodes[child].start);
        strange.or_else(|| {
            let close = self.outline.nodes[node].close?;
            let is_outdented = self.begins_line(close)
                && self.line(close) > self.line(open)
                && self.indent(close) < indent;
            (is_broken && is_outdented).then_some(close)
        })
    }

    fn describe(&self, node: usize, at: usize) -> SceneError {
        let (kind, open) = self.outline.nodes[node].open.expect("its bracket is open");
        let closing = match kind {
            '(' => ')',
            '[' => ']',
            _ => '}',
        };
        let rest = &self.text[at..];
        let is_part = |c: char| c.is_alphanumeric() || c == '_';
        let end = rest.find(|c| !is_part(c)).unwrap_or(rest.len()).max(1);
        let before = &rest[..rest
            .char_indices()
            .map(|(i, _)| i)
            .find(|&i| i >= end)
            .unwrap_or(rest.len())];
        let path = self.outline.path(node);
        let of = if path.is_empty() {
            String::new()
        } else {
            format!(" of {path}")
        };
        let (line, column) = line_and_column(self.text, open);
        let message = format!(
            "a {closing} is missing before {before}: the {kind}{of} at {line}:{column} is not closed"
        );
        SceneError::new(line_and_column(self.text, at), &message)
    }

    /// Number of the line of a place, from 0.
    fn line(&self, at: usize) -> usize {
        self.lines.partition_point(|line| line.start <= at) - 1
    }

    fn indent(&self, at: usize) -> usize {
        self.lines[self.line(at)].indent
    }

    fn begins_line(&self, at: usize) -> bool {
        at <= self.lines[self.line(at)].begin
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCENE: &str = "Scene(
    filament: Filament(
        sections: [
            Ellipsoids(from_nm: 0.0, to_nm: 80.0),
            Rod(from_nm: 80.0, to_nm: 160.0),
        ],
        at_nm: (0.0, 1.0, 0.0),
    ),
    clamps: [Clamp(end: Start)],
    task: Equilibrium(),
)
";

    /// What is written in place of what, where that is blamed, and what the message has.
    const MISSING: &[(&str, &str, (usize, usize), &str)] = &[
        (
            "to_nm: 80.0)",
            "to_nm: 80.0",
            (5, 13),
            "Rod: the ( of filament.sections[0] at 4:23",
        ),
        (
            "160.0)",
            "160.0",
            (6, 9),
            "]: the ( of filament.sections[1] at 5:16",
        ),
        (
            "        ],",
            "        ",
            (7, 9),
            "at_nm: the [ of filament.sections at 3:19",
        ),
        (
            "1.0, 0.0)",
            "1.0, 0.0",
            (8, 5),
            "): the ( of filament.at_nm at 7:16",
        ),
        (
            "    ),\n",
            "\n",
            (9, 5),
            "clamps: the ( of filament at 2:23",
        ),
        (
            "Start)]",
            "Start]",
            (9, 30),
            "]: the ( of clamps[0] at 9:19",
        ),
        (
            "Start)]",
            "Start)",
            (10, 5),
            "task: the [ of clamps at 9:13",
        ),
        (
            "Equilibrium()",
            "Equilibrium(",
            (11, 1),
            "): the ( of task at 10:22",
        ),
    ];

    /// Each bracket of a scene left out in turn: blamed where it is missing, but for the last, of which the
    /// end of the text tells.
    #[test]
    fn a_missing_bracket_is_blamed_where_it_is_missing() {
        for &(from, to, place, before) in MISSING {
            let text = SCENE.replacen(from, to, 1);
            let error = mistake(&text).unwrap_or_else(|| panic!("{from}"));
            let found = error.to_string();
            assert_eq!((error.line, error.column), place, "{from}: {found}");
            assert!(found.contains(before), "{from}: {found}");
        }
        assert_eq!(mistake(SCENE), None);
        assert_eq!(mistake(SCENE.trim_end().trim_end_matches(')')), None);
        let extra = mistake(&format!("{SCENE})")).unwrap();
        assert_eq!(extra.to_string(), "12:1: this ) closes nothing");
    }
}
