//! Quadrature bonds: weighted bonds that reproduce the moments of all possible bonds.

mod cache;
mod gauss;
mod moments;
mod patch;
mod search;
mod table;

use crate::gap::Gap;
use crate::stream::Stream;
use crate::{EllipsoidParameters, Helix, InterfaceKind, Neighbour};
use actin_mechanics::Vector3;
use moments::{MOMENTS, Moments, Site};
use patch::Patch;
use search::{Bounds, UNKNOWNS, search};
use std::sync::Arc;
use thiserror::Error;

/// Tolerance of the moments, relative to the root mean square of their feature: a tenth of the
/// required accuracy.
const MET: f64 = 1e-3;

/// Deviation at which the search ends.
const ENOUGH: f64 = 1e-4;

/// Minimum weight relative to the mean.
const LEAST_WEIGHT: f64 = 0.05;

const STARTS: u64 = 30;

const SEED: u64 = 0x0063_7562_6174_7572;

/// Point of the quadrature: a bond parallel to the line of centres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CubaturePoint {
    /// Position across the line of centres (nm). The first direction points away from the filament
    /// axis, midway between the monomers; the second is the line of centres times the first.
    pub place: [f64; 2],
    /// Height of the bond's midpoint above the midpoint of the line of centres (nm): the value of a
    /// sampled bond at this position.
    pub height: f64,
    /// Rest length (nm).
    pub length: f64,
    /// Fraction of the rigidity of the interface.
    pub weight: f64,
}

/// Certificate of a quadrature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MomentCheck {
    /// Largest deviation of the 46 moments, each relative to the root mean square of its feature.
    pub residual: f64,
    /// Minimum and maximum weight.
    pub weights: [f64; 2],
    /// Minimum and maximum length (nm).
    pub lengths: [f64; 2],
    /// Minimum and maximum length of all possible bonds (nm).
    pub drawn_lengths: [f64; 2],
    /// Number of points outside the convex outline of all possible bonds.
    pub outside: usize,
}

/// Quadrature bonds of an interface.
///
/// At rest, all bonds of an interface are parallel to the line of centres. The energy therefore
/// depends on the joint distribution of transverse position `rho` and length `L`. Expanding the
/// length of a sheared bond gives 46 moments:
///
/// ```text
/// rho^a,  |a| <= 2;    rho^a / L,  |a| <= 3;    rho^a / L^2  and  rho^a / L^3,  |a| <= 4
/// ```
///
/// Position, length and weight of the points fit the moments of bonds uniformly distributed on the
/// surface of the lower monomer. Twelve points (48 unknowns) match all moments; fewer points
/// minimise the deviation. The gap is tilted and curved, so points have the midpoint height of a
/// sampled bond at the same position.
///
/// The result is independent of any seed and identical for all interfaces of a kind. It is computed
/// once per geometry and process; the points of the default parameters are built in.
#[derive(Clone, Debug, PartialEq)]
pub struct Cubature {
    /// Points of the quadrature.
    pub points: Vec<CubaturePoint>,
    /// Certificate of the points.
    pub certificate: MomentCheck,
}

/// Error of the computation of quadrature bonds.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum CubatureError {
    /// No possible bond has an admissible length.
    #[error(
        "no bond is between {minimum_nm:?} and {maximum_nm:?} nm long: widen the range of bond lengths"
    )]
    NoBonds {
        /// Minimum bond length (nm).
        minimum_nm: f64,
        /// Maximum bond length (nm).
        maximum_nm: f64,
    },
    /// The bond length has no positive lower bound, so moments of the inverse length are infinite.
    #[error(
        "the monomers touch or overlap, so averages of the inverse length are infinite: set a \
         minimum bond length or sample the bonds"
    )]
    Touching,
    /// No search gave positive weights with lengths and positions within bounds.
    #[error(
        "no quadrature of {points} points with lengths between {shortest_nm:?} and {longest_nm:?} nm \
         was found: widen the range of bond lengths, use more points or sample the bonds"
    )]
    OutOfBounds {
        /// Number of points.
        points: usize,
        /// Minimum length of all possible bonds (nm).
        shortest_nm: f64,
        /// Maximum length of all possible bonds (nm).
        longest_nm: f64,
    },
    /// The moments are not matched to the tolerance.
    #[error(
        "{points} points match the moments of all bonds to {nearest:.1e} only (tolerance \
         {MET:.0e}): use more points, raise the minimum bond length or sample the bonds"
    )]
    NotMet {
        /// Number of points.
        points: usize,
        /// Smallest deviation of the moments among the admissible results.
        nearest: f64,
    },
}

