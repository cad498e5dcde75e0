//! Many three-vectors, stored component by component.

use crate::Vector3;

/// `n` three-vectors as three arrays of `n` components, so that loops over them vectorise.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Vectors {
    /// First components.
    pub x: Vec<f64>,
    /// Second components.
    pub y: Vec<f64>,
    /// Third components.
    pub z: Vec<f64>,
}

impl Vectors {
    /// `n` zero vectors.
    pub fn zeros(n: usize) -> Self {
        Self {
            x: vec![0.0; n],
            y: vec![0.0; n],
            z: vec![0.0; n],
        }
    }

    /// Number of vectors.
    pub fn len(&self) -> usize {
        self.x.len()
    }

    /// Whether there is no vector at all.
    pub fn is_empty(&self) -> bool {
        self.x.is_empty()
    }

    /// Vector `i`.
    #[inline]
    pub fn get(&self, i: usize) -> Vector3 {
        Vector3::new(self.x[i], self.y[i], self.z[i])
    }

    /// Replaces vector `i`.
    #[inline]
    pub fn set(&mut self, i: usize, v: Vector3) {
        self.x[i] = v.x;
        self.y[i] = v.y;
        self.z[i] = v.z;
    }

    /// Adds `v` to vector `i`.
    #[inline]
    pub fn add(&mut self, i: usize, v: Vector3) {
        self.x[i] += v.x;
        self.y[i] += v.y;
        self.z[i] += v.z;
    }

    /// Appends a vector.
    pub fn push(&mut self, v: Vector3) {
        self.x.push(v.x);
        self.y.push(v.y);
        self.z.push(v.z);
    }

    /// Sets every vector to zero.
    pub fn clear_to_zero(&mut self) {
        self.x.fill(0.0);
        self.y.fill(0.0);
        self.z.fill(0.0);
    }

    /// Takes over the vectors of `other`, which has as many.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        self.x.copy_from_slice(&other.x);
        self.y.copy_from_slice(&other.y);
        self.z.copy_from_slice(&other.z);
    }

    /// Multiplies every vector by `factor`.
    pub fn scale(&mut self, factor: f64) {
        for component in [&mut self.x, &mut self.y, &mut self.z] {
            for c in component {
                *c *= factor;
            }
        }
    }

    /// The vectors in order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = Vector3> + '_ {
        (0..self.len()).map(|i| self.get(i))
    }
}

impl FromIterator<Vector3> for Vectors {
    fn from_iter<I: IntoIterator<Item = Vector3>>(vectors: I) -> Self {
        let mut all = Self::default();
        vectors.into_iter().for_each(|v| all.push(v));
        all
    }
}
