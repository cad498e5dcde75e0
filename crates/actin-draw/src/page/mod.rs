//! Self-contained HTML pages of pictures, tables and text.
//!
//! A [`Page`] is filled in order and finished once. It begins with a contact sheet of the first picture of every
//! artefact, which links to its section. SVG pictures follow the light or dark mode of the page ([`on_dark`]). States
//! are JSON files for a script of the caller, which uses the scripts [`SOLIDS`] and [`SPACE`]. A table at the end lists all
//! verdicts, failed ones first, with their reasons.

mod markdown;
mod shades;
mod tables;
mod verdicts;

pub use maud::Markup;
pub use shades::{DARK_CARD, on_dark};
pub use tables::{ExplainedMisses, Misses, breakable, significant};
pub use verdicts::Verdicts;

use crate::report::{Artefact, Picture, View};
use maud::{DOCTYPE, PreEscaped, html};
use shades::Shades;
use std::fs;
use std::path::Path;

/// Style sheet of pages.
pub const STYLE: &str = include_str!("style.css");
/// Script that draws ellipsoids and tubes with WebGL 2.
pub const SOLIDS: &str = include_str!("solids.js");
/// Script of an interactive view with camera, input, scale bar and axes, which requires [`SOLIDS`]. Scripts of the caller
/// provide the solids.
pub const SPACE: &str = include_str!("space.js");

/// A page under construction.
///
/// ```
/// use actin_draw::page::{Misses, Page};
/// use actin_draw::report::{Artefact, Row};
/// let artefact = Artefact {
///     id: "table1",
///     title: "One number",
///     settings: "none".into(),
///     rows: vec![Row::measured("table1", "height", "nm", 36.7, "a note").with_paper_value(36.0, 1.0)],
///     pictures: Vec::new(),
///     views: Vec::new(),
///     wall_s: 0.1,
/// };
/// let mut page = Page::new("A report", "0.1.0");
/// page.header(&maud::html! { h1 id="summary" { "A report" } });
/// page.artefact(&artefact, &Misses::default(), ".".as_ref())?;
/// page.verdicts(&maud::html! {});
/// let html = page.finish();
/// assert!(html.contains("<h2>Table 1: One number</h2>") && html.contains("agrees"));
/// # Ok::<(), String>(())
/// ```
#[derive(Debug)]
pub struct Page<'a> {
    title: &'a str,
    version: &'a str,
    header: String,
    sheet: String,
    contents: String,
    main: String,
    judged: String,
    scripts: String,
    shades: Shades,
}

impl<'a> Page<'a> {
    /// Creates an empty page; `version` is printed for every artefact.
    pub fn new(title: &'a str, version: &'a str) -> Self {
        let mut page = Self {
            title,
            version,
            header: String::new(),
            sheet: String::new(),
            contents: String::new(),
            main: String::new(),
            judged: String::new(),
            scripts: String::new(),
            shades: Shades::default(),
        };
        page.script(SOLIDS);
        page.script(SPACE);
        page
    }

    /// Returns the CSS value of a colour that follows light and dark mode.
    pub fn colour(&mut self, colour: [u8; 3]) -> String {
        self.shades.variable(colour)
    }

    /// Adds HTML to the head of the page, before its contents. Its title must have the id `summary`.
    pub fn header(&mut self, html: &Markup) {
        self.header.push_str(&html.0);
    }

