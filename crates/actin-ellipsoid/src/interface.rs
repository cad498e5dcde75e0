//! One interface: the anchors of the bonds between two neighbouring monomers.
//!
//! Everything is in the body frame of the lower monomer, where the upper one stands at the same
//! place all along the helix.

use crate::stream::Stream;
use crate::{Anchors, Ellipsoid, EllipsoidParameters, Helix, InterfaceParameters, Neighbour};
use actin_mechanics::Vector3;
use thiserror::Error;

/// Points that are drawn in a row without a bond before an interface is given up: one that
/// accepts a fraction 1e-5 of the lower monomer's surface is given up by mistake once in 2e4.
const MAXIMUM_ATTEMPTS: u64 = 1_000_000;

/// Points that are drawn for each bond of an interface, beyond the above, before it is given up: a
/// thousandth of the surface is little to hold on by, and drawing from less of it takes ever longer.
const ATTEMPTS_PER_BOND: u64 = 1_000;

/// The two kinds of interface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum InterfaceKind {
    /// Between monomers `i` and `i + 1`, of different strands.
    Lateral,
    /// Between monomers `i` and `i + 2`, of the same strand.
    Longitudinal,
}

impl InterfaceKind {
    /// Both kinds.
    pub const ALL: [Self; 2] = [Self::Lateral, Self::Longitudinal];

    /// Lattice steps from the lower to the upper monomer.
    pub fn steps(self) -> usize {
        match self {
            Self::Lateral => 1,
            Self::Longitudinal => 2,
        }
    }

    /// The parameters of this kind of interface.
    pub fn parameters(self, parameters: &EllipsoidParameters) -> &InterfaceParameters {
        match self {
            Self::Lateral => &parameters.lateral,
            Self::Longitudinal => &parameters.longitudinal,
        }
    }

    /// The number of the stream from which the interface above `index` draws: no two pairs of
    /// kind and index share one while indices stay below 2^61, and the shared patterns have
    /// streams of their own.
    fn stream_number(self, anchors: Anchors, index: i64) -> u64 {
        let kind = match self {
            Self::Lateral => 0,
            Self::Longitudinal => 1,
        };
        match anchors {
            Anchors::Independent => (index.cast_unsigned() << 2) | kind,
            Anchors::Identical => 2 | kind,
        }
    }
}

impl std::fmt::Display for InterfaceKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Lateral => "lateral",
            Self::Longitudinal => "longitudinal",
        })
    }
}

/// Why an interface could not be drawn.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum InterfaceError {
    /// No bond was short enough.
    #[error(
        "bond limit that leaves an interface without bonds: no {kind} bond of at most \
         {maximum_nm:?} nm among {attempts} drawn points"
    )]
    NoBonds {
        /// Kind of the interface.
        kind: InterfaceKind,
        /// Longest bond that would have been accepted (nm).
        maximum_nm: f64,
        /// Points drawn since the last bond.
        attempts: u64,
    },
    /// Too few bonds were short enough.
    #[error(
        "bond limit that leaves an interface short of bonds: {found} of {wanted} {kind} bonds of \
         at most {maximum_nm:?} nm among {attempts} drawn points"
    )]
    FewBonds {
        /// Kind of the interface.
        kind: InterfaceKind,
        /// Longest bond that would have been accepted (nm).
        maximum_nm: f64,
        /// Bonds that were found.
        found: usize,
        /// Bonds that were wanted.
        wanted: usize,
        /// Points drawn in all.
        attempts: u64,
    },
}

/// One bond: its ends, fixed in the bodies, and its length at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bond {
    /// End on the lower monomer (nm, its body frame).
    pub lower: Vector3,
    /// End on the upper monomer (nm, its body frame).
    pub upper: Vector3,
    /// Length in the built filament (nm).
    pub rest_length: f64,
}

/// The bonds of one interface, as drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Interface {
    /// Kind of the interface.
    pub kind: InterfaceKind,
    /// The upper monomer as the lower one sees it.
    pub neighbour: Neighbour,
    /// The bonds.
    pub bonds: Vec<Bond>,
    /// Points drawn on the lower monomer's surface until all bonds were found.
    pub attempts: u64,
}

