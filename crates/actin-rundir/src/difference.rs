//! Comparison of two texts.

/// First line in which two texts differ.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// Line number, starting at 1.
    pub line: usize,
    /// Line of the first text, trimmed; empty after its end.
    pub kept: String,
    /// Line of the second text, trimmed; empty after its end.
    pub given: String,
}

/// Returns the first line in which two texts differ; `None` if they are equal.
pub fn first_difference(kept: &str, given: &str) -> Option<Difference> {
    if kept == given {
        return None;
    }
    let (mut old, mut new) = (kept.lines(), given.lines());
    let mut line = 0;
    loop {
        line += 1;
        let (kept, given) = (old.next(), new.next());
        if kept != given || kept.is_none() {
            let text = |line: Option<&str>| line.unwrap_or_default().trim().to_owned();
            let (kept, given) = (text(kept), text(given));
            return Some(Difference { line, kept, given });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_line_is_found() {
        let of = |a, b| first_difference(a, b).map(|d| (d.line, d.kept, d.given));
        let found = |line, kept: &str, given: &str| Some((line, kept.into(), given.into()));
        assert_eq!(of("a\n b", "a\n b"), None);
        assert_eq!(of("a\n b\nc", "a\n d\ne"), found(2, "b", "d"));
        assert_eq!(of("a", "a\nb"), found(2, "", "b"));
        assert_eq!(of("a\n", "a"), found(2, "", ""));
    }
}
