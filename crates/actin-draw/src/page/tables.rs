//! Tables of numbers: expected value and its origin, our value, difference, verdict.

use super::Verdicts;
use crate::report::{Artefact, Row};
use maud::{Markup, PreEscaped, html};

const COLUMNS: usize = 9;

/// Failed rows, grouped by reason.
#[derive(Clone, Debug, Default)]
pub struct Misses<'a> {
    /// Rows with a reason, in order.
    pub explained: Vec<ExplainedMisses<'a>>,
    /// Rows without a reason.
    pub open: Vec<&'a Row>,
    /// Text about rows without a reason.
    pub open_note: &'a str,
}

/// Failed rows of one artefact with the same reason.
#[derive(Clone, Debug)]
pub struct ExplainedMisses<'a> {
    /// Name of the artefact.
    pub artefact: &'a str,
    /// Heading.
    pub title: &'a str,
    /// The reason.
    pub text: &'a str,
    /// Rows; without any, the reason is not shown.
    pub rows: Vec<&'a Row>,
}

/// Returns a collapsed table of rows without a verdict; empty if there are none.
pub(super) fn measured(rows: &[Row]) -> Markup {
    let groups = [(true, "Compared without a verdict"), (false, "Measured")];
    html! {
        @for (beside, title) in groups {
            @let chosen: Vec<&Row> = rows
                .iter()
                .filter(|row| row.pass.is_none() && row.paper.is_some() == beside)
                .collect();
            @if !chosen.is_empty() {
                details {
                    summary class="open" { (title) ": " (chosen.len()) }
                    table { (head()) tbody { @for row in chosen { (line(row)) } } }
                }
            }
        }
    }
}

/// Returns the part of the table of verdicts for an artefact, with failed rows first; empty without verdicts.
pub(super) fn judged(artefact: &Artefact, misses: &Misses<'_>) -> Markup {
    let verdicts = Verdicts::from_rows(&artefact.rows);
    if verdicts.compared() == 0 {
        return Markup::default();
    }
    let id = artefact.id;
    let agree = artefact.rows.iter().filter(|row| row.pass == Some(true));
    let told = misses.explained.iter().filter(|one| !one.rows.is_empty());
    html! {
        tbody id={ "verdicts-" (id) } {
            tr class="group" {
                th colspan=(COLUMNS) {
                    a href={ "#" (id) } { (super::name(id)) } ": " (artefact.title)
                    " " small { (verdicts.in_words()) } " " (verdicts.bar())
                }
            }
            @for one in told {
                (reason(one.title, one.text))
                @for row in &one.rows { (line(row)) }
            }
            @if !misses.open.is_empty() {
                (reason("Not looked into", misses.open_note))
                @for row in &misses.open { (line(row)) }
            }
            @for row in agree { (line(row)) }
        }
    }
}

pub(super) fn verdicts(parts: &str) -> Markup {
    let choices = [
        ("all", "all"),
        ("missed", "what was missed"),
        ("agree", "what agrees"),
    ];
    html! {
        div class="judged" {
            p class="choose" {
                @for (id, name) in choices {
                    input type="radio" name="judged" id={ "only-" (id) } checked[id == "all"];
                    label for={ "only-" (id) } { (name) }
                }
            }
            table { (head()) (PreEscaped(parts)) }
        }
    }
}

fn reason(title: &str, text: &str) -> Markup {
    html! {
        tr class="why" { td colspan=(COLUMNS) class="wide" { strong { (title) "." } " " (text) } }
    }
}

fn head() -> Markup {
    html! {
        thead {
            tr {
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
    }
}

fn line(row: &Row) -> Markup {
    let (by_class, by) = row
        .origin
        .map_or(("none", "–"), |origin| ("by", origin.name()));
    let unit_class = if row.unit.is_empty() { "none" } else { "unit" };
    html! {
        tr class=(class(row.pass)) {
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

/// Returns a name that may be broken between its parts.
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

/// Formats a number with five significant digits, in the shorter of two notations.
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

    /// Failed rows are first, after their reasons. Every row with a verdict occurs once, and other rows occur in
    /// another table.
    #[test]
    fn misses_come_first_and_every_row_is_there_once() {
        let row = |i: usize| Row::measured("fig1", format!("q/{i}"), "nm", 1.0, "a < b");
        let mut rows: Vec<Row> = (0..40).map(|i| row(i).with_paper_value(1.0, 0.1)).collect();
        rows.extend((40..60).map(|i| row(i).with_paper_value(3.0, 0.1)));
        rows.extend((60..63).map(row));
        let artefact = Artefact {
            id: "fig1",
            title: "",
            settings: String::new(),
            rows,
            pictures: Vec::new(),
            views: Vec::new(),
            wall_s: 0.0,
        };
        let misses = Misses {
            open: artefact.rows[40..60].iter().collect(),
            open_note: "nobody looked",
            ..Misses::default()
        };
        let part = judged(&artefact, &misses).into_string();
        let place = |text: &str| part.find(text).unwrap();
        assert!(place("nobody looked") < place("✗ missed"));
        assert!(part.rfind("✗ missed").unwrap() < place("✓ agrees"));
        assert_eq!(part.matches("✗ missed").count(), 20);
        assert_eq!(part.matches("✓ agrees").count(), 40);
        assert!(part.contains("a &lt; b") && part.contains("40 agree, 20 missed"));
        let rest = measured(&artefact.rows).into_string();
        assert!(rest.contains("Measured: 3") && !rest.contains("agrees"));
    }
}
