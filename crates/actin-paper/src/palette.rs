//! Colours of all pictures and of the viewer: what stands for a resolution, and what for a thing.
//!
//! A run has one palette, chosen once before anything is drawn. Numbers never depend on it.

use actin_draw::Colour;
use std::sync::OnceLock;

pub use actin_view::Palette;
pub(crate) use actin_view::Things;

/// The palette of this run.
static CHOSEN: OnceLock<Palette> = OnceLock::new();

/// What is given by others: data, the paper's entries.
pub(crate) const DATA: Colour = Colour([20, 20, 20]);
/// What stands back.
pub(crate) const GREY: Colour = Colour([130, 130, 130]);
/// What stands back further.
pub(crate) const LIGHT_GREY: Colour = Colour([165, 165, 165]);

/// Chooses the palette of this run; a second choice is not heard.
pub(crate) fn choose(palette: Palette) {
    CHOSEN.get_or_init(|| palette);
}

/// The palette of this run.
pub(crate) fn chosen() -> Palette {
    *CHOSEN.get_or_init(Palette::default)
}

/// The colour of a share of rod between 0 (all monomers) and 1 (all rod).
pub(crate) fn resolution(share: f64) -> Colour {
    chosen().ramp().at(share)
}

/// The colour of the line number `k` of those that are not resolutions.
pub(crate) fn line(k: usize) -> Colour {
    let lines = chosen().lines();
    Colour(lines[k % lines.len()])
}
