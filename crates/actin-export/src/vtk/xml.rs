//! Escaping of text in XML attributes.

/// Escapes `text` for use between double quotes in XML 1.0.
///
/// Markup becomes entities and line breaks become character references, since readers replace
/// literal line breaks by spaces. Characters forbidden in XML become U+FFFD.
///
/// # Source
/// XML 1.0 (fifth edition), sections 2.2, 2.4 and 3.3.3.
pub(super) fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&apos;"),
            '\t' => escaped.push_str("&#9;"),
            '\n' => escaped.push_str("&#10;"),
            '\r' => escaped.push_str("&#13;"),
            '\0'..='\u{1F}' | '\u{FFFE}' | '\u{FFFF}' => escaped.push('\u{FFFD}'),
            _ => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::escape;

    #[test]
    fn markup_and_forbidden_characters_are_replaced() {
        assert_eq!(
            escape("a<b> & \"c\" 'd'\n\u{7}é"),
            "a&lt;b&gt; &amp; &quot;c&quot; &apos;d&apos;&#10;\u{FFFD}é"
        );
    }
}
