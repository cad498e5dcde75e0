//! Where a filament that is built along a curve stands.

use crate::scene::Curve;
use actin_mechanics::{UnitQuaternion, Vector3};

/// The axis of a filament as built, seen as if it began at the origin along lab +z: the curve of its shape, but
/// for what rods miss of it, whose segments are straight and as long as at rest. What follows such a rod is
/// shifted with its end.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Built {
    curve: Curve,
    sections: Vec<Shifted>,
}

/// A section with its shift from the curve (nm) at start and end.
#[derive(Clone, Debug, PartialEq)]
struct Shifted {
    span: [f64; 2],
    shifts: [Vector3; 2],
}

impl Built {
    pub(super) fn new(curve: Curve) -> Self {
        Self {
            curve,
            sections: Vec::new(),
        }
    }

    /// The curve.
    pub(super) fn curve(&self) -> &Curve {
        &self.curve
    }

    /// Shift of the end of the last section (nm).
    pub(super) fn last_shift(&self) -> Vector3 {
        (self.sections.last()).map_or_else(Vector3::zeros, |section| section.shifts[1])
    }

    /// Appends a section that spans these arc lengths (nm), with the shift of its end.
    pub(super) fn push(&mut self, span: [f64; 2], shift: Vector3) {
        let shifts = [self.last_shift(), shift];
        self.sections.push(Shifted { span, shifts });
    }

    /// Place (nm) and frame of the axis at an arc length.
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
