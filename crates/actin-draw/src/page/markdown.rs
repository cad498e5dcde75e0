//! Conversion of Markdown to a section of the page.

use maud::html;
use pulldown_cmark::{CowStr, Event, HeadingLevel, Options, Parser, Tag, TagEnd};

/// Converts Markdown to HTML with headings one level lower. Table cells contain the name of their column, so that
/// narrow screens can show rows as cards.
pub(super) fn rendered(markdown: &str) -> String {
    let mut columns = Columns::default();
    let events = Parser::new_ext(markdown, Options::ENABLE_TABLES);
    let mut text = String::new();
    pulldown_cmark::html::push_html(
        &mut text,
        events.map(|event| columns.follow(lowered(event))),
    );
    text
}

#[derive(Default)]
struct Columns {
    heads: Vec<String>,
    in_head: bool,
    at: usize,
}

impl Columns {
    fn follow<'a>(&mut self, event: Event<'a>) -> Event<'a> {
        match event {
            Event::Start(Tag::TableHead) => {
                (self.heads, self.in_head) = (Vec::new(), true);
                event
            }
            Event::End(TagEnd::TableHead) => {
                self.in_head = false;
                event
            }
            Event::Start(Tag::TableRow) => {
                self.at = 0;
                event
            }
            Event::Start(Tag::TableCell) if self.in_head => {
                self.heads.push(String::new());
                event
            }
            Event::Start(Tag::TableCell) => Event::InlineHtml(self.cell()),
            Event::End(TagEnd::TableCell) if !self.in_head => {
                self.at += 1;
                Event::InlineHtml("</td>".into())
            }
            Event::Text(ref words) if self.in_head => {
                if let Some(head) = self.heads.last_mut() {
                    head.push_str(words);
                }
                event
            }
            _ => event,
        }
    }

    fn cell<'a>(&self) -> CowStr<'a> {
        let head = self.heads.get(self.at).map_or("", String::as_str);
        let cell = html! { td class="wide" data-label=(head) {} };
        let open = cell.0.strip_suffix("</td>").expect("a cell has an end");
        open.to_owned().into()
    }
}

fn lowered(event: Event<'_>) -> Event<'_> {
    match event {
        Event::Start(Tag::Heading {
            level,
            id,
            classes,
            attrs,
        }) => Event::Start(Tag::Heading {
            level: lower(level),
            id,
            classes,
            attrs,
        }),
        Event::End(TagEnd::Heading(level)) => Event::End(TagEnd::Heading(lower(level))),
        _ => event,
    }
}

fn lower(level: HeadingLevel) -> HeadingLevel {
    match level {
        HeadingLevel::H1 => HeadingLevel::H2,
        HeadingLevel::H2 => HeadingLevel::H3,
        HeadingLevel::H3 => HeadingLevel::H4,
        HeadingLevel::H4 => HeadingLevel::H5,
        HeadingLevel::H5 | HeadingLevel::H6 => HeadingLevel::H6,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_becomes_cells_that_name_their_column() {
        let text = rendered("# A\n\n| place | `b` |\n|---|---|\n| 1 < 2 | `x` |\n| 3 | 4 |\n");
        assert!(text.contains("<h2>A</h2>"), "{text}");
        assert!(text.contains("<th>place</th>"));
        assert!(text.contains("<td class=\"wide\" data-label=\"place\">1 &lt; 2</td>"));
        assert!(text.contains("<code>x</code></td>"));
        assert_eq!(text.matches("data-label=\"place\"").count(), 2);
        assert_eq!(text.matches("<td").count(), text.matches("</td>").count());
    }
}
