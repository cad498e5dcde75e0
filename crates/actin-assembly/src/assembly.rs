//! Assembly of a scene: bodies, interactions, prescribed motion, and descriptions of all of them.

use crate::kinetics::Kinetics;
use crate::repulsion::RepulsionModel;
use crate::rod::Rod;
use crate::scene::{ClampedEnds, End, Filament, Monomers, RodModel, Scene};
use crate::{
    BodyKind, Clamped, Counts, Drive, FilamentSpan, FrameInfo, InterfaceSampling, PointInfo,
    SectionChoice, SectionSpan, Term,
};
use actin_coupling::{Linker, PeriodicCell, Site};
use actin_mechanics::{ControlId, EnergyBalance, State, System, UnitQuaternion, Vector3};
use nalgebra::Unit;
use std::ops::Range;
use std::sync::Arc;

/// Bodies, interactions and prescribed motion of a scene.
#[derive(Debug)]
pub struct Assembly {
    /// The scene with all defaults filled in.
    pub scene: Scene,
    /// Bodies and interactions.
    pub system: System,
    /// Description of each interaction of the system, in the same order.
    pub terms: Vec<Term>,
    /// Description of each point.
    pub points: Vec<PointInfo>,
    /// Description of each frame.
    pub frames: Vec<FrameInfo>,
    /// Resolved sections, filament by filament.
    pub sections: Vec<SectionSpan>,
    /// Filaments in the order of the scene.
    pub filaments: Vec<FilamentSpan>,
    pub(crate) rods: Vec<Rod>,
    /// Clamped ends.
    pub clamps: Vec<Clamped>,
    /// Clamps and hinges by filament and end.
    pub held: ClampedEnds,
    pub(crate) loads: Vec<ControlId>,
    /// Periodic box.
    pub cell: Option<PeriodicCell>,
    /// Linkers in the order of the scene; stepping linkers at their first place.
    pub linkers: Vec<Linker>,
    /// Centres of beads and their radii (nm), in the order of the scene.
    pub(crate) beads: Vec<(Site, f64)>,
    /// Linkers that bind, unbind or step.
    pub kinetics: Option<Arc<Kinetics>>,
    /// Controls that accumulate work and heat of a motion.
    pub energy_balance: Option<EnergyBalance>,
    /// Repulsion between filaments and from walls.
    pub repelled: Option<RepulsionModel>,
    /// Arc length interval (nm) of each element of each term; empty for loads and linkers.
    pub spans: Vec<Vec<[f64; 2]>>,
    /// Prescribed motion along the path of the scene.
    pub drive: Drive,
    /// State as built: unloaded, at rest and without imperfections.
    pub rest: State,
    pub(crate) sampled: Vec<InterfaceSampling>,
    /// Choice of automatic sections, if the scene has any.
    pub chosen: Option<SectionChoice>,
    /// Time of the construction (s).
    pub build_s: f64,
    /// Estimated memory of the task without its records (bytes).
    pub bytes: f64,
    pub(crate) is_started: bool,
}

impl Assembly {
    /// Returns the number of bodies and elements of each kind in all filaments.
    pub fn counts(&self) -> Counts {
        let filaments = 0..self.filaments.len();
        filaments.map(|filament| self.counts_of(filament)).sum()
    }

    /// Returns the number of bodies and elements of each kind in one filament.
    ///
    /// # Panics
    /// If the index is out of range.
    pub fn counts_of(&self, filament: usize) -> Counts {
        let span = &self.filaments[filament];
        let state = self.system.state();
        let free_points = span.points.clone().filter(|&i| state.points.is_free(i));
        let free_frames = span.frames.clone().filter(|&i| state.frames.is_free(i));
        let ends = [End::Start, End::End].into_iter();
        let clamps = ends.filter_map(|end| self.clamp_at(filament, end));
        let slides = clamps.map(|clamp| clamp.slides.directions(clamp.axis).len());
        let points = self.points[span.points.clone()].iter();
        let frames = self.frames[span.frames.clone()].iter();
        let sections = span.sections.start..span.sections.end - 1;
        Counts {
            monomers: points.filter(|p| p.kind == BodyKind::Monomer).count(),
            bonds: self
                .sections_of(filament)
                .iter()
                .map(SectionSpan::bonds)
                .sum(),
            segments: frames.filter(|f| f.kind == BodyKind::Segment).count(),
            junctions: sections
                .filter(|&section| self.is_junction(section))
                .count(),
            dofs: 3 * (free_points.count() + free_frames.count()) + slides.sum::<usize>(),
        }
    }

    /// Resolved length of filament 0 (nm), from arc length 0 to the tip or the inner held monomer.
    pub fn length_nm(&self) -> f64 {
        self.length_of(0)
    }

    /// Resolved length of a filament (nm); see [`length_nm`](Self::length_nm).
    ///
    /// # Panics
    /// If the index is out of range.
    pub fn length_of(&self, filament: usize) -> f64 {
        let sections = self.sections_of(filament);
        sections.last().map_or(0.0, |section| section.to_nm)
    }

