//! Nonlinear least squares for the quadrature points.

use super::moments::{Features, MOMENTS, Moments, Site};
use nalgebra::{DMatrix, DVector};

const STEPS: usize = 600;
/// Residual at which the search stops, a hundredth of the tolerance.
const ENDED: f64 = 1e-5;
/// Initial and minimum damping, relative to the mean square of the Jacobian.
const DAMPING: (f64, f64) = (1e-2, 1e-13);
/// Unknowns per point: position (2), inverse length, square root of the weight above its minimum.
pub(super) const UNKNOWNS: usize = 4;

#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub(super) least: f64,
    pub(super) most: f64,
    pub(super) weight: f64,
}

impl Bounds {
    fn half(self) -> f64 {
        0.5 * (self.most - self.least).max(f64::MIN_POSITIVE)
    }

    /// Inverse length `middle + half t / sqrt(1 + t^2)` and its derivative with respect to `t`.
    fn inverse(self, t: f64) -> (f64, f64) {
        let root = (1.0 + t * t).sqrt();
        let middle = 0.5 * (self.least + self.most);
        (
            middle + self.half() * t / root,
            self.half() / (root * root * root),
        )
    }

    fn unknown(self, inverse: f64) -> f64 {
        let part = (inverse - 0.5 * (self.least + self.most)) / self.half();
        let part = part.clamp(-0.99, 0.99);
        part / (1.0 - part * part).sqrt()
    }
}

#[derive(Clone, Debug)]
struct Unknowns(DVector<f64>, Bounds);

impl Unknowns {
    fn new(sites: &[(Site, f64)], bounds: Bounds) -> Self {
        let of_site = |(site, weight): &(Site, f64)| {
            let [x, y] = site.place;
            let root = (weight - bounds.weight).max(0.0).sqrt();
            [x, y, bounds.unknown(site.inverse), root]
        };
        Self(
            DVector::from_vec(sites.iter().flat_map(of_site).collect::<Vec<f64>>()),
            bounds,
        )
    }

    /// A weight is the minimum plus a square.
    fn sites(&self) -> Vec<(Site, f64)> {
        let (points, _) = self.0.as_slice().as_chunks::<UNKNOWNS>();
        points
            .iter()
            .map(|&[x, y, t, root]| {
                let place = [x, y];
                let inverse = self.1.inverse(t).0;
                (Site { place, inverse }, self.1.weight + root * root)
            })
            .collect()
    }

    fn jacobian(&self, moments: &Moments) -> DMatrix<f64> {
        let mut jacobian = DMatrix::zeros(MOMENTS, self.0.len());
        for (p, (site, weight)) in self.sites().iter().enumerate() {
            let root = self.0[UNKNOWNS * p + 3];
            let by_t = self.1.inverse(self.0[UNKNOWNS * p + 2]).1;
            let mut columns = site.slopes().map(|slope| slope.map(|s| weight * s));
            columns[2] = columns[2].map(|s| s * by_t);
            let by_root = site.features().map(|f| 2.0 * root * f);
            for (c, column) in columns.iter().chain([&by_root]).enumerate() {
                for (f, (slope, size)) in column.iter().zip(moments.sizes()).enumerate() {
                    jacobian[(f, UNKNOWNS * p + c)] = slope / size;
                }
            }
        }
        jacobian
    }
}

fn square(residuals: &Features) -> f64 {
    residuals.iter().map(|r| r * r).sum()
}

/// Minimises the residuals of the moments: the step `d` solves `(J^T J + m 1) d = -J^T r` with
/// adaptive damping `m`.
///
/// # Source
/// Levenberg, Q. Appl. Math. 2 (1944) 164.
pub(super) fn search(moments: &Moments, start: &[(Site, f64)], bounds: Bounds) -> Vec<(Site, f64)> {
    let mut x = Unknowns::new(start, bounds);
    let mut residuals = moments.residuals(&x.sites());
    let mut damping = DAMPING.0;
    for _ in 0..STEPS {
        if residuals.iter().all(|r| r.abs() <= ENDED) {
            break;
        }
        let jacobian = x.jacobian(moments);
        let unit = jacobian.norm_squared() / MOMENTS as f64;
        let mut better = None;
        while better.is_none() && damping < 1e6 {
            let step = step(&jacobian, &residuals, damping * unit);
            let next = Unknowns(&x.0 - step, bounds);
            let found = moments.residuals(&next.sites());
            if square(&found) < square(&residuals) {
                better = Some((next, found));
                damping = (0.25 * damping).max(DAMPING.1);
            } else {
                damping *= 4.0;
            }
        }
        let Some(found) = better else { break };
        (x, residuals) = found;
    }
    x.sites()
}

/// Computes `(J^T J + m 1)^-1 J^T r = J^T (J J^T + m 1)^-1 r` with the smaller of the two matrices,
/// in the same order of summation on every machine.
fn step(jacobian: &DMatrix<f64>, residuals: &Features, damping: f64) -> DVector<f64> {
    let r = DVector::from_column_slice(residuals);
    let transposed = jacobian.transpose();
    if jacobian.nrows() <= jacobian.ncols() {
        transposed * solve(jacobian, damping, &r)
    } else {
        solve(&transposed, damping, &(&transposed * r))
    }
}

/// Solves `(A A^T + m 1) x = b`; returns zero if the matrix is numerically indefinite.
fn solve(a: &DMatrix<f64>, damping: f64, b: &DVector<f64>) -> DVector<f64> {
    let n = a.nrows();
    let mut matrix = DMatrix::from_diagonal_element(n, n, damping);
    for column in a.column_iter() {
        matrix.syger(1.0, &column, &column, 1.0);
    }
    let factor = matrix.cholesky();
    factor.map_or_else(|| DVector::zeros(n), |factor| factor.solve(b))
}
