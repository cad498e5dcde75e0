//! `report.html`: one page without links to anything outside itself.
//!
//! Here is the order of the page and what each artefact's section holds. Its parts are in files
//! of their own: the summary with its findings, tables of rows, reasons for what was missed, colours
//! on a dark page, the errata. The viewer is `viewer.js` on top of `raster.js`.

#[cfg(test)]
mod browser;
mod errata;
mod findings;
mod reasons;
mod score;
mod shades;
mod summary;
mod tables;
mod verdicts;

pub(super) use reasons::unexplained;
pub(super) use tables::significant;

use super::palette;
use super::report::{Artefact, Picture, View, save};
use shades::Shades;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use verdicts::Verdicts;

const STYLE: &str = include_str!("style.css");
const RASTER: &str = include_str!("raster.js");
const VIEWER: &str = include_str!("viewer.js");
const TITLE: &str = "Actin at two resolutions: the paper's figures and tables, computed again";

/// Writes the page, with everything that it shows inside it.
pub(super) fn write(artefacts: &[Artefact], out: &Path, quick: bool) -> Result<(), String> {
    let (mut sections, mut shades) = (String::new(), Shades::default());
    for artefact in artefacts {
        section(&mut sections, &mut shades, artefact, out)?;
    }
    let mut header = String::new();
    summary::write(&mut header, &mut shades, artefacts, quick);
    let mut page = String::new();
    push(
        &mut page,
        format_args!(
            "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\
             <title>{TITLE}</title><style>\n{STYLE}{}</style></head><body>\n<header>\n",
            shades.style()
        ),
    );
    page.push_str(&header);
    page.push_str("</header>\n");
    contents(&mut page, artefacts);
    page.push_str("<main>\n");
    page.push_str(&sections);
    errata::write(&mut page)?;
    page.push_str("</main>\n");
    scripts(&mut page)?;
    page.push_str("</body></html>\n");
    save(out, "report.html", &page)
}

/// `Figure 4` for `fig4`, `Table 1` for `table1`.
fn name(id: &str) -> String {
    let known = [("fig", "Figure"), ("table", "Table")];
    let known = known
        .iter()
        .find_map(|(short, long)| Some(format!("{long} {}", id.strip_prefix(short)?)));
    known.unwrap_or_else(|| id.to_owned())
}

/// Version of the code, and of its sources where they are under git.
fn version() -> String {
    let number = env!("CARGO_PKG_VERSION");
    let mut git = std::process::Command::new("git");
    git.args(["describe", "--always", "--dirty"]);
    let output = git.current_dir(crate::check::workspace_root()).output();
    let commit = output.ok().filter(|o| o.status.success());
    let commit = commit.map(|o| String::from_utf8_lossy(&o.stdout).trim().to_owned());
    commit.map_or_else(
        || number.to_owned(),
        |commit| format!("{number}, sources {commit}"),
    )
}

fn contents(page: &mut String, artefacts: &[Artefact]) {
    page.push_str(
        "<nav id=\"contents\"><h2>Contents</h2><ol><li><a href=\"#summary\">Summary</a></li>\n",
    );
    for artefact in artefacts {
        push(
            page,
            format_args!(
                "<li><a href=\"#{id}\">{}: {}</a> <small>{}</small></li>\n",
                name(artefact.id),
                escape(artefact.title),
                Verdicts::of(&artefact.rows).in_words(),
                id = artefact.id,
            ),
        );
    }
    page.push_str("<li><a href=\"#errata\">Errata of the paper</a></li></ol></nav>\n");
}

/// Pictures, states to be turned, how they came about, numbers.
fn section(
    page: &mut String,
    shades: &mut Shades,
    artefact: &Artefact,
    out: &Path,
) -> Result<(), String> {
    push(
        page,
        format_args!(
            "<section id=\"{id}\"><h2>{}: {}</h2>\n",
            name(artefact.id),
            escape(artefact.title),
            id = artefact.id,
        ),
    );
    for view in &artefact.views {
        viewer(page, view, out)?;
    }
    for shown in &artefact.pictures {
        picture(page, shades, shown, out)?;
    }
    push(
        page,
        format_args!(
            "<h3>How it was made</h3><dl><dt>Settings</dt><dd>{}</dd><dt>Version</dt><dd>{}</dd>\
             <dt>Computed in</dt><dd>{:.1} s</dd></dl>\n",
            escape(&artefact.settings),
            escape(&version()),
            artefact.wall_s,
        ),
    );
    tables::write(page, &artefact.rows);
    page.push_str("</section>\n");
    Ok(())
}

