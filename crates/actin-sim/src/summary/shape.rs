//! Twist, writhe, link and distance from the axis in `summary.json`.

use crate::Assembly;
use crate::shape::{self, Ribbon};
use actin_mechanics::State;
use serde::{Deserialize, Serialize};

/// Shape of a filament, extended straight beyond both ends.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ShapeSummary {
    /// Twist from end to end (turns); over-twist is positive.
    pub twist_turns: f64,
    /// Writhe of the centre line; `None` if its points times the points of all filaments exceed
    /// 1e8.
    pub writhe: Option<f64>,
    /// Rotation of the end relative to the start (turns), equal to twist plus writhe. `None` unless
    /// both ends are clamped and parallel.
    pub link_turns: Option<f64>,
    /// Largest distance of the centre line from the initial axis (nm).
    pub largest_distance_nm: f64,
}

impl ShapeSummary {
    pub(super) fn new(
        assembly: &Assembly,
        filament: usize,
        (state, parameter): (&State, f64),
    ) -> Self {
        let ribbon = Ribbon::from_state(assembly, filament, state);
        Self {
            twist_turns: ribbon.twist(),
            writhe: shape::writhe_of(assembly, filament, &ribbon),
            link_turns: assembly.link_at(filament, parameter),
            largest_distance_nm: ribbon.largest_distance_nm(),
        }
    }

    pub(super) fn numbers(&self) -> impl Iterator<Item = (String, f64)> {
        let all = [
            ("twist_turns", Some(self.twist_turns)),
            ("writhe", self.writhe),
            ("link_turns", self.link_turns),
            ("largest_distance_nm", Some(self.largest_distance_nm)),
        ];
        all.into_iter()
            .filter_map(|(key, value)| Some((key.to_owned(), value?)))
    }
}
