//! Region of possible bonds of an interface, and averages over it.

use super::{gauss, transverse};
use crate::gap::Gap;
use actin_mechanics::Vector3;
use std::f64::consts::TAU;

const RAYS: usize = 192;
const POINTS_PER_RAY: usize = 48;
/// Bisections of an interval on a ray: full precision.
const HALVINGS: usize = 60;

/// Set of lines parallel to the line of centres that bridge a gap.
///
/// Scaling by the inverse semi-axes maps the lower monomer to the unit sphere and the line of
/// centres to a direction `g`. A line is identified by its intersection with the central plane
/// normal to `g`. The length of the gap is a convex function of this point and increases along each
/// ray from the shortest line.
#[derive(Clone, Debug)]
pub(crate) struct Patch {
    gap: Gap,
    scale: Vector3,
    /// Unit vectors after scaling: along the lines, and two transverse ones.
    along: Vector3,
    across: [Vector3; 2],
    /// Body frame of the lower monomer.
    transverse: [Vector3; 2],
    middle: [f64; 2],
    shortest: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Share {
    pub(crate) weight: f64,
    pub(crate) place: [f64; 2],
    pub(crate) length: f64,
}

impl Patch {
    pub(crate) fn new(gap: Gap, half_turn: f64) -> Self {
        let scale = Vector3::from(gap.ellipsoid.semi_axes());
        let direction = gap.direction();
        let transverse = transverse(direction, half_turn);
        let along = direction.component_div(&scale).normalize();
        let first = transverse[0].cross(&along).normalize();
        let mut patch = Self {
            gap,
            scale,
            along,
            across: [first, along.cross(&first)],
            transverse,
            middle: [0.0; 2],
            shortest: f64::INFINITY,
        };
        (patch.middle, patch.shortest) = patch.find_shortest();
        patch
    }

    /// Length of the shortest line (nm), negative if the monomers overlap.
    pub(crate) fn shortest(&self) -> f64 {
        self.shortest
    }

    /// Exit point of a line from the lower monomer; `None` outside the disc.
    fn point(&self, [x, y]: [f64; 2]) -> Option<Vector3> {
        let height = 1.0 - (x * x + y * y);
        (height >= 0.0).then(|| {
            let q = x * self.across[0] + y * self.across[1] + height.sqrt() * self.along;
            q.component_mul(&self.scale)
        })
    }

    /// Length of the gap along a line; infinite if the line misses.
    fn length(&self, line: [f64; 2]) -> f64 {
        let length = self.point(line).and_then(|p| self.gap.length_from(p));
        length.unwrap_or(f64::INFINITY)
    }

    /// Shortest line. The length is convex, so a compass search with halved steps converges.
    fn find_shortest(&self) -> ([f64; 2], f64) {
        let (mut best, mut least) = ([0.0; 2], self.length([0.0; 2]));
        let mut step = 0.25;
        while step > 1e-9 {
            let [x, y] = best;
            let around = [[x + step, y], [x - step, y], [x, y + step], [x, y - step]];
            let next = around
                .map(|line| (line, self.length(line)))
                .into_iter()
                .min_by(|a, b| a.1.total_cmp(&b.1));
            match next {
                Some((line, length)) if length < least => (best, least) = (line, length),
                _ => step *= 0.5,
            }
        }
        (best, least)
    }

    pub(crate) fn place(&self, point: Vector3) -> [f64; 2] {
        self.transverse.map(|axis| axis.dot(&point))
    }

    /// Length of the gap at a transverse position (nm); `None` if the line misses.
    pub(crate) fn length_at(&self, place: [f64; 2]) -> Option<f64> {
        let length = self.length(self.line_at(place));
        length.is_finite().then_some(length)
    }

    /// Height of the midpoint of the gap above the midpoint of the line of centres (nm); `None` if
    /// the line misses.
    pub(crate) fn height_at(&self, place: [f64; 2]) -> Option<f64> {
        let (direction, offset) = (self.gap.direction(), self.gap.neighbour.offset);
        let lower = self.point(self.line_at(place))?;
        Some(lower.dot(&direction) + 0.5 * self.length_at(place)? - 0.5 * offset.norm())
    }

    fn line_at(&self, place: [f64; 2]) -> [f64; 2] {
        let point = place[0] * self.transverse[0] + place[1] * self.transverse[1];
        let q = point.component_div(&self.scale);
        [q.dot(&self.across[0]), q.dot(&self.across[1])]
    }

    /// Quadrature nodes over all bonds, distributed uniformly on the surface of the lower monomer;
    /// the weights add up to 1. Returns `None` if no bond has an admissible length.
    ///
    /// The ratio of surface to disc area is proportional to `|q / scale| / sqrt(1 - r^2)` with `q`
    /// on the unit sphere and `r` the distance from the centre of the disc. The substitution of the
    /// radius removes a square root singularity at the end of the rays.
    pub(crate) fn shares(&self) -> Option<Vec<Share>> {
        self.shares_by(RAYS, POINTS_PER_RAY)
    }

