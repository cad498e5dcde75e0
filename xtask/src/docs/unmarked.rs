//! Numbers of a document that nothing holds to the report: each is to be deliberate.
//!
//! Decimal numbers outside marks, code and comments are counted block by block: a paragraph, an item
//! of a list, a table. A block that has some says how many and why, `<!-- unmarked: 3, settings -->`;
//! below a heading, `<!-- unmarked section: what prints them -->` speaks for all blocks up to the next
//! heading. Whole numbers are not counted: most are sizes and settings.

use super::marks::Mark;
use std::collections::BTreeSet;

const BLOCK: &str = "<!-- unmarked:";
const SECTION: &str = "<!-- unmarked section:";

/// Lines that belong together.
#[derive(Debug, Default)]
struct Block {
    /// Line of its first number, from 1.
    line: usize,
    numbers: Vec<String>,
    /// How many it says it has.
    told: Option<usize>,
}

impl Block {
    fn finding(&self, document: &str) -> Option<String> {
        let told = self.told.unwrap_or(0);
        (told != self.numbers.len()).then(|| {
            let (line, numbers) = (self.line, self.numbers.join(", "));
            let count = self.numbers.len();
            format!("{document}:{line}: {count} decimal numbers without a mark, {told} told of: {numbers}")
        })
    }
}

/// Blocks whose count of unmarked numbers is not what they say.
pub(super) fn findings(document: &str, text: &str, marks: &[Mark]) -> Vec<String> {
    let marked: BTreeSet<(usize, usize)> = marks.iter().map(|m| (m.line, m.start)).collect();
    let (mut blocks, mut block) = (Vec::new(), Block::default());
    let (mut in_code, mut is_spoken_for) = (false, false);
    for (line, text) in (1..).zip(text.lines()) {
        let bare = text.trim_start();
        in_code ^= bare.starts_with("```");
        if text.trim().is_empty() || bare.starts_with("- ") || bare.starts_with('#') {
            blocks.push(std::mem::take(&mut block));
        }
        is_spoken_for = (is_spoken_for && !bare.starts_with('#')) || bare.starts_with(SECTION);
        if in_code || is_spoken_for {
            continue;
        }
        if let Some(start) = text.find(BLOCK) {
            let count = text[start + BLOCK.len()..].split(',').next();
            block.told = count.and_then(|n| n.trim().parse().ok());
        }
        let numbers = decimals(text);
        let open = numbers
            .into_iter()
            .filter(|(start, _)| !marked.contains(&(line, *start)));
        for (_, number) in open {
            if block.numbers.is_empty() {
                block.line = line;
            }
            block.numbers.push(number.to_owned());
        }
    }
    blocks.push(block);
    blocks.iter().filter_map(|b| b.finding(document)).collect()
}

/// Decimal numbers of a line with the bytes at which they start; what follows a plus-minus sign is
/// the uncertainty of the number before.
fn decimals(line: &str) -> Vec<(usize, &str)> {
    let bare = without(&without(line, "<!--", "-->"), "`", "`");
    let is_part = |c: char| c.is_ascii_alphanumeric() || "+-.^/_".contains(c);
    let mut all = Vec::new();
    let mut after_sign = false;
    let mut from = 0;
    while let Some(start) = bare[from..].find(|c| is_part(c) || c == '±') {
        let start = from + start;
        if bare[start..].starts_with('±') {
            (after_sign, from) = (true, start + '±'.len_utf8());
            continue;
        }
        let end = bare[start..].find(|c| !is_part(c));
        let end = end.map_or(bare.len(), |length| start + length);
        let word = line[start..end].trim_end_matches(['.', '-', '/']);
        if is_decimal(word) && !after_sign {
            all.push((start, word));
        }
        (after_sign, from) = (false, end);
    }
    all
}

fn is_decimal(word: &str) -> bool {
    word.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c))
        && word.contains(['.', 'e'])
        && word.parse::<f64>().is_ok()
}

/// The line with what stands between two signs blanked, byte by byte, so that places stay.
fn without(line: &str, open: &str, close: &str) -> String {
    let mut text = line.to_owned();
    let mut from = 0;
    while let Some(start) = text[from..].find(open).map(|at| from + at) {
        let inside = start + open.len();
        let end = text[inside..].find(close);
        let end = end.map_or(text.len(), |at| inside + at + close.len());
        text.replace_range(start..end, &" ".repeat(end - start));
        from = end;
    }
    text
}

#[cfg(test)]
mod tests {
    use super::super::marks::marks;
    use super::*;

    fn found(text: &str) -> Vec<String> {
        findings("a.md", text, &marks("a.md", text).unwrap())
    }

    /// What is marked, code, uncertainties, whole numbers and names are left alone.
    #[test]
    fn decimals_without_a_mark_are_counted() {
        let text = "A 1.5 nm <!-- fig8:spread --> and `2.5`, 3 ± 0.1 of 4 x 10, arXiv v1.2a.\n";
        assert_eq!(found(text), [""; 0]);
        let open = "Up to 1.5 nm <!-- fig8:spread -->, **2.5** of\n(1e-3).\n\n- 7.5 nm\n- 8\n";
        assert_eq!(
            found(open),
            [
                "a.md:1: 2 decimal numbers without a mark, 0 told of: 2.5, 1e-3",
                "a.md:4: 1 decimal numbers without a mark, 0 told of: 7.5",
            ]
        );
        assert_eq!(
            decimals("-0.5, +1.5e-3; nm^2.5, 71.2/26"),
            [(0, "-0.5"), (6, "+1.5e-3")]
        );
    }

    /// A block says how many it has; one more or one less is found.
    #[test]
    fn a_block_that_says_why_is_left_alone() {
        let told = "A 2.5 and\n3.5. <!-- unmarked: 2, settings -->\n";
        assert_eq!(found(told), [""; 0]);
        assert_eq!(found(&told.replace("2.5", "2")).len(), 1);
        let section = "# A\n<!-- unmarked section: tests -->\n1.5\n\n2.5\n\n# B\n\n3.5\n";
        assert_eq!(found(section).len(), 1);
    }
}
