//! One interface: the anchors of the bonds between two neighbouring monomers.
//!
//! Everything is in the body frame of the lower monomer, where the upper one stands at the same
//! place all along the helix.

use crate::gap::Gap;
use crate::stream::Stream;
use crate::{
    Anchors, Cubature, CubatureError, CubaturePoint, EllipsoidParameters, Helix,
    InterfaceParameters, Neighbour,
};
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

    /// 0 or 1.
    pub(crate) fn number(self) -> u64 {
        match self {
            Self::Lateral => 0,
            Self::Longitudinal => 1,
        }
    }

    /// The number of the stream from which the interface above `index` draws: no two pairs of
    /// kind and index share one while indices stay below 2^61, and the shared patterns have
    /// streams of their own.
    fn stream_number(self, anchors: Anchors, index: i64) -> u64 {
        if anchors.are_shared() {
            2 | self.number()
        } else {
            (index.cast_unsigned() << 2) | self.number()
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
        "bond limit that leaves an interface without bonds: no {kind} bond of \
         {minimum_nm:?} to {maximum_nm:?} nm among {attempts} drawn points"
    )]
    NoBonds {
        /// Kind of the interface.
        kind: InterfaceKind,
        /// Shortest bond that would have been accepted (nm).
        minimum_nm: f64,
        /// Longest bond that would have been accepted (nm).
        maximum_nm: f64,
        /// Points drawn since the last bond.
        attempts: u64,
    },
    /// Too few bonds were short enough.
    #[error(
        "bond limit that leaves an interface short of bonds: {found} of {wanted} {kind} bonds of \
         {minimum_nm:?} to {maximum_nm:?} nm among {attempts} drawn points"
    )]
    FewBonds {
        /// Kind of the interface.
        kind: InterfaceKind,
        /// Shortest bond that would have been accepted (nm).
        minimum_nm: f64,
        /// Longest bond that would have been accepted (nm).
        maximum_nm: f64,
        /// Bonds that were found.
        found: usize,
        /// Bonds that were wanted.
        wanted: usize,
        /// Points drawn in all.
        attempts: u64,
    },
    /// No weighted bonds stand for all that could be drawn.
    #[error("weighted {kind} bonds: {reason}")]
    NoCubature {
        /// Kind of the interface.
        kind: InterfaceKind,
        /// What is wrong.
        reason: CubatureError,
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
    /// Share of the interface's rigidity: all of those of an interface add up to 1.
    pub weight: f64,
}

/// The bonds of one interface, drawn or weighted.
#[derive(Clone, Debug, PartialEq)]
pub struct Interface {
    /// Kind of the interface.
    pub kind: InterfaceKind,
    /// The upper monomer as the lower one sees it.
    pub neighbour: Neighbour,
    /// The bonds.
    pub bonds: Vec<Bond>,
    /// Points drawn on the lower monomer's surface until all bonds were found; 0 of weighted ones.
    pub attempts: u64,
}

impl Interface {
    /// The interface of the given kind whose lower monomer has the given lattice index.
    ///
    /// Weighted bonds are the same for all interfaces of a kind. The draws of others depend on seed and sampling, the kind and the index only (not on the index where
    /// anchors are identical), so the same monomers have the same anchors in whatever run.
    ///
    /// # Errors
    /// [`InterfaceError`] if no bond is short and long enough, or too small a part of the surface has
    /// any, or no weighted ones are found.
    pub(crate) fn new(
        parameters: &EllipsoidParameters,
        kind: InterfaceKind,
        index: i64,
    ) -> Result<Self, InterfaceError> {
        match parameters.anchors {
            Anchors::Independent | Anchors::Identical => Self::draw(parameters, kind, index),
            Anchors::Cubature => Self::weighted(parameters, kind),
        }
    }

    /// The interface of weighted bonds.
    fn weighted(
        parameters: &EllipsoidParameters,
        kind: InterfaceKind,
    ) -> Result<Self, InterfaceError> {
        let helix = Helix::new(parameters);
        let (neighbour, half_turn) = (helix.neighbour(kind), helix.half_turn(kind));
        let cubature = Cubature::of(parameters, kind)
            .map_err(|reason| InterfaceError::NoCubature { kind, reason })?;
        let bond = |point: &CubaturePoint| {
            let [lower, upper] = point.ends(&neighbour, half_turn);
            Bond {
                lower,
                upper,
                rest_length: point.length,
                weight: point.weight,
            }
        };
        Ok(Self {
            kind,
            neighbour,
            bonds: cubature.points.iter().map(bond).collect(),
            attempts: 0,
        })
    }

    /// Draws the bonds of an interface.
    ///
    /// # Source
    /// arXiv 2203.01284, Appendix A.
    fn draw(
        parameters: &EllipsoidParameters,
        kind: InterfaceKind,
        index: i64,
    ) -> Result<Self, InterfaceError> {
        let gap = Gap::new(parameters, kind);
        let number = kind.stream_number(parameters.anchors, index);
        let mut stream = Stream::new(parameters.seed, parameters.sampling, number);
        let mut attempts = 0;
        let wanted = kind.parameters(parameters).bonds;
        let most = MAXIMUM_ATTEMPTS + ATTEMPTS_PER_BOND * wanted as u64;
        let mut bonds = Vec::with_capacity(wanted);
        while bonds.len() < wanted {
            let bond = draw_bond(&gap, kind, &mut stream, &mut attempts)?;
            let weight = 1.0 / wanted as f64;
            bonds.push(Bond { weight, ..bond });
            if attempts > most {
                return Err(InterfaceError::FewBonds {
                    kind,
                    minimum_nm: gap.minimum,
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
        let square = |bond: &Bond| bond.weight * bond.lower.cross(&axis).norm_squared();
        self.bonds.iter().map(square).sum()
    }

    /// Mean length of the bonds at rest (nm).
    pub fn mean_length(&self) -> f64 {
        let length = |bond: &Bond| bond.weight * bond.rest_length;
        self.bonds.iter().map(length).sum()
    }
}

/// Draws points on the lower monomer until one has a bond.
fn draw_bond(
    gap: &Gap,
    kind: InterfaceKind,
    stream: &mut Stream,
    attempts: &mut u64,
) -> Result<Bond, InterfaceError> {
    for _ in 0..MAXIMUM_ATTEMPTS {
        *attempts += 1;
        if let Some(bond) = gap.bond_from(gap.ellipsoid.sample(stream)) {
            return Ok(bond);
        }
    }
    Err(InterfaceError::NoBonds {
        kind,
        minimum_nm: gap.minimum,
        maximum_nm: gap.maximum,
        attempts: MAXIMUM_ATTEMPTS,
    })
}

#[cfg(test)]
mod tests;