    fn shares_by(&self, rays: usize, points: usize) -> Option<Vec<Share>> {
        let least = self.gap.minimum;
        let nodes = gauss::legendre(points);
        let mut shares = Vec::with_capacity(rays * points);
        for ray in 0..rays {
            let (sin, cos) = (TAU * ray as f64 / rays as f64).sin_cos();
            let line = |r: f64| [self.middle[0] + r * cos, self.middle[1] + r * sin];
            let near = last(|r| self.length(line(r)) < least);
            let far = last(|r| self.length(line(r)) <= self.gap.maximum);
            for &(x, weight) in &nodes {
                let s = 0.5 * (1.0 + x);
                let r = near + (far - near) * s * (2.0 - s);
                let stretch = (far - near) * (1.0 - s) * weight;
                let Some(point) = self.point(line(r)) else {
                    continue;
                };
                let length = self.length(line(r));
                let q = point.component_div(&self.scale);
                let slope = q.dot(&self.along);
                let area = q.component_div(&self.scale).norm() / slope;
                if length.is_finite() && slope > 0.0 {
                    shares.push(Share {
                        weight: r * area * stretch,
                        place: self.place(point),
                        length,
                    });
                }
            }
        }
        let total: f64 = shares.iter().map(|share| share.weight).sum();
        for share in &mut shares {
            share.weight /= total;
        }
        (total > 0.0).then_some(shares)
    }
}

/// Largest distance up to the diameter of the disc at which a monotone predicate holds, or 0.
fn last(holds: impl Fn(f64) -> bool) -> f64 {
    let (mut inside, mut outside) = (0.0, 2.0);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (inside + outside);
        if holds(middle) {
            inside = middle;
        } else {
            outside = middle;
        }
    }
    inside
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cubature::moments::Moments;
    use crate::stream::Stream;
    use crate::{EllipsoidParameters, Helix, InterfaceKind};

    fn patches() -> Vec<Patch> {
        let standard = EllipsoidParameters::default();
        let (mut floor, mut wide) = (standard.clone(), standard.clone());
        floor.longitudinal.minimum_length = 0.3;
        wide.semi_axes = [2.0, 2.0, 2.6];
        wide.lateral.maximum_length = 6.0;
        wide.longitudinal.maximum_length = 6.0;
        let all = [standard, floor, wide];
        let patch = |parameters: &EllipsoidParameters, kind| {
            Patch::new(
                Gap::new(parameters, kind),
                Helix::new(parameters).half_turn(kind),
            )
        };
        all.iter()
            .flat_map(|p| InterfaceKind::ALL.map(|kind| patch(p, kind)))
            .collect()
    }

    fn difference(of: &Moments, shares: &[Share]) -> f64 {
        let sites: Vec<_> = shares
            .iter()
            .map(|s| (of.site(s.place, s.length), s.weight))
            .collect();
        of.residuals(&sites)
            .iter()
            .fold(0.0, |worst, r| r.abs().max(worst))
    }

    #[test]
    fn moments_agree_with_sampled_bonds() {
        const DRAWS: usize = 100_000;
        for (i, patch) in patches().iter().enumerate() {
            let moments = Moments::new(&patch.shares().unwrap());
            let mut stream = Stream::new(i as u64, 0, 0);
            let points = std::iter::repeat_with(|| patch.gap.ellipsoid.sample(&mut stream));
            let bonds = points.filter_map(|point| patch.gap.bond_from(point));
            let shares: Vec<Share> = bonds
                .take(DRAWS)
                .map(|bond| Share {
                    weight: 1.0 / DRAWS as f64,
                    place: patch.place(bond.lower),
                    length: bond.rest_length,
                })
                .collect();
            let error = difference(&moments, &shares);
            assert!(error < 5.0 / (DRAWS as f64).sqrt(), "{i}: {error:.1e}");
        }
    }

    /// Rounding for smooth outlines, 1e-6 for outlines with corners.
    #[test]
    fn quadrature_has_converged() {
        for (i, patch) in patches().iter().enumerate() {
            let moments = Moments::new(&patch.shares().unwrap());
            let coarse = patch.shares_by(RAYS / 2, POINTS_PER_RAY / 2).unwrap();
            let error = difference(&moments, &coarse);
            let bound = if i < 4 { 1e-10 } else { 1e-5 };
            assert!(error < bound, "{i}: {error:.1e}");
        }
    }

    #[test]
    fn positions_reproduce_lengths() {
        for patch in patches() {
            for share in patch.shares_by(7, 5).unwrap() {
                let length = patch.length_at(share.place).unwrap();
                assert!((length - share.length).abs() < 1e-6, "{share:?} {length}");
                assert!(share.length >= patch.shortest());
                let height = patch.height_at(share.place).unwrap();
                let half = 0.5 * patch.gap.neighbour.offset.norm();
                assert!(height.abs() < half - 0.5 * share.length + patch.scale.max());
            }
            assert_eq!(patch.length_at([9.0, 0.0]), None);
        }
    }
}
