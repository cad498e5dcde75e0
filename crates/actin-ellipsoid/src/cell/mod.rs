//! Periodic cell of monomers under uniform strain.

mod error;
mod heat;
mod hold;
mod jets;
mod minimum;
mod pairs;
mod response;

pub use error::CellError;
pub use heat::{Heat, HeatResponse};
pub use hold::Hold;
pub use response::{CellResponse, Control};

use crate::{EllipsoidModel, InterfaceKind};
use actin_mechanics::Vector3;
use nalgebra::{DMatrix, DVector, Rotation3};
use std::f64::consts::{PI, TAU};

/// Coordinates per monomer: displacement, then rotation vector.
const PER_MONOMER: usize = 6;
const STRAINS: usize = 6;

/// Strains of a rod: `kappa_1`, `kappa_2`, `kappa_3` (rad/nm), `sigma_1`, `sigma_2`, `sigma_3`; or
/// the conjugate loads: torque (pN nm), then force (pN), in body axes.
pub type SixVector = nalgebra::Vector6<f64>;
/// Derivatives of loads with respect to strains.
pub type SixMatrix = nalgebra::Matrix6<f64>;

/// Displacements `u` (nm) and rotation vectors `w` (rad) of all monomers relative to the uniformly
/// strained helix, in the frame of the axis at the monomer.
pub type Displacements = DVector<f64>;

/// Cell of `P` monomers of an infinite, uniformly strained filament.
///
/// The axis is the curve `g(s) = exp(s xi)` of rigid motions with the strain
/// `xi = (kappa, e3 + sigma)`, position `T(s)` and frame `R(s)`:
///
/// ```text
/// s_i = i rise
/// monomer i: position T(s_i) + R(s_i) (o_i + u_i), orientation R(s_i) exp([w_i]x) Q_i
/// monomer i + P: image of monomer i under exp(P rise xi)
/// d   = R_n (o_j + u_j + exp([w_j]x) b) + T_n - (o_i + u_i + exp([w_i]x) a)
/// R_n = exp(n rise [kappa]x),   T_n = n rise J_l(n rise kappa) (e3 + sigma)
///
/// o_i, Q_i   offset from the axis (nm) and orientation in the built filament
/// d          vector of a bond between i and i + n (nm), in the frame at s_i
/// j          monomer of the cell with image i + n
/// a, b       anchors, rotated by Q_i and Q_j (nm)
/// J_l        left Jacobian of SO(3)
/// ```
///
/// Six conditions hold the mean displacement and rotation ([`Hold`]); all other coordinates relax.
/// The energy per length `W(kappa, sigma)` is the energy of the bonds of the cell divided by
/// `P rise`. Its derivatives are the torque and the force in body axes. The cell excludes longer
/// waves and end effects.
///
/// ```
/// use actin_ellipsoid::{Cell, EllipsoidModel, EllipsoidParameters, Hold, SixVector};
/// let model = EllipsoidModel::new(EllipsoidParameters::default()).unwrap();
/// let cell = Cell::new(&model, 13, Hold::Means).unwrap();
/// // Stretched by 1e-3 at fixed twist: force over strain is the rigidity S3.
/// let strain = SixVector::new(0.0, 0.0, 0.0, 0.0, 0.0, 1e-3);
/// let response = cell.relax(&strain, None).unwrap();
/// assert!((response.loads[5] / 1e-3 / 3.45e4 - 1.0).abs() < 0.01);
/// ```
///
/// # Source
/// Cauchy-Born rule with relaxation for helical structures: R. D. James, J. Mech. Phys. Solids 54
/// (2006) 2354.
#[derive(Clone, Debug)]
pub struct Cell {
    offsets: Vec<Vector3>,
    pairs: Vec<pairs::CellPair>,
    rise: f64,
    held: DMatrix<f64>,
}

impl Cell {
    /// Cell of `monomers` monomers starting with lattice index 0.
    ///
    /// # Errors
    /// Fewer than three monomers, a number that is not a period of the helix (multiples of 13 for
    /// the default helix), or interfaces without bonds.
    pub fn new(model: &EllipsoidModel, monomers: usize, hold: Hold) -> Result<Self, CellError> {
        Self::with_turn(model, monomers, model.parameters().turn, hold)
    }

    /// Cell of a pre-twisted filament: the turn per monomer about the axis is `turn` (rad), the
    /// bonds are unchanged. The frames of the strains do not rotate with the pre-twist, so a
    /// constant curvature bends the filament in a plane. A filament twisted by its strain is bent
    /// along a helix.
    ///
    /// # Errors
    /// As [`new`](Self::new), for the period with this turn.
    pub fn with_turn(
        model: &EllipsoidModel,
        monomers: usize,
        turn: f64,
        hold: Hold,
    ) -> Result<Self, CellError> {
        let helix = model.helix();
        let all = turn * monomers as f64;
        let missing = (all + PI).rem_euclid(TAU) - PI;
        if monomers < 3 || missing.abs() > 1e-9 {
            return Err(CellError::NoPeriod { monomers, missing });
        }
        let twist = turn - model.parameters().turn;
        let place = |(index, k): (i64, usize)| {
            let height = Vector3::z() * helix.arc_length(index);
            let axes = helix.orientation(index).to_rotation_matrix().into_inner();
            let turned = Rotation3::from_axis_angle(&Vector3::z_axis(), twist * k as f64);
            (turned * (helix.centre(index) - height), turned * axes)
        };
        let indices = || (0_i64..).zip(0..monomers);
        let places: Vec<_> = indices().map(place).collect();
        let mut pairs = Vec::new();
        for (index, lower) in indices() {
            for kind in InterfaceKind::ALL {
                let interface = model.interface(kind, index)?;
                let upper = (lower + kind.steps()) % monomers;
                let axes = [places[lower].1, places[upper].1];
                let rigidity = model.parameters().interface(kind).rigidity;
                let pair = pairs::CellPair::new([lower, upper], &interface, axes, rigidity);
                pairs.push(pair);
            }
        }
        let offsets: Vec<Vector3> = places.iter().map(|place| place.0).collect();
        Ok(Self {
            held: hold.rows(&offsets),
            offsets,
            pairs,
            rise: helix.rise(),
        })
    }

    /// Number of monomers.
    pub(crate) fn monomers(&self) -> usize {
        self.offsets.len()
    }

    /// Length of the cell in the built filament (nm).
    pub fn length(&self) -> f64 {
        self.monomers() as f64 * self.rise
    }

    fn coordinates(&self) -> usize {
        PER_MONOMER * self.monomers()
    }
}

#[cfg(test)]
mod tests;
