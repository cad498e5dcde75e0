use super::capsule::Row;
use super::kernel::{Kernel, Tangent};
use actin_mechanics::{Matrix3, Vector3};

#[derive(Clone, Copy, Debug)]
pub(super) struct Pair {
    pub(super) ends: [[Vector3; 2]; 2],
    pub(super) rows: [Row; 2],
}

/// Two points in contact: vector from first to second, depth, relative positions along the
/// capsules, and product of their lengths.
struct ContactPoint {
    d: Vector3,
    depth: f64,
    shares: [f64; 2],
    weight: f64,
}

impl Pair {
    /// Visits all pairs of points in contact, in order of the first and then of the second index.
    #[inline]
    fn touches(&self, kernel: &Kernel, mut visit: impl FnMut(&ContactPoint)) {
        let [[a0, a1], [b0, b1]] = self.ends;
        let (along_a, along_b) = (a1 - a0, b1 - b0);
        let length2 = along_b.norm_squared();
        let [row, other] = self.rows;
        let weight = row.weight * other.weight;
        for k in 0..row.count {
            let share = row.share(k);
            let x = a0 + along_a * share;
            let start = x - b0;
            // Part of the second axis within the contact distance.
            let middle = start.dot(&along_b) / length2;
            let across = start.norm_squared() - middle * middle * length2;
            let half = ((kernel.reach * kernel.reach - across) / length2).sqrt();
            let count = other.count as f64;
            for l in points_between(
                (middle - half) * count,
                (middle + half) * count,
                other.count,
            ) {
                let at = other.share(l);
                let d = along_b * at - start;
                let depth = kernel.depth(d);
                if depth > 0.0 {
                    visit(&ContactPoint {
                        d,
                        depth,
                        shares: [share, at],
                        weight,
                    });
                }
            }
        }
    }

    /// Energy (pN nm).
    pub(super) fn energy(&self, kernel: &Kernel) -> f64 {
        let mut energy = 0.0;
        self.touches(kernel, |t| energy += t.weight * kernel.energy(t.depth));
        energy
    }

    /// Forces on the two ends of both capsules (pN, lab frame).
    pub(super) fn forces(&self, kernel: &Kernel) -> [[Vector3; 2]; 2] {
        let mut forces = [[Vector3::zeros(); 2]; 2];
        self.touches(kernel, |t| {
            let force = t.d * (t.weight * kernel.force_over_distance(t.depth));
            let [a, b] = t.shares;
            forces[0][0] -= force * (1.0 - a);
            forces[0][1] -= force * a;
            forces[1][0] += force * (1.0 - b);
            forces[1][1] += force * b;
        });
        forces
    }

    /// Second derivatives with respect to the four ends, from the tangents of all points in
    /// contact (pN/nm).
    pub(super) fn tangents(&self, kernel: &Kernel, tangent: Tangent) -> [[Matrix3; 4]; 4] {
        // Moments of the tangents with the positions `a` and `b` along the capsules.
        let [mut one, mut a, mut b, mut aa, mut ab, mut bb] = [Matrix3::zeros(); 6];
        self.touches(kernel, |t| {
            let tangent = tangent(kernel, t.depth, t.d) * t.weight;
            let [at_a, at_b] = t.shares;
            let (along_a, along_b) = (tangent * at_a, tangent * at_b);
            one += tangent;
            a += along_a;
            b += along_b;
            aa += along_a * at_a;
            ab += along_a * at_b;
            bb += along_b * at_b;
        });
        // Factors of the ends: a - 1, -a, 1 - b, b.
        let (a_only, b_only) = (a - ab, b - ab);
        let neither = one - a - b_only;
        [
            [one - a - (a - aa), a - aa, -neither, -b_only],
            [a - aa, aa, -a_only, -ab],
            [-neither, -a_only, one - b - (b - bb), b - bb],
            [-b_only, -ab, b - bb, bb],
        ]
    }
}

/// Indices of points at 0.5, 1.5, 2.5 ... between two positions, extended by one on each side for
/// rounding. Empty if the positions are not numbers.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "not negative; conversions saturate, which leaves all points on that side"
)]
fn points_between(from: f64, to: f64, count: usize) -> std::ops::Range<usize> {
    let first = (from - 1.5).max(0.0) as usize;
    let past = (to + 1.5).max(0.0) as usize;
    first.min(count)..past.min(count)
}
