//! Sizes of files and functions, and the header that each file opens with.

/// Most lines of a file.
const MOST_LINES: usize = 500;
/// Most lines of code in the body of a function.
const MOST_FUNCTION_LINES: usize = 40;

/// Files and functions that are too long, and files that do not say what lives in them.
pub(super) fn findings(name: &str, text: &str) -> Vec<String> {
    let mut all = Vec::new();
    let lines = text.lines().count();
    if lines > MOST_LINES {
        all.push(format!("{name}: {lines} lines, at most {MOST_LINES}"));
    }
    if !text.trim_start().starts_with("//!") {
        all.push(format!("{name}: does not open with //!"));
    }
    all.extend(long_functions(name, text));
    all
}

/// Functions are found by their indentation, which the formatter guarantees. Lines of code in the
/// body count; signature, blank lines and comments do not.
fn long_functions(name: &str, text: &str) -> Vec<String> {
    let lines: Vec<&str> = text.lines().collect();
    let mut all = Vec::new();
    for (start, line) in lines.iter().enumerate() {
        let code = line.trim_start();
        if !is_function(code) || code.ends_with('}') {
            continue;
        }
        let closing = format!("{}}}", " ".repeat(line.len() - code.len()));
        let body: Vec<&str> = lines[start..]
            .iter()
            .skip_while(|l| !l.ends_with('{') && !l.ends_with(';'))
            .skip(1)
            .take_while(|l| **l != closing)
            .map(|l| l.trim())
            .filter(|l| !l.is_empty() && !l.starts_with("//"))
            .collect();
        if body.len() > MOST_FUNCTION_LINES {
            all.push(format!(
                "{name}:{}: a function of {} lines, at most {MOST_FUNCTION_LINES}",
                start + 1,
                body.len()
            ));
        }
    }
    all
}

fn is_function(code: &str) -> bool {
    [
        "fn ",
        "pub fn ",
        "pub(crate) fn ",
        "pub(super) fn ",
        "const fn ",
    ]
    .iter()
    .any(|start| code.starts_with(start))
}

#[cfg(test)]
mod tests {
    use super::findings;

    #[test]
    fn a_long_function_is_found_and_a_short_one_is_not() {
        let body = "    let x = 1;\n".repeat(70);
        let text = format!("//! Header.\n\nfn long() {{\n{body}}}\n\nfn short() {{\n}}\n");
        let found = findings("a.rs", &text);
        assert_eq!(found.len(), 1, "{found:?}");
        assert!(found[0].contains("a.rs:3"));
    }

    #[test]
    fn a_missing_header_is_found() {
        assert_eq!(findings("a.rs", "fn f() {}\n").len(), 1);
    }
}
