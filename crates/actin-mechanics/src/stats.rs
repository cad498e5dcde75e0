//! Fast check of a state for divergence, in one vectorised pass.
#![allow(
    clippy::inline_always,
    reason = "vector code must be compiled into the function that enables the instructions"
)]

use crate::wide::{self, Columns, Simd, Sums, WithSimd};
use crate::{Frames, Points, State};

/// Result of [`State::stats`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StateStats {
    /// Kinetic energy of free and sliding bodies.
    ///
    /// It is not finite if any number of the state is not finite, also of held bodies, or if a
    /// square overflows.
    pub kinetic_energy: f64,
    /// Largest squared angular velocity of the free frames, valid if `kinetic_energy` is finite.
    pub largest_spin_squared: f64,
}

impl State {
    /// Computes the kinetic energy and checks all numbers of the state, in one vectorised pass.
    ///
    /// The energy equals [`kinetic_energy`](Self::kinetic_energy) up to the order of summation.
    ///
    /// ```
    /// use actin_mechanics::{Point, State, Vector3};
    /// let mut state = State::default();
    /// let (position, mass) = (Vector3::zeros(), 3.0);
    /// state.points.push(Point { position, mass });
    /// state.points.velocity.set(0, Vector3::new(0.0, 2.0, 0.0));
    /// assert_eq!(state.stats().kinetic_energy, 6.0);
    /// state.points.position.x[0] = f64::INFINITY;
    /// assert!(!state.stats().kinetic_energy.is_finite());
    /// ```
    pub fn stats(&self) -> StateStats {
        let sliding: f64 = self
            .sliders
            .iter()
            .map(|s| s.kinetic_energy(&self.points))
            .sum();
        let of_bodies = wide::dispatch(Pass(self));
        StateStats {
            kinetic_energy: of_bodies.kinetic_energy + sliding,
            ..of_bodies
        }
    }
}

struct Pass<'a>(&'a State);

impl WithSimd for Pass<'_> {
    type Output = StateStats;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> StateStats {
        let points = points(simd, &self.0.points);
        let (frames, squared) = frames(simd, &self.0.frames);
        StateStats {
            kinetic_energy: 0.5 * (points + frames),
            largest_spin_squared: simd.reduce_max_f64s(squared),
        }
    }
}

/// Twice the kinetic energy of free points, or NaN if any number of any point is not finite: zero
/// times such a number is NaN.
#[inline(always)]
fn points<S: Simd>(simd: S, points: &Points) -> f64 {
    let (x, v) = (&points.position, &points.velocity);
    let places = Columns::<S, 3>::new([&x.x, &x.y, &x.z]);
    let motion = Columns::<S, 4>::new([&v.x, &v.y, &v.z, points.inverse_mass()]);
    let (zero, one) = (simd.splat_f64s(0.0), simd.splat_f64s(1.0));
    let mut sums = [Sums::new(simd), Sums::new(simd)];
    for group in 0..places.groups() {
        let [x, y, z] = places.get(simd, group);
        let [u, v, w, inverse] = motion.get(simd, group);
        let moves = simd.greater_than_f64s(inverse, zero);
        let mass = simd.select_f64s(moves, simd.div_f64s(one, inverse), zero);
        let squared = wide::dot(simd, [u, v, w], [u, v, w]);
        sums[0].add(simd, group, simd.mul_f64s(mass, squared));
        let place = simd.add_f64s(simd.add_f64s(x, y), z);
        sums[1].add(simd, group, simd.mul_f64s(zero, place));
    }
    sums[0].total(simd) + sums[1].total(simd)
}