    /// Adds a section with views, pictures, settings and rows without a verdict, whose files are in `folder`. Rows
    /// with a verdict are added to the table of [`verdicts`](Self::verdicts); `misses` are the failed ones.
    ///
    /// # Errors
    /// If a file cannot be read.
    pub fn artefact(
        &mut self,
        artefact: &Artefact,
        misses: &Misses<'_>,
        folder: &Path,
    ) -> Result<(), String> {
        let (id, title) = (artefact.id, artefact.title);
        let counted = Verdicts::from_rows(&artefact.rows);
        let line = html! {
            li class="artefact" {
                a href={ "#" (id) } { (name(id)) ": " (title) }
                " " small { (counted.in_words()) }
            }
        };
        let views = artefact.views.iter().map(|view| viewer(view, folder));
        let views: Vec<Markup> = views.collect::<Result<_, _>>()?;
        let shades = &mut self.shades;
        let pictures = artefact.pictures.iter().enumerate();
        let pictures = pictures.map(|(k, one)| picture(shades, one, &anchor(id, k), folder));
        let pictures: Vec<Markup> = pictures.collect::<Result<_, _>>()?;
        let section = html! {
            section id=(id) {
                h2 { (name(id)) ": " (title) }
                @for view in views { (view) }
                div class="panels" { @for picture in pictures { (picture) } }
                @if counted.compared() > 0 {
                    p { a href={ "#verdicts-" (id) } { (counted.in_words()) } " " (counted.bar()) }
                }
                details {
                    summary { "How it was made" }
                    dl {
                        dt { "Settings" } dd { (artefact.settings) }
                        dt { "Version" } dd { (self.version) }
                        dt { "Computed in" } dd { (format!("{:.1} s", artefact.wall_s)) }
                    }
                }
                (tables::measured(&artefact.rows))
            }
        };
        let card = card(artefact, counted, folder)?;
        self.sheet.push_str(&card.0);
        self.contents.push_str(&line.0);
        self.main.push_str(&section.0);
        self.judged.push_str(&tables::judged(artefact, misses).0);
        Ok(())
    }

    /// Adds a section with the table of verdicts of all artefacts, after the text `lead`.
    pub fn verdicts(&mut self, lead: &Markup) {
        let line = html! { li { a href="#verdicts" { "Verdicts" } } };
        let section = html! {
            section id="verdicts" { h2 { "Verdicts" } (lead) (tables::verdicts(&self.judged)) }
        };
        self.contents.push_str(&line.0);
        self.main.push_str(&section.0);
    }

    /// Adds a section of text with a heading `title`, which is also listed in the contents.
    pub fn section(&mut self, id: &str, title: &str, text: &Markup) {
        let line = html! { li { a href={ "#" (id) } { (title) } } };
        let section = html! { section id=(id) { h2 { (title) } (text) } };
        self.contents.push_str(&line.0);
        self.main.push_str(&section.0);
    }

    /// Adds a section of Markdown, with headings one level lower, and a heading `title`.
    pub fn markdown(&mut self, id: &str, title: &str, markdown: &str) {
        let line = html! { li { a href={ "#" (id) } { (title) } } };
        let section = html! {
            section id=(id) { (PreEscaped(markdown::rendered(markdown))) }
        };
        self.contents.push_str(&line.0);
        self.main.push_str(&section.0);
    }

    /// Adds JSON with an id, before all scripts.
    pub fn data(&mut self, id: &str, json: &str) {
        let data = html! {
            script type="application/json" id=(id) { (in_script(json)) }
        };
        self.scripts.insert_str(0, &data.0);
    }

    /// Adds a script after [`SOLIDS`] and [`SPACE`].
    pub fn script(&mut self, text: &str) {
        let script = html! { script { (PreEscaped(text)) } };
        self.scripts.push_str(&script.0);
    }

    /// Returns the page.
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
                            li { a href="#summary" { "All figures" } }
                            (PreEscaped(self.contents))
                        }
                    }
                    main {
                        @if !self.sheet.is_empty() {
                            ul class="sheet" { (PreEscaped(self.sheet)) }
                        }
                        (PreEscaped(self.main))
                    }
                    noscript {
                        p { "Interactive views require JavaScript." }
                    }
                    (PreEscaped(self.scripts))
                }
            }
        };
        page.into_string()
    }
}

/// Converts `fig4` to `Figure 4`, and `table1` to `Table 1`.
pub fn name(id: &str) -> String {
    let known = [("fig", "Figure"), ("table", "Table")];
    let known = known
        .iter()
        .find_map(|(short, long)| Some(format!("{long} {}", id.strip_prefix(short)?)));
    known.unwrap_or_else(|| id.to_owned())
}

