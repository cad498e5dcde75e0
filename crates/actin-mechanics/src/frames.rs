//! Frames: orientations with an inertia. The kernel of free rotation is in `frames/drift.rs`.

mod drift;

use crate::inertia::is_inertia;
use crate::sums::add_scaled;
use crate::vectors::{damp_where, sum_in_lanes};
use crate::{Inertia, Quaternions, Shared, UnitQuaternion, Vector3, Vectors, wide};
use drift::Drift;

/// Input of [`Frames::push`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Orientation, body to lab.
    pub orientation: UnitQuaternion,
    /// Inertia in body axes.
    pub inertia: Inertia,
}

impl Frame {
    /// Returns `true` if the orientation is finite, and all moments of inertia and their inverses
    /// are positive and finite.
    pub fn is_valid(&self) -> bool {
        let is_oriented = self.orientation.coords.iter().all(|q| q.is_finite());
        let moments = [self.inertia.axial, self.inertia.transverse];
        let mut both = moments.iter().flat_map(|&m| [m, 1.0 / m]);
        is_oriented && both.all(is_inertia)
    }
}

/// All frames of a state. Every frame is a symmetric top.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frames {
    /// Orientations, body to lab.
    pub orientation: Quaternions,
    /// Angular momenta in body axes.
    pub angular_momentum: Vectors,
    inertias: Shared<Inertias>,
}

#[derive(Clone, Debug, Default, PartialEq)]
struct Inertias {
    /// 1 / transverse moment.
    inverse_transverse: Vec<f64>,
    /// `(1 / axial - 1 / transverse)` times the unit vector of the symmetry axis.
    excess: Vectors,
    /// `true` if the symmetry axis of any frame is not the third body axis.
    off_z: bool,
    /// 1 for free frames, 0 for held frames.
    mobility: Vec<f64>,
}

impl Frames {
    /// Number of frames.
    pub fn len(&self) -> usize {
        self.inertias.mobility.len()
    }

    /// Returns `true` if there are no frames.
    pub fn is_empty(&self) -> bool {
        self.inertias.mobility.is_empty()
    }

    pub(crate) fn bodies(&self) -> Self {
        Self {
            inertias: self.inertias.clone(),
            ..Self::default()
        }
    }

    /// Appends a frame at rest and returns its index.
    ///
    /// # Panics
    /// If the frame is not [valid](Frame::is_valid).
    pub fn push(&mut self, frame: Frame) -> usize {
        assert!(
            frame.is_valid(),
            "an orientation must be finite, moments of inertia and their inverses positive and finite, \
             got {frame:?}"
        );
        let Inertia {
            axis,
            axial,
            transverse,
        } = frame.inertia;
        self.orientation.push(frame.orientation);
        self.angular_momentum.push(Vector3::zeros());
        self.inertias.inverse_transverse.push(1.0 / transverse);
        let excess = axis.unit() * (1.0 / axial - 1.0 / transverse);
        self.inertias.excess.push(excess);
        self.inertias.off_z |= excess.x != 0.0 || excess.y != 0.0;
        self.inertias.mobility.push(1.0);
        self.len() - 1
    }

    /// Holds frame `i`: torques do not change its angular momentum, which is set to zero.
    ///
    /// The inertia is kept for driven frames.
    /// # Panics
    /// If there is no frame `i`.
    pub fn hold(&mut self, i: usize) {
        self.inertias.mobility[i] = 0.0;
        self.angular_momentum.set(i, Vector3::zeros());
    }

    /// Frees frame `i` again, at rest. Does nothing if it is already free.
    ///
    /// # Panics
    /// If there is no frame `i`.
    pub fn release(&mut self, i: usize) {
        if !self.is_free(i) {
            self.inertias.mobility[i] = 1.0;
            self.angular_momentum.set(i, Vector3::zeros());
        }
    }

    /// Returns `true` if frame `i` is free.
    pub fn is_free(&self, i: usize) -> bool {
        self.inertias.mobility[i] > 0.0
    }

    /// Angular velocity of frame `i` for the angular momentum `l` (both in the body frame).
    pub fn angular_velocity(&self, i: usize, l: Vector3) -> Vector3 {
        l * self.inertias.inverse_transverse[i] + l.component_mul(&self.inertias.excess.get(i))
    }

    /// Inverse principal moments of frame `i`, also if it is held.
    pub fn inverse_moments(&self, i: usize) -> Vector3 {
        self.inertias
            .excess
            .get(i)
            .add_scalar(self.inertias.inverse_transverse[i])
    }

    /// Columns `1 / transverse`, excess of the inverse moments about the three body axes, and
    /// mobility (1 for free frames, 0 for held frames).
    pub(crate) fn inertia_columns(&self) -> [&[f64]; 5] {
        let excess = &self.inertias.excess;
        [
            &self.inertias.inverse_transverse,
            &excess.x,
            &excess.y,
            &excess.z,
            &self.inertias.mobility,
        ]
    }

    pub(crate) fn assert_shape(&self) {
        let count = self.len();
        self.orientation.assert_len("orientations", count);
        self.angular_momentum.assert_len("angular momenta", count);
    }

    /// Rotates every frame freely for a time `h`, by its exact flow.
    ///
    /// Quaternions are renormalised to first order, which keeps unit length to round-off.
    pub fn drift(&mut self, h: f64) {
        wide::dispatch(Drift { frames: self, h });
    }

