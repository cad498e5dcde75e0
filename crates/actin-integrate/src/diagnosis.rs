//! Whether a state is sound, and what to blame if it is not.

use crate::{Body, FailureKind};
use actin_mechanics::{
    Interaction, Loads, Split, State, StateStats, System, Thermostat, Vector3, Vectors,
};
use std::f64::consts::PI;

/// Kinetic energy may not grow beyond that of all earlier checks by more than this factor.
///
/// From rest it grows fourfold while the time doubles under constant loads, sixteenfold under
/// loads that rise steadily, and less after that; above the stability limit it grows by a factor
/// in every step.
const LARGEST_GROWTH: f64 = 1e8;

/// Kinetic energy (pN nm) that counts as rest. A motion that begins late goes from what rounding moves
/// (1e-26) to whatever its loads give it between two checks, so that growth tells nothing before it has
/// reached 1e4 pN nm, far more than a load or heat gives a few bodies at once.
const STILL: f64 = 1e-4;

/// Watches over the states of one run.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Watch {
    /// Time step (ns), without sign.
    pub(crate) h: f64,
    /// Kinetic energy (pN nm) that no sound state has.
    pub(crate) kinetic_limit: f64,
    /// Largest kinetic energy seen so far.
    pub(crate) largest_kinetic: f64,
}

impl Watch {
    /// A watch that has seen kinetic energies up to `largest_kinetic`; zero at the start.
    pub(crate) fn new(h: f64, kinetic_limit: f64, largest_kinetic: f64) -> Self {
        Self {
            h: h.abs(),
            kinetic_limit,
            largest_kinetic,
        }
    }

    /// The kinetic energy (pN nm) of `state`, or what is wrong with it. Changes nothing.
    ///
    /// A sound state takes one pass without branches; only where that shows anything unusual are
    /// all bodies looked at one by one.
    pub(crate) fn inspect(&self, state: &State) -> Result<f64, FailureKind> {
        let StateStats {
            kinetic_energy,
            largest_spin_squared,
        } = state.stats();
        let turn = self.h * largest_spin_squared.sqrt();
        if self.is_sound(kinetic_energy) && turn <= PI {
            return Ok(kinetic_energy);
        }
        self.look_closer(state)
    }

    /// Whether a state may have this kinetic energy. Written so that an overflow to infinity or
    /// NaN is found.
    fn is_sound(&self, kinetic: f64) -> bool {
        let before = self.largest_kinetic.max(STILL);
        let grown = self.largest_kinetic > 0.0 && kinetic > LARGEST_GROWTH * before;
        kinetic <= self.kinetic_limit && kinetic.is_finite() && !grown
    }

    /// The same as [`inspect`](Self::inspect), body by body.
    fn look_closer(&self, state: &State) -> Result<f64, FailureKind> {
        if !state.is_finite() {
            return Err(FailureKind::NotFinite);
        }
        let turn = self.h * largest_angular_velocity(state);
        if turn > PI {
            return Err(FailureKind::TurnsTooFar(turn));
        }
        let kinetic = state.kinetic_energy();
        if self.is_sound(kinetic) {
            Ok(kinetic)
        } else {
            Err(FailureKind::TooFast(kinetic))
        }
    }

    /// Remembers the kinetic energy of a sound state.
    pub(crate) fn remember(&mut self, kinetic: f64) {
        self.largest_kinetic = self.largest_kinetic.max(kinetic);
    }
}

/// Largest angular velocity of a free frame (rad/ns).
fn largest_angular_velocity(state: &State) -> f64 {
    let frames = &state.frames;
    (0..frames.len())
        .filter(|&i| frames.is_free(i))
        .map(|i| {
            frames
                .angular_velocity(i, frames.angular_momentum.get(i))
                .norm_squared()
        })
        .fold(0.0, f64::max)
        .sqrt()
}

/// The body and the term to blame for the state `broken`, whose state one step before is given.
pub(crate) fn blame(
    interactions: &[Box<dyn Interaction>],
    broken: &State,
    before: &State,
) -> (Body, &'static str) {
    let body =
        first_body(broken, |body| !body_is_finite(broken, body)).unwrap_or_else(|| fastest(broken));
    // Loads at positions that are not finite say nothing: those before still do.
    let sighted = if broken.is_finite() { broken } else { before };
    (body, strongest_term(interactions, sighted, body))
}

/// The term with the largest load on a body; "none" if no term acts on it.
pub(crate) fn strongest_term(
    interactions: &[Box<dyn Interaction>],
    state: &State,
    body: Body,
) -> &'static str {
    // One buffer for all terms, of which nothing but the load on this body is read: a buffer for each
    // would take the square of the number of terms.
    let mut loads = Loads::zeros(state);
    let strongest = interactions
        .iter()
        .map(|interaction| {
            clear_load(&mut loads, body);
            interaction.add_loads(state, &mut loads);
            (interaction.term(), load_on(&loads, body).norm())
        })
        .filter(|(_, size)| *size > 0.0)
        .max_by(|a, b| a.1.total_cmp(&b.1));
    strongest.map_or("none", |(term, _)| term)
}

/// A system that looks at the loads of each term before each kick, to catch the first that is not
/// finite while the state still is.
///
/// Loads often break down within a step, at positions that neither of its ends shows.
#[derive(Debug)]
pub(crate) struct Probe<'a> {
    pub(crate) system: &'a mut System,
    pub(crate) culprit: Option<(Body, &'static str)>,
}

