//! What is wanted of an equilibrium, and how the loads in a filament change with it.
//!
//! A stretch that is longer, more bent or more twisted by `delta` than its model says moves a tip by
//! `delta . dw / dF`, with `w` the couple and force that the stretch carries and `F` a force on the tip along its
//! displacement; it changes what a clamp bears by `-delta . dw / dc`, with `c` the motion of the clamp. Both
//! derivatives come from one linear solve with the stiffness of the equilibrium.
//! The force of a linker depends on the places of its sites, as a displacement does on that of the tip: `F` are the loads
//! that are its derivative. Those of the elastic energy are the elastic loads with their sign changed; and a stretch that
//! is strained by more stores another energy at the same strains, which is added.
//!
//! The energy is the elastic one, not the potential: the first variation of the potential vanishes, so that no linear solve
//! would be needed, but it is a number of the loads as much as of the filament.

use super::ideal::PERIOD;
use super::section_loads::{SectionLoads, elastic_energy, elastic_loads};
use crate::scene::{Quantity, SceneProblem};
use crate::shape::Ribbon;
use crate::shape::axis::Axis;
use crate::{Assembly, End};
use actin_coupling::{Linker, LinkerEnd, Site};
use actin_ellipsoid::SixVector;
use actin_equilibrium::ImplicitSolver;
use actin_mechanics::{
    Coordinates, Loads, Matrix3, SecondOrder, State, Stiffness, Vector3, rotation,
};

/// Largest displacement (nm) or turn (rad) of a body, or of a clamp, in a difference; what follows it may move by
/// this share of the length of the filament.
const STEP: f64 = 1e-4;
/// What is added to the stiffness (pN/nm, pN nm/rad) where directions have none.
const SHIFT: f64 = 1e-9;

/// A wanted number about one equilibrium.
#[derive(Clone, Copy, Debug)]
enum Goal {
    /// The displacement of the tip along a direction.
    Tip(Vector3),
    /// The largest distance from the axis.
    Height,
    /// What the clamp at the end bears along and about the filament.
    Clamp { along: Vector3, about: Vector3 },
    /// The elastic energy.
    Energy,
    /// The force of a linker along a direction.
    Linker { linker: usize, along: Vector3 },
    /// The size of the curvature between two arc lengths (nm).
    Curvature([f64; 2]),
}

impl Goal {
    fn of(quantity: Quantity, assembly: &Assembly, state: &State) -> Self {
        let axis = assembly.filaments[0].axis();
        let zero = Vector3::zeros();
        match quantity {
            Quantity::Tip => {
                let moved = tip_displacement(assembly, state);
                Self::Tip(moved.try_normalize(0.0).unwrap_or_else(Vector3::x))
            }
            Quantity::Height => Self::Height,
            Quantity::EndForce => Self::Clamp {
                along: axis,
                about: zero,
            },
            Quantity::EndCouple => Self::Clamp {
                along: zero,
                about: axis,
            },
            Quantity::Energy => Self::Energy,
            Quantity::LinkerForce { linker } => {
                let force = assembly.linkers[linker].force(state);
                let along = force.try_normalize(0.0).unwrap_or_else(Vector3::x);
                Self::Linker { linker, along }
            }
            Quantity::Curvature { at_nm } => Self::Curvature(periods_about(assembly, at_nm)),
        }
    }

    fn value(&self, assembly: &Assembly, state: &State) -> f64 {
        match self {
            Self::Tip(direction) => tip_displacement(assembly, state).dot(direction),
            Self::Height => Ribbon::new(assembly, state).largest_distance_nm(),
            Self::Clamp { along, about } => {
                let clamp = assembly.clamp_at(0, End::End).expect("checked before");
                let reaction = clamp.reaction(state, &all_loads(assembly, state));
                reaction.force_pn.dot(along) + reaction.torque_pn_nm.dot(about)
            }
            Self::Energy => elastic_energy(assembly, state),
            Self::Linker { linker, along } => assembly.linkers[*linker].force(state).dot(along),
            Self::Curvature(ends) => curvature_between(assembly, state, *ends),
        }
    }

    /// The linker whose force this is, if it is, and the derivative of that by the place of its end (lab frame).
    fn by_end_of_linker(&self, assembly: &Assembly) -> Option<(usize, Vector3)> {
        match *self {
            Self::Linker { linker, along } => {
                let stiffness = assembly.scene.linkers[linker].stiffness_pn_per_nm;
                Some((linker, along * stiffness))
            }
            _ => None,
        }
    }

