//! Colours and their shades.

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
