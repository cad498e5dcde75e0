//! A page of pictures, tables and text as one HTML file without links to anything outside.
//!
//! A [`Page`] is filled in order and finished once. Pictures are SVG files whose colours follow the
//! page, light or dark ([`on_dark`]); states to be turned are JSON files for a script of the caller's,
//! which draws them with `raster.js`, part of every page. Rows come as tables with their verdicts, what
//! was missed first, under its reason.

mod markdown;
mod shades;
mod tables;
mod verdicts;

pub use shades::{DARK_CARD, on_dark};
pub use tables::{Explained, Misses, significant};
pub use verdicts::Verdicts;

use crate::report::{Artefact, Picture, View};
use shades::Shades;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use tables::Among;

const STYLE: &str = include_str!("style.css");
const RASTER: &str = include_str!("raster.js");

/// A page under construction.
///
/// ```
/// use actin_draw::page::{Misses, Page};
/// use actin_draw::report::{Artefact, Row};
/// let artefact = Artefact {
///     id: "table1",
///     title: "One number",
///     settings: "none".into(),
///     rows: vec![Row::measured("table1", "height", "nm", 36.7, "a note").against(36.0, 1.0)],
///     pictures: Vec::new(),
///     views: Vec::new(),
///     wall_s: 0.1,
/// };
/// let mut page = Page::new("A report", "0.1.0");
/// page.header("<h1 id=\"summary\">A report</h1>\n");
/// page.artefact(&artefact, &Misses::default(), ".".as_ref())?;
/// let html = page.finish();
/// assert!(html.contains("<h2>Table 1: One number</h2>") && html.contains("agrees"));
/// # Ok::<(), String>(())
/// ```
#[derive(Debug)]
pub struct Page<'a> {
    title: &'a str,
    version: &'a str,
    header: String,
    contents: String,
    main: String,
    scripts: String,
    shades: Shades,
}

impl<'a> Page<'a> {
    /// An empty page; `version` says beside every artefact what computed it.
    pub fn new(title: &'a str, version: &'a str) -> Self {
        Self {
            title,
            version,
            header: String::new(),
            contents: String::new(),
            main: String::new(),
            scripts: format!("<script>\n{RASTER}</script>\n"),
            shades: Shades::default(),
        }
    }

    /// The CSS value of a colour that changes with the page, light or dark.
    pub fn colour(&mut self, colour: [u8; 3]) -> String {
        self.shades.variable(colour)
    }

    /// Adds HTML to the head of the page, above its contents; its title has the id `summary`.
    pub fn header(&mut self, html: &str) {
        self.header.push_str(html);
    }

    /// Adds a section with states to be turned, pictures, settings and rows, whose files are in
    /// `folder`; `misses` are the rows that were missed.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub fn artefact(
        &mut self,
        artefact: &Artefact,
        misses: &Misses<'_>,
        folder: &Path,
    ) -> Result<(), String> {
        let (id, title) = (artefact.id, escape(artefact.title));
        push(
            &mut self.contents,
            format_args!(
                "<li><a href=\"#{id}\">{}: {title}</a> <small>{}</small></li>\n",
                name(id),
                Verdicts::of(&artefact.rows).in_words(),
            ),
        );
        push(
            &mut self.main,
            format_args!("<section id=\"{id}\"><h2>{}: {title}</h2>\n", name(id)),
        );
        for view in &artefact.views {
            viewer(&mut self.main, view, folder)?;
        }
        for shown in &artefact.pictures {
            picture(&mut self.main, &mut self.shades, shown, folder)?;
        }
        push(
            &mut self.main,
            format_args!(
                "<h3>How it was made</h3><dl><dt>Settings</dt><dd>{}</dd><dt>Version</dt><dd>{}</dd>\
                 <dt>Computed in</dt><dd>{:.1} s</dd></dl>\n",
                escape(&artefact.settings),
                escape(self.version),
                artefact.wall_s,
            ),
        );
        tables::write(&mut self.main, &artefact.rows, misses);
        self.main.push_str("</section>\n");
        Ok(())
    }

    /// Adds a section of Markdown, its headings one level lower; `title` is its line in the contents.
    pub fn markdown(&mut self, id: &str, title: &str, markdown: &str) {
        push(
            &mut self.contents,
            format_args!("<li><a href=\"#{id}\">{title}</a></li>"),
        );
        push(&mut self.main, format_args!("<section id=\"{id}\">\n"));
        self.main.push_str(&markdown::rendered(markdown));
        self.main.push_str("</section>\n");
    }

    /// Adds JSON that scripts find by its id, ahead of all scripts.
    pub fn data(&mut self, id: &str, json: &str) {
        let data = format!(
            "<script type=\"application/json\" id=\"{id}\">{}</script>\n",
            in_script(json)
        );
        self.scripts.insert_str(0, &data);
    }

    /// Adds a script; `raster.js` stands ahead of it.
    pub fn script(&mut self, text: &str) {
        push(
            &mut self.scripts,
            format_args!("<script>\n{text}</script>\n"),
        );
    }

    /// The whole page.
    pub fn finish(self) -> String {
        let Self {
            title,
            header,
            contents,
            main,
            scripts,
            ..
        } = &self;
        format!(
            "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\
             <title>{title}</title><style>\n{STYLE}{}</style></head><body>\n<header>\n{header}</header>\n\
             <nav id=\"contents\"><h2>Contents</h2><ol><li><a href=\"#summary\">Summary</a></li>\n\
             {contents}</ol></nav>\n<main>\n{main}</main>\n\
             <noscript><p>The views that can be turned need JavaScript; all else does not.</p>\
             </noscript>{scripts}</body></html>\n",
            self.shades.style()
        )
    }
}

/// Writes what was missed in all artefacts, each row with the name of its artefact.
pub fn write_misses(html: &mut String, misses: &Misses<'_>) {
    tables::missed(html, misses, Among::All);
}

/// `Figure 4` for `fig4`, `Table 1` for `table1`.
pub fn name(id: &str) -> String {
    let known = [("fig", "Figure"), ("table", "Table")];
    let known = known
        .iter()
        .find_map(|(short, long)| Some(format!("{long} {}", id.strip_prefix(short)?)));
    known.unwrap_or_else(|| id.to_owned())
}

/// Least share of its own width to which a picture shrinks: letters of 14 pixels stay above 10.
/// Narrower screens scroll it in a box of its own.
const SMALLEST: f64 = 0.74;

fn picture(
    page: &mut String,
    shades: &mut Shades,
    picture: &Picture,
    folder: &Path,
) -> Result<(), String> {
    let path = folder.join(&picture.file);
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

fn viewer(page: &mut String, view: &View, folder: &Path) -> Result<(), String> {
    let path = folder.join(&view.file);
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

/// JSON that cannot end the element that it stands in.
fn in_script(json: &str) -> String {
    json.replace('<', "\\u003c")
}

/// Adds formatted text to HTML.
pub fn push(html: &mut String, text: std::fmt::Arguments<'_>) {
    // Writing to a string cannot fail.
    let _ = html.write_fmt(text);
}

/// Text as it is shown, in elements and in attributes.
pub fn escape(text: &str) -> String {
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
