//! Free filaments of these tests and their initial motion.

use actin_integrate::{Composition, Drag, advance, largest_frequency, stable_step};
use actin_mechanics::{State, System, Vector3, rotation};
use actin_mechanics::{Xorshift, perturb, randomise_velocities};
use actin_sim::{Assembly, ForceLaw, Scene};

/// kBT at 298 K (pN nm).
pub(crate) const KBT: f64 = 4.114;

pub(crate) type Filament = (&'static str, &'static str);

pub(crate) const ELLIPSOIDS: Filament = ("ellipsoids", "Ellipsoids(from_nm: 0.0, to_nm: 35.6)");

pub(crate) const ROD: Filament = ("rod", "Rod(from_nm: 0.0, to_nm: 80.0, segments: 8)");

pub(crate) const MIXED: Filament = (
    "monomers + rod",
    "Ellipsoids(from_nm: 0.0, to_nm: 22.0), Rod(from_nm: 22.0, to_nm: 62.0, segments: 4)",
);

pub(crate) const ROD_AT_BOTH_ENDS: Filament = (
    "rod + monomers + rod",
    "Rod(from_nm: 0.0, to_nm: 30.0, segments: 3), Ellipsoids(from_nm: 30.0, to_nm: 52.0), \
     Rod(from_nm: 52.0, to_nm: 82.0, segments: 3)",
);

pub(crate) const FILAMENTS: [Filament; 4] = [ELLIPSOIDS, ROD, MIXED, ROD_AT_BOTH_ENDS];

pub(crate) fn assemble(filament: Filament, law: ForceLaw) -> Assembly {
    assemble_of(filament, &format!("law: Constant, force_law: {law:?}"))
}

pub(crate) fn assemble_of((_, sections): Filament, rod: &str) -> Assembly {
    let text = format!(
        "Scene(
            filament: Filament(
                sections: [{sections}],
                monomers: (anchors: Independent, seed: 1, lateral_bonds: 16, longitudinal_bonds: 16),
                rod: ({rod}),
            ),
            task: Dynamics(duration_ns: 1.0),
        )"
    );
    let scene = Scene::from_ron(&text).expect("the sections above are valid");
    Assembly::build(&scene).expect("the filaments above can be built")
}

/// Filament in flight at 37 nm/ns, rotating at 6 rad/ns, bent to 7e-3 and twisted to 1e-2 rad/nm,
/// and perturbed. The strain energy is a third to a half of kBT per degree of freedom.
pub(crate) fn in_flight(filament: Filament) -> System {
    let assembly = assemble(filament, ForceLaw::EnergyGradient);
    fly_off(assembly, Vector3::new(6e-3, -3e-3, 1e-2), 0.0, 1.0)
}

/// Bends and twists an assembly to `kappa` (rad/nm), stretches it by `extension`, sets it in flight
/// as in [`in_flight`], and perturbs it by `shake` times as much.
pub(crate) fn fly_off(
    mut assembly: Assembly,
    kappa: Vector3,
    extension: f64,
    shake: f64,
) -> System {
    let mut noise = Xorshift::new(5);
    randomise_velocities(assembly.system.state_mut(), &mut noise, shake, shake);
    bend(&mut assembly, kappa);
    let state = assembly.system.state_mut();
    for i in 0..state.points.len() {
        let x = state.points.position.get(i);
        state.points.position.set(i, x * (1.0 + extension));
    }
    perturb(state, &mut noise, 2e-3 * shake, 1e-3 * shake);
    let (velocity, omega) = (
        Vector3::new(20.0, -10.0, 30.0),
        Vector3::new(3.0, -2.0, 5.0),
    );
    fly(state, velocity, omega);
    assembly.system
}

/// Bends and twists the filament as built to the uniform curvature `kappa` (rad/nm). The
/// cross-section at arc length s moves to `s J_l(kappa s) e3` and rotates by `exp(kappa s)`.
fn bend(assembly: &mut Assembly, kappa: Vector3) {
    let (points, frames) = (&assembly.points, &assembly.frames);
    let state = assembly.system.state_mut();
    for (i, info) in points.iter().enumerate() {
        let theta = kappa * info.s_nm;
        let offset = state.points.position.get(i) - Vector3::z() * info.s_nm;
        let centre = info.s_nm * mean_of_turned(theta, Vector3::z());
        let x = centre + rotation::exp(theta) * offset;
        state.points.position.set(i, x);
    }
    for (i, info) in frames.iter().enumerate() {
        let q = rotation::exp(kappa * info.s_nm) * state.frames.orientation.get(i);
        state.frames.orientation.set(i, q);
    }
}