    /// Applies the body torques `torque` for a time `h`.
    pub fn kick(&mut self, torque: &Vectors, h: f64) {
        add_scaled(
            &mut self.angular_momentum,
            torque,
            &self.inertias.mobility,
            h,
        );
    }

    /// Adds `deviates` times the square root of the moment to each component of the body angular
    /// momentum of each free frame.
    pub(crate) fn add_thermal_impulses(&mut self, deviates: &Vectors) {
        let (l, excess) = (&mut self.angular_momentum, &self.inertias.excess);
        for (l, excess, d) in [
            (&mut l.x, &excess.x, &deviates.x),
            (&mut l.y, &excess.y, &deviates.y),
            (&mut l.z, &excess.z, &deviates.z),
        ] {
            let tops = excess.iter().zip(&self.inertias.inverse_transverse);
            for (((l, d), m), (excess, inverse)) in
                l.iter_mut().zip(d).zip(&self.inertias.mobility).zip(tops)
            {
                *l += m * d / (excess + inverse).sqrt();
            }
        }
    }

    pub(crate) fn damp(&mut self, factor: f64) {
        damp_where(&mut self.angular_momentum, &self.inertias.mobility, factor);
    }

    /// Kinetic energy of free frames.
    pub(crate) fn kinetic_energy(&self) -> f64 {
        let l = &self.angular_momentum;
        let [transverse, x, y, z, mobility] = self.inertia_columns();
        let columns = [transverse, x, y, z, mobility, &l.x, &l.y, &l.z];
        0.5 * sum_in_lanes(columns, |[transverse, x, y, z, mobility, lx, ly, lz]| {
            let excess = lx * lx * x + ly * ly * y + lz * lz * z;
            mobility * (transverse * (lx * lx + ly * ly + lz * lz) + excess)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Xorshift;
    use crate::rotation;
    use crate::testing::architectures;

    #[test]
    fn drift_is_the_free_flow_of_each_top() {
        let tops = [[2.0, 1.0, 1.0], [1.0, 2.0, 1.0], [1.0, 1.0, 2.0], [1.5; 3]]
            .map(|moments| Inertia::from_moments(moments).unwrap());
        // All tops, then tops with symmetry axis z, which have a separate kernel.
        for (tops, count) in [&tops[..], &tops[2..]]
            .into_iter()
            .flat_map(|tops| [1, 2, 4, 7, 13].map(|count| (tops, count)))
        {
            for h in [0.0, 1e-9, 0.01, -0.3, 0.7, 100.0] {
                for arch in architectures() {
                    let (before, mut frames) = spinning(tops, count);
                    let all = &mut frames;
                    arch.dispatch(Drift { frames: all, h });
                    for (i, (q, l)) in before.into_iter().enumerate() {
                        let (q, l) = tops[i % tops.len()].free_flow(q, l, h);
                        let turned = frames.orientation.get(i).coords - q.coords;
                        // Rounding of the angle for the longest time.
                        let tolerance = 1e-15 * (1.0 + h.abs());
                        assert!(turned.norm() < tolerance, "{count} frames, h = {h}");
                        let momentum = frames.angular_momentum.get(i) - l;
                        assert!(momentum.norm() < 2.0 * tolerance, "{count} frames, h = {h}");
                    }
                }
            }
        }
    }

    #[test]
    fn drift_is_the_same_with_any_number_of_lanes() {
        let tops = [[1.0, 1.0, 2.0], [2.0, 1.0, 1.0]]
            .map(|moments| Inertia::from_moments(moments).unwrap());
        for tops in [&tops[..1], &tops[..]] {
            for h in [1e-3, 0.2, 0.5, 3.0] {
                crate::testing::assert_same_with_any_lanes(|arch| {
                    let (_, mut frames) = spinning(tops, 29);
                    let all = &mut frames;
                    arch.dispatch(Drift { frames: all, h });
                    let (q, l) = (frames.orientation, frames.angular_momentum);
                    [q.w, q.x, q.y, q.z, l.x, l.y, l.z].concat()
                });
            }
        }
    }

    fn spinning(tops: &[Inertia], count: usize) -> (Vec<(UnitQuaternion, Vector3)>, Frames) {
        let mut noise = Xorshift::new(5);
        let mut frames = Frames::default();
        let motion = (0..count).map(|i| {
            let orientation = rotation::exp(noise.vector() * 3.0);
            frames.push(Frame {
                orientation,
                inertia: tops[i % tops.len()],
            });
            let l = noise.vector();
            frames.angular_momentum.set(i, l);
            (orientation, l)
        });
        (motion.collect(), frames)
    }

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
    fn invalid_moments_are_refused() {
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-310] {
            for (axial, transverse) in [(bad, 1.0), (1.0, bad)] {
                let inertia = Inertia {
                    axis: crate::Axis::Z,
                    axial,
                    transverse,
                };
                let orientation = UnitQuaternion::identity();
                let frame = Frame {
                    orientation,
                    inertia,
                };
                let push = || Frames::default().push(frame);
                assert!(std::panic::catch_unwind(push).is_err(), "{bad}");
            }
        }
    }

    #[test]
    fn torques_do_not_move_held_frames() {
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
