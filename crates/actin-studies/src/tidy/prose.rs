//! Places in comments and pages that may need a second reading, counted for each folder. The committed counts in `prose.csv`
//! may only fall.

use regex::Regex;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Patterns of sentences that are hard to read. A good sentence may match one of them.
const PATTERNS: [(&str, &str); 5] = [
    (
        "clause as a subject",
        r"(?:^|[.:;]\s+)(?:What|Where|How|Whether|Who|Which)\s+[a-z]",
    ),
    (
        "clause as an object",
        r"\b(?:of|from|by|to|with|in|for|than|as|and|is|are)\s+what\s+[a-z]",
    ),
    (
        "pronoun without a noun",
        r"(?:^|[.:;]\s+)(?:That|Those|None|Nothing|Nobody|The same|Others)\s+(?:of|that|which|who|is|are|has|have)\b",
    ),
    (
        "code that speaks",
        r"\b(?:is|are|was|were)\s+(?:told|said|asked)\b|\b(?:tells|knows|asks|says|hears|wants|remembers|forgets)\b",
    ),
    (
        "odd phrase",
        r"\b(?:goes? on|leaves? over|left over|left out|gives? way|all the same|as good as|thereof|anew|beyond use)\b",
    ),
];

/// Largest number of words of a sentence.
const MOST_WORDS: usize = 30;

/// Finds folders with more places than committed, with each of these places.
pub(super) fn findings(root: &Path, files: &[(PathBuf, String)]) -> Vec<String> {
    let patterns = PATTERNS.map(|(name, pattern)| {
        let regex = Regex::new(pattern).expect("patterns are regular expressions");
        (name, regex)
    });
    let mut places: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for (path, text) in files {
        let path = path.strip_prefix(root).unwrap_or(path);
        let name = path.display().to_string();
        let found = paragraphs(path, text)
            .into_iter()
            .flat_map(|(line, text)| {
                let kinds = kinds(&text, &patterns).into_iter();
                kinds.map(move |kind| (line, kind)).collect::<Vec<_>>()
            })
            .map(|(line, kind)| format!("{name}:{line}: {kind}"));
        places.entry(folder(path)).or_default().extend(found);
    }
    let committed = committed();
    let mut all = Vec::new();
    for (folder, places) in places {
        let most = committed.get(folder.as_str()).copied().unwrap_or(0);
        if places.len() > most {
            all.push(format!(
                "{folder}: {} places that may need a second reading, at most {most} (tidy/prose.csv):",
                places.len()
            ));
            all.extend(places);
        }
    }
    all
}

/// Returns the committed number of places of each folder.
fn committed() -> BTreeMap<&'static str, usize> {
    let lines = include_str!("prose.csv").lines().skip(1);
    let rows = lines.filter_map(|line| line.split_once(','));
    rows.filter_map(|(folder, count)| Some((folder, count.trim().parse().ok()?)))
        .collect()
}

/// Returns the first two components of a path, or `.` for a file of the root.
fn folder(path: &Path) -> String {
    let parts: Vec<_> = path.iter().map(|part| part.to_string_lossy()).collect();
    match parts.as_slice() {
        [first, second, _, ..] => format!("{first}/{second}"),
        [first, _] => first.to_string(),
        _ => ".".to_owned(),
    }
}

/// Returns paragraphs of prose with their first lines: comments of sources, text of pages.
fn paragraphs(path: &Path, text: &str) -> Vec<(usize, String)> {
    let is_page = path.extension().is_some_and(|e| e == "md");
    let mut all: Vec<(usize, String)> = Vec::new();
    let (mut is_code, mut is_open) = (false, false);
    for (i, line) in text.lines().enumerate() {
        let line = line.trim_start();
        let prose = if is_page {
            Some(line)
        } else {
            line.strip_prefix("//")
                .map(|rest| rest.trim_start_matches(['/', '!']).trim_start())
        };
        let Some(prose) = prose else {
            (is_code, is_open) = (false, false);
            continue;
        };
        let is_fence = prose.starts_with("```");
        is_code ^= is_fence;
        if is_fence || is_code || prose.is_empty() || prose.starts_with(['#', '|', '<']) {
            is_open = false;
        } else if let (true, Some((_, last))) = (is_open, all.last_mut()) {
            last.push(' ');
            last.push_str(prose);
        } else {
            all.push((i + 1, prose.to_owned()));
            is_open = true;
        }
    }
    all
}

/// Returns the kinds of the places of a paragraph.
fn kinds(text: &str, patterns: &[(&'static str, Regex)]) -> Vec<&'static str> {
    let matches = patterns
        .iter()
        .flat_map(|(kind, regex)| regex.find_iter(text).map(|_| *kind));
    let sentences = text.split_inclusive(['.', ':', ';', '?']);
    let words = |sentence: &&str| {
        let words = sentence.split_whitespace();
        words
            .filter(|word| word.chars().any(char::is_alphabetic))
            .count()
            > MOST_WORDS
    };
    let long = sentences.filter(words).map(|_| "long sentence");
    matches.chain(long).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_found_in_comments_but_not_in_code() {
        let text = "//! What a run tells.\n\n/// ```text\n/// What is code.\n/// ```\n/// Force on a node.\nlet what = \"is told\";\n";
        let file = (PathBuf::from("crates/none/src/lib.rs"), text.to_owned());
        let found = findings(Path::new(""), &[file]);
        assert_eq!(
            found[1..],
            [
                "crates/none/src/lib.rs:1: clause as a subject",
                "crates/none/src/lib.rs:1: code that speaks"
            ]
        );
    }
}
