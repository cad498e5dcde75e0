//! Frames: orientations with an inertia.

use crate::{Inertia, Quaternions, UnitQuaternion, Vector3, Vectors};

/// One frame, as it enters a [`Frames`].
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    /// Orientation, body to lab.
    pub orientation: UnitQuaternion,
    /// Inertia in body axes.
    pub inertia: Inertia,
}

/// All frames of a state. Every frame is a symmetric top.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frames {
    /// Orientations, body to lab.
    pub orientation: Quaternions,
    /// Angular momenta in body axes.
    pub angular_momentum: Vectors,
    /// 1 / transverse moment.
    inverse_transverse: Vec<f64>,
    /// (1 / axial - 1 / transverse) times the unit vector of the axis of symmetry.
    excess: Vectors,
    /// Unit vector of the axis of symmetry.
    axis: Vectors,
    /// 1 where torques turn the frame, 0 where it is held.
    mobility: Vec<f64>,
}

impl Frames {
    /// Number of frames.
    pub fn len(&self) -> usize {
        self.mobility.len()
    }

    /// Whether there is no frame at all.
    pub fn is_empty(&self) -> bool {
        self.mobility.is_empty()
    }

    /// Appends a frame at rest and returns its index.
    pub fn push(&mut self, frame: Frame) -> usize {
        let Inertia {
            axis,
            axial,
            transverse,
        } = frame.inertia;
        self.orientation.push(frame.orientation);
        self.angular_momentum.push(Vector3::zeros());
        self.inverse_transverse.push(1.0 / transverse);
        self.excess
            .push(axis.unit() * (1.0 / axial - 1.0 / transverse));
        self.axis.push(axis.unit());
        self.mobility.push(1.0);
        self.len() - 1
    }

    /// Takes frame `i` out of the reach of torques; it keeps whatever angular momentum it is
    /// given from outside (zero unless driven).
    ///
    /// Its inertia is kept, so that a driven frame turns by the same exact flow as a free one.
    pub fn hold(&mut self, i: usize) {
        self.mobility[i] = 0.0;
        self.angular_momentum.set(i, Vector3::zeros());
    }

    /// Whether torques turn frame `i`.
    pub fn is_free(&self, i: usize) -> bool {
        self.mobility[i] > 0.0
    }

    /// Body angular velocity for body angular momentum `l` of frame `i`.
    pub fn angular_velocity(&self, i: usize, l: Vector3) -> Vector3 {
        l * self.inverse_transverse[i] + l.component_mul(&self.excess.get(i))
    }

    /// Inverse principal moments of frame `i` as if it were free.
    pub fn inverse_moments(&self, i: usize) -> Vector3 {
        self.excess.get(i).add_scalar(self.inverse_transverse[i])
    }

    /// Turns every frame freely for a time `h`: the exact flow of [`Inertia::free_flow`].
    ///
    /// The quaternions are brought back to unit length to first order, which keeps them there to
    /// round-off over any number of steps.
    pub fn drift(&mut self, h: f64) {
        for i in 0..self.len() {
            let l = self.angular_momentum.get(i);
            let axis = self.axis.get(i);
            // One component of the excess differs from zero, so this is its rate about the axis.
            let angle = h * l.dot(&self.excess.get(i));
            let spin = axis_turn(axis, angle);
            let precession = crate::rotation::exp(l * (h * self.inverse_transverse[i]));
            let q = self.orientation.get(i) * precession * spin;
            let correction = 1.5 - 0.5 * q.norm_squared();
            let q = nalgebra::Unit::new_unchecked(q.into_inner() * correction);
            self.orientation.set(i, q);
            self.angular_momentum.set(i, turn_about(axis, -angle, l));
        }
    }

    /// Applies the body torques `torque` for a time `h`.
    pub fn kick(&mut self, torque: &Vectors, h: f64) {
        let l = &mut self.angular_momentum;
        for (l, t) in [
            (&mut l.x, &torque.x),
            (&mut l.y, &torque.y),
            (&mut l.z, &torque.z),
        ] {
            for ((l, t), m) in l.iter_mut().zip(t).zip(&self.mobility) {
                *l += h * m * t;
            }
        }
    }

