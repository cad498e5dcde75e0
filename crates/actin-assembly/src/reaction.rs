//! Reaction force and torque at a clamp.

use crate::scene::{End, FreeTranslation};
use actin_mechanics::{Loads, State, UnitQuaternion, Vector3};

/// Clamped end, its held bodies and the reference point of its torque.
#[derive(Clone, Debug, PartialEq)]
pub struct Clamped {
    /// Index of the filament.
    pub filament: usize,
    /// End of the filament.
    pub end: End,
    /// Held points.
    pub points: Vec<usize>,
    /// Held frames; empty for a pinned end without a hinge.
    pub frames: Vec<usize>,
    /// Clamped point on the axis as built (nm, lab frame).
    pub about_nm: Vector3,
    /// Sliding directions of the end.
    pub slides: FreeTranslation,
    pub(super) axis: Vector3,
    /// Position of the first held point minus the clamped point, as built (nm, lab frame).
    pub(super) arm_nm: Vector3,
    /// Orientation as built of the first held frame, or of the filament if no frame is held.
    pub(super) rest: UnitQuaternion,
}

impl Clamped {
    /// Returns the outermost held frame of a clamp at this end of its filament; `None` for a pin.
    pub fn outermost_frame(&self, end: End) -> Option<usize> {
        match end {
            End::Start => self.frames.first().copied(),
            End::End => self.frames.last().copied(),
        }
    }
}

/// Force and torque of a clamp on its filament.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reaction {
    /// Force on the filament (pN, lab frame).
    pub force_pn: Vector3,
    /// Torque on the filament about the clamped point (pN nm, lab frame).
    pub torque_pn_nm: Vector3,
}

impl Clamped {
    /// Position of the clamped point in `state` (nm, lab frame). It moves with the held bodies.
    pub fn point_nm(&self, state: &State) -> Vector3 {
        let place = state.points.position.get(self.points[0]);
        match self.frames.first() {
            Some(frame) => {
                let turn = state.frames.orientation.get(*frame) * self.rest.inverse();
                place - turn * self.arm_nm
            }
            // A pinned point lies on the axis.
            None => place - self.arm_nm,
        }
    }

    /// Reaction in `state` under `loads`: minus the loads on the held bodies. Components along
    /// sliding directions are zero, because the loads there accelerate the end. The held points
    /// share that acceleration equally, having equal masses.
    pub fn reaction(&self, state: &State, loads: &Loads) -> Reaction {
        let about = self.point_nm(state);
        let felt: Vector3 = self.points.iter().map(|&i| loads.force.get(i)).sum();
        let free: Vector3 = self
            .slides
            .directions(self.axis)
            .iter()
            .map(|d| d * d.dot(&felt))
            .sum();
        let share = free / self.points.len() as f64;
        let moments: Vector3 = self
            .points
            .iter()
            .map(|&i| (state.points.position.get(i) - about).cross(&(loads.force.get(i) - share)))
            .sum();
        let couples: Vector3 = self
            .frames
            .iter()
            .map(|&i| state.frames.orientation.get(i) * loads.torque.get(i))
            .sum();
        Reaction {
            force_pn: -(felt - free),
            torque_pn_nm: -(moments + couples),
        }
    }
}
