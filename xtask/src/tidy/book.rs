//! The book: every page is listed in its summary, and every link leads somewhere.

use super::files;
use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};

const SUMMARY: &str = "docs/SUMMARY.md";

/// Pages that the summary leaves out, and links that lead to nothing.
pub(super) fn findings(root: &Path) -> Result<Vec<String>, String> {
    let found = files(root, "md")?.into_iter();
    let inside = |path: PathBuf| path.strip_prefix(root).map(Path::to_path_buf).ok();
    let pages: BTreeMap<PathBuf, String> = found
        .filter_map(|(path, text)| Some((inside(path)?, text)))
        .collect();
    let summary = Path::new(SUMMARY);
    let listed: Vec<PathBuf> = pages.get(summary).map_or_else(Vec::new, |text| {
        let links = links(text).into_iter();
        links.map(|(_, to)| target(summary, to).0).collect()
    });
    let left_out = pages
        .keys()
        .filter(|page| page.starts_with("docs") && *page != summary && !listed.contains(page))
        .map(|page| format!("{SUMMARY}: does not list {}", page.display()));
    let broken = pages.iter().flat_map(|(page, text)| {
        let links = links(text).into_iter();
        links.filter_map(|(line, to)| broken(root, &pages, page, line, to))
    });
    Ok(left_out.chain(broken).collect())
}

/// What is wrong with a link, if anything.
fn broken(
    root: &Path,
    pages: &BTreeMap<PathBuf, String>,
    page: &Path,
    line: usize,
    to: &str,
) -> Option<String> {
    let (path, heading) = target(page, to);
    let place = format!("{}:{line}", page.display());
    if !root.join(&path).exists() {
        return Some(format!("{place}: links to {to}, which does not exist"));
    }
    let text = pages.get(&path)?;
    let has = |heading: &str| headings(text).iter().any(|h| h == heading);
    (!heading.is_empty() && !has(heading))
        .then(|| format!("{place}: {to}: there is no such heading"))
}

/// Links to files, with the line each is in; code is left out.
fn links(text: &str) -> Vec<(usize, &str)> {
    let mut all = Vec::new();
    let mut in_code = false;
    for (line, text) in (1..).zip(text.lines()) {
        in_code ^= text.starts_with("```");
        if in_code {
            continue;
        }
        let starts = text.match_indices("](").map(|(at, _)| &text[at + 2..]);
        let targets = starts.filter_map(|rest| Some(&rest[..rest.find(')')?]));
        let own = targets.filter(|to| !to.contains("://"));
        all.extend(own.map(|to| (line, to)));
    }
    all
}

/// The file of a link, from the root, and the heading in it.
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

/// Names by which the headings of a page are linked to.
fn headings(text: &str) -> Vec<String> {
    let headings = text.lines().filter(|line| line.starts_with('#'));
    let kept = |c: &char| c.is_alphanumeric() || " -_".contains(*c);
    headings
        .map(|line| line.trim_start_matches('#').trim().to_lowercase())
        .map(|name| {
            name.chars()
                .filter(kept)
                .collect::<String>()
                .replace(' ', "-")
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_are_resolved_from_their_page() {
        let text = "[a](../b.md#c) and [d](https://e.org)\n```\n[f](g.md)\n```\n![h](i.svg)";
        assert_eq!(links(text), [(1, "../b.md#c"), (5, "i.svg")]);
        let (path, heading) = target(Path::new("docs/how-to/a.md"), "../b.md#c");
        assert_eq!((path, heading), (PathBuf::from("docs/b.md"), "c"));
        assert_eq!(
            headings("# Where to add things, if any"),
            ["where-to-add-things-if-any"]
        );
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
                "docs/a.md:2: b.md#no: there is no such heading",
            ]
        );
    }
}
