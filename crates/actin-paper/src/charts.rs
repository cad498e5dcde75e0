//! Series of charts.

use actin_draw::{Colour, Mark, Series};

pub(crate) fn line(label: impl Into<String>, colour: Colour, points: Vec<(f64, f64)>) -> Series {
    Series {
        label: Some(label.into()),
        colour,
        points,
        mark: Mark::Line,
    }
}

pub(crate) fn dots(colour: Colour, points: Vec<(f64, f64)>) -> Series {
    Series {
        label: None,
        colour,
        points,
        mark: Mark::Dots,
    }
}
