//! Colours of all pictures and of the viewer. A run has one palette.

use actin_draw::{Colour, OKABE_ITO};
use std::sync::OnceLock;

pub(crate) use actin_view::BodyColours;
pub use actin_view::Palette;

static CHOSEN: OnceLock<Palette> = OnceLock::new();

/// Colour of reference data, such as entries of the paper.
pub(crate) const DATA: Colour = Colour([20, 20, 20]);
pub(crate) const GREY: Colour = Colour([130, 130, 130]);
pub(crate) const LIGHT_GREY: Colour = Colour([165, 165, 165]);

/// Sets the palette of this run. Further calls have no effect.
pub(crate) fn choose(palette: Palette) {
    CHOSEN.get_or_init(|| palette);
}

pub(crate) fn chosen() -> Palette {
    *CHOSEN.get_or_init(Palette::default)
}

/// Colour of a share of rod between 0 (all monomers) and 1 (all rod).
pub(crate) fn resolution(share: f64) -> Colour {
    chosen().ramp().at(share)
}

/// Colour of curve number `k` in charts without resolutions.
pub(crate) fn line(k: usize) -> Colour {
    Colour(OKABE_ITO[k % OKABE_ITO.len()])
}
