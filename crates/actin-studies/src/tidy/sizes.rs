//! Sizes of files. A lint limits the sizes of functions (`clippy.toml`).

/// Largest number of lines of a file.
const MOST_LINES: usize = 600;

pub(super) fn findings(name: &str, text: &str) -> Vec<String> {
    let mut all = Vec::new();
    let lines = text.lines().count();
    if lines > MOST_LINES {
        all.push(format!("{name}: {lines} lines, at most {MOST_LINES}"));
    }
    all
}

#[cfg(test)]
mod tests {
    use super::findings;

    #[test]
    fn a_long_file_is_found() {
        assert!(findings("a.rs", "fn f() {}\n").is_empty());
        let long = "fn f() {}\n".repeat(601);
        let found = findings("a.rs", &long);
        assert_eq!(found, ["a.rs: 601 lines, at most 600"]);
    }
}
