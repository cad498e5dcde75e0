//! Parser of RON and JSON, and choice of the format. It continues after a mistake and finds further ones.

mod yaml;

use super::position::without_mark;
use super::tree::{Kind, SceneValue, Source, TextSpan};
use yaml::{is_yaml, parse_yaml};

/// Largest depth of brackets.
pub(super) const MOST_DEPTH: usize = 128;

#[derive(Clone, Debug)]
pub(super) struct Parsed {
    pub(super) root: SceneValue,
    /// Syntax errors, with their positions.
    pub(super) mistakes: Vec<(usize, String)>,
    pub(super) brackets: Brackets,
}

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Brackets {
    /// First closing bracket that does not match the innermost open one, and the position of the open one.
    pub(super) misfit: Option<(usize, usize)>,
    /// First bracket deeper than [`MOST_DEPTH`], where parsing stopped.
    pub(super) too_deep: Option<usize>,
    pub(super) is_unclosed: bool,
    /// `true` if a list contains a key.
    pub(super) has_listed_key: bool,
    pub(super) has_text_after: bool,
    /// First string without a closing quotation mark.
    pub(super) unclosed_text: Option<usize>,
}

impl Brackets {
    /// Returns `true` if a bracket or quotation mark seems to be missing.
    pub(super) fn are_mistaken(self) -> bool {
        let is_odd = self.is_unclosed || self.has_listed_key;
        is_odd || self.misfit.is_some() || self.too_deep.is_some() || self.unclosed_text.is_some()
    }
}

/// Parses the text of a file; `file` is its kind for messages, such as `scene`.
pub(super) fn parse(text: &str, file: &str) -> Parsed {
    let text = without_mark(text);
    let mut parsed = if is_yaml(text) {
        parse_yaml(text)
    } else {
        parse_ron_or_json(text, file)
    };
    parsed.root.remove_schema();
    parsed
}

fn parse_ron_or_json(text: &str, file: &str) -> Parsed {
    let mut parser = Parser {
        text,
        at: 0,
        source: Source::Ron,
        opens: Vec::new(),
        mistakes: Vec::new(),
        brackets: Brackets::default(),
    };
    parser.skip_blank();
    if parser.rest().starts_with('{') {
        parser.source = Source::Json;
    }
    let root = parser.element();
    parser.skip_blank();
    let rest = parser.rest();
    parser.brackets.has_text_after = !rest.is_empty();
    if let Some(first) = rest.chars().next().filter(|_| parser.mistakes.is_empty()) {
        let message = match first {
            ')' | ']' | '}' => format!("this {first} closes nothing"),
            _ => format!("unexpected text after the {file}"),
        };
        parser.mistakes.push((parser.at, message));
    }
    Parsed {
        root,
        mistakes: parser.mistakes,
        brackets: parser.brackets,
    }
}

struct Parser<'a> {
    text: &'a str,
    at: usize,
    source: Source,
    opens: Vec<(char, usize)>,
    mistakes: Vec<(usize, String)>,
    brackets: Brackets,
}

