//! Bonds of one interface, in the body frame of the lower monomer.

use crate::gap::Gap;
use crate::stream::Stream;
use crate::{
    Anchors, Cubature, CubatureError, CubaturePoint, EllipsoidParameters, Helix,
    InterfaceParameters, Neighbour,
};
use actin_mechanics::Vector3;
use thiserror::Error;

/// Consecutive rejected samples after which sampling fails. An interface that covers a fraction
/// 1e-5 of the surface fails by chance once in 2e4.
const MAXIMUM_ATTEMPTS: u64 = 1_000_000;

/// Additional samples per bond.
const ATTEMPTS_PER_BOND: u64 = 1_000;

/// Kind of interface between two monomers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum InterfaceKind {
    /// Between monomers `i` and `i + 1`, of different strands.
    Lateral,
    /// Between monomers `i` and `i + 2`, of the same strand.
    Longitudinal,
}

impl InterfaceKind {
    /// Both kinds, in order of their index.
    pub const ALL: [Self; 2] = [Self::Lateral, Self::Longitudinal];

    /// Number of lattice steps from the lower to the upper monomer.
    pub fn steps(self) -> usize {
        match self {
            Self::Lateral => 1,
            Self::Longitudinal => 2,
        }
    }

    /// Parameters of this kind of interface.
    pub(crate) fn parameters(self, parameters: &EllipsoidParameters) -> &InterfaceParameters {
        match self {
            Self::Lateral => &parameters.lateral,
            Self::Longitudinal => &parameters.longitudinal,
        }
    }

    pub(crate) fn number(self) -> u64 {
        match self {
            Self::Lateral => 0,
            Self::Longitudinal => 1,
        }
    }

    /// Stream of the interface above `index`, unique for indices below 2^61; shared patterns have
    /// separate streams.
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

/// Error of the choice of bonds of an interface.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum InterfaceError {
    /// No sampled point gave a bond.
    #[error(
        "no {kind} bond of {minimum_nm:?} to {maximum_nm:?} nm among {attempts} sampled \
         points: widen the range of bond lengths"
    )]
    NoBonds {
        /// Kind of interface.
        kind: InterfaceKind,
        /// Minimum bond length (nm).
        minimum_nm: f64,
        /// Maximum bond length (nm).
        maximum_nm: f64,
        /// Number of consecutive rejected samples.
        attempts: u64,
    },
    /// Too few sampled points gave a bond.
    #[error(
        "only {found} of {wanted} {kind} bonds of {minimum_nm:?} to {maximum_nm:?} nm among \
         {attempts} sampled points: widen the range of bond lengths"
    )]
    FewBonds {
        /// Kind of interface.
        kind: InterfaceKind,
        /// Minimum bond length (nm).
        minimum_nm: f64,
        /// Maximum bond length (nm).
        maximum_nm: f64,
        /// Number of bonds found.
        found: usize,
        /// Number of bonds requested.
        wanted: usize,
        /// Total number of samples.
        attempts: u64,
    },
    /// Quadrature bonds could not be computed.
    #[error("quadrature of {kind} bonds: {reason}")]
    NoCubature {
        /// Kind of interface.
        kind: InterfaceKind,
        /// Cause.
        reason: CubatureError,
    },
}

/// One bond: anchors, rest length and weight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bond {
    /// Anchor on the lower monomer (nm, its body frame).
    pub lower: Vector3,
    /// Anchor on the upper monomer (nm, its body frame).
    pub upper: Vector3,
    /// Rest length (nm): length in the built filament.
    pub rest_length: f64,
    /// Fraction of the rigidity of the interface. The weights of an interface add up to 1.
    pub weight: f64,
}

/// Bonds of one interface.
#[derive(Clone, Debug, PartialEq)]
pub struct Interface {
    /// Kind of interface.
    pub kind: InterfaceKind,
    /// Pose of the upper monomer in the frame of the lower one.
    pub neighbour: Neighbour,
    /// Bonds of the interface.
    pub bonds: Vec<Bond>,
    /// Number of sampled points; 0 for quadrature bonds.
    pub attempts: u64,
}

impl Interface {
    /// Interface above the given lattice index. Only independent anchors depend on the index.
    ///
    /// # Errors
    /// [`InterfaceError`] if too few samples give a bond or the quadrature fails.
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

    fn weighted(
        parameters: &EllipsoidParameters,
        kind: InterfaceKind,
    ) -> Result<Self, InterfaceError> {
        let helix = Helix::new(parameters);
        let (neighbour, half_turn) = (helix.neighbour(kind), helix.half_turn(kind));
        let cubature = Cubature::for_interface(parameters, kind)
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
}

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
