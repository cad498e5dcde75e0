//! Energy balance: work of driven bodies and controls, and heat.

use crate::{ControlId, Drive, Interaction, Loads, State, Vectors, rotation};

/// Controls that store the energy balance of a [`System`](crate::System).
///
/// The energy of a trajectory minus work and heat is constant to the error of the integrator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnergyBalance {
    /// Work done by driven bodies and controls (pN nm).
    pub work: ControlId,
    /// Heat added by noise minus heat removed by drag (pN nm).
    pub heat: ControlId,
}

impl EnergyBalance {
    /// Adds the work of `drive` over a time `t` (ns) at the present positions, where `loads` act.
    ///
    /// To be called with each kick: the sum then has the order of the integrator, because this is
    /// the kick of the momentum conjugate to time.
    pub(crate) fn record_work(
        &self,
        state: &mut State,
        (drive, interactions): (&dyn Drive, &[Box<dyn Interaction>]),
        loads: &Loads,
        t: f64,
    ) {
        let by_bodies = t * power_of_held(state, loads);
        let by_controls = drive.work_of_controls(state, interactions, t);
        state.controls[self.work] += by_bodies + by_controls;
    }
}

/// Work (pN nm) of the sum of two loads on free bodies between two states.
pub(crate) fn work_on_free([a, b]: [&Loads; 2], [from, to]: [&State; 2]) -> f64 {
    let force = |i: usize| a.force.get(i) + b.force.get(i);
    let (places, frames) = (&from.points.position, &from.frames.orientation);
    let mut moved = Vectors::zeros(from.points.len());
    for i in 0..from.points.len() {
        moved.set(i, to.points.position.get(i) - places.get(i));
    }
    let mut work = 0.0;
    for i in (0..from.points.len()).filter(|&i| from.points.is_free(i)) {
        work += force(i).dot(&moved.get(i));
    }
    for slider in from.sliders.iter() {
        let slid = slider.sliding_velocity(&moved);
        for &i in &slider.points {
            work += force(i).dot(&slid);
        }
    }
    for i in (0..from.frames.len()).filter(|&i| from.frames.is_free(i)) {
        let turned = frames.get(i).inverse() * to.frames.orientation.get(i);
        let torque = a.torque.get(i) + b.torque.get(i);
        work += torque.dot(&rotation::log(turned));
    }
    work
}

/// Power that held bodies supply against the loads on them (pN nm/ns).
fn power_of_held(state: &State, loads: &Loads) -> f64 {
    let mut gained = 0.0;
    for i in (0..state.points.len()).filter(|&i| !state.points.is_free(i)) {
        gained += loads.force.get(i).dot(&state.points.velocity.get(i));
    }
    // Sliding bodies are free along their directions.
    for slider in state.sliders.iter() {
        let sliding = slider.sliding_velocity(&state.points.velocity);
        for &i in &slider.points {
            gained -= loads.force.get(i).dot(&sliding);
        }
    }
    for i in (0..state.frames.len()).filter(|&i| !state.frames.is_free(i)) {
        let momentum = state.frames.angular_momentum.get(i);
        let omega = state.frames.angular_velocity(i, momentum);
        gained += loads.torque.get(i).dot(&omega);
    }
    -gained
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{push_frame, push_point};
    use crate::{Slider, UnitQuaternion, Vector3};

    #[test]
    fn loads_work_on_free_bodies_and_along_sliders() {
        let mut from = State::default();
        for _ in 0..3 {
            push_point(&mut from, Vector3::zeros(), 1.0);
        }
        push_frame(&mut from, UnitQuaternion::identity(), [1.0; 3]);
        from.points.hold(1);
        from.points.hold(2);
        from.sliders.push(Slider {
            points: vec![1, 2],
            directions: vec![Vector3::y()],
            mass: 1.0,
        });
        let mut to = from.clone();
        to.points.position.set(0, Vector3::new(1.0, 2.0, 3.0));
        for i in [1, 2] {
            to.points.position.set(i, Vector3::new(5.0, 0.5, 0.0));
        }
        let turned = rotation::exp(Vector3::z() * 0.1);
        to.frames.orientation.set(0, turned);
        let (mut a, mut b) = (Loads::zeros(&from), Loads::zeros(&from));
        a.force.set(0, Vector3::x());
        b.force.set(0, Vector3::y());
        a.force.set(1, Vector3::new(9.0, 2.0, 0.0));
        b.force.set(2, Vector3::new(9.0, 4.0, 0.0));
        a.torque.set(0, Vector3::z() * 3.0);
        let expected = (1.0 + 2.0) + 0.5 * (2.0 + 4.0) + 0.3;
        let work = work_on_free([&a, &b], [&from, &to]);
        assert!((work - expected).abs() < 1e-14, "{work}");
    }
}
