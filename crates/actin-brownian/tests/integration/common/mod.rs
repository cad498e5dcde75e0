#![allow(dead_code, reason = "each test uses some of it")]

use actin_brownian::{Brownian, Dashpot, Friction, TurnDashpot};
use actin_cosserat::{End, EnergyGradient, Rigidities, RodLayout, RodMaterial, StraightRod};
use actin_equilibrium::{BodyOrder, Layout};
use actin_integrate::Stepper;
use actin_mechanics::{Interaction, State, System, Vector3};

/// Along, across (pN ns/nm^2), about the axis, tilt (pN ns).
pub(crate) type FrictionPerLength = [f64; 4];

pub(crate) const FRICTION: FrictionPerLength = [1.5, 2.8, 150.0, 40.0];

pub(crate) fn rigidities() -> Rigidities {
    Rigidities::table4()
}

pub(crate) fn friction_of(rod: &RodLayout) -> Friction {
    friction_with(FRICTION, rod)
}

fn friction_with(per_length: FrictionPerLength, rod: &RodLayout) -> Friction {
    let [along, across, about, tilt] = per_length;
    let mut friction = Friction::default();
    for (k, length) in rod.segment_lengths().iter().enumerate() {
        let (first, frame) = (rod.points().start + k, rod.frames().start + k);
        let of_line = Vector3::new(across, across, along) * *length;
        friction
            .dashpots
            .extend(Dashpot::of_line([first, first + 1], frame, of_line));
        let friction_of_turn = Vector3::new(tilt, tilt, about) * *length;
        friction.turns.push(TurnDashpot {
            frame,
            friction: friction_of_turn,
            is_sphere: false,
        });
    }
    friction
}

pub(crate) fn layout_of(state: &State, rod: &RodLayout) -> Layout {
    let point = |i: usize| i as f64 - rod.points().start as f64;
    let frame = |i: usize| i as f64 - rod.frames().start as f64 + 0.5;
    let order = BodyOrder {
        points: (0..state.points.len()).map(point).collect(),
        frames: (0..state.frames.len()).map(frame).collect(),
    };
    Layout::new(state, Some(&order)).unwrap()
}

pub(crate) fn law(rod: &RodLayout) -> Box<dyn Interaction> {
    let material = RodMaterial::new(rigidities()).unwrap();
    Box::new(EnergyGradient::new(rod.clone(), material))
}

pub(crate) fn free_rod(
    segments: usize,
    length: f64,
    noise: (f64, u64),
    further: impl FnOnce(&mut State, &RodLayout) -> Vec<Box<dyn Interaction>>,
) -> (System, Brownian, RodLayout) {
    free_rod_with(FRICTION, (segments, length), noise, further)
}

/// Free rod of a number of segments and a length (nm), with thermal energy (pN nm) and seed.
pub(crate) fn free_rod_with(
    friction: FrictionPerLength,
    (segments, length): (usize, f64),
    noise: (f64, u64),
    further: impl FnOnce(&mut State, &RodLayout) -> Vec<Box<dyn Interaction>>,
) -> (System, Brownian, RodLayout) {
    let mut state = State::default();
    let rod = StraightRod::uniform(segments, length / segments as f64);
    let rod = rod.push(&mut state).unwrap();
    let mut interactions = vec![law(&rod)];
    interactions.extend(further(&mut state, &rod));
    let layout = layout_of(&state, &rod);
    let system = System::new(state, interactions);
    let friction = friction_with(friction, &rod);
    let steps = Brownian::new(&system, layout, friction, noise).unwrap();
    let steps = steps.with_spinning_frames(&system, |_| true);
    (system, steps, rod)
}

/// Makes the steps `first` to `end` of time `h` and calls `look` after each.
pub(crate) fn advance(
    system: &mut System,
    steps: &mut Brownian,
    (first, end): (u64, u64),
    h: f64,
    mut look: impl FnMut(&System),
) {
    for step in first..end {
        steps.step(system, step, h).expect("the step converges");
        look(system);
    }
}

pub(crate) fn tip(rod: &RodLayout) -> usize {
    rod.end_point(End::End)
}

/// Mean of independent values and its standard error.
pub(crate) fn mean_and_error(values: &[f64]) -> (f64, f64) {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let squares: f64 = values.iter().map(|v| (v - mean).powi(2)).sum();
    (mean, (squares / (n - 1.0) / n).sqrt())
}