/// Smallest width of an enlarged picture on a narrow screen, relative to its own width, so that letters of 14 pixels
/// are larger than 10. Its box scrolls.
const SMALLEST: f64 = 0.74;

fn anchor(id: &str, k: usize) -> String {
    format!("{id}-picture-{k}")
}

/// Returns the entry of an artefact on the contact sheet, which reuses its first picture.
fn card(artefact: &Artefact, verdicts: Verdicts, folder: &Path) -> Result<Markup, String> {
    let first = artefact.pictures.first();
    let size = first.map(|one| read(one, folder).map(|svg| size(&svg).unwrap_or([900.0, 560.0])));
    let size = size.transpose()?;
    let id = artefact.id;
    Ok(html! {
        li {
            a href={ "#" (id) } {
                @if let Some([width, height]) = size {
                    svg viewBox=(format!("0 0 {width} {height}")) aria-hidden="true" {
                        use href={ "#" (anchor(id, 0)) } width=(width) height=(height) {}
                    }
                }
                strong { (name(id)) } " " span { (artefact.title) }
            }
            small { (verdicts.in_words()) } (verdicts.bar())
        }
    })
}

fn read(picture: &Picture, folder: &Path) -> Result<String, String> {
    let path = folder.join(&picture.file);
    fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))
}

const KINDS: [(&str, &str); 3] = [("svg", "SVG"), ("pdf", "PDF"), ("png", "PNG")];

fn picture(
    shades: &mut Shades,
    picture: &Picture,
    anchor: &str,
    folder: &Path,
) -> Result<Markup, String> {
    let svg = read(picture, folder)?;
    let caption = &picture.caption;
    let tag = html! { svg id=(anchor) role="img" aria-label=(caption) {} };
    // Inserts attributes into the svg tag.
    let named = tag.0.replacen("></svg>", " ", 1);
    let [width, height] = size(&svg).unwrap_or([900.0, 560.0]);
    let least = SMALLEST * width;
    let svg = shades.embed(&svg).replacen("<svg ", &named, 1);
    let there = KINDS.map(|(ending, name)| (Path::new(&picture.file).with_extension(ending), name));
    let there = there
        .into_iter()
        .filter(|(file, _)| folder.join(file).exists());
    let is_wide = width > WIDE * height || width > COLUMN;
    let class = if is_wide { "wide" } else { "" };
    Ok(html! {
        figure class=(class) {
            div class="scroll" tabindex="0" {
                div class="picture" style=(format!("--least:{least:.0}px")) { (PreEscaped(svg)) }
            }
            figcaption {
                (caption)
                span class="files" {
                    @for (file, name) in there { " " a href=(file.display()) { (name) } }
                }
            }
        }
    })
}

/// Pictures with a larger ratio of width to height have the full width of the page.
const WIDE: f64 = 2.4;
/// Pictures with a larger width (pixels) have the full width of the page, so that letters of 14 pixels are larger than
/// 9.
const COLUMN: f64 = 960.0;

/// Returns width and height of an SVG picture in pixels, from its attributes.
pub fn size(svg: &str) -> Option<[f64; 2]> {
    let tag = &svg[svg.find("<svg")?..];
    let tag = &tag[..tag.find('>')?];
    let side = |name: &str| -> Option<f64> {
        let value = &tag[tag.find(name)? + name.len()..];
        value[..value.find('"')?].parse().ok()
    };
    Some([side(" width=\"")?, side(" height=\"")?])
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
                     too, after a click), arrow keys, 0 to reset. The projection is orthographic."
                }
            }
        }
    })
}

/// Escapes JSON so that it cannot end its script element.
pub fn in_script(json: &str) -> PreEscaped<String> {
    PreEscaped(json.replace('<', "\\u003c"))
}

#[cfg(test)]
mod tests {
    use super::*;

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
        assert_eq!(size(svg), Some([1040.0, 5.0]));
        assert_eq!(size("<svg><rect width=\"3\"/></svg>"), None);
    }
}