/// Twice the kinetic energy of free frames, or NaN if any number of any frame is not finite, and
/// the largest squared angular velocity.
#[inline(always)]
fn frames<S: Simd>(simd: S, frames: &Frames) -> (f64, S::f64s) {
    let (q, l) = (&frames.orientation, &frames.angular_momentum);
    let turns = Columns::<S, 4>::new([&q.w, &q.x, &q.y, &q.z]);
    let momenta = Columns::<S, 3>::new([&l.x, &l.y, &l.z]);
    let inertia = Columns::<S, 5>::new(frames.inertia_columns());
    let zero = simd.splat_f64s(0.0);
    let (mut sums, mut largest) = ([Sums::new(simd), Sums::new(simd)], zero);
    for group in 0..turns.groups() {
        let [w, x, y, z] = turns.get(simd, group);
        let l = momenta.get(simd, group);
        let [transverse, ex, ey, ez, mobility] = inertia.get(simd, group);
        let spin = wide::mul_each(simd, l, [ex, ey, ez].map(|e| simd.add_f64s(transverse, e)));
        let moving = wide::scale(simd, spin, mobility);
        sums[0].add(simd, group, wide::dot(simd, l, moving));
        largest = simd.max_f64s(largest, wide::dot(simd, moving, moving));
        let turn = simd.add_f64s(simd.add_f64s(w, x), simd.add_f64s(y, z));
        sums[1].add(simd, group, simd.mul_f64s(zero, turn));
    }
    (sums[0].total(simd) + sums[1].total(simd), largest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::architectures;
    use crate::testing::{push_frame, push_point};
    use crate::{Slider, UnitQuaternion, Vector3};
    use crate::{Xorshift, perturb, randomise_velocities};

    fn moving(bodies: usize) -> State {
        let mut state = State::default();
        let tops = [[2.0, 1.0, 1.0], [1.0, 2.0, 1.0], [1.0, 1.0, 2.0]];
        for i in 0..bodies {
            push_point(&mut state, Vector3::zeros(), 1.0 + i as f64);
            push_frame(&mut state, UnitQuaternion::identity(), tops[i % 3]);
        }
        let mut noise = Xorshift::new(8);
        perturb(&mut state, &mut noise, 1.0, 1.0);
        randomise_velocities(&mut state, &mut noise, 1.0, 1.0);
        if bodies > 1 {
            state.points.hold(1);
            state.frames.hold(1);
            state.points.velocity.set(1, Vector3::x() * 50.0);
            state.frames.angular_momentum.set(1, Vector3::x() * 50.0);
        }
        if bodies > 2 {
            state.points.hold(2);
            state.points.velocity.set(2, Vector3::z());
            let directions = vec![Vector3::z()];
            state.sliders.push(Slider {
                points: vec![2],
                directions,
                mass: 7.0,
            });
        }
        state
    }

    fn spin_squared(state: &State, i: usize) -> f64 {
        let frames = &state.frames;
        if !frames.is_free(i) {
            return 0.0;
        }
        let omega = frames.angular_velocity(i, frames.angular_momentum.get(i));
        omega.norm_squared()
    }

    #[test]
    fn stats_agree_with_scalar_functions() {
        for bodies in [0, 1, 2, 3, 4, 7, 8, 13, 64] {
            let state = moving(bodies);
            let spins = (0..bodies).map(|i| spin_squared(&state, i));
            let (spin, kinetic) = (spins.fold(0.0, f64::max), state.kinetic_energy());
            let sliding: f64 = state
                .sliders
                .iter()
                .map(|s| s.kinetic_energy(&state.points))
                .sum();
            for arch in architectures() {
                let survey = arch.dispatch(Pass(&state));
                // Rounding of a sum of positive terms.
                let tolerance = 1e-15 * (4.0 + bodies as f64);
                let energy = survey.kinetic_energy + sliding;
                assert!((energy - kinetic).abs() <= tolerance * kinetic, "{bodies}");
                assert!((survey.largest_spin_squared - spin).abs() <= 1e-15 * spin);
            }
            let whole = state.stats().kinetic_energy;
            assert!((whole - kinetic).abs() <= 1e-15 * (4.0 + bodies as f64) * kinetic);
        }
    }

    #[test]
    fn stats_do_not_depend_on_the_number_of_lanes() {
        for bodies in [1, 4, 13, 64, 101] {
            let state = moving(bodies);
            crate::testing::assert_same_with_any_lanes(|arch| {
                let survey = arch.dispatch(Pass(&state));
                vec![survey.kinetic_energy, survey.largest_spin_squared]
            });
        }
    }

    fn columns(state: &mut State) -> [&mut Vec<f64>; 13] {
        let (x, v) = (&mut state.points.position, &mut state.points.velocity);
        let (q, l) = (
            &mut state.frames.orientation,
            &mut state.frames.angular_momentum,
        );
        [
            &mut x.x, &mut x.y, &mut x.z, &mut v.x, &mut v.y, &mut v.z, &mut q.w, &mut q.x,
            &mut q.y, &mut q.z, &mut l.x, &mut l.y, &mut l.z,
        ]
    }

    #[test]
    fn every_invalid_number_is_detected() {
        for bodies in [1, 3, 4, 11] {
            for (column, i) in (0..13).flat_map(|c| (0..bodies).map(move |i| (c, i))) {
                for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                    let mut state = moving(bodies);
                    columns(&mut state)[column][i] = bad;
                    for arch in architectures() {
                        let kinetic = arch.dispatch(Pass(&state)).kinetic_energy;
                        assert!(!kinetic.is_finite(), "column {column}, body {i}, {bad}");
                    }
                }
            }
        }
    }

    #[test]
    fn large_positions_are_valid() {
        let mut state = moving(5);
        state.points.position.set(3, Vector3::repeat(1e300));
        assert!(state.stats().kinetic_energy.is_finite());
        state.points.velocity.set(3, Vector3::repeat(1e200));
        assert!(!state.stats().kinetic_energy.is_finite());
    }
}
