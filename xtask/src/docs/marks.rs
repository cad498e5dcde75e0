//! Marks: comments that say which row of the report a number in a document is.
//!
//! - `36.74 nm <!-- fig8:height/over/180/rod-140 -->` marks the last number before it in its line;
//!   if a percent sign follows the number, the row holds a share.
//! - In the first cell of a table's row, a name with a star marks every cell of the row; what
//!   stands for the star in each column is listed above the table, `_` for a column that is none:
//!   `<!-- columns: rod, rod-240, ellipsoids -->`, with a unit if one is needed:
//!   `<!-- columns: 10, 40; in 1e-4 -->`. Of a cell the first number counts; empty ones are none.
//! - `@paper` after the name is the paper's number; `@verdict` is the verdict, `yes` or `no` in the
//!   place of a number.

use super::number;

/// What of a row is marked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Of {
    Ours,
    Paper,
    Verdict,
}

impl Of {
    /// A name without what follows it, and what that means.
    fn split(name: &str) -> (&str, Self) {
        let suffixes = [("@paper", Self::Paper), ("@verdict", Self::Verdict)];
        let found = suffixes
            .into_iter()
            .find_map(|(suffix, of)| Some((name.strip_suffix(suffix)?, of)));
        found.unwrap_or((name, Self::Ours))
    }

    /// The place in a word of what is marked so, and itself.
    fn in_word(self, word: &str) -> Option<(usize, &str)> {
        if self != Self::Verdict {
            return number::in_word(word);
        }
        let bare = word.trim_matches('*');
        let place = word.len() - word.trim_start_matches('*').len();
        ["yes", "no"].contains(&bare).then_some((place, bare))
    }
}

/// A number of a document, and what it should be.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Mark {
    /// Line, from 1, and the byte in it at which the number starts.
    pub line: usize,
    pub start: usize,
    /// The number as it stands.
    pub shown: String,
    pub artefact: String,
    pub quantity: String,
    pub of: Of,
    /// What the report's number is divided by.
    pub unit: f64,
}

impl Mark {
    pub(super) fn name(&self) -> String {
        let of = match self.of {
            Of::Ours => "",
            Of::Paper => "@paper",
            Of::Verdict => "@verdict",
        };
        format!("{}:{}{of}", self.artefact, self.quantity)
    }
}

/// What stands for the star in each column, and the unit of a table.
#[derive(Clone, Debug)]
struct Columns {
    keys: Vec<String>,
    unit: f64,
}

/// All marks of a document, in order.
///
/// # Errors
/// A mark without a number, a row of a table without its columns.
pub(super) fn marks(document: &str, text: &str) -> Result<Vec<Mark>, String> {
    let mut all = Vec::new();
    let mut columns: Option<Columns> = None;
    let mut in_code = false;
    for (line, text) in (1..).zip(text.lines()) {
        let fail = |error: String| format!("{document}:{line}: {error}");
        in_code ^= text.trim_start().starts_with("```");
        if in_code {
            continue;
        }
        for (start, comment) in comments(text) {
            if let Some(list) = comment.strip_prefix("columns:") {
                columns = Some(read_columns(list).map_err(fail)?);
            } else if comment.contains('*') {
                let columns = columns.as_ref();
                let columns =
                    columns.ok_or_else(|| fail(format!("{comment}: no columns above")))?;
                all.extend(row(line, text, comment, columns).map_err(fail)?);
            } else if is_name(comment) {
                all.push(single(line, text, start, comment).map_err(fail)?);
            }
        }
    }
    Ok(all)
}

/// Comments of a line: where each starts, and what it says.
fn comments(line: &str) -> Vec<(usize, &str)> {
    let starts = line.match_indices("<!--");
    starts
        .filter_map(|(start, opening)| {
            let inside = &line[start + opening.len()..];
            Some((start, inside[..inside.find("-->")?].trim()))
        })
        .collect()
}

/// Whether a comment is the name of a row: `fig8:...`, `table3:...`.
fn is_name(comment: &str) -> bool {
    comment.split_once(':').is_some_and(|(artefact, _)| {
        let number = artefact
            .strip_prefix("fig")
            .or(artefact.strip_prefix("table"));
        number.is_some_and(|n| n.parse::<u8>().is_ok())
    })
}

fn read_columns(list: &str) -> Result<Columns, String> {
    let (keys, unit) = list.split_once(';').unwrap_or((list, " in 1"));
    let unit = unit.trim().strip_prefix("in ");
    let unit = unit.and_then(|u| u.parse().ok());
    Ok(Columns {
        keys: keys.split(',').map(|key| key.trim().to_owned()).collect(),
        unit: unit.ok_or_else(|| format!("columns{list}: the unit is no number"))?,
    })
}

fn mark(line: usize, (start, shown): (usize, &str), name: &str, unit: f64) -> Mark {
    let (artefact, quantity) = name.split_once(':').unwrap_or((name, ""));
    let (quantity, of) = Of::split(quantity);
    Mark {
        line,
        start,
        shown: shown.to_owned(),
        artefact: artefact.to_owned(),
        quantity: quantity.to_owned(),
        of,
        unit,
    }
}

/// The last number before a comment.
fn single(line: usize, text: &str, comment: usize, name: &str) -> Result<Mark, String> {
    let before = &text[..comment];
    let words = words(before);
    let found = words.iter().rev().find_map(|&(start, word)| {
        let (offset, number) = Of::split(name).1.in_word(word)?;
        Some((start + offset, number))
    });
    let (start, number) = found.ok_or_else(|| format!("{name}: no number before the mark"))?;
    let after = before[start + number.len()..].trim_start();
    let unit = if after.starts_with('%') { 1e-2 } else { 1.0 };
    Ok(mark(line, (start, number), name, unit))
}

/// The first number of every cell of a row.
fn row(line: usize, text: &str, name: &str, columns: &Columns) -> Result<Vec<Mark>, String> {
    let mut cells = Vec::new();
    let mut start = 0;
    for cell in text.split('|') {
        cells.push((start, cell));
        start += cell.len() + 1;
    }
    // Before the first bar is nothing, then the cell with the name; after the last bar is nothing.
    let cells = cells.get(2..cells.len() - 1).unwrap_or_default();
    if cells.len() != columns.keys.len() {
        let (cells, keys) = (cells.len(), columns.keys.len());
        return Err(format!("{name}: {cells} cells for {keys} columns"));
    }
    let named = cells
        .iter()
        .zip(&columns.keys)
        .filter(|(_, key)| *key != "_");
    let marks = named.filter_map(|((start, cell), key)| {
        let name = name.replace('*', key);
        let found = words(cell).into_iter().find_map(|(at, word)| {
            let (offset, number) = Of::split(&name).1.in_word(word)?;
            Some((start + at + offset, number))
        });
        let unit = if cell.contains('%') {
            1e-2
        } else {
            columns.unit
        };
        Some(mark(line, found?, &name, unit))
    });
    Ok(marks.collect())
}

/// Words with the byte at which each starts.
fn words(text: &str) -> Vec<(usize, &str)> {
    let origin = text.as_ptr() as usize;
    let words = text.split_whitespace();
    words
        .map(|word| (word.as_ptr() as usize - origin, word))
        .collect()
}
