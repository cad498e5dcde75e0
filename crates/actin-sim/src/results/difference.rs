//! Where two texts differ.

/// The first line in which two texts differ.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// Its number, from 1.
    pub line: usize,
    /// The line of the one text, without white space around it; empty behind its end.
    pub kept: String,
    /// The same of the other.
    pub given: String,
}

/// The first line in which two texts differ; none of the same text.
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

    /// A changed line, a text that goes on, texts that differ in how their last line ends.
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
