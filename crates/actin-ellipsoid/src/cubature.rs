//! Weighted bonds: a few that stand for all that could be drawn in an interface.
//!
//! [`Cubature::of`] finds them once for a geometry; [`moments`] says what they have in common with
//! all bonds, [`patch`] averages over those, [`search`] moves the points, [`table`] holds those of
//! the default parameters.

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

/// Largest deviation of a moment, in units of its feature's root mean square, with which the moments
/// count as met: a tenth of the 1 % to which the points are to stand for many drawn bonds.
const MET: f64 = 1e-3;

/// Deviation with which no further start is tried. Of twelve points the best have 1e-5 to 2e-4.
const ENOUGH: f64 = 1e-4;

/// Least weight as a share of the mean one: without a bound weights vanish, and with them points.
const LEAST_WEIGHT: f64 = 0.05;

/// Searches from drawn bonds before the points are given up.
const STARTS: u64 = 30;

/// Seed of the bonds that searches start from.
const SEED: u64 = 0x0063_7562_6174_7572;

/// A bond of a weighted interface, as seen along the line of centres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CubaturePoint {
    /// Place across the line of centres (nm): away from the filament's axis, midway between the two
    /// monomers, and along the line of centres times that direction.
    pub place: [f64; 2],
    /// Height of its middle along the line of centres, above the middle of that line (nm): that of a
    /// bond drawn at this place.
    pub height: f64,
    /// Length at rest (nm).
    pub length: f64,
    /// Share of the interface's rigidity.
    pub weight: f64,
}

/// What the points of an interface were held against.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MomentCheck {
    /// Largest deviation of one of the 46 moments, in units of the root mean square of what it is
    /// the average of.
    pub residual: f64,
    /// Least and largest weight.
    pub weights: [f64; 2],
    /// Least and largest length (nm).
    pub lengths: [f64; 2],
    /// Least and largest length of all bonds that could be drawn (nm).
    pub drawn_lengths: [f64; 2],
    /// Points outside the convex outline of the places of all bonds.
    pub outside: usize,
}

/// Weighted bonds that stand for all bonds of an interface.
///
/// All bonds of an interface are parallel to the line of centres at rest, so that their energy
/// depends on the joint distribution of place `rho` across it and length `L`. Expanding the length of
/// a slipped bond shows by which moments: `rho^a` for `|a| <= 2`, `rho^a / L` for `|a| <= 3`,
/// `rho^a / L^2` and `rho^a / L^3` for `|a| <= 4`, 46 in all. Their values for bonds drawn uniformly
/// on the lower monomer's surface are found by quadrature; places, lengths and weights of the points
/// by least squares. Twelve points, with 48 unknowns, meet them; fewer come as near as they can.
///
/// The gap between the monomers is tilted and bent, so that the middles of bonds lie at different
/// heights along the line of centres: points have theirs where drawn bonds have it at the same place.
///
/// Nothing is drawn that depends on a seed, and all interfaces of a kind have the same points. They
/// are found once per geometry and process; those of the default parameters are built in.
///
/// An interface between two alike ellipsoids of a helix has a two-fold axis, but drawing on the
/// lower one's surface does not respect it, so the moments have no symmetry to use.
#[derive(Clone, Debug, PartialEq)]
pub struct Cubature {
    /// The points.
    pub points: Vec<CubaturePoint>,
    /// What they were held against.
    pub certificate: MomentCheck,
}

/// Why there are no weighted bonds.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum CubatureError {
    /// No bond could be drawn.
    #[error("no bond is between {minimum_nm:?} and {maximum_nm:?} nm long")]
    NoBonds {
        /// Shortest bond that would have been accepted (nm).
        minimum_nm: f64,
        /// Longest bond that would have been accepted (nm).
        maximum_nm: f64,
    },
    /// Bonds may be arbitrarily short: averages of inverse lengths are infinite.
    #[error(
        "the monomers touch or overlap, and averages of inverse lengths are infinite: accept no \
         bonds below some length, or draw bonds"
    )]
    Touching,
    /// No search ended with positive weights and with lengths and places within bounds.
    #[error(
        "{points} points with lengths between {shortest_nm:?} and {longest_nm:?} nm were not found: \
         allow a wider range of lengths, take more points, or draw bonds"
    )]
    OutOfBounds {
        /// Number of points.
        points: usize,
        /// Least length of all bonds that could be drawn (nm).
        shortest_nm: f64,
        /// Largest length of all bonds that could be drawn (nm).
        longest_nm: f64,
    },
    /// Too few points, or an odd geometry.
    #[error(
        "{points} points do not meet the moments of all bonds (nearest {nearest:.1e}, asked for \
         {MET:.0e}): take more points, raise the shortest length, or draw bonds"
    )]
    NotMet {
        /// Number of points.
        points: usize,
        /// Largest deviation of the moments of the best search with positive weights and lengths
        /// and places within bounds.
        nearest: f64,
    },
}

