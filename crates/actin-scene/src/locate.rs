//! Finds the line and column of a key in the text of a scene, and the key at a line and column.

use super::outline::{Outline, line_and_column, place, steps};

/// Line and column (from 1) of the key `path`, or of the innermost key above it that is written.
pub(super) fn position(text: &str, path: &str) -> (usize, usize) {
    let text = without_mark(text);
    let outline = Outline::of(text);
    let (mut node, _) = outline.follow(&steps(path));
    // A component of a vector is placed at its key.
    while let Some(inner) = node.filter(|&node| outline.step(node).is_none()) {
        node = outline.nodes[inner].parent;
    }
    node.map_or((1, 1), |node| {
        line_and_column(text, outline.nodes[node].start)
    })
}

/// Whether the key `path` is written.
pub(super) fn is_written(text: &str, path: &str) -> bool {
    let steps = steps(path);
    Outline::of(without_mark(text)).follow(&steps).1 == steps.len()
}

/// Path of the innermost key or list element that begins at or before a line and column and is
/// not closed before it; empty outside of all.
pub(super) fn path_at(text: &str, at: (usize, usize)) -> String {
    let text = without_mark(text);
    let outline = Outline::of(text);
    let node = outline.at(place(text, at));
    node.map_or_else(String::new, |node| outline.path(node))
}

/// The text behind a byte-order mark, which takes no column.
pub(super) fn without_mark(text: &str) -> &str {
    text.strip_prefix('\u{feff}').unwrap_or(text)
}

#[cfg(test)]
mod tests {
    use super::{path_at, position};

    const TEXT: &str = r#"// a: comment (
Scene(
    title: "x: ( \" [",
    filament: (
        sections: [
            Rod(from_nm: 0.0, to_nm: 1e1),
            Rod(
                from_nm: 10.0, /* nested /* to_nm: */ */
                to_nm: 5.0,
            ),
        ],
    ),
    loads: [EndForce(end: End, force_pn: (0.0, inf, 0.0))],
)"#;

    #[test]
    fn keys_are_found_behind_comments_strings_and_lists() {
        assert_eq!(position(TEXT, "filament"), (4, 5));
        assert_eq!(position(TEXT, "filament.sections[1]"), (7, 13));
        assert_eq!(position(TEXT, "filament.sections[1].to_nm"), (9, 17));
        assert_eq!(position(TEXT, "filament.sections[0].to_nm"), (6, 31));
        assert_eq!(position(TEXT, "loads[0].force_pn"), (13, 32));
    }

    #[test]
    fn a_key_that_is_not_written_is_placed_at_the_one_above() {
        assert_eq!(position(TEXT, "loads[0].force_pn[1]"), (13, 32));
        assert_eq!(position(TEXT, "filament.monomers.seed"), (4, 5));
        assert_eq!(position(TEXT, "absent"), (1, 1));
    }

    #[test]
    fn a_place_belongs_to_the_innermost_key() {
        assert_eq!(path_at(TEXT, (6, 31)), "filament.sections[0].to_nm");
        assert_eq!(path_at(TEXT, (9, 24)), "filament.sections[1].to_nm");
        assert_eq!(path_at(TEXT, (5, 9)), "filament.sections");
        assert_eq!(path_at(TEXT, (13, 47)), "loads[0].force_pn");
        assert_eq!(path_at(TEXT, (1, 1)), "");
        assert_eq!(path_at(TEXT, (99, 1)), "");
    }
}