impl Split for Probe<'_> {
    fn drift(&mut self, h: f64) {
        self.system.drift(h);
    }

    fn kick(&mut self, translation: f64, rotation: f64) {
        if self.culprit.is_none() && self.system.state().is_finite() {
            self.culprit = broken_load(self.system);
        }
        self.system.kick(translation, rotation);
    }

    fn damp(&mut self, translational: f64, rotational: f64) {
        self.system.damp(translational, rotational);
    }

    fn force_evaluations(&self) -> u64 {
        self.system.force_evaluations()
    }
}

impl Thermostat for Probe<'_> {
    fn bodies(&self) -> (usize, usize) {
        self.system.bodies()
    }

    fn add_thermal_impulses(&mut self, points: &Vectors, frames: &Vectors) {
        self.system.add_thermal_impulses(points, frames);
    }

    fn has_step_end(&self) -> bool {
        self.system.has_step_end()
    }

    fn end_step(&mut self, step: u64, h: f64) {
        self.system.end_step(step, h);
    }
}

/// The first load that is not finite: on which body, and of which term.
fn broken_load(system: &System) -> Option<(Body, &'static str)> {
    let (state, interactions) = (system.state(), system.interactions());
    let (k, loads) = first_broken(interactions, state)?;
    let body = first_body(state, |body| !is_finite(&load_on(&loads, body)))?;
    Some((body, interactions[k].term()))
}

/// The first term whose loads are not finite together with those before it, and these loads; `None`
/// if all are.
///
/// The terms are halved until it is found: a look at all loads after each of them would take the
/// square of the number of terms.
pub(crate) fn first_broken(
    interactions: &[Box<dyn Interaction>],
    state: &State,
) -> Option<(usize, Loads)> {
    let mut loads = Loads::zeros(state);
    let mut are_sound = |terms: usize| {
        loads.clear();
        for interaction in &interactions[..terms] {
            interaction.add_loads(state, &mut loads);
        }
        let mut all = loads.force.iter().chain(loads.torque.iter());
        all.all(|load| is_finite(&load))
    };
    let (mut sound, mut broken) = (0, interactions.len());
    if are_sound(broken) {
        return None;
    }
    while broken - sound > 1 {
        let half = usize::midpoint(sound, broken);
        if are_sound(half) {
            sound = half;
        } else {
            broken = half;
        }
    }
    are_sound(broken);
    Some((sound, loads))
}

/// The first term whose energy of a finite state is not finite, and the body on which it acts most
/// strongly.
pub(crate) fn broken_energy(
    interactions: &[Box<dyn Interaction>],
    state: &State,
) -> Option<(Body, &'static str)> {
    let mut terms = interactions.iter();
    let term = terms.find(|interaction| !interaction.energy(state).is_finite())?;
    let loads = loads_of(term.as_ref(), state);
    let size = |body: &Body| load_on(&loads, *body).norm();
    let body = bodies(state).max_by(|a, b| size(a).total_cmp(&size(b)))?;
    Some((body, term.term()))
}

/// Loads of one interaction alone.
fn loads_of(interaction: &dyn Interaction, state: &State) -> Loads {
    let mut loads = Loads::zeros(state);
    interaction.add_loads(state, &mut loads);
    loads
}

/// Points, then frames.
fn bodies(state: &State) -> impl Iterator<Item = Body> + use<> {
    let points = (0..state.points.len()).map(Body::Point);
    points.chain((0..state.frames.len()).map(Body::Frame))
}

/// The first body for which `test` holds.
fn first_body(state: &State, test: impl Fn(Body) -> bool) -> Option<Body> {
    bodies(state).find(|&body| test(body))
}

/// The force or torque on a body.
fn load_on(loads: &Loads, body: Body) -> Vector3 {
    match body {
        Body::Point(i) => loads.force.get(i),
        Body::Frame(i) => loads.torque.get(i),
    }
}

/// Sets the force or torque on a body to zero.
fn clear_load(loads: &mut Loads, body: Body) {
    match body {
        Body::Point(i) => loads.force.set(i, Vector3::zeros()),
        Body::Frame(i) => loads.torque.set(i, Vector3::zeros()),
    }
}

fn is_finite(v: &Vector3) -> bool {
    v.iter().all(|c| c.is_finite())
}

/// Whether place and motion of one body are finite.
fn body_is_finite(state: &State, body: Body) -> bool {
    match body {
        Body::Point(i) => {
            is_finite(&state.points.position.get(i)) && is_finite(&state.points.velocity.get(i))
        }
        Body::Frame(i) => {
            let q = state.frames.orientation.get(i);
            q.coords.iter().all(|c| c.is_finite())
                && is_finite(&state.frames.angular_momentum.get(i))
        }
    }
}

/// Kinetic energy of one body; zero if it is held.
fn kinetic_energy(state: &State, body: Body) -> f64 {
    match body {
        Body::Point(i) if state.points.is_free(i) => {
            0.5 * state.points.velocity.get(i).norm_squared() / state.points.inverse_mass()[i]
        }
        Body::Frame(i) if state.frames.is_free(i) => {
            let l = state.frames.angular_momentum.get(i);
            0.5 * l.dot(&state.frames.angular_velocity(i, l))
        }
        _ => 0.0,
    }
}

/// The body with the largest kinetic energy.
fn fastest(state: &State) -> Body {
    bodies(state)
        .max_by(|&a, &b| kinetic_energy(state, a).total_cmp(&kinetic_energy(state, b)))
        .unwrap_or(Body::Point(0))
}