    /// Bodies on whose places the value depends, but for those of a clamp: points, frames.
    fn bodies(&self, assembly: &Assembly, state: &State) -> (Vec<usize>, Vec<usize>) {
        match self {
            Self::Tip(_) => (assembly.tip_points(End::End).to_vec(), Vec::new()),
            Self::Height => about_the_top(assembly, state),
            Self::Linker { linker, .. } => at_the_sites(&assembly.linkers[*linker]),
            Self::Curvature(ends) => (Vec::new(), frames_about(assembly, *ends)),
            Self::Clamp { .. } | Self::Energy => (Vec::new(), Vec::new()),
        }
    }
}

fn tip_displacement(assembly: &Assembly, state: &State) -> Vector3 {
    assembly.tip_nm(state, End::End) - assembly.tip_nm(&assembly.rest, End::End)
}

fn all_loads(assembly: &Assembly, state: &State) -> Loads {
    let mut loads = Loads::zeros(state);
    for interaction in assembly.system.interactions() {
        interaction.add_loads(state, &mut loads);
    }
    loads
}

/// The bodies that the sites of a linker follow.
fn at_the_sites(linker: &Linker) -> (Vec<usize>, Vec<usize>) {
    let other = match linker.end() {
        LinkerEnd::Anchor(_) => None,
        LinkerEnd::Site(site) => Some(site),
    };
    let sites = [linker.site()].into_iter().chain(other);
    let points = sites.clone().flat_map(Site::shares).map(|&(i, _)| i);
    (points.collect(), sites.map(Site::frame).collect())
}

/// Two periods of monomers about an arc length, or the nearest that there are (nm).
fn periods_about(assembly: &Assembly, at_nm: f64) -> [f64; 2] {
    let period = period_nm(assembly);
    let last = (assembly.length_nm() - 2.0 * period).max(0.0);
    let from = (at_nm - period).clamp(0.0, last);
    [from, from + 2.0 * period]
}

fn period_nm(assembly: &Assembly) -> f64 {
    PERIOD as f64 * assembly.monomers_of(0).rise_nm
}

/// By how much the mean axes of the second half of a stretch of two periods are bent against those of the first, over
/// their distance: how monomers of a period stand differently drops out, also where it grows along the filament.
fn curvature_between(assembly: &Assembly, state: &State, [from, to]: [f64; 2]) -> f64 {
    let axis = Axis::of(assembly, state);
    let middle = axis.at(0.5 * (from + to)).1.inverse();
    let rise = (to - from) / (2 * PERIOD) as f64;
    let turns = (0..2 * PERIOD).map(|k| {
        let (_, axes) = axis.at(from + (k as f64 + 0.5) * rise);
        rotation::log(middle * axes)
    });
    let turns: Vec<Vector3> = turns.collect();
    let (before, behind) = turns.split_at(PERIOD);
    let turned = behind.iter().sum::<Vector3>() - before.iter().sum::<Vector3>();
    turned.x.hypot(turned.y) / (PERIOD * PERIOD) as f64 / rise
}

/// The frames between two arc lengths and the next on either side (nm).
fn frames_about(assembly: &Assembly, [from, to]: [f64; 2]) -> Vec<usize> {
    let frames = assembly.filaments[0].frames.clone();
    let before = |s_nm: f64| {
        let is_before = frames.clone().filter(|&i| assembly.frames[i].s_nm < s_nm);
        frames.start + is_before.count()
    };
    let first = before(from).saturating_sub(2).max(frames.start);
    (first..(before(to) + 2).min(frames.end)).collect()
}

/// The bodies about the vertex that is furthest from the axis.
fn about_the_top(assembly: &Assembly, state: &State) -> (Vec<usize>, Vec<usize>) {
    let ribbon = Ribbon::new(assembly, state);
    let span = &assembly.filaments[0];
    let distance = |i: usize| {
        let seen = span.seen_along_z(ribbon.points_nm[i]);
        seen.x.hypot(seen.y)
    };
    let vertices = 0..ribbon.points_nm.len();
    let top = vertices.max_by(|&i, &j| distance(i).total_cmp(&distance(j)));
    let top = top.unwrap_or_default();
    let last = ribbon.s_nm.len() - 1;
    let rise = assembly.monomers_of(0).rise_nm;
    let from = ribbon.s_nm[top.saturating_sub(1)] - rise;
    let to = ribbon.s_nm[(top + 1).min(last)] + rise;
    let near = |s_nm: f64| (from..=to).contains(&s_nm);
    (
        span.points
            .clone()
            .filter(|&i| near(assembly.points[i].s_nm))
            .collect(),
        span.frames
            .clone()
            .filter(|&i| near(assembly.frames[i].s_nm))
            .collect(),
    )
}