fn is_part(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

pub(super) fn word(text: &str) -> &str {
    &text[..text.find(|c| !is_part(c)).unwrap_or(text.len())]
}

pub(super) fn begins_with_key(rest: &str) -> bool {
    let word = word(rest);
    let is_word = word.starts_with(|c: char| c.is_alphabetic() || c == '_');
    is_word && rest[word.len()..].trim_start().starts_with(':')
}

impl<'a> Parser<'a> {
    fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    fn skip_blank(&mut self) {
        loop {
            let rest = self.rest();
            if rest.starts_with("#![") {
                self.skip_to("]");
                continue;
            }
            let blank = rest.len() - rest.trim_start().len();
            if blank > 0 {
                self.at += blank;
            } else if rest.starts_with("//") {
                self.skip_to("\n");
            } else if rest.starts_with('#') {
                let message = "comments begin with //, not with #".to_owned();
                self.mistakes.push((self.at, message));
                self.skip_to("\n");
            } else if rest.starts_with("/*") {
                self.skip_block_comment();
            } else {
                return;
            }
        }
    }

    fn skip_to(&mut self, mark: &str) {
        let found = self.rest().find(mark);
        self.at = found.map_or(self.text.len(), |found| self.at + found + mark.len());
    }

    fn skip_block_comment(&mut self) {
        let mut depth = 0;
        loop {
            let (step, length) = match self.rest().as_bytes() {
                [b'/', b'*', ..] => (1, 2),
                [b'*', b'/', ..] => (-1, 2),
                _ => (0, self.rest().chars().next().map_or(0, char::len_utf8)),
            };
            depth += step;
            self.at += length;
            if depth == 0 || length == 0 {
                return;
            }
        }
    }

    /// Parses a value with its key, up to the comma or bracket after it.
    fn element(&mut self) -> SceneValue {
        self.skip_blank();
        let start = self.at;
        let key = self.key();
        self.skip_blank();
        let mut value = self.value();
        (value.key, value.place.start) = (key, start);
        let end = self.at;
        self.skip_blank();
        while !self.opens.is_empty() && !self.is_at_end() {
            let key = self.key_without_colon(&value);
            if !value.place.is_mistaken && value.kind != Kind::Invalid {
                let mistake = self.unseparated(&value, key.is_some(), end);
                self.mistakes.push(mistake);
            }
            value.place.is_mistaken = true;
            if begins_with_key(self.rest()) || self.begins_next(&value, key.is_some()) {
                break;
            }
            if self.rest().starts_with('=') {
                self.at += 1;
                self.skip_blank();
            }
            let inner = self.value();
            if key.is_some() {
                value = SceneValue { key, ..inner };
            } else if value.place.open.is_none() && inner.place.open.is_some() {
                value.kind = inner.kind;
                (value.place.open, value.place.close) = (inner.place.open, inner.place.close);
            }
            (value.place.start, value.place.is_mistaken) = (start, true);
            self.skip_blank();
        }
        value.place.until = self.at;
        value
    }

    fn is_at_end(&self) -> bool {
        self.rest().is_empty() || self.rest().starts_with([',', ')', ']', '}'])
    }

    /// Returns `true` if the next element of a list or vector follows `value` without a comma.
    fn begins_next(&self, value: &SceneValue, is_key: bool) -> bool {
        let begins = |c: char| c.is_ascii_digit() || c.is_uppercase() || "+-.\"".contains(c);
        let is_element = value.key.is_none() && !is_key && value.kind != Kind::Invalid;
        is_element && self.rest().starts_with(begins)
    }

    /// Error for unexpected text after a value, or after a key without a colon (`is_key`), that ends at `end`.
    fn unseparated(&self, value: &SceneValue, is_key: bool, end: usize) -> (usize, String) {
        let rest = self.rest();
        if is_key {
            let remedy = if rest.starts_with('=') {
                "in place of ="
            } else {
                "between key and value"
            };
            return (end, format!("a colon is expected {remedy}"));
        }
        let is_named = matches!(value.kind, Kind::Name(_) | Kind::Group(..) | Kind::List(_));
        if rest.starts_with('(') && value.key.is_none() && !is_named {
            return (value.place.value.start, "a name is expected".to_owned());
        }
        (self.at, before_comma(rest))
    }

    /// Parses a key and its colon. In JSON the key is a string.
    fn key(&mut self) -> Option<String> {
        if self.opens.is_empty() {
            return None;
        }
        if begins_with_key(self.rest()) {
            let key = word(self.rest()).to_owned();
            self.at += key.len();
            self.skip_to(":");
            return Some(key);
        }
        if self.source != Source::Json || !self.rest().starts_with('"') {
            return None;
        }
        let start = self.at;
        let text = self.string();
        self.skip_blank();
        match text {
            Kind::Text(key) if self.rest().starts_with(':') => {
                self.at += 1;
                Some(key)
            }
            _ => {
                self.at = start;
                None
            }
        }
    }

    /// Key without a colon that was parsed as `value`.
    fn key_without_colon(&self, value: &SceneValue) -> Option<String> {
        let has_keys = self.opens.last().is_some_and(|open| open.0 != '[');
        match &value.kind {
            Kind::Name(name)
                if has_keys
                    && value.key.is_none()
                    && name.starts_with(|c: char| c.is_lowercase() || c == '_') =>
            {
                Some(name.clone())
            }
            _ => None,
        }
    }

    fn value(&mut self) -> SceneValue {
        let start = self.at;
        let mut place = TextSpan {
            source: self.source,
            start,
            ..TextSpan::default()
        };
        let rest = self.rest();
        let number = number(rest);
        let mut kind = match rest.chars().next() {
            None | Some(',' | ')' | ']' | '}') => Kind::Invalid,
            Some('"') => self.string(),
            Some('r') if rest[1..].trim_start_matches('#').starts_with('"') => self.raw_string(),
            Some('(' | '[' | '{') => self.group(None, &mut place),
            Some(_) if number > 0 => {
                let text = rest[..number].to_owned();
                self.at += number;
                number_kind(&text)
            }
            Some(c) if is_part(c) => self.named(&mut place),
            Some(c) => {
                self.at += c.len_utf8();
                Kind::Invalid
            }
        };
        if self.source == Source::Json {
            kind = kind.choice();
        }
        place.value = start..self.at;
        let key = None;
        SceneValue { key, kind, place }
    }

    fn named(&mut self, place: &mut TextSpan) -> Kind {
        let name = word(self.rest()).to_owned();
        self.at += name.len();
        let end = self.at;
        self.skip_blank();
        if self.rest().starts_with('(') {
            return match self.group(Some(name), place) {
                Kind::Group(Some(name), mut values)
                    if name == "Some" && values.len() == 1 && values[0].key.is_none() =>
                {
                    let inner = values.remove(0);
                    (place.open, place.close) = (inner.place.open, inner.place.close);
                    inner.kind
                }
                group => group,
            };
        }
        self.at = end;
        match name.as_str() {
            "true" => Kind::Bool(true),
            "false" => Kind::Bool(false),
            "None" => Kind::None,
            "null" if self.source == Source::Json => Kind::None,
            _ => Kind::Name(name),
        }
    }

    fn group(&mut self, name: Option<String>, place: &mut TextSpan) -> Kind {
        let open = self.at;
        if self.opens.len() == MOST_DEPTH {
            self.brackets.too_deep = Some(open);
            self.at = self.text.len();
            return Kind::Invalid;
        }
        let bracket = self.text.as_bytes()[open] as char;
        self.at += 1;
        self.opens.push((bracket, open));
        let values = self.elements(place);
        place.open = Some(open);
        if bracket != '[' {
            return Kind::Group(name, values);
        }
        self.brackets.has_listed_key |= values.iter().any(|value| value.key.is_some());
        Kind::List(values)
    }

    /// Parses values up to a closing bracket. A bracket that closes an outer value is not consumed.
    fn elements(&mut self, place: &mut TextSpan) -> Vec<SceneValue> {
        let depth = self.opens.len();
        let (mut values, mut is_separated) = (Vec::new(), true);
        loop {
            self.skip_blank();
            match self.rest().chars().next() {
                None => {
                    self.opens.truncate(depth - 1);
                    self.brackets.is_unclosed = true;
                    return values;
                }
                Some(c @ (')' | ']' | '}')) => {
                    let at = self.at;
                    if self.close(c) {
                        place.close = Some(at);
                    }
                    return values;
                }
                Some(',') if !is_separated => {
                    self.at += 1;
                    is_separated = true;
                }
                Some(c) => {
                    values.push(self.element());
                    is_separated = c == ',';
                    if is_separated {
                        self.at += 1;
                    }
                }
            }
        }
    }

    /// Closes the innermost bracket. A bracket that closes an outer value is not consumed.
    fn close(&mut self, closing: char) -> bool {
        let opening = match closing {
            ')' => '(',
            ']' => '[',
            _ => '{',
        };
        let suggestion = self.opens.iter().rposition(|open| open.0 == opening);
        let is_last = suggestion.is_some_and(|suggestion| suggestion + 1 == self.opens.len());
        if let (Some((_, open)), false) = (self.opens.pop(), is_last) {
            self.brackets.misfit.get_or_insert((self.at, open));
        }
        let is_closed = is_last || suggestion.is_none();
        if is_closed {
            self.at += 1;
        } else {
            self.brackets.is_unclosed = true;
        }
        is_closed
    }

    fn string(&mut self) -> Kind {
        let mut text = String::new();
        let mut characters = self.rest().char_indices().skip(1);
        let (mut end, mut is_text) = (None, true);
        while let Some((at, c)) = characters.next() {
            match c {
                '"' => {
                    end = Some(at + 1);
                    break;
                }
                '\\' => {
                    let escaped = characters.next().map(|(_, c)| c);
                    let c = escaped.and_then(|c| unescaped(c, &mut characters));
                    is_text &= c.is_some();
                    text.extend(c);
                }
                c => text.push(c),
            }
        }
        if end.is_none() {
            self.brackets.unclosed_text.get_or_insert(self.at);
        }
        self.at += end.unwrap_or(self.rest().len());
        if is_text && end.is_some() {
            Kind::Text(text)
        } else {
            Kind::Invalid
        }
    }

    fn raw_string(&mut self) -> Kind {
        let marks = self.rest()[1..].find('"').unwrap_or_default();
        let end = format!("\"{}", "#".repeat(marks));
        let start = self.at + 2 + marks;
        self.at = start;
        self.skip_to(&end);
        let text = self.text[start..self.at].strip_suffix(&end);
        text.map_or(Kind::Invalid, |text| Kind::Text(text.to_owned()))
    }
}

fn unescaped(c: char, rest: &mut impl Iterator<Item = (usize, char)>) -> Option<char> {
    let mut rest = rest.map(|(_, c)| c);
    let digits: String = match c {
        'n' => return Some('\n'),
        'r' => return Some('\r'),
        't' => return Some('\t'),
        '0' => return Some('\0'),
        'b' => return Some('\u{8}'),
        'f' => return Some('\u{c}'),
        '"' | '\'' | '\\' | '/' => return Some(c),
        'x' => rest.take(2).collect(),
        'u' => match rest.next()? {
            '{' => rest.take_while(|c| *c != '}').collect(),
            first => std::iter::once(first).chain(rest.take(3)).collect(),
        },
        _ => return None,
    };
    char::from_u32(u32::from_str_radix(&digits, 16).ok()?)
}

pub(super) fn number(text: &str) -> usize {
    let digits = |from: usize| {
        let rest = &text[from..];
        let end = rest.find(|c: char| !c.is_ascii_digit() && c != '_');
        end.unwrap_or(rest.len())
    };
    let sign = usize::from(text.starts_with(['+', '-']));
    let rest = &text[sign..];
    if matches!(word(rest), "inf" | "NaN") {
        return sign + 3;
    }
    if rest.starts_with(['.', '0', '1', '2', '3', '4', '5', '6', '7', '8', '9']) {
        if rest.starts_with("0x") || rest.starts_with("0b") || rest.starts_with("0o") {
            return sign + word(rest).len();
        }
        let mut end = sign + digits(sign);
        if text[end..].starts_with('.') {
            end += 1 + digits(end + 1);
        }
        if text[end..].starts_with(['e', 'E']) {
            let signed = usize::from(text[end + 1..].starts_with(['+', '-']));
            let exponent = digits(end + 1 + signed);
            if exponent > 0 {
                end += 1 + signed + exponent;
            }
        }
        return end;
    }
    0
}

pub(super) fn number_kind(text: &str) -> Kind {
    let text = text.replace('_', "");
    let (sign, digits) = match text.strip_prefix('-') {
        Some(digits) => (-1, digits),
        None => (1, text.trim_start_matches('+')),
    };
    let whole = match digits.get(..2) {
        Some("0x") => i128::from_str_radix(&digits[2..], 16),
        Some("0o") => i128::from_str_radix(&digits[2..], 8),
        Some("0b") => i128::from_str_radix(&digits[2..], 2),
        _ => digits.parse(),
    };
    match (whole, text.parse()) {
        (Ok(whole), _) => Kind::Whole(sign * whole),
        (_, Ok(number)) => Kind::Number(number),
        _ => Kind::Invalid,
    }
}

fn before_comma(rest: &str) -> String {
    let word: String = rest.chars().take_while(char::is_ascii_alphabetic).collect();
    if rest.starts_with("()") {
        "a choice without keys is written without brackets".to_owned()
    } else if !word.is_empty() && !begins_with_key(rest) && !rest[word.len()..].starts_with('(') {
        format!("a comma is expected, not {word}; units are part of keys")
    } else {
        "a comma is missing here".to_owned()
    }
}
