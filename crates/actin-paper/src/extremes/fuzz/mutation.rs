//! Ways to spoil the text of a scene.

use crate::extremes::text::{numbers, with_number};
use proptest::prelude::*;
use proptest::sample::Index;

/// One change of a text; places are shares of its length.
#[derive(Clone, Debug)]
pub(super) enum Mutation {
    /// Other bytes in place of some.
    Overwrite(Index, Vec<u8>),
    /// Bytes between others.
    Insert(Index, Vec<u8>),
    /// A stretch left out.
    Delete(Index, usize),
    /// A stretch of another text, or of the same.
    Splice(Index, Index, Index, usize),
    /// Another number in place of one.
    Number(Index, &'static str),
    /// A word of the language, where it may not belong.
    Word(Index, &'static str),
    /// The same bracket or word again and again.
    Repeat(Index, &'static str, usize),
}

const NUMBERS: [&str; 24] = [
    "NaN",
    "inf",
    "-inf",
    "1e400",
    "1e308",
    "-1e308",
    "1e-310",
    "-0.0",
    "0",
    "-1",
    "0.5",
    "1e-12",
    "1e12",
    "1000000000000",
    "18446744073709551615",
    "18446744073709551616",
    "0x10",
    "0b1",
    "1_0",
    "1e",
    "--1",
    "(1.0, 2.0)",
    "\"1\"",
    "1.0.0",
];

const WORDS: [&str; 34] = [
    "Scene(",
    "Rod(",
    "Ellipsoids(",
    "Linker(",
    "Clamp(",
    "Stage(",
    "Turn(",
    "Equilibrium(",
    "Dynamics(",
    "filament:",
    "sections:",
    "to_nm:",
    "segments:",
    "path:",
    "None",
    "Some(1)",
    "true",
    "()",
    "[]",
    "{}",
    "r#\"",
    "\"",
    "'",
    "/*",
    "*/",
    "//",
    "#![enable(unwrap_newtypes)]",
    "\\u{110000}",
    "\u{0}",
    "\u{feff}",
    "\u{1F980}",
    ",,",
    "::",
    "b\"",
];

const REPEATED: [&str; 10] = ["(", "[", "{", "Some(", "/*", "Rod(", "a:", ",", "\"\\", "-"];

fn bytes() -> impl Strategy<Value = Vec<u8>> {
    prop::collection::vec(any::<u8>(), 1..5)
}

/// A few changes of any kind.
pub(super) fn mutations() -> impl Strategy<Value = Vec<Mutation>> {
    let place = any::<Index>;
    let one = prop_oneof![
        1 => (place(), bytes()).prop_map(|(at, bytes)| Mutation::Overwrite(at, bytes)),
        1 => (place(), bytes()).prop_map(|(at, bytes)| Mutation::Insert(at, bytes)),
        1 => (place(), 1usize..60).prop_map(|(at, length)| Mutation::Delete(at, length)),
        1 => (place(), place(), place(), 1usize..120)
            .prop_map(|(text, from, to, length)| Mutation::Splice(text, from, to, length)),
        3 => (place(), prop::sample::select(NUMBERS.to_vec()))
            .prop_map(|(which, value)| Mutation::Number(which, value)),
        2 => (place(), prop::sample::select(WORDS.to_vec()))
            .prop_map(|(at, word)| Mutation::Word(at, word)),
        1 => (place(), prop::sample::select(REPEATED.to_vec()), 1usize..3000)
            .prop_map(|(at, what, times)| Mutation::Repeat(at, what, times)),
    ];
    prop::collection::vec(one, 1..5)
}

impl Mutation {
    /// The changed text; `corpus` lends stretches.
    pub(super) fn apply(&self, text: &str, corpus: &[String]) -> String {
        let mut bytes = text.as_bytes().to_vec();
        let place = |at: &Index, length: usize| at.index(length.max(1)).min(length);
        let at = |at: &Index| place(at, text.len());
        match self {
            Self::Overwrite(start, new) => {
                let start = at(start);
                let end = (start + new.len()).min(bytes.len());
                bytes.splice(start..end, new.iter().copied());
            }
            Self::Insert(start, new) => insert(&mut bytes, at(start), new),
            Self::Delete(start, length) => {
                let start = at(start);
                let end = (start + length).min(bytes.len());
                bytes.drain(start..end);
            }
            Self::Splice(source, from, to, length) => {
                let source = source.get(corpus).as_bytes();
                let from = place(from, source.len());
                let end = (from + length).min(source.len());
                insert(&mut bytes, at(to), &source[from..end]);
            }
            Self::Number(which, value) => {
                let all = numbers(text);
                if !all.is_empty() {
                    return with_number(text, which.get(&all), value);
                }
            }
            Self::Word(start, word) => insert(&mut bytes, at(start), word.as_bytes()),
            Self::Repeat(start, what, times) => {
                insert(&mut bytes, at(start), what.repeat(*times).as_bytes());
            }
        }
        String::from_utf8_lossy(&bytes).into_owned()
    }
}

fn insert(bytes: &mut Vec<u8>, at: usize, new: &[u8]) {
    bytes.splice(at..at, new.iter().copied());
}