impl Cubature {
    /// The weighted bonds of one kind of interface: as many as its parameters say.
    ///
    /// # Errors
    /// No bonds, monomers that touch while no shortest bond is set, or moments that are not met to
    /// 1e-3 by 12 points or more.
    pub fn of(
        parameters: &EllipsoidParameters,
        kind: InterfaceKind,
    ) -> Result<Arc<Self>, CubatureError> {
        cache::get(parameters, kind)
    }

    /// The same, found anew: from the built-in points, taken to this geometry, or from drawn bonds.
    fn find(parameters: &EllipsoidParameters, kind: InterfaceKind) -> Result<Self, CubatureError> {
        let count = kind.parameters(parameters).bonds;
        let finder = Finder::new(parameters, kind)?;
        let known = Some(table::sites(kind)).filter(|sites| sites.len() == count);
        let starts = known.into_iter().chain(finder.drawn_starts(kind, count));
        Self::find_from(&finder, starts, count)
    }

    /// The nearest points of all starts, or the first that are near enough. Fewer unknowns than there
    /// are moments cannot meet them: these are as near as they come.
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
    /// Whether all moments are met: to 1e-3, a tenth of the 1 % to which the points are to stand for many
    /// drawn bonds.
    pub fn meets_moments(&self) -> bool {
        self.residual <= MET
    }
}

impl CubaturePoint {
    /// The bond's ends: on the lower monomer in its frame, on the upper one in that one's frame.
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
    /// Whether weights are positive, lengths those of bonds that could be drawn, and places within
    /// the outline of theirs.
    pub fn is_within_bounds(&self) -> bool {
        let [least, most] = self.drawn_lengths;
        // The search keeps lengths between the bounds but for round-off.
        let roundoff = 1e-12 * most;
        self.weights[0] > 0.0
            && self.lengths[0] >= least - roundoff
            && self.lengths[1] <= most + roundoff
            && self.outside == 0
    }
}

/// Unit vectors across the line of centres (body frame of the lower monomer): away from the
/// filament's axis midway between the monomers, and the line of centres times that.
fn transverse(direction: Vector3, half_turn: f64) -> [Vector3; 2] {
    let (sin, cos) = half_turn.sin_cos();
    let outwards = Vector3::new(cos, sin, 0.0);
    [outwards, direction.cross(&outwards)]
}

/// What searches of one geometry share.
#[derive(Debug)]
struct Finder {
    gap: Gap,
    patch: Patch,
    moments: Moments,
    /// Lengths of the bonds that could be drawn.
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
            moments: Moments::of(&shares),
            patch,
            drawn: [least, longest],
        })
    }

    /// Drawn bonds for searches to start from.
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

    /// A bond, drawn as those of drawn interfaces are.
    fn draw(&self, stream: &mut Stream) -> Site {
        loop {
            let point = self.gap.ellipsoid.sample(stream);
            if let Some(bond) = self.gap.bond_from(point) {
                return self.moments.site(self.patch.place(point), bond.rest_length);
            }
        }
    }

    /// The points that a search leads to.
    fn search(&self, start: &[(Site, f64)]) -> Cubature {
        let [least, most] = self.drawn.map(|length| length * self.moments.inverse);
        let bounds = Bounds {
            least: 1.0 / most,
            most: 1.0 / least,
            weight: LEAST_WEIGHT / start.len() as f64,
        };
        let sites = search(&self.moments, start, bounds);
        // The zeroth moment is met exactly.
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

    /// What points are worth.
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

/// Least and largest of some values.
fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], x| {
        [least.min(x), most.max(x)]
    })
}

/// The numbers on which the points of an interface depend.
fn numbers(parameters: &EllipsoidParameters, kind: InterfaceKind) -> [f64; 8] {
    let interface = kind.parameters(parameters);
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