impl Interface {
    /// Draws the interface of the given kind whose lower monomer has the given lattice index.
    ///
    /// The draws depend on seed and sampling, the kind and the index only (not on the index where
    /// anchors are identical), so the same monomers have the same anchors in whatever run.
    ///
    /// # Errors
    /// [`InterfaceError`] if no bond is short enough, or too small a part of the surface has any.
    ///
    /// # Source
    /// arXiv 2203.01284, Appendix A.
    pub(crate) fn draw(
        parameters: &EllipsoidParameters,
        kind: InterfaceKind,
        index: i64,
    ) -> Result<Self, InterfaceError> {
        let gap = Gap {
            ellipsoid: Ellipsoid::new(parameters.semi_axes),
            neighbour: Helix::new(parameters).neighbour(kind),
            maximum: kind.parameters(parameters).maximum_length,
        };
        let number = kind.stream_number(parameters.anchors, index);
        let mut stream = Stream::new(parameters.seed, parameters.sampling, number);
        let mut attempts = 0;
        let wanted = kind.parameters(parameters).bonds;
        let most = MAXIMUM_ATTEMPTS + ATTEMPTS_PER_BOND * wanted as u64;
        let mut bonds = Vec::with_capacity(wanted);
        while bonds.len() < wanted {
            bonds.push(gap.draw_bond(kind, &mut stream, &mut attempts)?);
            if attempts > most {
                return Err(InterfaceError::FewBonds {
                    kind,
                    maximum_nm: gap.maximum,
                    found: bonds.len(),
                    wanted,
                    attempts,
                });
            }
        }
        Ok(Self {
            kind,
            neighbour: gap.neighbour,
            bonds,
            attempts,
        })
    }

    /// Mean square distance of the bonds from the line of centres (nm^2): times half the rigidity,
    /// the mean stiffness against tilting.
    pub fn mean_square_distance(&self) -> f64 {
        let axis = self.neighbour.offset.normalize();
        let distances = self.bonds.iter().map(|bond| bond.lower.cross(&axis));
        distances.map(|d| d.norm_squared()).sum::<f64>() / self.bonds.len() as f64
    }

    /// Mean length of the bonds at rest (nm).
    pub fn mean_length(&self) -> f64 {
        let sum: f64 = self.bonds.iter().map(|bond| bond.rest_length).sum();
        sum / self.bonds.len() as f64
    }
}

/// The space between two neighbours, which bonds bridge.
#[derive(Debug)]
struct Gap {
    ellipsoid: Ellipsoid,
    neighbour: Neighbour,
    maximum: f64,
}

impl Gap {
    /// Draws points on the lower monomer until one has a bond.
    fn draw_bond(
        &self,
        kind: InterfaceKind,
        stream: &mut Stream,
        attempts: &mut u64,
    ) -> Result<Bond, InterfaceError> {
        for _ in 0..MAXIMUM_ATTEMPTS {
            *attempts += 1;
            if let Some(bond) = self.bond_from(self.ellipsoid.sample(stream)) {
                return Ok(bond);
            }
        }
        Err(InterfaceError::NoBonds {
            kind,
            maximum_nm: self.maximum,
            attempts: MAXIMUM_ATTEMPTS,
        })
    }

    /// The bond that starts at `point` of the lower monomer's surface and runs parallel to the
    /// line of centres, if there is one that bridges the gap and is short enough.
    ///
    /// It runs *towards* the upper monomer, leaves the lower one where it starts (the outward
    /// normal faces the upper monomer) and ends where it *enters* the upper one (the smaller
    /// root, positive). Then the smaller root is also the shorter one, and no bond lies inside a
    /// monomer. What this refuses beyond the published rule: points on the far side, whose bond
    /// would run through the lower monomer, and points inside the upper monomer, where monomers
    /// overlap. With the default parameters there are none of either within the maximum length.
    fn bond_from(&self, point: Vector3) -> Option<Bond> {
        let Neighbour { rotation, offset } = self.neighbour;
        let direction = offset.normalize();
        if self.ellipsoid.normal(point).dot(&direction) <= 0.0 {
            return None;
        }
        let origin = rotation.tr_mul(&(point - offset));
        let towards = rotation.tr_mul(&direction);
        let [length, _] = self.ellipsoid.line_intersections(origin, towards)?;
        (length > 0.0 && length <= self.maximum).then(|| Bond {
            lower: point,
            upper: origin + length * towards,
            rest_length: length,
        })
    }
}

#[cfg(test)]
mod tests;
