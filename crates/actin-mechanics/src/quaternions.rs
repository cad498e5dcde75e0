//! Arrays of unit quaternions, stored by component.

use crate::{UnitQuaternion, vectors};
use nalgebra::{Quaternion, Unit};

/// Array of unit quaternions (body to lab), stored as four arrays, scalar part first.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Quaternions {
    /// Scalar parts.
    pub w: Vec<f64>,
    /// First imaginary parts.
    pub x: Vec<f64>,
    /// Second imaginary parts.
    pub y: Vec<f64>,
    /// Third imaginary parts.
    pub z: Vec<f64>,
}

impl Quaternions {
    /// Number of quaternions.
    pub fn len(&self) -> usize {
        self.w.len()
    }

    /// Returns `true` if there are no quaternions.
    pub fn is_empty(&self) -> bool {
        self.w.is_empty()
    }

    /// Quaternion `i`, not renormalised (unit length to round-off).
    #[inline]
    pub fn get(&self, i: usize) -> UnitQuaternion {
        Unit::new_unchecked(Quaternion::new(self.w[i], self.x[i], self.y[i], self.z[i]))
    }

    /// Replaces quaternion `i`.
    #[inline]
    pub fn set(&mut self, i: usize, q: UnitQuaternion) {
        self.w[i] = q.w;
        self.x[i] = q.i;
        self.y[i] = q.j;
        self.z[i] = q.k;
    }

    /// Appends a quaternion.
    pub(crate) fn push(&mut self, q: UnitQuaternion) {
        self.w.push(q.w);
        self.x.push(q.i);
        self.y.push(q.j);
        self.z.push(q.k);
    }

    pub(crate) fn assert_len(&self, what: &str, count: usize) {
        vectors::assert_lengths(what, &[&self.w, &self.x, &self.y, &self.z], count);
    }

    pub(crate) fn copy_from(&mut self, other: &Self) {
        self.w.copy_from_slice(&other.w);
        self.x.copy_from_slice(&other.x);
        self.y.copy_from_slice(&other.y);
        self.z.copy_from_slice(&other.z);
    }

    /// Iterates over the quaternions.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = UnitQuaternion> + '_ {
        (0..self.len()).map(|i| self.get(i))
    }
}