    /// Adds to each component of each body angular momentum `deviates` times the root of the
    /// moment about that axis; nothing to those of held frames.
    pub(crate) fn agitate(&mut self, deviates: &Vectors) {
        let (l, excess) = (&mut self.angular_momentum, &self.excess);
        for (l, excess, d) in [
            (&mut l.x, &excess.x, &deviates.x),
            (&mut l.y, &excess.y, &deviates.y),
            (&mut l.z, &excess.z, &deviates.z),
        ] {
            let tops = excess.iter().zip(&self.inverse_transverse);
            for (((l, d), m), (excess, inverse)) in
                l.iter_mut().zip(d).zip(&self.mobility).zip(tops)
            {
                *l += m * d / (excess + inverse).sqrt();
            }
        }
    }

    /// Kinetic energy of the free frames.
    pub fn kinetic_energy(&self) -> f64 {
        (0..self.len())
            .filter(|&i| self.is_free(i))
            .map(|i| {
                let l = self.angular_momentum.get(i);
                0.5 * l.dot(&self.angular_velocity(i, l))
            })
            .sum()
    }
}

/// Rotation by `angle` about the unit vector `axis`.
fn axis_turn(axis: Vector3, angle: f64) -> UnitQuaternion {
    let (sin, cos) = (0.5 * angle).sin_cos();
    let v = sin * axis;
    nalgebra::Unit::new_unchecked(nalgebra::Quaternion::new(cos, v.x, v.y, v.z))
}

/// `l` turned by `angle` about the unit vector `axis` (Rodrigues).
fn turn_about(axis: Vector3, angle: f64, l: Vector3) -> Vector3 {
    let (sin, cos) = angle.sin_cos();
    let along = axis * axis.dot(&l);
    along + (l - along) * cos + axis.cross(&l) * sin
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rotation;

    /// The flow over all frames is the reference flow of each, whichever axis it has.
    #[test]
    fn drift_is_the_free_flow_of_each_top() {
        let q = rotation::exp(Vector3::new(0.2, 0.5, -0.9));
        let l = Vector3::new(0.3, -0.8, 0.4);
        for moments in [[2.0, 1.0, 1.0], [1.0, 2.0, 1.0], [1.0, 1.0, 2.0]] {
            let inertia = Inertia::from_moments(moments).unwrap();
            let mut frames = Frames::default();
            frames.push(Frame {
                orientation: q,
                inertia,
            });
            frames.angular_momentum.set(0, l);
            frames.drift(0.7);
            let (q_expected, l_expected) = inertia.free_flow(q, l, 0.7);
            assert!((frames.orientation.get(0).coords - q_expected.coords).norm() < 1e-15);
            assert!((frames.angular_momentum.get(0) - l_expected).norm() < 1e-15);
        }
    }

    /// Without the correction the length would wander as the square root of the step count.
    #[test]
    fn quaternions_keep_unit_length() {
        let mut frames = Frames::default();
        frames.push(Frame {
            orientation: UnitQuaternion::identity(),
            inertia: Inertia::from_moments([1.0, 1.0, 2.0]).unwrap(),
        });
        frames.angular_momentum.set(0, Vector3::new(1.0, 2.0, 3.0));
        (0..100_000).for_each(|_| frames.drift(0.37));
        assert!((frames.orientation.get(0).norm() - 1.0).abs() < 4e-16);
    }

    #[test]
    fn a_held_frame_does_not_answer_torques() {
        let mut frames = Frames::default();
        frames.push(Frame {
            orientation: UnitQuaternion::identity(),
            inertia: Inertia::from_moments([1.0, 1.0, 2.0]).unwrap(),
        });
        frames.hold(0);
        frames.kick(&[Vector3::x()].into_iter().collect(), 1.0);
        frames.drift(1.0);
        assert_eq!(frames.orientation.get(0), UnitQuaternion::identity());
        assert!(frames.kinetic_energy() == 0.0);
    }
}
