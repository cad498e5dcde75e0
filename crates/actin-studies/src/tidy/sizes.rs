//! Sizes of files, and their headers. A lint limits the sizes of functions (`clippy.toml`).

/// Largest number of lines of a file.
const MOST_LINES: usize = 600;

pub(super) fn findings(name: &str, text: &str) -> Vec<String> {
    let mut all = Vec::new();
    let lines = text.lines().count();
    if lines > MOST_LINES {
        all.push(format!("{name}: {lines} lines, at most {MOST_LINES}"));
    }
    if !text.trim_start().starts_with("//!") {
        all.push(format!("{name}: does not open with //!"));
    }
    all
}

#[cfg(test)]
mod tests {
    use super::findings;

    #[test]
    fn a_long_file_and_a_missing_header_are_found() {
        assert_eq!(findings("a.rs", "fn f() {}\n").len(), 1);
        assert!(findings("a.rs", "//! Header.\n").is_empty());
        let long = format!("//! Header.\n{}", "fn f() {}\n".repeat(600));
        let found = findings("a.rs", &long);
        assert_eq!(found, ["a.rs: 601 lines, at most 600"]);
    }
}
