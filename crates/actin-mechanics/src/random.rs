//! Random perturbations of positions and velocities.

use crate::{State, Vector3, rotation};

/// Pseudorandom numbers in [-1, 1), reproducible on every machine, for perturbed states and tests.
///
/// # Source
/// xorshift64*: Vigna, ACM Trans. Math. Softw. 42 (2016) 30.
#[derive(Clone, Debug, PartialEq)]
pub struct Xorshift(u64);

impl Xorshift {
    /// Creates a generator from a seed.
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ 0xD1B5_4A32_D192_ED03)
    }

    /// Next number.
    pub fn sample(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        let bits = self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11;
        bits as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// Vector of three numbers.
    pub fn vector(&mut self) -> Vector3 {
        Vector3::new(self.sample(), self.sample(), self.sample())
    }
}

/// Displaces each point by up to `length` and rotates each frame by up to `angle` (rad) per axis.
pub fn perturb(state: &mut State, random: &mut Xorshift, length: f64, angle: f64) {
    for i in 0..state.points.len() {
        state.points.position.add(i, random.vector() * length);
    }
    for i in 0..state.frames.len() {
        let q = state.frames.orientation.get(i) * rotation::exp(random.vector() * angle);
        state.frames.orientation.set(i, q);
    }
}

/// Gives each free body a random velocity of up to `velocity` or `angular_velocity` (rad per time)
/// per axis.
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
