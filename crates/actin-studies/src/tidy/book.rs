//! Checks of the book beyond mdBook: the summary lists every page, and links lead to existing files and headings.

use super::files;
use pulldown_cmark::{Event, Parser, Tag, TagEnd};
use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};

const SUMMARY: &str = "docs/SUMMARY.md";

#[derive(Debug, Default)]
struct Page {
    links: Vec<(usize, String)>,
    headings: Vec<String>,
}

pub(super) fn findings(root: &Path) -> Result<Vec<String>, String> {
    let found = files(root, "md")?.into_iter();
    let inside = |path: PathBuf| path.strip_prefix(root).map(Path::to_path_buf).ok();
    let pages: BTreeMap<PathBuf, Page> = found
        .filter_map(|(path, text)| Some((inside(path)?, read(&text))))
        .collect();
    let summary = Path::new(SUMMARY);
    let listed: Vec<PathBuf> = pages.get(summary).map_or_else(Vec::new, |page| {
        let links = page.links.iter();
        links.map(|(_, to)| target(summary, to).0).collect()
    });
    let left_out = pages
        .keys()
        .filter(|page| page.starts_with("docs") && *page != summary && !listed.contains(page))
        .map(|page| format!("{SUMMARY}: does not list {}", page.display()));
    let broken = pages.iter().flat_map(|(name, page)| {
        let links = page.links.iter();
        links.filter_map(|(line, to)| broken(root, &pages, name, *line, to))
    });
    Ok(left_out.chain(broken).collect())
}

fn broken(
    root: &Path,
    pages: &BTreeMap<PathBuf, Page>,
    page: &Path,
    line: usize,
    to: &str,
) -> Option<String> {
    let (path, heading) = target(page, to);
    let place = format!("{}:{line}", page.display());
    if !root.join(&path).exists() {
        return Some(format!("{place}: links to {to}, which does not exist"));
    }
    let headings = &pages.get(&path)?.headings;
    (!heading.is_empty() && !headings.iter().any(|h| h == heading))
        .then(|| format!("{place}: {to}: missing heading"))
}

fn read(text: &str) -> Page {
    let mut page = Page::default();
    let mut heading: Option<String> = None;
    for (event, range) in
        Parser::new_ext(text, pulldown_cmark::Options::ENABLE_TABLES).into_offset_iter()
    {
        match event {
            Event::Start(Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. })
                if !dest_url.contains("://") =>
            {
                let line = text[..range.start].matches('\n').count() + 1;
                page.links.push((line, dest_url.into_string()));
            }
            Event::Start(Tag::Heading { .. }) => heading = Some(String::new()),
            Event::Text(part) | Event::Code(part) => {
                if let Some(heading) = &mut heading {
                    heading.push_str(&part);
                }
            }
            Event::End(TagEnd::Heading(_)) => {
                page.headings.extend(heading.take().map(|h| name(&h)));
            }
            _ => {}
        }
    }
    page
}

fn name(heading: &str) -> String {
    let kept = heading.trim().to_lowercase();
    let kept = kept
        .chars()
        .filter(|c| c.is_alphanumeric() || " -_".contains(*c));
    kept.collect::<String>().replace(' ', "-")
}

fn target<'a>(page: &Path, link: &'a str) -> (PathBuf, &'a str) {
    let (file, heading) = link.split_once('#').unwrap_or((link, ""));
    if file.is_empty() {
        return (page.to_path_buf(), heading);
    }
    let mut path = page.parent().unwrap_or(Path::new("")).to_path_buf();
    for part in Path::new(file).components() {
        if part == Component::ParentDir {
            path.pop();
        } else {
            path.push(part);
        }
    }
    (path, heading)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_are_resolved_from_their_page() {
        let text = "[a](../b.md#c) and [d](https://e.org) `[x](y.md)`\n```\n[f](g.md)\n```\n![h](i.svg)\n\
                    # Where to add things, if any\n";
        let page = read(text);
        let link = |line, to: &str| (line, to.to_owned());
        assert_eq!(page.links, [link(1, "../b.md#c"), link(5, "i.svg")]);
        assert_eq!(page.headings, ["where-to-add-things-if-any"]);
        let (path, heading) = target(Path::new("docs/how-to/a.md"), "../b.md#c");
        assert_eq!((path, heading), (PathBuf::from("docs/b.md"), "c"));
    }

    #[test]
    fn a_missing_page_and_a_broken_link_are_found() {
        let folder = tempfile::tempdir().unwrap();
        let write = |name: &str, text: &str| {
            let path = folder.path().join(name);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, text).unwrap();
        };
        write(SUMMARY, "- [a](a.md)\n");
        write(
            "docs/a.md",
            "# A\n[b](b.md) [none](none.md) [no](b.md#no)\n",
        );
        write("docs/b.md", "# B\n");
        assert_eq!(
            findings(folder.path()).unwrap(),
            [
                "docs/SUMMARY.md: does not list docs/b.md",
                "docs/a.md:2: links to none.md, which does not exist",
                "docs/a.md:2: b.md#no: missing heading",
            ]
        );
    }
}
