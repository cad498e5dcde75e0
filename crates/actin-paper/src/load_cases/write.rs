//! The table as CSV and as Markdown.

use super::case::{Bound, Group};
use super::picture::distinct;
use super::row::Row;
use crate::measure::Sampled;
use actin_draw::report::{save, write_csv};
use std::fmt::Write as _;
use std::path::Path;

/// A column of `load-cases.csv`.
type Column = (&'static str, fn(&Row) -> String);

const COLUMNS: [Column; 23] = [
    ("group", |r| r.group.name().to_owned()),
    ("case", |r| r.case.clone()),
    ("quantity", |r| r.quantity.clone()),
    ("law", |r| r.law.clone()),
    ("mean_filament", |r| number(r.mean.map(|s| s.mean))),
    ("mean_filament_sd", |r| number(r.mean.map(|s| s.deviation))),
    ("azimuths", |r| count(r.mean)),
    ("drawn", |r| number(r.drawn.map(|s| s.mean))),
    ("drawn_sd", |r| number(r.drawn.map(|s| s.deviation))),
    ("filaments", |r| count(r.drawn)),
    ("rod", |r| number(r.rod)),
    ("rod_fine", |r| number(r.fine)),
    ("rod_of_drawn", |r| number(r.rod_of_drawn)),
    ("error_mean", |r| number(r.error_mean)),
    ("error_drawn", |r| number(r.error_drawn)),
    ("error_fine", |r| number(r.error_fine)),
    ("scatter", |r| number(r.scatter)),
    ("bound", |r| r.bound.text()),
    ("share_of_bound_mean", |r| number(r.shares_of_bound()[0])),
    ("share_of_bound_drawn", |r| number(r.shares_of_bound()[1])),
    ("met_mean", |r| yes_or_no(r.is_met()[0])),
    ("met_drawn", |r| yes_or_no(r.is_met()[1])),
    ("note", |r| r.note.clone()),
];

/// Writes `load-cases.csv`.
pub(super) fn csv(out: &Path, rows: &[Row]) -> Result<(), String> {
    let cells = |row: &Row| COLUMNS.map(|(_, cell)| cell(row)).to_vec();
    let header = COLUMNS.map(|(name, _)| name);
    write_csv(out, "load-cases.csv", &header, rows.iter().map(cells))
}

fn number(value: Option<f64>) -> String {
    let finite = value.filter(|v| v.is_finite());
    finite.map_or(String::new(), |v| format!("{v:.6e}"))
}

fn count(sampled: Option<Sampled>) -> String {
    sampled.map_or(0, |s| s.count).to_string()
}

fn yes_or_no(met: Option<bool>) -> String {
    met.map_or("", |met| if met { "yes" } else { "no" })
        .to_owned()
}

/// Number of met bounds, and the largest error over its bound, in words.
fn score(rows: &[&Row], against: usize) -> [String; 2] {
    let verdicts = || rows.iter().filter_map(|row| row.is_met()[against]);
    let (judged, good) = (verdicts().count(), verdicts().filter(|met| *met).count());
    let shares = rows.iter().filter_map(|row| row.shares_of_bound()[against]);
    let worst = shares.reduce(f64::max);
    if judged == 0 {
        return [String::new(), String::new()];
    }
    [
        format!("{good} of {judged}"),
        worst.map_or(String::new(), |worst| format!("{worst:.2}")),
    ]
}

/// The page of the book.
pub(super) fn page(rows: &[Row]) -> String {
    let mut text = "# Load cases\n\n\
        Computed by `cargo xtask load-cases --write`: every case that a law of rods has to meet. Mean filament: \
        weighted bonds, over azimuths. Drawn: filaments of 64 drawn bonds, over samplings and azimuths, ± the \
        standard deviation of one. Errors of the rod (segments of 10 nm; fine: 2.5 nm, against the mean \
        filament; of drawn: under the law of drawn bonds) are relative, those of a shape largest distances, those \
        of mixed filaments spreads over resolutions. Worst: the largest error over its bound.\n"
        .to_owned();
    text += &summary(rows);
    for group in Group::all() {
        let own: Vec<&Row> = rows.iter().filter(|row| row.group == group).collect();
        if !own.is_empty() {
            text += &section(group, &own);
        }
    }
    text
}

/// Numbers of met bounds by case and law.
pub(super) fn summary(rows: &[Row]) -> String {
    let mut text = "\n| case | law | met, mean | worst | met, drawn | worst |\n\
                    | --- | --- | ---: | ---: | ---: | ---: |\n"
        .to_owned();
    let judged = rows.iter().filter(|row| row.bound != Bound::Open);
    let pairs = distinct(judged.map(|row| (row.group, &*row.law)));
    for (group, law) in pairs {
        let own = rows
            .iter()
            .filter(|row| row.group == group && row.law == law);
        let own: Vec<&Row> = own.collect();
        let ([met, worst], [met_drawn, worst_drawn]) = (score(&own, 0), score(&own, 1));
        let name = group.name();
        _ = writeln!(
            text,
            "| {name} | {law} | {met} | {worst} | {met_drawn} | {worst_drawn} |"
        );
    }
    text
}

fn section(group: Group, rows: &[&Row]) -> String {
    let mut text = format!(
        "\n## {}\n\n| case | quantity | mean filament | drawn | law | rod | of drawn | error, mean | error, drawn | fine | \
         bound |\n| --- | --- | ---: | ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: |\n",
        group.name()
    );
    let mut notes: Vec<String> = Vec::new();
    let mut before = None;
    for row in rows {
        let own = (&row.case, &row.quantity);
        text += &line(row, before.replace(own) == Some(own));
        let note = format!("- {}, {}: {}", row.case, row.law, row.note);
        if !row.note.is_empty() && !notes.contains(&note) {
            notes.push(note);
        }
    }
    if !notes.is_empty() {
        _ = write!(text, "\n{}\n", notes.join("\n"));
    }
    text
}

/// A line of the table; errors beyond their bound are bold. What the line before says is left out.
fn line(row: &Row, is_same: bool) -> String {
    let once = |text: String| if is_same { String::new() } else { text };
    let error = |value: Option<f64>, met: Option<bool>| {
        let text = value.map_or("–".to_owned(), |v| shown(row, v));
        if met == Some(false) {
            format!("**{text}**")
        } else {
            text
        }
    };
    let [mean, drawn] = row.is_met();
    let of_drawn = row.rod_of_drawn.filter(|_| row.rod_of_drawn != row.rod);
    let cells = [
        once(row.case.clone()),
        once(row.quantity.clone()),
        once(row.mean.map_or(String::new(), |s| digits(s.mean))),
        once(row.drawn.map_or(String::new(), with_sd)),
        row.law.clone(),
        row.rod.map_or(String::new(), digits),
        of_drawn.map_or(String::new(), digits),
        error(row.error_mean, mean),
        error(row.error_drawn, drawn),
        error(row.error_fine, None),
        row.bound.text(),
    ];
    format!("| {} |\n", cells.join(" | "))
}

fn shown(row: &Row, error: f64) -> String {
    match row.bound {
        Bound::Distance(_) => format!("{error:.2} nm"),
        Bound::Spread(_) => format!("{:.1} %", 100.0 * error),
        _ => format!("{:+.1} %", 100.0 * error),
    }
}

fn with_sd(sampled: Sampled) -> String {
    let sd = sampled.deviation;
    if sd.is_finite() {
        format!("{} ± {}", digits(sampled.mean), digits_of(sd, 2))
    } else {
        digits(sampled.mean)
    }
}

fn digits(value: f64) -> String {
    digits_of(value, 4)
}

/// A number with so many significant digits.
fn digits_of(value: f64, significant: u8) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let magnitude = value.abs().log10().floor();
    if !(-3.0..6.0).contains(&magnitude) {
        return format!("{value:.*e}", usize::from(significant) - 1);
    }
    #[expect(clippy::cast_possible_truncation, reason = "between -3 and 5")]
    let decimals = i32::from(significant) - 1 - magnitude as i32;
    format!("{value:.*}", usize::try_from(decimals).unwrap_or(0))
}

/// Writes `load-cases.md` into a folder.
pub(super) fn page_into(folder: &Path, page: &str) -> Result<(), String> {
    save(folder, "load-cases.md", page)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_digits_that_matter() {
        let shown = [62.5312, -0.01234, 32950.4, 1.5e-5].map(digits);
        assert_eq!(shown, ["62.53", "-0.01234", "32950", "1.500e-5"]);
    }
}
