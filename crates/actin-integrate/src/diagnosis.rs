use crate::{Body, FailureKind};
use actin_mechanics::{
    Interaction, Loads, Split, State, StateStats, System, Thermostat, Vector3, Vectors,
};
use std::f64::consts::PI;

/// Largest growth of the kinetic energy relative to all earlier checks.
///
/// From rest, kinetic energy grows at most sixteenfold per doubling of the time for steadily rising
/// loads. Above the stability limit it grows by a factor in every step.
const LARGEST_GROWTH: f64 = 1e8;

/// Kinetic energy (pN nm) of a state at rest. Growth from rounding errors (1e-26) below this value
/// is ignored.
const STILL: f64 = 1e-4;

#[derive(Clone, Copy, Debug)]
pub(crate) struct DivergenceMonitor {
    pub(crate) h: f64,
    /// Upper limit of the kinetic energy (pN nm).
    pub(crate) kinetic_limit: f64,
    /// Largest kinetic energy at all checks (pN nm).
    pub(crate) largest_kinetic: f64,
}

impl DivergenceMonitor {
    pub(crate) fn new(h: f64, kinetic_limit: f64, largest_kinetic: f64) -> Self {
        Self {
            h: h.abs(),
            kinetic_limit,
            largest_kinetic,
        }
    }

    /// Kinetic energy (pN nm) of `state`, or the kind of its failure.
    ///
    /// Sound states take one pass without branches; only suspicious ones are checked body by body.
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

    fn is_sound(&self, kinetic: f64) -> bool {
        let before = self.largest_kinetic.max(STILL);
        let grown = self.largest_kinetic > 0.0 && kinetic > LARGEST_GROWTH * before;
        kinetic <= self.kinetic_limit && kinetic.is_finite() && !grown
    }

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

    pub(crate) fn remember(&mut self, kinetic: f64) {
        self.largest_kinetic = self.largest_kinetic.max(kinetic);
    }
}

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

/// Body and term that cause the failure in the state `broken`, given the state one step before.
pub(crate) fn blame(
    interactions: &[Box<dyn Interaction>],
    broken: &State,
    before: &State,
) -> (Body, &'static str) {
    let body =
        first_body(broken, |body| !body_is_finite(broken, body)).unwrap_or_else(|| fastest(broken));
    // Loads at positions that are not finite carry no information.
    let sighted = if broken.is_finite() { broken } else { before };
    (body, strongest_term(interactions, sighted, body))
}

pub(crate) fn strongest_term(
    interactions: &[Box<dyn Interaction>],
    state: &State,
    body: Body,
) -> &'static str {
    // One buffer for all terms; clearing only the load of this body avoids quadratic cost.
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

/// System that checks the loads of each term before each kick for the first that is not finite.
///
/// Loads often fail at positions within a step.
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

fn broken_load(system: &System) -> Option<(Body, &'static str)> {
    let (state, interactions) = (system.state(), system.interactions());
    let (k, loads) = first_broken(interactions, state)?;
    let body = first_body(state, |body| !is_finite(&load_on(&loads, body)))?;
    Some((body, interactions[k].term()))
}

/// First term whose loads are not finite, and the sum of the loads up to it. `None` if all are
/// finite.
///
/// Bisection avoids a cost that is quadratic in the number of terms.
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

fn loads_of(interaction: &dyn Interaction, state: &State) -> Loads {
    let mut loads = Loads::zeros(state);
    interaction.add_loads(state, &mut loads);
    loads
}

fn bodies(state: &State) -> impl Iterator<Item = Body> + use<> {
    let points = (0..state.points.len()).map(Body::Point);
    points.chain((0..state.frames.len()).map(Body::Frame))
}

fn first_body(state: &State, test: impl Fn(Body) -> bool) -> Option<Body> {
    bodies(state).find(|&body| test(body))
}

fn load_on(loads: &Loads, body: Body) -> Vector3 {
    match body {
        Body::Point(i) => loads.force.get(i),
        Body::Frame(i) => loads.torque.get(i),
    }
}

fn clear_load(loads: &mut Loads, body: Body) {
    match body {
        Body::Point(i) => loads.force.set(i, Vector3::zeros()),
        Body::Frame(i) => loads.torque.set(i, Vector3::zeros()),
    }
}

fn is_finite(v: &Vector3) -> bool {
    v.iter().all(|c| c.is_finite())
}

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

fn fastest(state: &State) -> Body {
    bodies(state)
        .max_by(|&a, &b| kinetic_energy(state, a).total_cmp(&kinetic_energy(state, b)))
        .unwrap_or(Body::Point(0))
}