impl Cubature {
    /// Quadrature bonds of one kind of interface; the number of points is a parameter.
    ///
    /// # Errors
    /// No admissible bonds, touching monomers without a minimum length, or moments that 12 or more
    /// points match worse than 1e-3.
    pub fn for_interface(
        parameters: &EllipsoidParameters,
        kind: InterfaceKind,
    ) -> Result<Arc<Self>, CubatureError> {
        cache::get(parameters, kind)
    }

    /// Starts from the built-in points, then from random bonds.
    fn find(parameters: &EllipsoidParameters, kind: InterfaceKind) -> Result<Self, CubatureError> {
        let count = parameters.interface(kind).bonds;
        let finder = Finder::new(parameters, kind)?;
        let known = Some(table::sites(kind)).filter(|sites| sites.len() == count);
        let starts = known.into_iter().chain(finder.drawn_starts(kind, count));
        Self::find_from(&finder, starts, count)
    }

    /// Best result over the initial guesses, or the first sufficiently accurate one.
    fn find_from(
        finder: &Finder,
        starts: impl Iterator<Item = Vec<(Site, f64)>>,
        count: usize,
    ) -> Result<Self, CubatureError> {
        let residual = |found: &Self| found.certificate.residual;
        let mut best: Option<Self> = None;
        for found in starts.map(|start| finder.search(&start)) {
            if !found.certificate.is_within_bounds() {
                continue;
            }
            let is_better = |best: &Self| residual(&found) < residual(best);
            if best.as_ref().is_none_or(is_better) {
                best = Some(found);
            }
            if best.as_ref().is_some_and(|best| residual(best) <= ENOUGH) {
                break;
            }
        }
        let enough = |found: &Self| UNKNOWNS * count < MOMENTS || residual(found) <= MET;
        let points = count;
        let [shortest_nm, longest_nm] = finder.drawn;
        let best = best.ok_or(CubatureError::OutOfBounds {
            points,
            shortest_nm,
            longest_nm,
        })?;
        if enough(&best) {
            return Ok(best);
        }
        let nearest = residual(&best);
        Err(CubatureError::NotMet { points, nearest })
    }
}

impl MomentCheck {
    /// Returns `true` if all moments are matched to 1e-3.
    pub fn meets_moments(&self) -> bool {
        self.residual <= MET
    }
}

impl CubaturePoint {
    pub(crate) fn ends(&self, neighbour: &Neighbour, half_turn: f64) -> [Vector3; 2] {
        let direction = neighbour.offset.normalize();
        let [outwards, sideways] = transverse(direction, half_turn);
        let across = self.place[0] * outwards + self.place[1] * sideways;
        let middle = 0.5 * neighbour.offset + across + self.height * direction;
        let half = 0.5 * self.length * direction;
        let upper = middle + half - neighbour.offset;
        [middle - half, neighbour.rotation.tr_mul(&upper)]
    }
}

impl MomentCheck {
    /// Returns `true` if weights are positive and lengths and positions are those of possible
    /// bonds.
    pub(crate) fn is_within_bounds(&self) -> bool {
        let [least, most] = self.drawn_lengths;
        let roundoff = 1e-12 * most;
        self.weights[0] > 0.0
            && self.lengths[0] >= least - roundoff
            && self.lengths[1] <= most + roundoff
            && self.outside == 0
    }
}

/// Away from the filament axis midway between the monomers, and the line of centres times it (body
/// frame of the lower monomer).
fn transverse(direction: Vector3, half_turn: f64) -> [Vector3; 2] {
    let (sin, cos) = half_turn.sin_cos();
    let outwards = Vector3::new(cos, sin, 0.0);
    [outwards, direction.cross(&outwards)]
}