/// `J_l(theta) v`, the mean of `exp(t theta) v` over t from 0 to 1, by Simpson's rule with 64
/// intervals: 1e-12 at angles of 1.
fn mean_of_turned(theta: Vector3, v: Vector3) -> Vector3 {
    const PARTS: u32 = 64;
    let sum: Vector3 = (0..=PARTS)
        .map(|k| {
            let weight = match k {
                0 | PARTS => 1.0,
                _ if k % 2 == 1 => 4.0,
                _ => 2.0,
            };
            weight * (rotation::exp(theta * (f64::from(k) / f64::from(PARTS))) * v)
        })
        .sum();
    sum / (3.0 * f64::from(PARTS))
}

pub(crate) fn fly(state: &mut State, velocity: Vector3, omega: Vector3) {
    for i in 0..state.points.len() {
        let v = velocity + omega.cross(&state.points.position.get(i));
        state.points.velocity.add(i, v);
    }
    for i in 0..state.frames.len() {
        let body = state.frames.orientation.get(i).inverse() * omega;
        let l = body.component_div(&state.frames.inverse_moments(i));
        state.frames.angular_momentum.add(i, l);
    }
}

pub(crate) fn degrees_of_freedom(state: &State) -> usize {
    3 * (state.points.len() + state.frames.len())
}

/// Gives a filament at rest random velocities with a mean kinetic energy of `level` kBT per degree
/// of freedom. Half of it becomes potential energy, so that 1 is room temperature.
pub(crate) fn heat(state: &mut State, level: f64, seed: u64) {
    let mut noise = Xorshift::new(seed);
    let mut momentum = |mass: f64| (2.0 * level * KBT * mass).sqrt() * normal(&mut noise);
    for i in 0..state.points.len() {
        let mass = 1.0 / state.points.inverse_mass()[i];
        let p = Vector3::from_fn(|_, _| momentum(mass));
        state.points.velocity.set(i, p / mass);
    }
    for i in 0..state.frames.len() {
        let l = state.frames.inverse_moments(i).map(|m| momentum(1.0 / m));
        state.frames.angular_momentum.set(i, l);
    }
}

/// Approximately normal number of variance 1: the sum of 12 uniform numbers between -1/2 and 1/2.
pub(crate) fn normal(noise: &mut Xorshift) -> f64 {
    (0..12).map(|_| 0.5 * noise.sample()).sum()
}

/// Largest differences of two states: positions (nm), velocities (nm/ns), rotations (rad), angular
/// momenta (pN nm ns).
pub(crate) fn distances(a: &State, b: &State) -> [f64; 4] {
    let largest = |differences: &mut dyn Iterator<Item = f64>| differences.fold(0.0, f64::max);
    let of = |a: &actin_mechanics::Vectors, b: &actin_mechanics::Vectors| {
        largest(&mut a.iter().zip(b.iter()).map(|(a, b)| (a - b).norm()))
    };
    let (p, q) = (&a.frames.orientation, &b.frames.orientation);
    let turn = |i: usize| rotation::log(p.get(i).inverse() * q.get(i)).norm();
    [
        of(&a.points.position, &b.points.position),
        of(&a.points.velocity, &b.points.velocity),
        largest(&mut (0..a.frames.len()).map(turn)),
        of(&a.frames.angular_momentum, &b.frames.angular_momentum),
    ]
}

/// Mean of independent values and its standard error.
pub(crate) fn mean_and_error(values: &[f64]) -> (f64, f64) {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let squares: f64 = values.iter().map(|v| (v - mean).powi(2)).sum();
    (mean, (squares / (n - 1.0) / n).sqrt())
}

/// Duration of flights (ns): 50 to 90 radians of the fastest mode.
const FLIGHT: f64 = 0.1;

/// Steps of a flight in which the fastest mode, of frequency `omega` (rad/ns), advances by 1 rad.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "frequencies are a few hundred per ns, so this is a positive number below 100"
)]
pub(crate) fn steps_of_one_radian(omega: f64) -> u32 {
    (omega * FLIGHT).ceil() as u32
}

pub(crate) fn state_after(mut system: System, scheme: &Composition, steps: u32) -> State {
    let h = FLIGHT / f64::from(steps);
    advance(&mut system, scheme, h, steps.into(), &Drag::NONE);
    system.state().clone()
}

/// Orders of convergence of the four [`distances`] between `coarse` and `fine` at half the step.
pub(crate) fn orders(coarse: [f64; 4], fine: [f64; 4]) -> [f64; 4] {
    std::array::from_fn(|k| (coarse[k] / fine[k]).log2())
}

/// Time step at a share of the stability limit.
pub(crate) fn step(system: &System, scheme: &Composition, share: f64) -> f64 {
    stable_step(scheme, largest_frequency(system).unwrap(), share).unwrap()
}
