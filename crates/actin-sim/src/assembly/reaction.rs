//! What a clamp has to bear.

use crate::scene::{End, Slides};
use actin_mechanics::{Loads, State, UnitQuaternion, Vector3};

/// A held end: which bodies are held, and the point about which torques are taken.
#[derive(Clone, Debug, PartialEq)]
pub struct Clamped {
    /// Index of the filament.
    pub filament: usize,
    /// Which end.
    pub end: End,
    /// Held points.
    pub points: Vec<usize>,
    /// Held frames; none of a pinned end without a hinge.
    pub frames: Vec<usize>,
    /// The clamped point on the axis as built (nm, lab frame).
    pub about_nm: Vector3,
    /// Along which directions the end slides.
    pub slides: Slides,
    /// Unit vector along the filament as built (lab frame).
    pub(super) axis: Vector3,
    /// Position of the first held point minus the clamped point, as built (nm, lab frame).
    pub(super) arm_nm: Vector3,
    /// Orientation of the first held frame as built, of the filament where none is held.
    pub(super) rest: UnitQuaternion,
}

/// Force and torque that hold an end where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reaction {
    /// Force on the filament (pN, lab frame).
    pub force_pn: Vector3,
    /// Torque on the filament about the clamped point (pN nm, lab frame).
    pub torque_pn_nm: Vector3,
}

impl Clamped {
    /// Where the clamped point is in `state` (nm, lab frame): it moves with the held bodies.
    pub fn point_nm(&self, state: &State) -> Vector3 {
        let place = state.points.position.get(self.points[0]);
        match self.frames.first() {
            Some(frame) => {
                let turn = state.frames.orientation.get(*frame) * self.rest.inverse();
                place - turn * self.arm_nm
            }
            // What is pinned stands on the axis.
            None => place - self.arm_nm,
        }
    }

    /// The reaction in `state` under `loads`: minus what the held bodies feel. Along directions in which the end
    /// slides the clamp bears nothing: there the loads are what moves the end, shared alike by its points, which
    /// are of one mass.
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
