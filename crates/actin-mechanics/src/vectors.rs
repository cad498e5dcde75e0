//! Arrays of vectors, stored by component.

use crate::Vector3;

/// Array of vectors, stored as three arrays of components for vectorised loops.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Vectors {
    /// First components.
    pub x: Vec<f64>,
    /// Second components.
    pub y: Vec<f64>,
    /// Third components.
    pub z: Vec<f64>,
}

impl Vectors {
    /// Creates `n` zero vectors.
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

    /// Returns `true` if there are no vectors.
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
    pub(crate) fn push(&mut self, v: Vector3) {
        self.x.push(v.x);
        self.y.push(v.y);
        self.z.push(v.z);
    }

    pub(crate) fn assert_len(&self, what: &str, count: usize) {
        assert_lengths(what, &[&self.x, &self.y, &self.z], count);
    }

    pub(crate) fn has_len(&self, count: usize) -> bool {
        [&self.x, &self.y, &self.z].iter().all(|c| c.len() == count)
    }

    /// Sets every vector to zero.
    pub(crate) fn clear_to_zero(&mut self) {
        self.x.fill(0.0);
        self.y.fill(0.0);
        self.z.fill(0.0);
    }

    pub(crate) fn copy_from(&mut self, other: &Self) {
        self.x.copy_from_slice(&other.x);
        self.y.copy_from_slice(&other.y);
        self.z.copy_from_slice(&other.z);
    }

    /// Iterates over the vectors.
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

pub(crate) fn assert_lengths(what: &str, components: &[&Vec<f64>], count: usize) {
    for component in components {
        let length = component.len();
        assert!(
            length == count,
            "there must be {count} {what}, one for each body, got {length}"
        );
    }
}

pub(crate) fn damp_where(vectors: &mut Vectors, mobility: &[f64], factor: f64) {
    for column in [&mut vectors.x, &mut vectors.y, &mut vectors.z] {
        for (c, mobility) in column.iter_mut().zip(mobility) {
            *c *= if *mobility > 0.0 { factor } else { 1.0 };
        }
    }
}

/// Sum of `f` over the rows of `columns`, in four independent partial sums.
///
/// # Panics
/// If a column is shorter than the first.
#[inline]
pub(crate) fn sum_in_lanes<const N: usize>(
    columns: [&[f64]; N],
    f: impl Fn([f64; N]) -> f64,
) -> f64 {
    const LANES: usize = 4;
    let n = columns[0].len();
    let columns = columns.map(|column| &column[..n]);
    let chunks = columns.map(<[f64]>::as_chunks::<LANES>);
    let mut sums = [0.0; LANES];
    for i in 0..n / LANES {
        let rows = chunks.map(|(whole, _)| whole[i]);
        for (lane, sum) in sums.iter_mut().enumerate() {
            *sum += f(rows.map(|column| column[lane]));
        }
    }
    let rest = (n - n % LANES..n).map(|i| f(columns.map(|column| column[i])));
    sums.iter().sum::<f64>() + rest.sum::<f64>()
}
