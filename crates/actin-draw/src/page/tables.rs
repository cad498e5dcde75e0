//! Numbers as tables: what is expected and by whom, ours, difference, verdict; what was missed first,
//! under its reason.

use crate::report::Row;
use maud::{Markup, html};

/// Longer tables are folded away, unless they show what was missed.
const LONG: usize = 12;

/// Whether a row stands among others of its artefact, or names its artefact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Among {
    Own,
    All,
}

/// Missed rows, sorted by the reason that they share.
#[derive(Clone, Debug, Default)]
pub struct Misses<'a> {
    /// Those with a reason, in the order in which they are told.
    pub explained: Vec<Explained<'a>>,
    /// Those without.
    pub open: Vec<&'a Row>,
    /// What is said of those without.
    pub open_note: &'a str,
}

/// Missed rows of one artefact and the reason that they share.
#[derive(Clone, Debug)]
pub struct Explained<'a> {
    /// Name of the artefact.
    pub artefact: &'a str,
    /// What is found, as a heading.
    pub title: &'a str,
    /// The reason.
    pub text: &'a str,
    /// The rows; without any the reason is not told.
    pub rows: Vec<&'a Row>,
}

/// The rows of an artefact in up to four tables, those that are missed under their reasons.
pub(super) fn numbers(rows: &[Row], misses: &Misses<'_>) -> Markup {
    // The second says of rows without a verdict whether a number stands beside them.
    let groups = [
        (Some(false), None, "Missed"),
        (Some(true), None, "Agree"),
        (None, Some(true), "Shown beside another number, not judged"),
        (None, Some(false), "Measured"),
    ];
    html! {
        h3 { "Numbers" }
        @for (verdict, beside, title) in groups {
            (group(rows, verdict, beside, title, misses))
        }
    }
}

/// The rows with this verdict, if there are any.
fn group(
    rows: &[Row],
    verdict: Option<bool>,
    beside: Option<bool>,
    title: &str,
    misses: &Misses<'_>,
) -> Markup {
    let is_in = |row: &&Row| {
        row.pass == verdict && beside.is_none_or(|beside| row.paper.is_some() == beside)
    };
    let chosen: Vec<&Row> = rows.iter().filter(is_in).collect();
    if chosen.is_empty() {
        return Markup::default();
    }
    let is_missed = verdict == Some(false);
    html! {
        details open[is_missed || chosen.len() <= LONG] {
            summary class=(class(verdict)) { (title) ": " (chosen.len()) }
            @if is_missed {
                (missed(misses, Among::Own))
            } @else {
                (table(&chosen, Among::Own))
            }
        }
    }
}

/// What was missed: each reason, with the rows that it explains.
pub(super) fn missed(misses: &Misses<'_>, among: Among) -> Markup {
    html! {
        @for one in &misses.explained {
            (explained(one, among))
        }
        @if !misses.open.is_empty() {
            p class="why" { strong { "Not looked into." } " " (misses.open_note) }
            (table(&misses.open, among))
        }
    }
}

/// Rows beyond this number are folded away below their reason.
const MANY: usize = 6;

fn explained(reason: &Explained<'_>, among: Among) -> Markup {
    let rows = &reason.rows;
    if rows.is_empty() {
        return Markup::default();
    }
    html! {
        p class="why" { strong { (reason.title) "." } " " (reason.text) }
        @if rows.len() <= MANY {
            (table(rows, among))
        } @else {
            details {
                summary class="miss" { (rows.len()) " rows of " (super::name(reason.artefact)) }
                (table(rows, among))
            }
        }
    }
}

/// One table of rows.
fn table(rows: &[&Row], among: Among) -> Markup {
    html! {
        table {
            thead {
                tr {
                    @if among == Among::All { th { "where" } }
                    th { "quantity" }
                    th class="n" { "expected" }
                    th { "by" }
                    th class="n" { "ours" }
                    th class="n" { "difference" }
                    th class="n" { "tolerance" }
                    th { "unit" }
                    th { "verdict" }
                    th { "note" }
                }
            }
            tbody {
                @for row in rows {
                    (line(row, among))
                }
            }
        }
    }
}

