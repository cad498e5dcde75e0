//! Reference axis of a curved filament.

use crate::scene::Curve;
use actin_mechanics::{UnitQuaternion, Vector3};

/// Axis of a filament as built, with its start at the origin and its tangent along lab +z.
///
/// The axis is the curve of the filament's shape plus a shift: the segments of rods are straight
/// and have their rest length, so that the end of a rod deviates from the curve. Later sections are
/// shifted with that end.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct BuiltAxis {
    curve: Curve,
    sections: Vec<ShiftedSection>,
}

#[derive(Clone, Debug, PartialEq)]
struct ShiftedSection {
    span: [f64; 2],
    shifts: [Vector3; 2],
}

impl BuiltAxis {
    pub(super) fn new(curve: Curve) -> Self {
        Self {
            curve,
            sections: Vec::new(),
        }
    }

    pub(super) fn curve(&self) -> &Curve {
        &self.curve
    }

    pub(super) fn last_shift(&self) -> Vector3 {
        (self.sections.last()).map_or_else(Vector3::zeros, |section| section.shifts[1])
    }

    pub(super) fn push(&mut self, span: [f64; 2], shift: Vector3) {
        let shifts = [self.last_shift(), shift];
        self.sections.push(ShiftedSection { span, shifts });
    }

    pub(crate) fn at(&self, s_nm: f64) -> (Vector3, UnitQuaternion) {
        let (place, frame) = self.curve.at(s_nm);
        let past = self
            .sections
            .partition_point(|section| section.span[1] < s_nm);
        let section = self.sections.get(past).or(self.sections.last());
        let shift = section.map_or_else(Vector3::zeros, |section| {
            let [from, to] = section.span;
            let share = ((s_nm - from) / (to - from)).clamp(0.0, 1.0);
            section.shifts[0] * (1.0 - share) + section.shifts[1] * share
        });
        (place + shift, frame)
    }
}
