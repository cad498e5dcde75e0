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

pub use maud::Markup;
pub use shades::{DARK_CARD, on_dark};
pub use tables::{Explained, Misses, breakable, significant};
pub use verdicts::Verdicts;

use crate::report::{Artefact, Picture, View};
use maud::{DOCTYPE, PreEscaped, html};
use shades::Shades;
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
/// page.header(&maud::html! { h1 id="summary" { "A report" } });
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
        let mut page = Self {
            title,
            version,
            header: String::new(),
            contents: String::new(),
            main: String::new(),
            scripts: String::new(),
            shades: Shades::default(),
        };
        page.script(RASTER);
        page
    }

    /// The CSS value of a colour that changes with the page, light or dark.
    pub fn colour(&mut self, colour: [u8; 3]) -> String {
        self.shades.variable(colour)
    }

    /// Adds HTML to the head of the page, above its contents; its title has the id `summary`.
    pub fn header(&mut self, html: &Markup) {
        self.header.push_str(&html.0);
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
        let (id, title) = (artefact.id, artefact.title);
        let line = html! {
            li {
                a href={ "#" (id) } { (name(id)) ": " (title) }
                " " small { (Verdicts::of(&artefact.rows).in_words()) }
            }
        };
        let views = artefact.views.iter().map(|view| viewer(view, folder));
        let views: Vec<Markup> = views.collect::<Result<_, _>>()?;
        let shades = &mut self.shades;
        let pictures = artefact
            .pictures
            .iter()
            .map(|one| picture(shades, one, folder));
        let pictures: Vec<Markup> = pictures.collect::<Result<_, _>>()?;
        let section = html! {
            section id=(id) {
                h2 { (name(id)) ": " (title) }
                @for view in views { (view) }
                @for picture in pictures { (picture) }
                h3 { "How it was made" }
                dl {
                    dt { "Settings" } dd { (artefact.settings) }
                    dt { "Version" } dd { (self.version) }
                    dt { "Computed in" } dd { (format!("{:.1} s", artefact.wall_s)) }
                }
                (tables::numbers(&artefact.rows, misses))
            }
        };
        self.contents.push_str(&line.0);
        self.main.push_str(&section.0);
        Ok(())
    }

    /// Adds a section of Markdown, its headings one level lower; `title` is its line in the contents.
    pub fn markdown(&mut self, id: &str, title: &str, markdown: &str) {
        let line = html! { li { a href={ "#" (id) } { (title) } } };
        let section = html! {
            section id=(id) { (PreEscaped(markdown::rendered(markdown))) }
        };
        self.contents.push_str(&line.0);
        self.main.push_str(&section.0);
    }

    /// Adds JSON that scripts find by its id, ahead of all scripts.
    pub fn data(&mut self, id: &str, json: &str) {
        let data = html! {
            script type="application/json" id=(id) { (in_script(json)) }
        };
        self.scripts.insert_str(0, &data.0);
    }

    /// Adds a script; `raster.js` stands ahead of it.
    pub fn script(&mut self, text: &str) {
        let script = html! { script { (PreEscaped(text)) } };
        self.scripts.push_str(&script.0);
    }

    /// The whole page.
    pub fn finish(self) -> String {
        let style = [STYLE, &self.shades.style()].concat();
        let page = html! {
            (DOCTYPE)
            html lang="en" {
                head {
                    meta charset="utf-8";
                    meta name="viewport" content="width=device-width, initial-scale=1";
                    title { (self.title) }
                    style { (PreEscaped(style)) }
                }
                body {
                    header { (PreEscaped(self.header)) }
                    nav id="contents" {
                        h2 { "Contents" }
                        ol {
                            li { a href="#summary" { "Summary" } }
                            (PreEscaped(self.contents))
                        }
                    }
                    main { (PreEscaped(self.main)) }
                    noscript {
                        p { "The views that can be turned need JavaScript; all else does not." }
                    }
                    (PreEscaped(self.scripts))
                }
            }
        };
        page.into_string()
    }
}

/// What was missed in all artefacts, each row with the name of its artefact.
pub fn missed(misses: &Misses<'_>) -> Markup {
    tables::missed(misses, Among::All)
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

fn picture(shades: &mut Shades, picture: &Picture, folder: &Path) -> Result<Markup, String> {
    let path = folder.join(&picture.file);
    let svg = fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
    let caption = &picture.caption;
    let tag = html! { svg role="img" aria-label=(caption) {} };
    // The tag is given attributes and ends where its own go on.
    let named = tag.0.replacen("></svg>", " ", 1);
    let least = SMALLEST * width(&svg).unwrap_or(900.0);
    let svg = shades.embed(&svg).replacen("<svg ", &named, 1);
    Ok(html! {
        figure {
            div class="scroll" tabindex="0" {
                div class="picture" style=(format!("min-width:{least:.0}px")) { (PreEscaped(svg)) }
            }
            figcaption { (caption) }
        }
    })
}

/// Width of a picture in pixels, as it says of itself.
fn width(svg: &str) -> Option<f64> {
    let tag = &svg[svg.find("<svg")?..];
    let tag = &tag[..tag.find('>')?];
    let value = &tag[tag.find(" width=\"")? + " width=\"".len()..];
    value[..value.find('"')?].parse().ok()
}

fn viewer(view: &View, folder: &Path) -> Result<Markup, String> {
    let path = folder.join(&view.file);
    let json = fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
    let label = "Three-dimensional view, turned with the arrow keys";
    Ok(html! {
        figure class="viewer" {
            script type="application/json" { (in_script(&json)) }
            div class="controls" {}
            canvas tabindex="0" role="img" aria-label=(label) {}
            ul class="legend" {}
            figcaption {
                (view.caption) " "
                em {
                    "Drag to turn, Shift and drag to move, two fingers or + and − to zoom (the wheel \
                     too, after a click), arrow keys, 0 to reset. Lengths are true across the line of \
                     sight."
                }
            }
        }
    })
}

/// JSON that cannot end the element that it stands in.
fn in_script(json: &str) -> PreEscaped<String> {
    PreEscaped(json.replace('<', "\\u003c"))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Symptom of the plausible bug: a name with markup ends the script and the page with it.
    #[test]
    fn json_cannot_end_its_script() {
        let json = serde_json::to_string("</script><b>").unwrap();
        let PreEscaped(safe) = in_script(&json);
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
