//! Colours of views and pictures.

use actin_draw::page::on_dark;
use actin_draw::{OKABE_ITO, Ramp};
use serde::Serialize;

/// A set of colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Palette {
    /// Red (monomers) through yellow to blue (rod), as in the paper.
    #[default]
    Paper,
    /// Light green (monomers) to dark purple (rod); distinguishable with colour blindness and in greyscale.
    ColourBlind,
}

/// Colours of parts.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct BodyColours {
    /// Lateral and longitudinal bonds.
    pub bonds: [[u8; 3]; 2],
    /// Axes d1, d2, d3 of a frame.
    pub axes: [[u8; 3]; 3],
    /// Bonds of junctions.
    pub junction: [u8; 3],
    /// Nodes of rods.
    pub node: [u8; 3],
    /// Clamped ends.
    pub clamp: [u8; 3],
    /// Linkers.
    pub linker: [u8; 3],
    /// Fixed or moving ends of linkers outside filaments.
    pub anchor: [u8; 3],
    /// Forces, and prescribed motion of clamps.
    pub force: [u8; 3],
    /// Walls and the periodic box.
    pub wall: [u8; 3],
    /// Beads.
    pub bead: [u8; 3],
}

impl BodyColours {
    /// Applies a function to every colour.
    #[must_use]
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
            wall: shade(self.wall),
            bead: shade(self.bead),
        }
    }
}

/// Colours that are distinguishable from red monomers and blue rods.
const DISTINCT_FROM_RED_AND_BLUE: BodyColours = BodyColours {
    bonds: [[120, 40, 150], [0, 150, 140]],
    axes: [[213, 94, 0], [60, 140, 40], [0, 70, 160]],
    junction: [250, 205, 30],
    node: [255, 255, 255],
    clamp: [165, 165, 165],
    linker: [40, 40, 40],
    anchor: [0, 140, 70],
    force: [20, 20, 20],
    wall: [120, 120, 120],
    bead: [190, 120, 40],
};
/// Colours for colour-blind readers.
///
/// # Source
/// M. Okabe and K. Ito, Color Universal Design (2008): vermilion, reddish purple, sky blue, blue, orange, yellow.
const BODIES_OKABE_ITO: BodyColours = BodyColours {
    bonds: [[204, 121, 167], [0, 114, 178]],
    axes: [[213, 94, 0], [86, 180, 233], [0, 0, 0]],
    junction: [240, 228, 66],
    node: [255, 255, 255],
    clamp: [165, 165, 165],
    linker: [40, 40, 40],
    anchor: [213, 94, 0],
    force: [20, 20, 20],
    wall: [120, 120, 120],
    bead: [230, 159, 0],
};

impl Palette {
    /// Returns the colour ramp of the fraction of rod, from 0 to 1.
    pub fn ramp(self) -> Ramp {
        match self {
            Self::Paper => Ramp::RED_YELLOW_BLUE,
            Self::ColourBlind => Ramp::VIRIDIS,
        }
    }

    /// Returns a sentence that explains both ends of the ramp.
    pub fn ends(self) -> &'static str {
        match self {
            Self::Paper => "Red is all monomers, blue all rod.",
            Self::ColourBlind => "Light green is all monomers, dark purple all rod.",
        }
    }

    /// Returns the names of the first and last colour of the ramp.
    pub fn end_names(self) -> [&'static str; 2] {
        match self {
            Self::Paper => ["red", "blue"],
            Self::ColourBlind => ["light green", "dark purple"],
        }
    }

    /// Returns the colours of parts.
    pub fn body_colours(self) -> &'static BodyColours {
        match self {
            Self::Paper => &DISTINCT_FROM_RED_AND_BLUE,
            Self::ColourBlind => &BODIES_OKABE_ITO,
        }
    }

    /// Returns the colours for light and dark pages as JSON, for the HTML element `palette`.
    pub fn json(self) -> String {
        let colours = |shade: fn([u8; 3]) -> [u8; 3]| {
            let stops = |ramp: Ramp| ramp.stops().iter().copied().map(shade).collect::<Vec<_>>();
            serde_json::json!({
                "stops": stops(self.ramp()),
                "things": self.body_colours().map(shade),
                "lines": OKABE_ITO.map(shade),
                "rising": stops(Ramp::VIRIDIS).into_iter().rev().collect::<Vec<_>>(),
                "signed": stops(Ramp::BLUE_GREY_RED),
            })
        };
        serde_json::json!({ "light": colours(|c| c), "dark": colours(on_dark) }).to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use actin_draw::Colour;
    use actin_draw::page::DARK_CARD;

    #[test]
    fn every_thing_is_seen_on_the_dark_card() {
        let contrast = |one, other| Colour(one).contrast(Colour(other));
        for palette in [Palette::Paper, Palette::ColourBlind] {
            let things = palette.body_colours();
            let [first, second] = things.bonds;
            let [d1, d2, d3] = things.axes;
            let single = [things.junction, things.node, things.clamp, things.linker];
            let bound = [things.anchor, things.force, things.wall, things.bead];
            let all = [first, second, d1, d2, d3]
                .into_iter()
                .chain(single)
                .chain(bound);
            for thing in all {
                let least = contrast(thing, [255; 3]).min(3.0);
                let found = contrast(on_dark(thing), DARK_CARD);
                assert!(found >= least, "{palette:?} {thing:?}: {found} < {least}");
            }
        }
    }
}
