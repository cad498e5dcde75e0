//! Bonds of one interface, in the body frame of the lower monomer.

use crate::gap::Gap;
use crate::stream::Stream;
use crate::{
    Anchors, Bond, Cubature, CubatureError, CubaturePoint, EllipsoidParameters, Helix,
    InterfaceKind, Neighbour,
};
use thiserror::Error;

/// Consecutive rejected samples after which sampling fails. An interface that covers a fraction
/// 1e-5 of the surface fails by chance once in 2e4.
const MAXIMUM_ATTEMPTS: u64 = 1_000_000;

/// Additional samples per bond.
const ATTEMPTS_PER_BOND: u64 = 1_000;

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
        let number = stream_number(kind, parameters.anchors, index);
        let mut stream = Stream::new(parameters.seed, parameters.sampling, number);
        let mut attempts = 0;
        let wanted = parameters.interface(kind).bonds;
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

/// Stream of the interface above `index`, unique for indices below 2^61; shared patterns have
/// separate streams.
fn stream_number(kind: InterfaceKind, anchors: Anchors, index: i64) -> u64 {
    if anchors.are_shared() {
        2 | kind.number()
    } else {
        (index.cast_unsigned() << 2) | kind.number()
    }
}

#[cfg(test)]
mod tests;
