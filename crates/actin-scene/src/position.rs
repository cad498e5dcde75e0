//! Lines and columns in a text.

/// Line and column (in characters) of a byte offset, from 1.
pub(super) fn line_and_column(text: &str, at: usize) -> (usize, usize) {
    let before = &text[..at.min(text.len())];
    let line = before.matches('\n').count() + 1;
    let column = before.chars().rev().take_while(|&c| c != '\n').count() + 1;
    (line, column)
}

/// Byte offset of a line and column, limited to the end of the line or text.
pub(super) fn place(text: &str, (line, column): (usize, usize)) -> usize {
    let mut start = 0;
    for (number, content) in (1..).zip(text.split_inclusive('\n')) {
        if number == line {
            let content = content.trim_end_matches('\n');
            let mut characters = content.char_indices().map(|(at, _)| at);
            return start + characters.nth(column - 1).unwrap_or(content.len());
        }
        start += content.len();
    }
    text.len()
}

/// Removes a byte-order mark.
pub(super) fn without_mark(text: &str) -> &str {
    text.strip_prefix('\u{feff}').unwrap_or(text)
}
