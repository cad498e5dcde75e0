//! Inertia of frames, and the exact free rotation of a symmetric top.

use crate::Vector3;
#[cfg(test)]
use crate::{UnitQuaternion, rotation};
use thiserror::Error;

/// A body axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// First body axis.
    X,
    /// Second body axis.
    Y,
    /// Third body axis.
    Z,
}

impl Axis {
    /// Unit vector along the axis.
    pub(crate) fn unit(self) -> Vector3 {
        match self {
            Self::X => Vector3::x(),
            Self::Y => Vector3::y(),
            Self::Z => Vector3::z(),
        }
    }
}

/// Invalid moments of inertia.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum InertiaError {
    /// A moment is not a positive finite number.
    #[error("moments of inertia must be positive and finite, got {0:?}")]
    NotPositive([f64; 3]),
    /// The three moments all differ.
    #[error(
        "moments of inertia {0:?} all differ: two must be equal, because only the free rotation of a \
         symmetric top has a closed form"
    )]
    Asymmetric([f64; 3]),
}

pub(crate) fn is_inertia(value: f64) -> bool {
    value.is_finite() && value > 0.0
}

/// Principal moments of inertia of a symmetric top in its body axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inertia {
    /// Axis of symmetry.
    pub axis: Axis,
    /// Moment about the axis of symmetry.
    pub axial: f64,
    /// Moment about any axis perpendicular to the axis of symmetry.
    pub transverse: f64,
}

impl Inertia {
    /// Creates the top with the given principal moments about the body axes x, y, z.
    ///
    /// # Errors
    /// If a moment is not positive and finite, or if all three moments differ.
    ///
    /// ```
    /// use actin_mechanics::{Axis, Inertia};
    /// let rod = Inertia::from_moments([1.0, 1.0, 2.0]).unwrap();
    /// assert_eq!(rod.axis, Axis::Z);
    /// assert!(Inertia::from_moments([1.0, 2.0, 3.0]).is_err());
    /// ```
    pub fn from_moments(moments: [f64; 3]) -> Result<Self, InertiaError> {
        if !moments.iter().all(|m| is_inertia(*m)) {
            return Err(InertiaError::NotPositive(moments));
        }
        let [x, y, z] = moments;
        let equal = |a: f64, b: f64| (a - b).abs() <= 1e-12 * (a + b);
        let (axis, axial, transverse) = if equal(x, y) {
            (Axis::Z, z, x)
        } else if equal(y, z) {
            (Axis::X, x, y)
        } else if equal(x, z) {
            (Axis::Y, y, x)
        } else {
            return Err(InertiaError::Asymmetric(moments));
        };
        Ok(Self {
            axis,
            axial,
            transverse,
        })
    }

    /// Principal moments about the body axes x, y, z.
    pub fn moments(&self) -> Vector3 {
        self.axis.unit() * (self.axial - self.transverse) + Vector3::from_element(self.transverse)
    }

    /// Torque-free motion over time `t` from orientation `q` and body angular momentum `l`.
    ///
    /// ```text
    /// Q(t) = Q exp(t l / I_t) exp(t e w)
    /// l(t) = exp(-t e w) l
    /// w    = (l . e) (1/I_a - 1/I_t)
    /// ```
    ///
    /// `e` is the axis of symmetry, `I_a` and `I_t` are the axial and transverse moments. The flow
    /// is exact for every `t`. It is the scalar reference for [`crate::Frames::drift`].
    #[cfg(test)]
    pub(crate) fn free_flow(
        &self,
        q: UnitQuaternion,
        l: Vector3,
        t: f64,
    ) -> (UnitQuaternion, Vector3) {
        let e = self.axis.unit();
        let spin = rotation::exp(e * (t * l.dot(&e) * (1.0 / self.axial - 1.0 / self.transverse)));
        let precession = rotation::exp(l * (t / self.transverse));
        (q * precession * spin, spin.inverse() * l)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn symmetric_axis_is_recognised() {
        for (moments, axis) in [
            ([2.0, 1.0, 1.0], Axis::X),
            ([1.0, 2.0, 1.0], Axis::Y),
            ([1.0, 1.0, 2.0], Axis::Z),
        ] {
            let top = Inertia::from_moments(moments).unwrap();
            assert_eq!(top.axis, axis);
            assert_eq!(top.moments(), Vector3::from(moments));
        }
    }

    #[test]
    fn asymmetric_moments_are_refused() {
        assert!(matches!(
            Inertia::from_moments([1.0, 2.0, 3.0]),
            Err(InertiaError::Asymmetric(_))
        ));
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(
                Inertia::from_moments([1.0, bad, 1.0]),
                Err(InertiaError::NotPositive(_))
            ));
        }
    }

    #[test]
    fn free_flow_solves_eulers_equations() {
        for moments in [[2.92, 2.18, 2.18], [1.0, 1.0, 2.0], [0.7, 3.0, 0.7]] {
            let top = Inertia::from_moments(moments).unwrap();
            let (q0, l0) = (
                rotation::exp(Vector3::new(0.4, -0.2, 1.0)),
                Vector3::new(0.9, -0.5, 0.7),
            );
            let t = 1.3;
            let (q, l) = top.free_flow(q0, l0, t);
            assert!((q * l - q0 * l0).norm() < 1e-14);

            let steps = 4000;
            let h = t / f64::from(steps);
            let omega = |l: Vector3| l.component_div(&top.moments());
            let rate = |l: Vector3| l.cross(&omega(l));
            let (mut qn, mut ln) = (q0, l0);
            for _ in 0..steps {
                let middle = ln + 0.5 * h * rate(ln);
                qn *= rotation::exp(h * omega(middle));
                ln += h * rate(middle);
            }
            assert!((l - ln).norm() < 1e-6);
            assert!(rotation::log(q.inverse() * qn).norm() < 1e-6);
        }
    }
}
