//! From a scene to bodies and interactions.
//!
//! [`Assembly::build`] is the one place that decides by kind of model; everything after it sees
//! points, frames and terms. Bodies stand filament by filament and in filament order: monomers,
//! junction frames, rod nodes and segments follow one another as they do along the filament.

mod beyond_use;
mod bonded;
mod build;
mod built;
mod describe;
mod drive;
mod extrapolation;
mod friction;
mod hinge;
mod imperfection;
mod kinetics;
mod lattice;
mod law;
mod ledger;
mod models;
mod parts;
mod ramp;
mod range;
mod reaction;
mod repelled;
mod several_states;
mod slip;
mod unstable_twist;

pub use beyond_use::BeyondUse;
pub(crate) use beyond_use::worst as worst_of;
pub use bonded::JunctionBond;
pub(crate) use build::Sampled;
pub use drive::Drive;
pub use extrapolation::MeasuredError;
pub(crate) use kinetics::{COARSEST, Kinetics, Log};
pub use kinetics::{Happening, LinkerEvent};
pub(crate) use lattice::cells_nm;
pub use ledger::Booked;
pub(crate) use models::ellipsoids;
pub(crate) use parts::Rod;
pub use parts::{
    BodyKind, Counts, FilamentSpan, FrameInfo, Part, PointInfo, Resolution, SectionSpan, Term,
};
pub(crate) use ramp::{Ramp, StageTimes};
pub use range::{BeyondRange, Fluctuations};
pub(crate) use range::{RangeWatch, Ranges};
pub use reaction::{Clamped, Reaction};
pub(crate) use repelled::Repelled;
pub use unstable_twist::UnstableTwist;
pub(crate) use unstable_twist::{TwistRecords, TwistWatch};

use crate::observe::Observers;
use crate::scene::{End, HeldEnds, Monomers, Scene};
use crate::trade::Chosen;
use actin_coupling::Linker;
use actin_mechanics::{ControlId, Ledger, State, System, UnitQuaternion, Vector3};
use nalgebra::Unit;
use std::ops::Range;
use std::sync::Arc;

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
    /// Sections as resolved, in order, those of one filament after those of another.
    pub sections: Vec<SectionSpan>,
    /// The filaments, in the order of the scene.
    pub filaments: Vec<FilamentSpan>,
    /// The rods among the sections.
    pub(crate) rods: Vec<Rod>,
    /// The ends that are held.
    pub clamps: Vec<Clamped>,
    /// Which of them holds which end.
    pub(crate) held: HeldEnds,
    /// The controls of the factors of its loads, in the order of the scene.
    pub(crate) loads: Vec<ControlId>,
    /// The linkers, in the order of the scene; those that step at their first place.
    pub linkers: Vec<Linker>,
    /// Those of them to which something happens in time, if there are some.
    pub(crate) kinetics: Option<Arc<Kinetics>>,
    /// Where a motion books what comes from outside; none of other tasks.
    pub(crate) ledger: Option<Ledger>,
    /// What repels them, if anything does.
    pub(crate) repelled: Option<Repelled>,
    /// For each term the arc lengths (nm) between which each of its elements lies; empty for loads
    /// and linkers, which are no part of a filament.
    pub(crate) spans: Vec<Vec<[f64; 2]>>,
    /// What is observed of every record.
    pub(crate) observers: Observers,
    /// What the path of the scene moves.
    pub drive: Drive,
    /// The state as built, unloaded and at rest, without imperfections.
    pub rest: State,
    /// The runs of monomers whose interfaces are quasi-harmonic.
    pub(crate) sampled: Vec<Sampled>,
    /// How its sections were chosen, if the program chose them.
    pub chosen: Option<Chosen>,
    /// Time that it took to build (s).
    pub(crate) build_s: f64,
    /// Memory that the task takes but for its records, estimated (bytes).
    pub(crate) bytes: f64,
}

impl Assembly {
    /// Number of bodies and elements of each kind, in all filaments.
    pub fn counts(&self) -> Counts {
        let (points, frames) = (0..self.points.len(), 0..self.frames.len());
        self.counts_in(0..self.filaments.len(), points, frames)
    }

    /// The same of one filament.
    ///
    /// # Panics
    /// If there is no such filament.
    pub fn counts_of(&self, filament: usize) -> Counts {
        let span = &self.filaments[filament];
        let (points, frames) = (span.points.clone(), span.frames.clone());
        self.counts_in(filament..filament + 1, points, frames)
    }

    fn counts_in(
        &self,
        filaments: Range<usize>,
        points: Range<usize>,
        frames: Range<usize>,
    ) -> Counts {
        let state = self.system.state();
        let free_points = points.clone().filter(|&i| state.points.is_free(i));
        let free_frames = frames.clone().filter(|&i| state.frames.is_free(i));
        let held = filaments
            .clone()
            .flat_map(|f| [(f, End::Start), (f, End::End)]);
        let slides = held.filter_map(|(filament, end)| {
            let clamp = self.clamp_at(filament, end)?;
            Some(clamp.slides.directions(clamp.axis).len())
        });
        let kinds = |kind| {
            let points = self.points[points.clone()].iter().map(|p| p.kind);
            points.filter(|k| *k == kind).count()
        };
        let segments = self.frames[frames.clone()].iter();
        let sections = self.filaments[filaments].iter().map(|f| f.sections.clone());
        Counts {
            monomers: kinds(BodyKind::Monomer),
            segments: segments.filter(|f| f.kind == BodyKind::Segment).count(),
            bonds: sections
                .clone()
                .flat_map(|sections| &self.sections[sections])
                .map(SectionSpan::bonds)
                .sum(),
            junctions: sections
                .flat_map(|sections| sections.start..sections.end - 1)
                .filter(|&section| self.is_junction(section))
                .count(),
            dofs: 3 * (free_points.count() + free_frames.count()) + slides.sum::<usize>(),
        }
    }

