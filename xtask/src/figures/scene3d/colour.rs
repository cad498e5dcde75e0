//! Colours and their shades.

use plotters::style::RGBColor;

/// A colour: red, green, blue.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Colour(pub [u8; 3]);

impl From<RGBColor> for Colour {
    fn from(RGBColor(red, green, blue): RGBColor) -> Self {
        Self([red, green, blue])
    }
}

impl Colour {
    /// The colour mixed with a share of white.
    pub(crate) fn lighter(self, share: f64) -> Self {
        self.towards(255.0, share)
    }

    /// The colour mixed with a share of black.
    pub(crate) fn darker(self, share: f64) -> Self {
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

    /// As SVG writes it.
    pub(super) fn hex(self) -> String {
        let [red, green, blue] = self.0;
        format!("#{red:02x}{green:02x}{blue:02x}")
    }
}