fn line(row: &Row, among: Among) -> Markup {
    let (by_class, by) = row
        .origin
        .map_or(("none", "–"), |origin| ("by", origin.name()));
    let unit_class = if row.unit.is_empty() { "none" } else { "unit" };
    html! {
        tr {
            @if among == Among::All {
                td data-label="where" class="where" {
                    a href={ "#" (row.artefact) } { (super::name(row.artefact)) }
                }
            }
            td class="path" { code { (breakable(&row.quantity)) } }
            (number("expected", row.paper))
            td data-label="by" class=(by_class) { (by) }
            (number("ours", Some(row.ours)))
            (number("difference", row.paper.map(|paper| row.ours - paper)))
            (number("tolerance", row.tolerance))
            td data-label="unit" class=(unit_class) { (row.unit) }
            td data-label="verdict" class=(class(row.pass)) { (word(row.pass)) }
            td class="note" { (row.note) }
        }
    }
}

/// A name that may be broken between its parts.
///
/// ```
/// let name = actin_draw::page::breakable("b3/over").into_string();
/// assert_eq!(name, "b3/<wbr>over");
/// ```
pub fn breakable(path: &str) -> Markup {
    html! {
        @for part in path.split_inclusive(['/', '_']) {
            (part)
            @if part.ends_with(['/', '_']) { wbr; }
        }
    }
}

fn number(label: &str, value: Option<f64>) -> Markup {
    let (class, text) = value.map_or(("n none", "–".to_owned()), |v| ("n", significant(v)));
    html! {
        td data-label=(label) class=(class) { (text) }
    }
}

fn class(verdict: Option<bool>) -> &'static str {
    match verdict {
        Some(true) => "pass",
        Some(false) => "miss",
        None => "open",
    }
}

fn word(verdict: Option<bool>) -> &'static str {
    match verdict {
        Some(true) => "✓ agrees",
        Some(false) => "✗ missed",
        None => "measured",
    }
}

/// Five significant digits, in the shorter of the two notations.
///
/// ```
/// use actin_draw::page::significant;
/// assert_eq!(significant(61.234_567), "61.235");
/// assert_eq!(significant(-1.5e-7), "-1.5000e-7");
/// ```
pub fn significant(value: f64) -> String {
    let magnitude = value.abs();
    if magnitude == 0.0 {
        "0".to_owned()
    } else if (1e-3..1e6).contains(&magnitude) {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "between 0 and 7: the magnitude lies between 1e-3 and 1e6"
        )]
        let decimals = (4.0 - magnitude.log10().floor()).max(0.0) as usize;
        let text = format!("{value:.decimals$}");
        if text.contains('.') {
            let text = text.trim_end_matches('0');
            text.trim_end_matches('.').to_owned()
        } else {
            text
        }
    } else {
        format!("{value:.4e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_five_digits() {
        assert_eq!(significant(61.234_567), "61.235");
        assert_eq!(significant(0.123_456_7), "0.12346");
        assert_eq!(significant(123_456.0), "123456");
        assert_eq!(significant(120.0), "120");
        assert_eq!(significant(2.5), "2.5");
        assert_eq!(significant(-1.5e-7), "-1.5000e-7");
        assert_eq!(significant(0.0), "0");
    }

    /// What was missed without a known reason comes first and is never folded away; a long list of what
    /// agrees is.
    #[test]
    fn misses_come_first_and_long_tables_are_folded() {
        let row = |i: usize| Row::measured("fig1", format!("q/{i}"), "nm", 1.0, "a < b");
        let mut rows: Vec<Row> = (0..40).map(|i| row(i).against(1.0, 0.1)).collect();
        rows.extend((40..60).map(|i| row(i).against(3.0, 0.1)));
        let misses = Misses {
            open: rows[40..].iter().collect(),
            ..Misses::default()
        };
        let page = numbers(&rows, &misses).into_string();
        let place = |text: &str| page.find(text).unwrap();
        assert!(place("Missed: 20") < place("Agree: 40"));
        assert!(page.contains("<details open><summary class=\"miss\">Missed"));
        assert!(page.contains("<details><summary class=\"pass\">Agree"));
        assert_eq!(page.matches("<tr><td").count(), rows.len());
        assert_eq!(page.matches("✗ missed").count(), 20);
        assert!(page.contains("a &lt; b") && !page.contains("Measured"));
    }
}
