//! The numbers in the text of a scene, and the keys that they belong to.

use std::ops::Range;

/// Where a number stands in a text, and the key before it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Number {
    /// Its bytes.
    pub(super) place: Range<usize>,
    /// The last key written before it.
    pub(super) key: String,
}

/// Every number of a text in order. Comments, strings and names that hold digits are left out.
pub(super) fn numbers(text: &str) -> Vec<Number> {
    let bytes = text.as_bytes();
    let (mut found, mut key, mut i) = (Vec::new(), String::new(), 0);
    while i < bytes.len() {
        let rest = &text[i..];
        let length = match bytes[i] {
            b'/' if rest.starts_with("//") => rest.find('\n').unwrap_or(rest.len()),
            b'"' => rest[1..].find('"').map_or(rest.len(), |end| end + 2),
            b'0'..=b'9' | b'-' | b'+' => {
                let length = token(rest, |c| c.is_ascii_alphanumeric() || "+-._".contains(c));
                let place = i..i + length;
                let key = key.clone();
                found.push(Number { place, key });
                length
            }
            c if c.is_ascii_alphabetic() || c == b'_' => {
                let length = token(rest, |c| c.is_ascii_alphanumeric() || c == '_');
                if rest[length..].trim_start().starts_with(':') {
                    rest[..length].clone_into(&mut key);
                }
                length
            }
            c if c < 0x80 => 1,
            _ => rest.chars().next().map_or(1, char::len_utf8),
        };
        i += length.max(1);
    }
    found
}

/// Length of the token that a text begins with.
fn token(text: &str, belongs: impl Fn(char) -> bool) -> usize {
    text.find(|c| !belongs(c)).unwrap_or(text.len())
}

/// The text with one number replaced.
pub(super) fn with_number(text: &str, number: &Number, value: &str) -> String {
    let Range { start, end } = number.place;
    format!("{}{value}{}", &text[..start], &text[end..])
}