    /// Returns the sections of one filament.
    ///
    /// # Panics
    /// If the index is out of range.
    pub fn sections_of(&self, filament: usize) -> &[SectionSpan] {
        &self.sections[self.filaments[filament].sections.clone()]
    }

    /// Returns the filament of a section.
    ///
    /// # Panics
    /// If the index is out of range.
    pub fn filament_of_section(&self, section: usize) -> usize {
        let is_past = |f: &FilamentSpan| f.sections.end <= section;
        let filament = self.filaments.partition_point(is_past);
        assert!(filament < self.filaments.len(), "no section {section}");
        filament
    }

    /// Returns the filament of a section and the index of the section in this filament.
    ///
    /// # Panics
    /// If the index is out of range.
    pub fn place_of_section(&self, section: usize) -> (usize, usize) {
        let filament = self.filament_of_section(section);
        (filament, section - self.filaments[filament].sections.start)
    }

    /// Returns the scene of a filament.
    ///
    /// # Panics
    /// If the index is out of range.
    pub fn written(&self, filament: usize) -> &Filament {
        let filament = self.scene.filament_at(filament);
        filament.expect("the scene has this filament")
    }

    /// Returns the rod model of a section; for monomers, the model of the rod that represents them.
    ///
    /// # Panics
    /// If the index is out of range.
    pub fn rod_model_of(&self, section: usize) -> RodModel {
        let (filament, i) = self.place_of_section(section);
        let filament = self.written(filament);
        filament.sections[i].rod_model(&filament.rod)
    }

    /// Returns the rod of a section; `None` for monomers.
    pub(crate) fn rod_of(&self, section: usize) -> Option<&Rod> {
        let found = self.rods.binary_search_by_key(&section, |rod| rod.section);
        Some(&self.rods[found.ok()?])
    }

    /// Ratio of the longest segment of a rod to its persistence length at the thermal energy `kt` (pN nm). `None` for
    /// monomers.
    pub fn segment_over_persistence_length(&self, section: usize, kt: f64) -> Option<f64> {
        Some(self.rod_of(section)?.over_persistence_length(kt))
    }

    /// Returns the filament of a point.
    pub fn filament_of_point(&self, point: usize) -> usize {
        self.filaments.partition_point(|f| f.points.end <= point)
    }

    /// Returns the frame shown at a point: a monomer's frame, or the frame of the segment that
    /// begins at a node. The last node has the frame of the last segment. `None` for a node without
    /// a segment.
    ///
    /// # Panics
    /// If the index is out of range.
    pub fn frame_of_point(&self, point: usize) -> Option<usize> {
        self.points[point].frame.or_else(|| {
            let behind = |s: &SectionSpan| s.points.end <= point;
            let section = self.sections.get(self.sections.partition_point(behind))?;
            let begins_there = section.frames.start + point.checked_sub(section.points.start)?;
            let last = section.frames.clone().next_back()?;
            Some(begins_there.min(last))
        })
    }

    /// Returns the filament of a frame.
    pub fn filament_of_frame(&self, frame: usize) -> usize {
        self.filaments.partition_point(|f| f.frames.end <= frame)
    }

    /// Returns the clamp at one end of a filament; `None` if the end is free.
    pub fn clamp_at(&self, filament: usize, end: End) -> Option<&Clamped> {
        let clamp = self.held.clamp_at(filament, end)?;
        Some(&self.clamps[clamp])
    }

    /// Returns the points whose mean is the tip of a filament at `end`: the last node of a rod, or
    /// the last two monomers. At a held end of monomers it is the inner held monomer.
    ///
    /// # Panics
    /// If the index is out of range.
    pub fn tip_points_of(&self, filament: usize, end: End) -> Range<usize> {
        let section = self.written(filament).end_index(end);
        self.sections_of(filament)[section].tip_points(end)
    }

    /// Position of the tip of filament 0 at `end` in `state` (nm, lab frame).
    pub fn tip_nm(&self, state: &State, end: End) -> Vector3 {
        self.tip_of(0, state, end)
    }

    /// Position of the tip of a filament at `end` in `state` (nm, lab frame).
    ///
    /// # Panics
    /// If the index is out of range.
    pub fn tip_of(&self, filament: usize, state: &State, end: End) -> Vector3 {
        let points = self.tip_points_of(filament, end);
        let count = points.len() as f64;
        let sum: Vector3 = points.map(|i| state.points.position.get(i)).sum();
        sum / count
    }

    /// Point `i` projected to the centre line (nm, lab frame). Nodes are unchanged; a monomer's
    /// centre moves inward along its radial axis by the radius of the helix.
    ///
    /// # Panics
    /// If the index is out of range.
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
    /// If the index is out of range.
    pub fn monomers_of(&self, filament: usize) -> &Monomers {
        &self.written(filament).monomers
    }

    /// Controls of the load factors, in the order of the scene.
    pub fn load_controls(&self) -> &[ControlId] {
        &self.loads
    }

    /// Rotates every filament about its initial axis by `angle` (rad), as a different initial guess
    /// for the same equilibria. Anchors and loads are unchanged.
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
