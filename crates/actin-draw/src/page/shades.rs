//! Colours on dark pages. Files of pictures have colours for white paper, which are replaced by CSS variables in the
//! page.

use std::collections::BTreeMap;

/// Background of pictures on a dark page, as in `style.css`.
pub const DARK_CARD: [u8; 3] = [0x1c, 0x20, 0x24];
const DARK_INK: [u8; 3] = [0xe6, 0xe6, 0xe2];
/// Largest difference of the components of a grey.
const GREY: u8 = 12;
/// Fraction of white mixed with other colours on a dark page.
const LIFT: f64 = 0.3;
const ATTRIBUTES: [&str; 3] = [" fill=\"#", " stroke=\"#", " stop-color=\"#"];
const DIGITS: usize = 6;

type Colour = [u8; 3];

/// Colours of the pictures of a page, with the numbers of their variables.
#[derive(Debug, Default)]
pub(super) struct Shades(BTreeMap<Colour, usize>);

impl Shades {
    pub(super) fn embed(&mut self, svg: &str) -> String {
        let mut text = String::with_capacity(svg.len());
        let mut rest = svg;
        while let Some((before, colour, after)) = next_colour(rest) {
            // The sign before the digits is removed.
            text.push_str(&before[..before.len() - 1]);
            text.push_str(&self.variable(colour));
            rest = after;
        }
        text.push_str(rest);
        text
    }

    pub(super) fn variable(&mut self, colour: Colour) -> String {
        let known = self.0.len();
        let number = *self.0.entry(colour).or_insert(known);
        format!("var(--p{number})")
    }

    pub(super) fn style(&self) -> String {
        let rules = |shade: fn(Colour) -> Colour| -> String {
            let rule = |(colour, number): (&Colour, &usize)| {
                let [red, green, blue] = shade(*colour);
                format!("--p{number}:#{red:02x}{green:02x}{blue:02x};")
            };
            self.0.iter().map(rule).collect()
        };
        format!(
            ":root {{ {} }}\n@media (prefers-color-scheme: dark) {{ :root {{ {} }} }}\n",
            rules(|colour| colour),
            rules(on_dark)
        )
    }
}

fn next_colour(svg: &str) -> Option<(&str, Colour, &str)> {
    let mut from = 0;
    loop {
        let found = ATTRIBUTES.iter().filter_map(|attribute| {
            let start = svg[from..].find(attribute)?;
            Some(from + start + attribute.len())
        });
        let start = found.min()?;
        let digits = svg.get(start..start + DIGITS);
        let ends = svg[start..].find('"') == Some(DIGITS);
        if let Some(colour) = digits.filter(|_| ends).and_then(parsed) {
            return Some((&svg[..start], colour, &svg[start + DIGITS..]));
        }
        from = start;
    }
}

fn parsed(digits: &str) -> Option<Colour> {
    let number = u32::from_str_radix(digits, 16).ok()?;
    let [_, red, green, blue] = number.to_be_bytes();
    Some([red, green, blue])
}

/// Converts a colour for a dark page. Greys are mapped from white and black to the dark background and text colours;
/// other colours are lightened.
pub fn on_dark(colour: Colour) -> Colour {
    let (most, least) = colour.iter().fold((0, u8::MAX), |(most, least), &v| {
        (v.max(most), v.min(least))
    });
    if most - least < GREY {
        let white = f64::from(most) / 255.0;
        return [0, 1, 2].map(|k| between(DARK_INK[k], DARK_CARD[k], white));
    }
    colour.map(|v| between(v, u8::MAX, LIFT))
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a mean of two bytes"
)]
fn between(from: u8, to: u8, share: f64) -> u8 {
    (f64::from(from) + share * (f64::from(to) - f64::from(from))).round() as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    const SVG: &str = "<svg><rect fill=\"#FFFFFF\" stroke=\"none\"/><g fill=\"url(#a)\">\
        <text fill=\"#000000\">fill=\"red\" #123456</text><path stroke=\"#be1923\" fill=\"#FFFFFF\"/>\
        <stop stop-color=\"#be1923\"/><path stroke=\"#be19231\"/></g></svg>";

    #[test]
    fn a_light_page_shows_the_file_as_it_is() {
        let mut shades = Shades::default();
        let embedded = shades.embed(SVG);
        assert_eq!(shades.0.len(), 3);
        assert_eq!(embedded.matches("var(--p").count(), 5);
        let back = shades
            .0
            .iter()
            .fold(embedded, |text, ([red, green, blue], number)| {
                let colour = format!("#{red:02x}{green:02x}{blue:02x}");
                text.replace(&format!("var(--p{number})"), &colour)
            });
        assert_eq!(back.to_lowercase(), SVG.to_lowercase());
        let style = shades.style();
        assert!(style.contains("--p0:#ffffff;") && style.contains("--p0:#1c2024;"));
    }

    #[test]
    fn white_becomes_the_card_and_black_the_ink() {
        assert_eq!(on_dark([255, 255, 255]), DARK_CARD);
        assert_eq!(on_dark([0, 0, 0]), DARK_INK);
        assert_eq!(on_dark([190, 25, 35]), [210, 94, 101]);
        let style = include_str!("style.css");
        for [red, green, blue] in [DARK_CARD, DARK_INK] {
            assert!(style.contains(&format!("#{red:02x}{green:02x}{blue:02x}")));
        }
    }
}
