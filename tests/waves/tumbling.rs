//! A tumbling free rod against the free symmetric top.

use super::field::{build, set_spin};
use actin_mechanics::{State, Vector3, rotation};
use actin_sim::Assembly;

const LENGTH: f64 = 160.0;
const SEGMENTS: usize = 16;
/// Initial spin of the rod about its axis and across it (rad/ns).
const SPIN: [f64; 2] = [1e-2, 2e-3];

fn tumbling(turns: f64) -> Assembly {
    let duration = turns * std::f64::consts::TAU / SPIN[1];
    let mut assembly = build(&format!(
        "Scene(
            filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: {LENGTH:?}, segments: {SEGMENTS})], rod: RodModel(law: Constant)),
            task: Dynamics(duration_ns: {duration:?}, record_every_ns: {:?}),
        )",
        duration / 100.0,
    ));
    let spin = Vector3::z() * SPIN[0] + Vector3::x() * SPIN[1];
    let state = assembly.system.state_mut();
    for i in 0..state.points.len() {
        let arm = state.points.position.get(i) - Vector3::z() * (0.5 * LENGTH);
        state.points.velocity.set(i, spin.cross(&arm));
    }
    for i in 0..state.frames.len() {
        set_spin(state, i, spin);
    }
    assembly
}

/// Moments of inertia of the straight rod about its middle: along and across (pN ns^2 nm).
fn moments(state: &State) -> (f64, f64) {
    let mut along = 0.0;
    let mut across = 0.0;
    for i in 0..state.points.len() {
        let z = state.points.position.get(i).z - 0.5 * LENGTH;
        across += z * z / state.points.inverse_mass()[i];
    }
    for i in 0..state.frames.len() {
        let inverse = state.frames.inverse_moments(i);
        across += 1.0 / inverse.x;
        along += 1.0 / inverse.z;
    }
    (along, across)
}

fn angular_momentum(state: &State) -> Vector3 {
    let middle = Vector3::z() * (0.5 * LENGTH);
    let points = (0..state.points.len()).map(|i| {
        let momentum = state.points.velocity.get(i) / state.points.inverse_mass()[i];
        (state.points.position.get(i) - middle).cross(&momentum)
    });
    let frames = (0..state.frames.len())
        .map(|i| state.frames.orientation.get(i) * state.frames.angular_momentum.get(i));
    points.chain(frames).sum()
}

/// The axis of a free symmetric top precesses about the angular momentum at the rate `|L| /
/// I_across` at a fixed angle. The centrifugal strain is (2e-3 / 1.1)^2 = 3e-6, the squared ratio
/// of the tumbling rate to the first bending frequency.
#[test]
fn a_slowly_tumbling_rod_is_a_symmetric_top() {
    let assembly = tumbling(3.0);
    let (along, across) = moments(assembly.system.state());
    let momentum = angular_momentum(assembly.system.state());
    let expected = Vector3::z() * (along * SPIN[0]) + Vector3::x() * (across * SPIN[1]);
    assert!((momentum - expected).norm() < 1e-13 * momentum.norm());
    let rate = momentum.norm() / across;
    let (trajectory, _) = actin_sim::Plan::new(&assembly).unwrap().run().unwrap();
    let pole = momentum.normalize();
    let mut worst = 0.0_f64;
    for record in &trajectory.records {
        let points = &record.state.points.position;
        let axis = (points.get(SEGMENTS) - points.get(0)).normalize();
        let turned = rotation::exp(pole * (rate * record.at.value())) * Vector3::z();
        worst = worst.max((axis - turned).norm());
        let now = angular_momentum(&record.state);
        // Round-off of about 1e5 steps.
        assert!((now - momentum).norm() < 1e-11 * momentum.norm());
    }
    println!("tumbling: axis off by at most {worst:.1e} rad in three turns");
    // 3e-6 of 19 rad.
    assert!(worst < 1e-4, "{worst}");
}
