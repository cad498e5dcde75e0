//! Colours, their shades, colour ramps and sets of line colours.

use plotters::style::RGBColor;

/// A colour: red, green, blue.
///
/// ```
/// use actin_draw::Colour;
/// let red = Colour([200, 0, 0]);
/// assert_eq!(red.lighter(1.0), Colour([255, 255, 255]));
/// assert_eq!(red.darker(0.5), Colour([100, 0, 0]));
/// // Black on white has the largest contrast.
/// assert!((Colour([0; 3]).contrast(Colour([255; 3])) - 21.0).abs() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Colour(pub [u8; 3]);

impl From<Colour> for RGBColor {
    fn from(Colour([red, green, blue]): Colour) -> Self {
        Self(red, green, blue)
    }
}

impl Colour {
    /// Mixes the colour with a fraction of white.
    #[must_use]
    pub fn lighter(self, share: f64) -> Self {
        self.towards(255.0, share)
    }

    /// Mixes the colour with a fraction of black.
    #[must_use]
    pub fn darker(self, share: f64) -> Self {
        self.towards(0.0, share)
    }

    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a mean of two bytes"
    )]
    fn towards(self, end: f64, share: f64) -> Self {
        Self(
            self.0
                .map(|v| (f64::from(v) + share * (end - f64::from(v))) as u8),
        )
    }

    /// Returns the contrast ratio to another colour, from 1 (equal) to 21 (black and white).
    ///
    /// # Source
    /// W3C, Web Content Accessibility Guidelines 2.1, contrast ratio.
    pub fn contrast(self, other: Self) -> f64 {
        let [one, other] = [self, other].map(|colour| colour.luminance() + 0.05);
        (one / other).max(other / one)
    }

    /// Returns the relative luminance in sRGB, from 0 to 1.
    ///
    /// # Source
    /// W3C, Web Content Accessibility Guidelines 2.1, relative luminance.
    fn luminance(self) -> f64 {
        let linear = self.0.map(|byte| {
            let v = f64::from(byte) / 255.0;
            if v <= 0.03928 {
                v / 12.92
            } else {
                ((v + 0.055) / 1.055).powf(2.4)
            }
        });
        0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
    }

    pub(crate) fn hex(self) -> String {
        let [red, green, blue] = self.0;
        format!("#{red:02x}{green:02x}{blue:02x}")
    }
}

/// A sequence of colours (red, green, blue) at equal steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ramp(&'static [[u8; 3]]);

/// Colours (red, green, blue) of unordered lines, safe for the colour-blind: vermilion, orange, bluish green, blue,
/// reddish purple, sky blue.
///
/// # Source
/// M. Okabe and K. Ito, Color Universal Design (2008).
pub const OKABE_ITO: [[u8; 3]; 6] = [
    [213, 94, 0],
    [230, 159, 0],
    [0, 158, 115],
    [0, 114, 178],
    [204, 121, 167],
    [86, 180, 233],
];

impl Ramp {
    /// Red through yellow to blue, dark enough to be visible on white.
    pub const RED_YELLOW_BLUE: Self = Self(&[
        [190, 25, 35],
        [235, 110, 40],
        [235, 180, 0],
        [90, 165, 215],
        [30, 70, 180],
    ]);
    /// Entries 7 to 2 of eight colours of viridis. Its yellow end is not visible on white, and its dark end resembles
    /// black.
    ///
    /// # Source
    /// S. van der Walt and N. Smith, matplotlib 1.5 (2015), as sampled by `viridisLite::viridis(8)`.
    pub const VIRIDIS: Self = Self(&[
        [159, 218, 58],
        [74, 193, 109],
        [31, 161, 135],
        [39, 127, 142],
        [54, 92, 141],
        [70, 51, 126],
    ]);
    /// Blue through grey to red, for signed values.
    ///
    /// # Source
    /// K. Moreland, Diverging Color Maps for Scientific Visualization (2009), with a darker grey, visible on white.
    pub const BLUE_GREY_RED: Self = Self(&[
        [30, 70, 180],
        [120, 150, 235],
        [150, 150, 150],
        [235, 140, 110],
        [190, 25, 35],
    ]);

    /// Returns the colours at equal steps.
    pub fn stops(self) -> &'static [[u8; 3]] {
        self.0
    }

    /// Interpolates linearly at a fraction from 0 to 1; other fractions are clamped.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a place between the first and the last stop, and a mean of two bytes"
    )]
    pub fn at(self, share: f64) -> Colour {
        let stops = self.stops();
        let place = share.clamp(0.0, 1.0) * (stops.len() - 1) as f64;
        let i = (place as usize).min(stops.len() - 2);
        let t = place - i as f64;
        Colour([0, 1, 2].map(|k| {
            let (from, to) = (f64::from(stops[i][k]), f64::from(stops[i + 1][k]));
            (from + t * (to - from)) as u8
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::page::{DARK_CARD, on_dark};

    const ALL: [Ramp; 3] = [Ramp::RED_YELLOW_BLUE, Ramp::VIRIDIS, Ramp::BLUE_GREY_RED];

    #[test]
    fn the_ends_are_the_stops() {
        assert_eq!(Ramp::RED_YELLOW_BLUE.at(0.0), Colour([190, 25, 35]));
        assert_eq!(Ramp::RED_YELLOW_BLUE.at(1.0), Colour([30, 70, 180]));
        assert_eq!(Ramp::RED_YELLOW_BLUE.at(0.5), Colour([235, 180, 0]));
        assert_eq!(Ramp::VIRIDIS.at(-1.0), Colour(Ramp::VIRIDIS.stops()[0]));
        assert_eq!(Ramp::VIRIDIS.at(2.0), Colour(Ramp::VIRIDIS.stops()[5]));
    }

    #[test]
    fn viridis_darkens_throughout() {
        let shades: Vec<f64> = (0..=40)
            .map(|k| Ramp::VIRIDIS.at(f64::from(k) / 40.0))
            .map(|colour| colour.contrast(Colour([255; 3])))
            .collect();
        assert!(shades.is_sorted_by(|a, b| a < b), "{shades:?}");
    }

    /// All colours are visible on white, with a contrast of at least 1.5.
    #[test]
    fn every_colour_is_seen_on_white() {
        for ramp in ALL {
            for k in 0..=40 {
                let contrast = ramp.at(f64::from(k) / 40.0).contrast(Colour([255; 3]));
                assert!(contrast > 1.5, "{ramp:?} {k}");
            }
        }
    }

    /// All colours have a contrast of 3 to the dark background, the minimum for graphics.
    ///
    /// # Source
    /// W3C, Web Content Accessibility Guidelines 2.1, success criterion 1.4.11.
    #[test]
    fn every_stop_is_seen_on_the_dark_card() {
        for ramp in ALL {
            for &stop in ramp.stops() {
                let contrast = Colour(on_dark(stop)).contrast(Colour(DARK_CARD));
                assert!(contrast > 3.0, "{ramp:?} {stop:?}: {contrast}");
            }
        }
    }
}