/// The wanted number, and what the loads in the filament have to do with it.
#[derive(Debug)]
pub(super) struct Adjoint {
    /// The number.
    pub value: f64,
    ahead: (SectionLoads, State),
    behind: (SectionLoads, State),
    /// Of the parameter that the loads are differentiated by.
    step: f64,
    sign: f64,
    is_energy: bool,
    /// Along which the displacement of the tip is wanted, if it is.
    tip: Option<Vector3>,
    /// The linker whose force is wanted, if it is, and the derivative of that by the place of its end (lab frame).
    linker: Option<(usize, Vector3)>,
}

impl Adjoint {
    /// That of an equilibrium.
    ///
    /// # Errors
    /// Bodies that the solver refuses.
    pub(super) fn of(
        quantity: Quantity,
        assembly: &Assembly,
        state: &State,
    ) -> Result<Self, SceneProblem> {
        let goal = Goal::of(quantity, assembly, state);
        let loads = conjugate(&goal, assembly, state);
        let mut solver = factorised(assembly, state)?;
        let extent = solver.advance(&mut state.clone(), &loads, f64::INFINITY);
        let is_clamp = matches!(goal, Goal::Clamp { .. });
        let own = if is_clamp { 1.0 } else { f64::MIN_POSITIVE };
        let moved = extent.displacement / assembly.length_nm().max(1.0);
        let step = STEP / extent.rotation.max(moved).max(own);
        let mut at = |step: f64| {
            let mut moved = match goal {
                Goal::Clamp { along, about } => {
                    moved_end(assembly, state, along, about * step, step)
                }
                _ => state.clone(),
            };
            solver.advance(
                &mut moved,
                &scaled(&loads, &Loads::zeros(state), step),
                f64::INFINITY,
            );
            (SectionLoads::of(assembly, &moved), moved)
        };
        Ok(Self {
            value: goal.value(assembly, state),
            ahead: at(step),
            behind: at(-step),
            step,
            sign: if is_clamp { -1.0 } else { 1.0 },
            is_energy: matches!(goal, Goal::Energy),
            tip: match goal {
                Goal::Tip(direction) => Some(direction),
                _ => None,
            },
            linker: goal.by_end_of_linker(assembly),
        })
    }

    /// The number alone.
    pub(super) fn value_of(quantity: Quantity, assembly: &Assembly, state: &State) -> f64 {
        Goal::of(quantity, assembly, state).value(assembly, state)
    }

    /// By how much the number changes per strain of a stretch at an arc length (nm) beyond what its model says, in
    /// body axes: per turn, then per displacement.
    pub(super) fn weight(&self, s_nm: f64) -> SixVector {
        self.slope(self.of_both(|loads, _| loads.at(s_nm)))
    }

    /// What something is a step of the parameter ahead and behind.
    pub(super) fn of_both(
        &self,
        what: impl Fn(&SectionLoads, &State) -> SixVector,
    ) -> [SixVector; 2] {
        [&self.ahead, &self.behind].map(|(loads, state)| what(loads, state))
    }

    /// Its derivative.
    pub(super) fn slope(&self, [ahead, behind]: [SixVector; 2]) -> SixVector {
        (ahead - behind) * (self.sign / (2.0 * self.step))
    }

    /// Whether the number is the force of a linker.
    pub(super) fn is_force_of(&self, linker: usize) -> bool {
        self.by_end_of(linker).is_some()
    }

    /// Derivative of the number by the place of the end of a linker, if it is the force of that; with its sign changed that by
    /// the place of its site (lab frame).
    pub(super) fn by_end_of(&self, linker: usize) -> Option<Vector3> {
        let wanted = self.linker.filter(|wanted| wanted.0 == linker);
        wanted.map(|wanted| wanted.1)
    }

    /// The change of the number where a stretch at an arc length (nm) is strained by `defect` beyond its model under the
    /// same loads, and stores `stored` (pN nm) beyond it at the same strains.
    pub(super) fn change(&self, s_nm: f64, defect: &SixVector, stored: f64) -> f64 {
        defect.dot(&self.weight(s_nm)) + self.of_stored(stored)
    }

