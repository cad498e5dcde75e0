//! Colours of all pictures and of the viewer: what stands for a resolution, and what for a thing.
//!
//! A run has one palette, chosen once before anything is drawn. Numbers never depend on it.

use plotters::style::RGBColor;
use serde::Serialize;
use std::sync::OnceLock;

/// A set of colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Palette {
    /// From red through yellow to blue with the share of rod, as in the paper.
    #[default]
    Paper,
    /// From light green to dark purple; told apart without red and green, and in grey.
    ColourBlind,
}

/// What colours of things stand for.
#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) struct Things {
    /// Lateral and longitudinal bonds.
    pub bonds: [[u8; 3]; 2],
    /// First, second and third axis of a frame.
    pub axes: [[u8; 3]; 3],
    pub junction: [u8; 3],
    pub node: [u8; 3],
    pub clamp: [u8; 3],
    pub linker: [u8; 3],
    pub anchor: [u8; 3],
    /// Forces, and what held ends are made to do.
    pub force: [u8; 3],
}

impl Things {
    /// Every colour changed in the same way.
    pub(crate) fn map(&self, shade: fn([u8; 3]) -> [u8; 3]) -> Self {
        Self {
            bonds: self.bonds.map(shade),
            axes: self.axes.map(shade),
            junction: shade(self.junction),
            node: shade(self.node),
            clamp: shade(self.clamp),
            linker: shade(self.linker),
            anchor: shade(self.anchor),
            force: shade(self.force),
        }
    }
}

/// The palette of this run.
static CHOSEN: OnceLock<Palette> = OnceLock::new();

/// The paper's order of hues, dark enough in the middle to be seen on white.
const RED_YELLOW_BLUE: [[u8; 3]; 5] = [
    [190, 25, 35],
    [235, 110, 40],
    [235, 180, 0],
    [90, 165, 215],
    [30, 70, 180],
];
/// Entries 7 to 2 of the eight of viridis: its yellow end would vanish on white, its black one
/// could not be told from ink.
///
/// # Source
/// S. van der Walt and N. Smith, matplotlib 1.5 (2015), as sampled by `viridisLite::viridis(8)`.
const VIRIDIS: [[u8; 3]; 6] = [
    [159, 218, 58],
    [74, 193, 109],
    [31, 161, 135],
    [39, 127, 142],
    [54, 92, 141],
    [70, 51, 126],
];

/// Colours of things beside red monomers and blue rods.
const BESIDE_RED_AND_BLUE: Things = Things {
    bonds: [[120, 40, 150], [0, 150, 140]],
    axes: [[213, 94, 0], [60, 140, 40], [0, 70, 160]],
    junction: [250, 205, 30],
    node: [255, 255, 255],
    clamp: [165, 165, 165],
    linker: [40, 40, 40],
    anchor: [0, 140, 70],
    force: [20, 20, 20],
};
/// Colours of things that keep their differences for all kinds of sight.
///
/// # Source
/// M. Okabe and K. Ito, Color Universal Design (2008): vermilion, reddish purple, sky blue, blue,
/// orange, yellow.
const OKABE_ITO: Things = Things {
    bonds: [[204, 121, 167], [0, 114, 178]],
    axes: [[213, 94, 0], [86, 180, 233], [0, 0, 0]],
    junction: [240, 228, 66],
    node: [255, 255, 255],
    clamp: [165, 165, 165],
    linker: [40, 40, 40],
    anchor: [213, 94, 0],
    force: [20, 20, 20],
};

/// Lines that are told apart by what they are and not by a resolution.
const LINES: [[u8; 3]; 5] = [
    [190, 25, 35],
    [235, 150, 20],
    [60, 150, 90],
    [30, 70, 180],
    [140, 70, 160],
];
/// The same from Okabe and Ito: vermilion, orange, bluish green, blue, reddish purple.
const OKABE_ITO_LINES: [[u8; 3]; 5] = [
    [213, 94, 0],
    [230, 159, 0],
    [0, 158, 115],
    [0, 114, 178],
    [204, 121, 167],
];

/// What is given by others: data, the paper's entries.
pub(crate) const DATA: RGBColor = RGBColor(20, 20, 20);
/// What stands back.
pub(crate) const GREY: RGBColor = RGBColor(130, 130, 130);
/// What stands back further.
pub(crate) const LIGHT_GREY: RGBColor = RGBColor(165, 165, 165);

/// Chooses the palette of this run; a second choice is not heard.
pub(crate) fn choose(palette: Palette) {
    CHOSEN.get_or_init(|| palette);
}

