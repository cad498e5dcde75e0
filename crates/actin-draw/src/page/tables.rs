//! Numbers as tables: what is expected and by whom, ours, difference, verdict; what was missed first,
//! under its reason.

use super::{escape, push};
use crate::report::{Origin, Row};

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

/// Writes the rows of an artefact in up to four tables, those that are missed under their reasons.
pub(super) fn write(page: &mut String, rows: &[Row], misses: &Misses<'_>) {
    // The second says of rows without a verdict whether a number stands beside them.
    let groups = [
        (Some(false), None, "Missed"),
        (Some(true), None, "Agree"),
        (None, Some(true), "Shown beside another number, not judged"),
        (None, Some(false), "Measured"),
    ];
    page.push_str("<h3>Numbers</h3>\n");
    for (verdict, beside, title) in groups {
        let is_in = |row: &&Row| {
            row.pass == verdict && beside.is_none_or(|beside| row.paper.is_some() == beside)
        };
        let chosen: Vec<&Row> = rows.iter().filter(is_in).collect();
        if chosen.is_empty() {
            continue;
        }
        let open = if chosen.len() <= LONG || verdict == Some(false) {
            " open"
        } else {
            ""
        };
        push(
            page,
            format_args!(
                "<details{open}><summary class=\"{}\">{title}: {}</summary>\n",
                class(verdict),
                chosen.len()
            ),
        );
        if verdict == Some(false) {
            missed(page, misses, Among::Own);
        } else {
            table(page, &chosen, Among::Own);
        }
        page.push_str("</details>\n");
    }
}

/// Writes what was missed: each reason, with the rows that it explains.
pub(super) fn missed(page: &mut String, misses: &Misses<'_>, among: Among) {
    for one in &misses.explained {
        explained(page, one, among);
    }
    if !misses.open.is_empty() {
        push(
            page,
            format_args!(
                "<p class=\"why\"><strong>Not looked into.</strong> {}</p>\n",
                escape(misses.open_note)
            ),
        );
        table(page, &misses.open, among);
    }
}

/// Rows beyond this number are folded away below their reason.
const MANY: usize = 6;

fn explained(page: &mut String, reason: &Explained<'_>, among: Among) {
    let rows = &reason.rows;
    if rows.is_empty() {
        return;
    }
    push(
        page,
        format_args!(
            "<p class=\"why\"><strong>{}.</strong> {}</p>\n",
            escape(reason.title),
            escape(reason.text)
        ),
    );
    if rows.len() <= MANY {
        table(page, rows, among);
        return;
    }
    push(
        page,
        format_args!(
            "<details><summary class=\"miss\">{} rows of {}</summary>\n",
            rows.len(),
            super::name(reason.artefact)
        ),
    );
    table(page, rows, among);
    page.push_str("</details>\n");
}

/// One table of rows.
fn table(page: &mut String, rows: &[&Row], among: Among) {
    page.push_str("<table><thead><tr>");
    if among == Among::All {
        page.push_str("<th>where</th>");
    }
    page.push_str(
        "<th>quantity</th><th class=\"n\">expected</th><th>by</th><th class=\"n\">ours</th>\
         <th class=\"n\">difference</th><th class=\"n\">tolerance</th><th>unit</th>\
         <th>verdict</th><th>note</th></tr></thead><tbody>\n",
    );
    for row in rows {
        write_row(page, row, among);
    }
    page.push_str("</tbody></table>\n");
}

fn write_row(page: &mut String, row: &Row, among: Among) {
    page.push_str("<tr>");
    if among == Among::All {
        let id = escape(row.artefact);
        let name = super::name(row.artefact);
        push(
            page,
            format_args!(
                "<td data-label=\"where\" class=\"where\"><a href=\"#{id}\">{name}</a></td>"
            ),
        );
    }
    push(
        page,
        format_args!(
            "<td class=\"path\"><code>{}</code></td>",
            breakable(&row.quantity)
        ),
    );
    number(page, "expected", row.paper);
    origin(page, row.origin);
    let numbers = [
        ("ours", Some(row.ours)),
        ("difference", row.paper.map(|paper| row.ours - paper)),
        ("tolerance", row.tolerance),
    ];
    for (label, value) in numbers {
        number(page, label, value);
    }
    push(
        page,
        format_args!(
            "<td data-label=\"unit\" class=\"{}\">{}</td>\
             <td data-label=\"verdict\" class=\"{}\">{}</td><td class=\"note\">{}</td></tr>\n",
            if row.unit.is_empty() { "none" } else { "unit" },
            escape(row.unit),
            class(row.pass),
            word(row.pass),
            escape(&row.note),
        ),
    );
}

/// A name that may be broken between its parts.
fn breakable(path: &str) -> String {
    let text = escape(path);
    text.replace('/', "/<wbr>").replace('_', "_<wbr>")
}

fn number(page: &mut String, label: &str, value: Option<f64>) {
    let (class, text) = value.map_or(("n none", "–".to_owned()), |v| ("n", significant(v)));
    push(
        page,
        format_args!("<td data-label=\"{label}\" class=\"{class}\">{text}</td>"),
    );
}

/// Who expects the number, or sets the bound.
fn origin(page: &mut String, origin: Option<Origin>) {
    let (class, text) = origin.map_or(("none", "–"), |origin| ("by", origin.name()));
    push(
        page,
        format_args!("<td data-label=\"by\" class=\"{class}\">{text}</td>"),
    );
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
        let mut page = String::new();
        write(&mut page, &rows, &misses);
        let place = |text: &str| page.find(text).unwrap();
        assert!(place("Missed: 20") < place("Agree: 40"));
        assert!(page.contains("<details open><summary class=\"miss\">Missed"));
        assert!(page.contains("<details><summary class=\"pass\">Agree"));
        assert_eq!(page.matches("<tr><td").count(), rows.len());
        assert_eq!(page.matches("✗ missed").count(), 20);
        assert!(page.contains("a &lt; b") && !page.contains("Measured"));
    }
}
