//! Series of charts.

use actin_draw::{Colour, Series};

pub(crate) fn line(label: impl Into<String>, colour: Colour, points: Vec<(f64, f64)>) -> Series {
    Series {
        label: Some(label.into()),
        colour,
        points,
        dots: false,
    }
}

pub(crate) fn dots(colour: Colour, points: Vec<(f64, f64)>) -> Series {
    Series {
        label: None,
        colour,
        points,
        dots: true,
    }
}
