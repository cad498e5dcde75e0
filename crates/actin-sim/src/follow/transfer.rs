//! Transfer of a state to another resolution of the same filament.

use super::field::{CrossSection, Field};
use super::momentum::{Bodies, Momentum};
use crate::scene::{SceneProblem, Task};
use crate::{Assembly, At, BodyKind};
use actin_assembly::whole::to_index;
use actin_mechanics::{State, UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Tolerance (nm) for equal arc lengths of bodies.
const SAME_PLACE_NM: f64 = 1e-6;

/// Switch of cells and its effect on energy and momentum.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Switch {
    /// Steps since the start of the motion.
    pub step: u64,
    /// Time since the start (ns).
    pub time_ns: f64,
    /// Arc length intervals (nm) that became monomers.
    pub to_monomers: Vec<[f64; 2]>,
    /// Arc length intervals (nm) that became a rod.
    pub to_rod: Vec<[f64; 2]>,
    /// Change of the kinetic and potential energy (pN nm).
    pub energy_pn_nm: f64,
    /// Change of the momentum (ag nm/ns), round-off only.
    pub momentum_change: f64,
    /// Change of the angular momentum about the origin (ag nm^2/ns), round-off only.
    pub angular_momentum_change: f64,
}

pub(super) struct Transfer<'a> {
    pub(super) from: &'a Assembly,
    pub(super) to: &'a Assembly,
    /// Arc length intervals of the cells that become monomers (nm).
    pub(super) to_monomers: Vec<[f64; 2]>,
    /// Arc length intervals of the cells that become a rod (nm).
    pub(super) to_rod: Vec<[f64; 2]>,
    pub(super) step: u64,
    pub(super) time_ns: f64,
}

impl Transfer<'_> {
    /// Returns the state of the new bodies that continues `old`, and the switch.
    ///
    /// # Errors
    /// If the new bodies do not settle.
    pub(super) fn state(&self, old: &State, task: &Task) -> Result<(State, Switch), SceneProblem> {
        let mut state = self.to.rest.clone();
        state.controls.clone_from(&old.controls);
        state.time = old.time;
        let made = self.place(old, &mut state);
        self.slide(old, &mut state);
        self.to.place_controls(&mut state, At::Time(self.time_ns));
        let bodies = self.bodies(&state, |s_nm| self.is_switched(s_nm));
        let settled = self.settled(&state, &bodies, task)?;
        let wanted = Momentum::new(old);
        take_places(&settled, &mut state, &bodies);
        // Overdamped motion has no momenta to transfer.
        if let Task::Dynamics(dynamics) = task {
            if dynamics.thermal.is_some() {
                take_motion(&settled, &mut state, &bodies);
            } else {
                made.move_along(&mut state);
            }
            bodies.give(&mut state, wanted);
        }
        let switch = self.switch([old, &state]);
        Ok((state, switch))
    }

    fn switch(&self, [old, new]: [&State; 2]) -> Switch {
        let energy = |assembly: &Assembly, state: &State| {
            assembly.system.in_state(state.clone()).total_energy()
        };
        let [before, after] = [old, new].map(Momentum::new);
        Switch {
            step: self.step,
            time_ns: self.time_ns,
            to_monomers: self.to_monomers.clone(),
            to_rod: self.to_rod.clone(),
            energy_pn_nm: energy(self.to, new) - energy(self.from, old),
            momentum_change: (after.linear - before.linear).norm(),
            angular_momentum_change: (after.angular - before.angular).norm(),
        }
    }

    /// Returns `true` if a body at an arc length (nm) belongs to a switched cell. Monomers can lie
    /// beyond the ends of the filament.
    pub(super) fn is_switched(&self, s_nm: f64) -> bool {
        let inside = s_nm.clamp(0.0, self.to.length_nm());
        let mut spans = self.to_monomers.iter().chain(&self.to_rod);
        spans.any(|[from, to]| *from - SAME_PLACE_NM <= inside && inside <= *to + SAME_PLACE_NM)
    }

    /// Free bodies of the new filament at the selected arc lengths.
    pub(super) fn bodies(&self, state: &State, is_wanted: impl Fn(f64) -> bool) -> Bodies {
        let (points, frames) = (self.to.points.iter(), self.to.frames.iter());
        let points = points.enumerate().filter(|(_, p)| is_wanted(p.s_nm));
        let frames = frames.enumerate().filter(|(_, f)| is_wanted(f.s_nm));
        Bodies {
            points: (points.map(|(i, _)| i))
                .filter(|&i| state.points.is_free(i))
                .collect(),
            frames: (frames.map(|(i, _)| i))
                .filter(|&i| state.frames.is_free(i))
                .collect(),
        }
    }

    /// Copies the state of existing bodies and places new bodies on their cross-sections. New held
    /// bodies stay as built. Returns the new free bodies with their cross-sections.
    fn place(&self, old: &State, state: &mut State) -> TransferredBodies {
        let field = Field::new(self.from, old);
        let (known, keys) = (BodyPositions::new(self.from), BodyPositions::new(self.to));
        let mut made = TransferredBodies::default();
        for (key, &i) in &keys.points {
            if let Some(&there) = known.points.get(key) {
                state.points.position.set(i, old.points.position.get(there));
                state.points.velocity.set(i, old.points.velocity.get(there));
            } else if state.points.is_free(i) {
                let section = self.cross_section(&field, self.to.points[i].s_nm);
                let place = section.place + section.axes * self.arm(i);
                state.points.position.set(i, place);
                made.points.push((i, section));
            }
        }
        for (key, &i) in &keys.frames {
            let kept = known.frames.get(key).filter(|_| !self.is_new_junction(i));
            if let Some(&there) = kept {
                let orientation = old.frames.orientation.get(there);
                state.frames.orientation.set(i, orientation);
                let momentum = old.frames.angular_momentum.get(there);
                state.frames.angular_momentum.set(i, momentum);
            } else if state.frames.is_free(i) {
                let section = self.cross_section(&field, self.to.frames[i].s_nm);
                let own = self.own_axes(i);
                state.frames.orientation.set(i, section.axes * own);
                made.frames.push((i, section));
            }
        }
        made
    }

    /// Vector from the cross-section to a point as built (nm, axes of the cross-section).
    fn arm(&self, i: usize) -> Vector3 {
        let s_nm = self.to.points[i].s_nm;
        let rest = self.to.rest.points.position.get(i) - self.span().axis_place(s_nm);
        self.span().frame_at(s_nm).inverse() * rest
    }

    /// Orientation of a frame as built, in the axes of its cross-section.
    fn own_axes(&self, i: usize) -> UnitQuaternion {
        let rest = self.to.rest.frames.orientation.get(i);
        self.span().frame_at(self.to.frames[i].s_nm).inverse() * rest
    }

    /// Copies displacement and velocity of sliding ends.
    fn slide(&self, old: &State, state: &mut State) {
        let sliders = state.sliders.clone();
        for (before, slider) in old.sliders.iter().zip(sliders.iter()) {
            let one = before.points[0];
            let moved = old.points.position.get(one) - self.from.rest.points.position.get(one);
            let along = |v: Vector3| slider.directions.iter().map(|d| d * d.dot(&v)).sum();
            let (moved, velocity): (Vector3, Vector3) =
                (along(moved), before.sliding_velocity(&old.points.velocity));
            for &i in &slider.points {
                let place = self.to.rest.points.position.get(i) + moved;
                state.points.position.set(i, place);
                state.points.velocity.set(i, velocity);
            }
        }
    }

    /// Returns `true` for a junction frame at a switched cell, which may join different sides.
    fn is_new_junction(&self, i: usize) -> bool {
        let frame = &self.to.frames[i];
        frame.kind == BodyKind::Junction && self.is_switched(frame.s_nm)
    }

    fn span(&self) -> &crate::FilamentSpan {
        &self.to.filaments[0]
    }

    fn cross_section(&self, field: &Field, s_nm: f64) -> CrossSection {
        let sections = self.from.sections_of(0);
        let behind = sections.partition_point(|section| section.to_nm < s_nm);
        if sections[behind.min(sections.len() - 1)].is_ellipsoids() {
            field.of_monomers(s_nm)
        } else {
            field.of_rod(s_nm)
        }
    }
}