/// The palette of this run.
pub(crate) fn chosen() -> Palette {
    *CHOSEN.get_or_init(Palette::default)
}

/// The colour of a share of rod between 0 (all monomers) and 1 (all rod).
pub(crate) fn resolution(share: f64) -> RGBColor {
    let [red, green, blue] = chosen().resolution(share);
    RGBColor(red, green, blue)
}

/// The colour of the line number `k` of those that are not resolutions.
pub(crate) fn line(k: usize) -> RGBColor {
    let lines = chosen().lines();
    let [red, green, blue] = lines[k % lines.len()];
    RGBColor(red, green, blue)
}

impl Palette {
    /// Colours at even steps of the share of rod, from 0 to 1.
    pub(crate) fn stops(self) -> &'static [[u8; 3]] {
        match self {
            Self::Paper => &RED_YELLOW_BLUE,
            Self::ColourBlind => &VIRIDIS,
        }
    }

    /// What the ends of the range of resolutions look like, as a sentence.
    pub(crate) fn ends(self) -> &'static str {
        match self {
            Self::Paper => "Red is all monomers, blue all rod.",
            Self::ColourBlind => "Light green is all monomers, dark purple all rod.",
        }
    }

    /// Names of the colours of the first and of the last stop.
    pub(crate) fn end_names(self) -> [&'static str; 2] {
        match self {
            Self::Paper => ["red", "blue"],
            Self::ColourBlind => ["light green", "dark purple"],
        }
    }

    /// Colours of things.
    pub(crate) fn things(self) -> &'static Things {
        match self {
            Self::Paper => &BESIDE_RED_AND_BLUE,
            Self::ColourBlind => &OKABE_ITO,
        }
    }

    fn lines(self) -> &'static [[u8; 3]; 5] {
        match self {
            Self::Paper => &LINES,
            Self::ColourBlind => &OKABE_ITO_LINES,
        }
    }

    /// Between the stops in a straight line.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a place between the first and the last stop, and a mean of two bytes"
    )]
    fn resolution(self, share: f64) -> [u8; 3] {
        let stops = self.stops();
        let place = share.clamp(0.0, 1.0) * (stops.len() - 1) as f64;
        let i = (place as usize).min(stops.len() - 2);
        let t = place - i as f64;
        [0, 1, 2].map(|k| {
            let (from, to) = (f64::from(stops[i][k]), f64::from(stops[i + 1][k]));
            (from + t * (to - from)) as u8
        })
    }
}

/// Relative luminance of an sRGB colour.
///
/// # Source
/// W3C, Web Content Accessibility Guidelines 2.1, relative luminance.
#[cfg(test)]
pub(super) fn luminance(colour: [u8; 3]) -> f64 {
    let linear = colour.map(|byte| {
        let v = f64::from(byte) / 255.0;
        if v <= 0.03928 {
            v / 12.92
        } else {
            ((v + 0.055) / 1.055).powf(2.4)
        }
    });
    0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ends_are_the_stops() {
        assert_eq!(Palette::Paper.resolution(0.0), [190, 25, 35]);
        assert_eq!(Palette::Paper.resolution(1.0), [30, 70, 180]);
        assert_eq!(Palette::Paper.resolution(0.5), [235, 180, 0]);
        assert_eq!(Palette::ColourBlind.resolution(-1.0), VIRIDIS[0]);
        assert_eq!(Palette::ColourBlind.resolution(2.0), VIRIDIS[5]);
    }

    /// Resolutions are in the order of their lightness, so that they differ for every kind of sight
    /// and in grey. Symptom of a swapped or mistyped stop: a step back.
    #[test]
    fn the_colour_blind_range_darkens_throughout() {
        let shades: Vec<f64> = (0..=40)
            .map(|k| luminance(Palette::ColourBlind.resolution(f64::from(k) / 40.0)))
            .collect();
        assert!(shades.is_sorted_by(|a, b| a > b), "{shades:?}");
    }

    /// Nothing is drawn that cannot be seen on white: 1.5 is the contrast of a light yellow pencil,
    /// 1 that of white on white.
    #[test]
    fn every_resolution_is_seen_on_white() {
        for palette in [Palette::Paper, Palette::ColourBlind] {
            for k in 0..=40 {
                let shade = luminance(palette.resolution(f64::from(k) / 40.0));
                assert!(1.05 / (shade + 0.05) > 1.5, "{palette:?} {k}");
            }
        }
    }
}