    /// The change of the number where `stored` (pN nm) is stored at the same strains.
    pub(super) fn of_stored(&self, stored: f64) -> f64 {
        if self.is_energy { stored } else { 0.0 }
    }

    /// By how much more a number that is the displacement of the tip at `end` is of a place beside it, at rest.
    pub(super) fn at_rest(&self, end: End, arm: Vector3) -> f64 {
        let wanted = self.tip.filter(|_| end == End::End);
        wanted.map_or(0.0, |direction| direction.dot(&arm))
    }
}

/// The stiffness at a state, factorised; with a little more where directions have none.
fn factorised(assembly: &Assembly, state: &State) -> Result<ImplicitSolver, SceneProblem> {
    let mut solver = ImplicitSolver::new(crate::run::layout(assembly)?);
    let loads = all_loads(assembly, state);
    let interactions = assembly.system.interactions();
    if !solver.factorize((state, &loads), interactions, &Shift(0.0)) {
        solver.factorize((state, &loads), interactions, &Shift(SHIFT));
    }
    Ok(solver)
}

/// `factor (a - b)`.
fn scaled(a: &Loads, b: &Loads, factor: f64) -> Loads {
    let mut difference = a.clone();
    for i in 0..a.force.len() {
        difference
            .force
            .set(i, (a.force.get(i) - b.force.get(i)) * factor);
    }
    for i in 0..a.torque.len() {
        difference
            .torque
            .set(i, (a.torque.get(i) - b.torque.get(i)) * factor);
    }
    difference
}

/// The state with its clamped end moved by `step` along a direction and turned about its point.
fn moved_end(
    assembly: &Assembly,
    state: &State,
    along: Vector3,
    turn: Vector3,
    step: f64,
) -> State {
    let clamp = assembly.clamp_at(0, End::End).expect("checked before");
    let centre = clamp.point_nm(state);
    let turn = rotation::exp(turn);
    let mut moved = state.clone();
    for &i in &clamp.points {
        let arm = state.points.position.get(i) - centre;
        moved
            .points
            .position
            .set(i, centre + turn * arm + along * step);
    }
    for &i in &clamp.frames {
        moved
            .frames
            .orientation
            .set(i, turn * state.frames.orientation.get(i));
    }
    moved
}

/// The loads whose displacements are what loads in the filament are differentiated along.
fn conjugate(goal: &Goal, assembly: &Assembly, state: &State) -> Loads {
    match *goal {
        Goal::Energy => scaled(&Loads::zeros(state), &elastic_loads(assembly, state), 1.0),
        Goal::Tip(_) | Goal::Height | Goal::Linker { .. } | Goal::Curvature(_) => {
            gradient(goal, assembly, state)
        }
        Goal::Clamp { along, about } => {
            let moved = |step: f64| {
                let moved = moved_end(assembly, state, along, about * step, step);
                all_loads(assembly, &moved)
            };
            scaled(&moved(STEP), &moved(-STEP), (2.0 * STEP).recip())
        }
    }
}

/// Derivative of a goal by the places of bodies, as loads.
fn gradient(goal: &Goal, assembly: &Assembly, state: &State) -> Loads {
    let mut loads = Loads::zeros(state);
    let (points, frames) = goal.bodies(assembly, state);
    let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
    let slope = |change: &dyn Fn(&mut State, f64)| {
        let at = |step: f64| {
            let mut moved = state.clone();
            change(&mut moved, step);
            goal.value(assembly, &moved)
        };
        (at(STEP) - at(-STEP)) / (2.0 * STEP)
    };
    for i in points {
        let by = axes.map(|axis| slope(&|state, step| state.points.position.add(i, axis * step)));
        loads.force.set(i, Vector3::from(by));
    }
    for i in frames {
        let by = axes.map(|axis| {
            slope(&|state, step| {
                let q = state.frames.orientation.get(i) * rotation::exp(axis * step);
                state.frames.orientation.set(i, q);
            })
        });
        loads.torque.set(i, Vector3::from(by));
    }
    loads
}

/// The same stiffness against every motion of every free body.
struct Shift(f64);

impl SecondOrder for Shift {
    fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
        let points = (0..state.points.len()).filter(|&i| state.points.is_free(i));
        let frames = (0..state.frames.len()).filter(|&i| state.frames.is_free(i));
        let bodies = points
            .map(Coordinates::Point)
            .chain(frames.map(Coordinates::Frame));
        for body in bodies {
            stiffness.push(body, body, Matrix3::identity() * self.0);
        }
    }
}