#[derive(Default)]
struct TransferredBodies {
    points: Vec<(usize, CrossSection)>,
    frames: Vec<(usize, CrossSection)>,
}

impl TransferredBodies {
    fn move_along(&self, state: &mut State) {
        for (i, section) in &self.points {
            let arm = state.points.position.get(*i) - section.place;
            let velocity = section.velocity + section.angular_velocity.cross(&arm);
            state.points.velocity.set(*i, velocity);
        }
        for (i, section) in &self.frames {
            let own = state.frames.orientation.get(*i).inverse() * section.angular_velocity;
            let moments = state.frames.inverse_moments(*i);
            let momentum = own.component_div(&moments);
            state.frames.angular_momentum.set(*i, momentum);
        }
    }
}

/// Kind of body, arc length in units of [`SAME_PLACE_NM`], and number of earlier bodies of that
/// kind there.
type Key = (u8, i64, usize);

/// Bodies of filament 0 by place.
struct BodyPositions {
    points: BTreeMap<Key, usize>,
    frames: BTreeMap<Key, usize>,
}

impl BodyPositions {
    fn new(assembly: &Assembly) -> Self {
        let points = assembly.points.iter().map(|p| (p.kind, p.s_nm));
        let frames = assembly.frames.iter().map(|f| (f.kind, f.s_nm));
        Self {
            points: places(points),
            frames: places(frames),
        }
    }
}

fn places(bodies: impl Iterator<Item = (BodyKind, f64)>) -> BTreeMap<Key, usize> {
    let mut places = BTreeMap::new();
    for (i, (kind, s_nm)) in bodies.enumerate() {
        let unit = to_index((s_nm / SAME_PLACE_NM).round());
        let others = places
            .range((kind as u8, unit, 0)..=(kind as u8, unit, usize::MAX))
            .count();
        places.insert((kind as u8, unit, others), i);
    }
    places
}

fn take_places(from: &State, to: &mut State, bodies: &Bodies) {
    for &i in &bodies.points {
        to.points.position.set(i, from.points.position.get(i));
    }
    for &i in &bodies.frames {
        to.frames.orientation.set(i, from.frames.orientation.get(i));
    }
}

fn take_motion(from: &State, to: &mut State, bodies: &Bodies) {
    for &i in &bodies.points {
        to.points.velocity.set(i, from.points.velocity.get(i));
    }
    for &i in &bodies.frames {
        let momentum = from.frames.angular_momentum.get(i);
        to.frames.angular_momentum.set(i, momentum);
    }
}
