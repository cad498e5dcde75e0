//! States that are perturbed or set in motion at random.

use crate::{State, Vector3, rotation};

/// Cheap pseudorandom numbers in [-1, 1), the same on every machine.
///
/// For states to try things on; thermal noise has a generator of its own.
///
/// # Source
/// xorshift64*: Vigna, ACM Trans. Math. Softw. 42 (2016) 30.
#[derive(Clone, Debug, PartialEq)]
pub struct Xorshift(u64);

impl Xorshift {
    /// A source that always gives the same numbers for the same seed.
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ 0xD1B5_4A32_D192_ED03)
    }

    /// The next number (xorshift64*).
    pub fn sample(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        let bits = self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11;
        bits as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// A vector of three such numbers.
    pub fn vector(&mut self) -> Vector3 {
        Vector3::new(self.sample(), self.sample(), self.sample())
    }
}

/// Displaces every point by up to `length` and turns every frame by up to `angle` per axis.
pub fn perturb(state: &mut State, random: &mut Xorshift, length: f64, angle: f64) {
    for i in 0..state.points.len() {
        state.points.position.add(i, random.vector() * length);
    }
    for i in 0..state.frames.len() {
        let q = state.frames.orientation.get(i) * rotation::exp(random.vector() * angle);
        state.frames.orientation.set(i, q);
    }
}

/// Gives every free body a random motion of up to `velocity` and `angular_velocity` per axis.
pub fn randomise_velocities(
    state: &mut State,
    random: &mut Xorshift,
    velocity: f64,
    angular_velocity: f64,
) {
    for i in 0..state.points.len() {
        if state.points.is_free(i) {
            state.points.velocity.set(i, random.vector() * velocity);
        }
    }
    for i in 0..state.frames.len() {
        if state.frames.is_free(i) {
            let omega = random.vector() * angular_velocity;
            let l = omega.component_div(&state.frames.inverse_moments(i));
            state.frames.angular_momentum.set(i, l);
        }
    }
}
