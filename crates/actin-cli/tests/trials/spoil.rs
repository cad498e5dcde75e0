//! Corruption of the text of a scene.

use rand::Rng;
use rand_chacha::ChaCha8Rng;

/// Numbers at and beyond the limits of scenes, and invalid numbers.
const NUMBERS: [&str; 20] = [
    "NaN",
    "inf",
    "-inf",
    "1e400",
    "1e308",
    "1e-310",
    "-0.0",
    "0",
    "-1",
    "0.5",
    "2",
    "1e-12",
    "1e-3",
    "1e3",
    "1e12",
    "18446744073709551615",
    "0x10",
    "--1",
    "(1.0, 2.0)",
    "\"1\"",
];

const PIECES: [&str; 22] = [
    "Rod(",
    "Ellipsoids(",
    "Clamp(end: End)",
    "Equilibrium()",
    "filament:",
    "None",
    "Some(1)",
    "true",
    "()",
    "[]",
    "r#\"",
    "\"",
    "/*",
    "//",
    "\\u{110000}",
    "\u{0}",
    "\u{feff}",
    ",,",
    "::",
    "\r",
    "\t",
    "é",
];

pub(super) fn below(random: &mut ChaCha8Rng, end: usize) -> usize {
    let wide = random.next_u64() % end.max(1) as u64;
    usize::try_from(wide).expect("it is below a usize")
}

pub(super) fn one_of<'a, T: ?Sized>(random: &mut ChaCha8Rng, all: &[&'a T]) -> &'a T {
    all[below(random, all.len())]
}

pub(super) fn between(random: &mut ChaCha8Rng, low: f64, high: f64) -> f64 {
    low + (high - low) * (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64
}

pub(super) fn spoil(text: &str, corpus: &[String], random: &mut ChaCha8Rng) -> Vec<u8> {
    let mut bytes = text.as_bytes().to_vec();
    for _ in 0..=below(random, 4) {
        if below(random, 2) == 0 {
            replace_number(&mut bytes, random);
        } else {
            change(&mut bytes, corpus, random);
        }
    }
    bytes
}

pub(super) fn other_numbers(text: &str, random: &mut ChaCha8Rng) -> Vec<u8> {
    let mut bytes = text.as_bytes().to_vec();
    for _ in 0..=below(random, 3) {
        replace_number(&mut bytes, random);
    }
    bytes
}

/// Replaces a number by one of the list, or multiplies it by a power of ten.
fn replace_number(bytes: &mut Vec<u8>, random: &mut ChaCha8Rng) {
    let numbers = numbers(bytes);
    if numbers.is_empty() {
        return;
    }
    let (start, end) = numbers[below(random, numbers.len())];
    let old = String::from_utf8_lossy(&bytes[start..end]).parse::<f64>();
    let new = match old {
        Ok(old) if below(random, 2) == 0 => {
            let factor = 10f64.powf(between(random, -3.0, 3.0));
            format!("{:?}", old * factor)
        }
        _ => one_of(random, &NUMBERS).to_owned(),
    };
    bytes.splice(start..end, new.into_bytes());
}

/// Returns the positions of numbers: digits, points, signs and exponents after a blank or a bracket.
fn numbers(bytes: &[u8]) -> Vec<(usize, usize)> {
    let is_part = |b: u8| b.is_ascii_digit() || b".+-eE".contains(&b);
    let mut found = Vec::new();
    let mut at = 0;
    while at < bytes.len() {
        let begins = bytes[at].is_ascii_digit() || bytes[at] == b'-';
        let free = at == 0 || b" ([,".contains(&bytes[at - 1]);
        let length = bytes[at..].iter().take_while(|&&b| is_part(b)).count();
        if begins && free {
            found.push((at, at + length));
        }
        at += length.max(1);
    }
    found
}

/// Changes bytes: deletes text, inserts fragments, parts of other scenes, repeated brackets or noise.
fn change(bytes: &mut Vec<u8>, corpus: &[String], random: &mut ChaCha8Rng) {
    let at = below(random, bytes.len() + 1);
    let end = (at + below(random, 80)).min(bytes.len());
    let new: Vec<u8> = match below(random, 5) {
        0 => Vec::new(),
        1 => one_of(random, &PIECES).as_bytes().to_vec(),
        2 => {
            let other = corpus[below(random, corpus.len())].as_bytes();
            let from = below(random, other.len());
            other[from..(from + below(random, 120)).min(other.len())].to_vec()
        }
        3 => one_of(random, &["(", "[", "{", "Some(", "/*", "a:", "-"])
            .repeat(below(random, 3000))
            .into_bytes(),
        _ => (0..below(random, 5))
            .map(|_| random.next_u64().to_le_bytes()[0])
            .collect(),
    };
    let end = if below(random, 2) == 0 { at } else { end };
    bytes.splice(at..end, new);
}
