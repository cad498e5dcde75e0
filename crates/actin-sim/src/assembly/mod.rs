//! From a scene to bodies and interactions.
//!
//! [`Assembly::build`] is the one place that decides by kind of model; everything after it sees
//! points, frames and terms. Bodies stand in filament order: monomers, junction frames, rod
//! nodes and segments follow one another as they do along the filament.

mod bonded;
mod build;
mod describe;
mod drive;
mod lattice;
mod law;
mod models;
mod parts;
mod ramp;
mod range;
mod reaction;
mod slip;

pub use bonded::JunctionBond;
pub use drive::Drive;
pub use parts::{BodyKind, Counts, FrameInfo, Part, PointInfo, Resolution, SectionSpan, Term};
pub(crate) use ramp::Ramp;
pub use range::BeyondRange;
pub use reaction::{Clamped, Reaction};

use crate::scene::{End, Scene};
use actin_cosserat::RodLayout;
use actin_coupling::Linker;
use actin_mechanics::{State, System, UnitQuaternion, Vector3};

/// A scene, ready to run.
#[derive(Debug)]
pub struct Assembly {
    /// The scene that was built, every default filled in.
    pub scene: Scene,
    /// Bodies and interactions.
    pub system: System,
    /// What each interaction of the system is, in the same order.
    pub terms: Vec<Term>,
    /// What each point is.
    pub points: Vec<PointInfo>,
    /// What each frame is.
    pub frames: Vec<FrameInfo>,
    /// Sections as resolved, in order.
    pub sections: Vec<SectionSpan>,
    /// Rods: the index of the section and what it is made of.
    pub(crate) rods: Vec<(usize, RodLayout)>,
    /// Largest twist of the data behind their laws (rad/nm), if these have data.
    pub(crate) twist_range: Option<f64>,
    /// Largest curvature of such data (rad/nm).
    pub(crate) bend_range: Option<f64>,
    /// The ends that are held.
    pub clamps: Vec<Clamped>,
    /// The linkers, in the order of the scene.
    pub linkers: Vec<Linker>,
    /// For each term the arc lengths (nm) between which each of its elements lies; empty for loads
    /// and linkers, which are no part of the filament.
    pub(crate) spans: Vec<Vec<[f64; 2]>>,
    /// What the path of the scene moves.
    pub drive: Drive,
    /// The state as built, unloaded and at rest.
    pub rest: State,
}

impl Assembly {
    /// Number of bodies and elements of each kind.
    pub fn counts(&self) -> Counts {
        let points = |kind| self.points.iter().filter(|p| p.kind == kind).count();
        let frames = |kind| self.frames.iter().filter(|f| f.kind == kind).count();
        let state = self.system.state();
        let free_points = (0..self.points.len()).filter(|&i| state.points.is_free(i));
        let free_frames = (0..self.frames.len()).filter(|&i| state.frames.is_free(i));
        Counts {
            monomers: points(BodyKind::Monomer),
            bonds: self.sections.iter().map(SectionSpan::bonds).sum(),
            segments: frames(BodyKind::Segment),
            junctions: self.sections.len() - 1,
            dofs: 3 * (free_points.count() + free_frames.count())
                + state
                    .sliders
                    .iter()
                    .map(|s| s.directions.len())
                    .sum::<usize>(),
        }
    }

    /// Resolved length of the filament (nm), from arc length 0 to the tip or the inner held
    /// monomer at its end.
    pub fn length_nm(&self) -> f64 {
        self.sections.last().map_or(0.0, |section| section.to_nm)
    }

    /// Points whose mean is the tip at `end`: the last node of a rod, or the last two monomers
    /// (of a held monomer end: the inner one).
    pub fn tip_points(&self, end: End) -> &[usize] {
        let section = match end {
            End::Start => self.sections.first(),
            End::End => self.sections.last(),
        };
        section.map_or(&[], |section| section.tip_points(end))
    }

    /// Position of the tip at `end` in `state` (nm, lab frame).
    pub fn tip_nm(&self, state: &State, end: End) -> Vector3 {
        let points = self.tip_points(end);
        let sum: Vector3 = points.iter().map(|&i| state.points.position.get(i)).sum();
        sum / points.len() as f64
    }

    /// Point `i` brought to the centre line: a node as it is, a monomer's centre moved inward
    /// along its radial axis by the radius of the helix (nm, lab frame).
    pub fn centre_line_nm(&self, state: &State, i: usize) -> Vector3 {
        let position = state.points.position.get(i);
        match self.points[i].frame {
            Some(frame) => {
                let radial = state.frames.orientation.get(frame) * Vector3::x();
                position - radial * self.scene.filament.monomers.radius_nm
            }
            None => position,
        }
    }

    /// Turns a free filament as it stands about lab z, along which it is built, by `angle` (rad):
    /// another start for the same equilibria. Anchors and loads stay.
    ///
    /// # Panics
    /// If an end is clamped.
    pub fn roll(&mut self, angle: f64) {
        assert!(self.clamps.is_empty(), "a clamped end does not roll");
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angle);
        let state = self.system.state_mut();
        for i in 0..state.points.len() {
            let place = turn * state.points.position.get(i);
            state.points.position.set(i, place);
        }
        for i in 0..state.frames.len() {
            let orientation = turn * state.frames.orientation.get(i);
            state.frames.orientation.set(i, orientation);
        }
    }
}