/// Least share of its own width to which a picture shrinks: letters of 14 pixels stay above 10.
/// Narrower screens scroll it in a box of its own.
const SMALLEST: f64 = 0.74;

fn picture(
    page: &mut String,
    shades: &mut Shades,
    picture: &Picture,
    out: &Path,
) -> Result<(), String> {
    let path = out.join(&picture.file);
    let svg = fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
    let caption = escape(&picture.caption);
    let named = format!("<svg role=\"img\" aria-label=\"{caption}\" ");
    push(
        page,
        format_args!(
            "<figure><div class=\"scroll\" tabindex=\"0\"><div class=\"picture\" \
             style=\"min-width:{:.0}px\">{}</div></div><figcaption>{caption}</figcaption></figure>\n",
            SMALLEST * width(&svg).unwrap_or(900.0),
            shades.embed(&svg).replacen("<svg ", &named, 1),
        ),
    );
    Ok(())
}

/// Width of a picture in pixels, as it says of itself.
fn width(svg: &str) -> Option<f64> {
    let tag = &svg[svg.find("<svg")?..];
    let tag = &tag[..tag.find('>')?];
    let value = &tag[tag.find(" width=\"")? + " width=\"".len()..];
    value[..value.find('"')?].parse().ok()
}

fn viewer(page: &mut String, view: &View, out: &Path) -> Result<(), String> {
    let path = out.join(&view.file);
    let json = fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
    push(
        page,
        format_args!(
            "<figure class=\"viewer\"><script type=\"application/json\">{}</script>\
             <div class=\"controls\"></div><canvas tabindex=\"0\" role=\"img\" \
             aria-label=\"Three-dimensional view, turned with the arrow keys\"></canvas>\
             <ul class=\"legend\"></ul><figcaption>{} <em>Drag to turn, Shift and drag to move, two \
             fingers or + and − to zoom (the wheel too, after a click), arrow keys, 0 to reset. \
             Lengths are true across the line of sight.</em></figcaption></figure>\n",
            in_script(&json),
            escape(&view.caption),
        ),
    );
    Ok(())
}

fn scripts(page: &mut String) -> Result<(), String> {
    let palette = palette::chosen();
    let colours = |shade: fn([u8; 3]) -> [u8; 3]| {
        let stops: Vec<_> = palette.stops().iter().copied().map(shade).collect();
        serde_json::json!({ "stops": stops, "things": palette.things().map(shade) })
    };
    let colours = serde_json::json!({ "light": colours(|c| c), "dark": colours(shades::on_dark) });
    let colours = serde_json::to_string(&colours).map_err(|e| e.to_string())?;
    push(
        page,
        format_args!(
            "<noscript><p>The views that can be turned need JavaScript; all else does not.</p>\
             </noscript><script type=\"application/json\" id=\"palette\">{}</script>\n\
             <script>\n{RASTER}</script>\n<script>\n{VIEWER}</script>\n",
            in_script(&colours)
        ),
    );
    Ok(())
}

/// JSON that cannot end the element that it stands in.
fn in_script(json: &str) -> String {
    json.replace('<', "\\u003c")
}

fn push(page: &mut String, text: std::fmt::Arguments<'_>) {
    page.write_fmt(text)
        .expect("writing to a string cannot fail");
}

/// Text as it is shown, in elements and in attributes.
fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn markup_in_notes_is_shown_as_written() {
        assert_eq!(escape("a < b & c"), "a &lt; b &amp; c");
        assert_eq!(escape("\"d\" > e"), "&quot;d&quot; &gt; e");
    }

    /// Symptom of the plausible bug: a name with markup ends the script and the page with it.
    #[test]
    fn json_cannot_end_its_script() {
        let json = serde_json::to_string("</script><b>").unwrap();
        let safe = in_script(&json);
        assert!(!safe.contains('<'));
        let back: String = serde_json::from_str(&safe).unwrap();
        assert_eq!(back, "</script><b>");
    }

    #[test]
    fn artefacts_have_their_names_and_pictures_their_widths() {
        assert_eq!(name("fig10"), "Figure 10");
        assert_eq!(name("table3"), "Table 3");
        let svg = "<?xml?><svg height=\"5\" width=\"1040\" viewBox=\"0 0 1 1\"><rect width=\"3\"/>";
        assert_eq!(width(svg), Some(1040.0));
        assert_eq!(width("<svg><rect width=\"3\"/></svg>"), None);
    }
}
