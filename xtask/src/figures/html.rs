//! `report.html`: one page without links to anything outside itself.

use super::report::{Artefact, Picture, Row, save};
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

const STYLE: &str = "
:root { color-scheme: light dark; --line: #8884; --good: #2a7f3f; --bad: #b3261e; }
body { font: 16px/1.5 system-ui, sans-serif; max-width: 72rem; margin: 0 auto; padding: 1rem; }
h1, h2 { line-height: 1.2; }
figure { margin: 1.5rem 0; }
figure svg { width: 100%; height: auto; background: #fff; border-radius: 6px; }
figcaption, .settings { font-size: .9rem; opacity: .85; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: .9rem; width: 100%; }
th, td { border-bottom: 1px solid var(--line); padding: .3rem .6rem; text-align: left; }
td.n { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
.pass { color: var(--good); font-weight: 600; } .miss { color: var(--bad); font-weight: 600; }
@media (prefers-color-scheme: dark) { :root { --good: #7bd88f; --bad: #ff8a80; } }
";

/// Writes the page, pictures embedded.
pub(super) fn write(artefacts: &[Artefact], out: &Path) -> Result<(), String> {
    let mut page = format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\
         <title>Actin at two resolutions: figures and tables</title><style>{STYLE}</style></head>\
         <body><h1>Actin at two resolutions: figures and tables</h1>\
         <p>Version {}. Every picture and number below was computed by the run that wrote this \
         page. Where a tolerance is missed, it says so.</p>\n",
        env!("CARGO_PKG_VERSION")
    );
    for artefact in artefacts {
        section(&mut page, artefact, out)?;
    }
    page.push_str("</body></html>\n");
    save(out, "report.html", &page)
}

fn section(page: &mut String, artefact: &Artefact, out: &Path) -> Result<(), String> {
    push(
        page,
        format_args!(
            "<section id=\"{id}\"><h2>{id}: {}</h2><p class=\"settings\">{} Computed in {:.1} s.</p>\n",
            escape(artefact.title),
            escape(&artefact.settings),
            artefact.wall_s,
            id = artefact.id,
        ),
    );
    for Picture { file, caption } in &artefact.pictures {
        let path = out.join(file);
        let svg = fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
        let caption = escape(caption);
        push(
            page,
            format_args!("<figure>{svg}<figcaption>{caption}</figcaption></figure>\n"),
        );
    }
    page.push_str(
        "<div class=\"scroll\"><table><thead><tr><th>quantity</th><th>paper</th><th>ours</th>\
         <th>difference</th><th>tolerance</th><th>unit</th><th>verdict</th><th>note</th></tr>\
         </thead><tbody>\n",
    );
    artefact.rows.iter().for_each(|row| table_row(page, row));
    page.push_str("</tbody></table></div></section>\n");
    Ok(())
}

fn table_row(page: &mut String, row: &Row) {
    let number = |value: Option<f64>| value.map_or("–".to_owned(), significant);
    let (class, verdict) = match row.pass {
        Some(true) => ("pass", "agrees"),
        Some(false) => ("miss", "missed"),
        None => ("", "–"),
    };
    push(
        page,
        format_args!(
            "<tr><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td>\
             <td class=\"n\">{}</td><td>{}</td><td class=\"{class}\">{verdict}</td><td>{}</td></tr>\n",
            escape(&row.quantity),
            number(row.paper),
            significant(row.ours),
            number(row.paper.map(|paper| row.ours - paper)),
            number(row.tolerance),
            escape(row.unit),
            escape(&row.note),
        ),
    );
}

/// Five significant digits, in the shorter of the two notations.
pub(super) fn significant(value: f64) -> String {
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
        format!("{value:.decimals$}")
    } else {
        format!("{value:.4e}")
    }
}

fn push(page: &mut String, text: std::fmt::Arguments<'_>) {
    page.write_fmt(text)
        .expect("writing to a string cannot fail");
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::{escape, significant};

    #[test]
    fn numbers_keep_five_digits() {
        assert_eq!(significant(61.234_567), "61.235");
        assert_eq!(significant(0.123_456_7), "0.12346");
        assert_eq!(significant(123_456.0), "123456");
        assert_eq!(significant(-1.5e-7), "-1.5000e-7");
        assert_eq!(significant(0.0), "0");
    }

    #[test]
    fn markup_in_notes_is_shown_as_written() {
        assert_eq!(escape("a < b & c"), "a &lt; b &amp; c");
    }
}