#[derive(Debug)]
struct Finder {
    gap: Gap,
    patch: Patch,
    moments: Moments,
    drawn: [f64; 2],
}

impl Finder {
    fn new(parameters: &EllipsoidParameters, kind: InterfaceKind) -> Result<Self, CubatureError> {
        let gap = Gap::new(parameters, kind);
        let patch = Patch::new(gap, Helix::new(parameters).half_turn(kind));
        let (minimum_nm, maximum_nm) = (gap.minimum, gap.maximum);
        let shares = patch.shares().ok_or(CubatureError::NoBonds {
            minimum_nm,
            maximum_nm,
        })?;
        let least = minimum_nm.max(patch.shortest());
        if least <= 0.0 {
            return Err(CubatureError::Touching);
        }
        let longest = shares.iter().map(|share| share.length).fold(0.0, f64::max);
        Ok(Self {
            gap,
            moments: Moments::new(&shares),
            patch,
            drawn: [least, longest],
        })
    }

    fn drawn_starts(
        &self,
        kind: InterfaceKind,
        count: usize,
    ) -> impl Iterator<Item = Vec<(Site, f64)>> + '_ {
        (0..STARTS).map(move |start| {
            let mut stream = Stream::new(SEED, start, kind.number());
            let weight = 1.0 / count as f64;
            let sites = (0..count).map(|_| (self.draw(&mut stream), weight));
            sites.collect()
        })
    }

    fn draw(&self, stream: &mut Stream) -> Site {
        loop {
            let point = self.gap.ellipsoid.sample(stream);
            if let Some(bond) = self.gap.bond_from(point) {
                return self.moments.site(self.patch.place(point), bond.rest_length);
            }
        }
    }

    fn search(&self, start: &[(Site, f64)]) -> Cubature {
        let [least, most] = self.drawn.map(|length| length * self.moments.inverse);
        let bounds = Bounds {
            least: 1.0 / most,
            most: 1.0 / least,
            weight: LEAST_WEIGHT / start.len() as f64,
        };
        let sites = search(&self.moments, start, bounds);
        let total: f64 = sites.iter().map(|(_, weight)| weight).sum();
        let points: Vec<CubaturePoint> = sites
            .iter()
            .map(|(site, weight)| (site.place.map(|x| x * self.moments.distance), site, weight))
            .map(|(place, site, weight)| CubaturePoint {
                place,
                height: self.patch.height_at(place).unwrap_or(0.0),
                length: 1.0 / (site.inverse * self.moments.inverse),
                weight: weight / total,
            })
            .collect();
        let certificate = self.certificate(&points);
        Cubature {
            points,
            certificate,
        }
    }

    fn certificate(&self, points: &[CubaturePoint]) -> MomentCheck {
        let sites: Vec<(Site, f64)> = points
            .iter()
            .map(|p| (self.moments.site(p.place, p.length), p.weight))
            .collect();
        let residuals = self.moments.residuals(&sites);
        let is_outside = |p: &&CubaturePoint| {
            let length = self.patch.length_at(p.place);
            length.is_none_or(|length| length > self.gap.maximum)
        };
        MomentCheck {
            residual: residuals.iter().fold(0.0, |worst, r| r.abs().max(worst)),
            weights: range(points.iter().map(|p| p.weight)),
            lengths: range(points.iter().map(|p| p.length)),
            drawn_lengths: self.drawn,
            outside: points.iter().filter(is_outside).count(),
        }
    }
}

fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], x| {
        [least.min(x), most.max(x)]
    })
}

fn numbers(parameters: &EllipsoidParameters, kind: InterfaceKind) -> [f64; 8] {
    let interface = parameters.interface(kind);
    let [x, y, z] = parameters.semi_axes;
    [
        parameters.radius,
        parameters.rise,
        parameters.turn,
        x,
        y,
        z,
        interface.minimum_length,
        interface.maximum_length,
    ]
}

#[cfg(test)]
mod tests;