    /// Resolved length of filament 0 (nm), from arc length 0 to the tip or the inner held monomer
    /// at its end.
    pub fn length_nm(&self) -> f64 {
        self.length_of(0)
    }

    /// The same of any filament.
    ///
    /// # Panics
    /// If there is no such filament.
    pub fn length_of(&self, filament: usize) -> f64 {
        let sections = self.sections_of(filament);
        sections.last().map_or(0.0, |section| section.to_nm)
    }

    /// The sections of one filament.
    ///
    /// # Panics
    /// If there is no such filament.
    pub fn sections_of(&self, filament: usize) -> &[SectionSpan] {
        &self.sections[self.filaments[filament].sections.clone()]
    }

    /// The filament that a section belongs to.
    ///
    /// # Panics
    /// If there is no such section.
    pub fn filament_of_section(&self, section: usize) -> usize {
        let is_past = |f: &FilamentSpan| f.sections.end <= section;
        let filament = self.filaments.partition_point(is_past);
        assert!(filament < self.filaments.len(), "no section {section}");
        filament
    }

    /// The filament that a point belongs to; points of one filament stand together.
    pub fn filament_of_point(&self, point: usize) -> usize {
        self.filaments.partition_point(|f| f.points.end <= point)
    }

    /// The frame to be drawn at a point: a monomer's own, of a node that of the segment which begins there, at
    /// the end of a rod of the last; none of a node without a segment.
    ///
    /// # Panics
    /// If there is no such point.
    pub fn frame_of_point(&self, point: usize) -> Option<usize> {
        self.points[point].frame.or_else(|| {
            let behind = |s: &SectionSpan| s.points.end <= point;
            let section = self.sections.get(self.sections.partition_point(behind))?;
            let begins_there = section.frames.start + point.checked_sub(section.points.start)?;
            let last = section.frames.clone().next_back()?;
            Some(begins_there.min(last))
        })
    }

    /// The filament that a frame belongs to.
    pub fn filament_of_frame(&self, frame: usize) -> usize {
        self.filaments.partition_point(|f| f.frames.end <= frame)
    }

    /// The clamp at one end of a filament; none if it is free.
    pub fn clamp_at(&self, filament: usize, end: End) -> Option<&Clamped> {
        let clamp = self.held.clamp_at(filament, end)?;
        Some(&self.clamps[clamp])
    }

    /// Points whose mean is the tip of filament 0 at `end`: the last node of a rod, or the last two
    /// monomers (of a held monomer end: the inner one).
    pub fn tip_points(&self, end: End) -> &[usize] {
        self.tip_points_of(0, end)
    }

    /// The same of any filament.
    ///
    /// # Panics
    /// If there is no such filament.
    pub fn tip_points_of(&self, filament: usize, end: End) -> &[usize] {
        let sections = self.sections_of(filament);
        let section = match end {
            End::Start => sections.first(),
            End::End => sections.last(),
        };
        section.map_or(&[], |section| section.tip_points(end))
    }

    /// Position of the tip of filament 0 at `end` in `state` (nm, lab frame).
    pub fn tip_nm(&self, state: &State, end: End) -> Vector3 {
        self.tip_of(0, state, end)
    }

    /// The same of any filament.
    ///
    /// # Panics
    /// If there is no such filament.
    pub fn tip_of(&self, filament: usize, state: &State, end: End) -> Vector3 {
        let points = self.tip_points_of(filament, end);
        let sum: Vector3 = points.iter().map(|&i| state.points.position.get(i)).sum();
        sum / points.len() as f64
    }

    /// Point `i` brought to the centre line: a node as it is, a monomer's centre moved inward
    /// along its radial axis by the radius of the helix (nm, lab frame).
    ///
    /// # Panics
    /// If there is no such point.
    pub fn centre_line_nm(&self, state: &State, i: usize) -> Vector3 {
        let position = state.points.position.get(i);
        match self.points[i].frame {
            Some(frame) => {
                let radial = state.frames.orientation.get(frame) * Vector3::x();
                position - radial * self.monomers_of(self.filament_of_point(i)).radius_nm
            }
            None => position,
        }
    }

    /// Parameters of the monomers of one filament.
    ///
    /// # Panics
    /// If there is no such filament.
    pub fn monomers_of(&self, filament: usize) -> &Monomers {
        let filament = self.scene.filament_at(filament);
        &filament.expect("the scene has this filament").monomers
    }

    /// The controls of the factors of its loads, in the order of the scene.
    pub fn load_controls(&self) -> &[ControlId] {
        &self.loads
    }

    /// Names of what the scene observes, in the order of the numbers of a record.
    pub fn observed(&self) -> &[String] {
        self.observers.columns()
    }

    /// Turns every filament as it stands about the axis along which it is built, by `angle` (rad):
    /// another start for the same equilibria. Anchors and loads stay.
    ///
    /// # Panics
    /// If an end is clamped.
    pub fn roll(&mut self, angle: f64) {
        assert!(self.clamps.is_empty(), "a clamped end does not roll");
        let state = self.system.state_mut();
        for filament in &self.filaments {
            let axis = Unit::new_normalize(filament.axis());
            let turn = UnitQuaternion::from_axis_angle(&axis, angle);
            for i in filament.points.clone() {
                let arm = state.points.position.get(i) - filament.origin_nm;
                let place = filament.origin_nm + turn * arm;
                state.points.position.set(i, place);
            }
            for i in filament.frames.clone() {
                let orientation = turn * state.frames.orientation.get(i);
                state.frames.orientation.set(i, orientation);
            }
        }
    }
}
