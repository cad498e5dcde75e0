//! Precession of a free symmetric top about its angular momentum, compared with Euler's theory.

use actin_mechanics::{Frame, Inertia, InertiaError, State, UnitQuaternion, Vector3};

fn main() -> Result<(), InertiaError> {
    let transverse = 1.0;
    let mut state = State::default();
    let top = state.frames.push(Frame {
        orientation: UnitQuaternion::identity(),
        inertia: Inertia::from_moments([transverse, transverse, 2.0])?,
    });
    let momentum = Vector3::new(0.0, 0.3, 1.0);
    state.frames.angular_momentum.set(top, momentum);

    // One step of any length is exact.
    let time = 2.0;
    state.frames.drift(time);
    let axis = state.frames.orientation.get(top) * Vector3::z();

    // Rotation by L t / I about the angular momentum, which is constant in the lab frame.
    let precession = UnitQuaternion::from_scaled_axis(momentum * (time / transverse));
    let theory = precession * Vector3::z();
    println!("axis: {:.12} {:.12} {:.12}", axis.x, axis.y, axis.z);
    println!("Euler: {:.12} {:.12} {:.12}", theory.x, theory.y, theory.z);
    assert!((axis - theory).norm() < 1e-14);
    Ok(())
}
