//! Word counts of the book and the READMEs, without code, tables, comments and generated pages.

use super::{generated, tables};
use crate::tidy;
use std::path::Path;

/// Returns pages with their numbers of words, longest first.
///
/// # Errors
/// If a file cannot be read.
pub(super) fn by_hand(root: &Path) -> Result<Vec<(String, usize)>, String> {
    let generated = generated(root)?;
    let is_by_hand =
        |name: &str| !generated.contains_key(name) && !name.starts_with(tables::FOLDER);
    let mut counts = Vec::new();
    for (path, text) in tidy::files(root, "md")? {
        let name = path.strip_prefix(root).unwrap_or(&path).display();
        let name = name.to_string();
        if is_by_hand(&name) && !name.ends_with("CHANGELOG.md") {
            counts.push((name, count(&text)));
        }
    }
    counts.sort_by_key(|(name, count)| (std::cmp::Reverse(*count), name.clone()));
    Ok(counts)
}

/// Counts words outside fenced code, tables and comments, without list and heading markers.
fn count(text: &str) -> usize {
    let (mut words, mut in_code, mut in_comment) = (0, false, false);
    for line in text.lines().map(str::trim) {
        let is_fence = line.starts_with("```");
        in_code ^= is_fence;
        in_comment |= line.starts_with("<!--");
        if !(in_code || is_fence || in_comment || line.starts_with('|')) {
            let is_word = |word: &&str| word.contains(char::is_alphanumeric);
            words += line.split_whitespace().filter(is_word).count();
        }
        in_comment &= !line.ends_with("-->");
    }
    words
}

#[cfg(test)]
mod tests {
    use super::count;

    #[test]
    fn code_tables_and_comments_are_left_out() {
        let text = "# One two\n\nThree `four`, five.\n\n| a | b |\n|---|---|\n\n```sh\nnot this\n```\n\
                    <!-- not run: no\nreason -->\nsix\n";
        assert_eq!(count(text), 5 + 1);
    }
}
