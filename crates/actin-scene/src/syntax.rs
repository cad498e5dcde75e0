//! What RON's parser refuses, said so that it tells what to write. Keys and choices have words of their own in
//! `read`.

use ron::error::Error as RonError;

/// What to write instead; none for what is rare. `rest` is the text from where the parser stopped, `before`
/// what it has read.
pub(super) fn advice(error: &RonError, (before, rest): (&str, &str)) -> Option<String> {
    let rest = rest.trim_start();
    let (kind, behind) = match error {
        RonError::ExpectedComma => return Some(before_comma(rest)),
        RonError::ExpectedFloat => ("a number", ""),
        RonError::ExpectedInteger => ("a whole number", ""),
        RonError::IntegerOutOfBounds => ("a whole number", ", not negative and not beyond 2^64"),
        RonError::ExpectedBoolean => ("true or false", ""),
        RonError::ExpectedString => ("text", ", in quotation marks"),
        RonError::ExpectedArray => ("a list", ", in square brackets"),
        RonError::ExpectedIdentifier if rest.starts_with('#') => {
            ("a key", "; comments begin with //")
        }
        RonError::ExpectedIdentifier => ("a name", ""),
        RonError::ExpectedMapColon if rest.starts_with('=') => ("a colon", " in place of ="),
        RonError::ExpectedMapColon => ("a colon", " between key and value"),
        RonError::ExpectedStructLike | RonError::ExpectedNamedStructLike(_) => {
            return Some(round_brackets(before));
        }
        _ => return of_names_and_lengths(error),
    };
    let quoted = if behind.is_empty() && rest.starts_with('"') {
        ", without quotation marks"
    } else {
        ""
    };
    Some(format!("{kind} is expected{behind}{quoted}"))
}

/// Errors that carry what was found.
fn of_names_and_lengths(error: &RonError) -> Option<String> {
    match error {
        RonError::SuggestRawIdentifier(found)
            if found.starts_with(|c: char| c.is_ascii_digit()) =>
        {
            Some(format!(
                "a key is expected, not {found}; decimals are written with a point"
            ))
        }
        RonError::ExpectedDifferentLength { expected, found } => {
            let numbers = expected.strip_prefix("an array of length ")?;
            Some(format!("{numbers} numbers are expected, not {found}"))
        }
        RonError::ExpectedDifferentStructName { expected, found } => {
            let brackets = if matches!(found.as_str(), "true" | "false") {
                "(...)"
            } else {
                ""
            };
            Some(format!("{expected}{brackets} is expected, not {found}"))
        }
        _ => None,
    }
}

/// That a structure is written in brackets, even of one whose name stands there alone.
fn round_brackets(before: &str) -> String {
    let before = before.trim_end();
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let name = &before[before.trim_end_matches(is_part).len()..];
    if name.starts_with(|c: char| c.is_ascii_uppercase()) {
        format!("{name} is written with round brackets, even if nothing is in them: {name}()")
    } else {
        "a ( is expected: structures and vectors are written in round brackets".to_owned()
    }
}

/// What stands where a value has ended and a comma is expected.
fn before_comma(rest: &str) -> String {
    let word: String = rest.chars().take_while(char::is_ascii_alphabetic).collect();
    if rest.starts_with("()") {
        return "a choice without keys is written without brackets".to_owned();
    }
    // Only whole numbers end at a point.
    if rest.starts_with(['.', 'e', 'E']) && !begins_with_key(rest) {
        "a whole number is expected".to_owned()
    } else if !word.is_empty() && !begins_with_key(rest) && !rest[word.len()..].starts_with('(') {
        format!("a comma is expected, not {word}; units are part of keys")
    } else {
        "a comma is missing before this".to_owned()
    }
}

/// Whether a key with its colon comes first.
fn begins_with_key(rest: &str) -> bool {
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let behind = rest.trim_start_matches(is_part);
    behind.len() < rest.len() && behind.trim_start().starts_with(':')
}
