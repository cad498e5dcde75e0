//! A periodic cell of monomers under uniform strain: what a filament stores per length.
//!
//! [`Cell::relax`] is what to call first. Pairs of monomers are in `pairs.rs`, the search for the
//! minimum in `minimum.rs`, loads and tangent in `response.rs`, the same at a temperature in `heat/`.

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

/// Coordinates of one monomer of a cell: displacement, then turn.
const PER_MONOMER: usize = 6;
/// Strains of a cell: curvature, then shear strain.
const STRAINS: usize = 6;

/// The six strains of a rod: `kappa_1`, `kappa_2`, `kappa_3` (rad/nm), then `sigma_1`, `sigma_2`,
/// `sigma_3`; or what is conjugate to them: couple (pN nm), then force (pN), in body axes.
pub type SixVector = nalgebra::Vector6<f64>;
/// Derivatives of loads by strains.
pub type SixMatrix = nalgebra::Matrix6<f64>;

/// Displacements (nm) and turns (rad) of the monomers of a cell from the uniformly strained helix:
/// for each `u`, then `w`, in the frame of its place on the axis.
pub type Displacements = DVector<f64>;

/// A cell of `P` monomers of an endless filament that is strained uniformly.
///
/// With the strains `xi = (kappa, e3 + sigma)` the axis is the curve `g(s) = exp(s xi)` of the group
/// of rigid motions, place `T(s)` and frame `R(s)`. Monomer `i` stands at
/// `T(s_i) + R(s_i) (o_i + u_i)` with the orientation `R(s_i) exp([w_i]x) Q_i`, where `o_i` and `Q_i`
/// are its offset from the axis and its orientation in the built filament and `s_i = i rise`. Monomer
/// `i + P` is the image of `i` under `exp(P rise xi)`, which takes `g(s_i)` to `g(s_{i + P})`. So a
/// bond between `i` and `i + n` is in the frame of `s_i` the vector
///
/// `d = R_n (o_j + u_j + exp([w_j]x) b) + T_n - (o_i + u_i + exp([w_i]x) a)`,
/// `R_n = exp(n rise [kappa]x)`, `T_n = n rise J_l(n rise kappa) (e3 + sigma)`,
///
/// `j` the one of the cell that `i + n` is or is an image of, `a` and `b` the ends of the bond turned
/// by `Q_i` and `Q_j`, `J_l` the left Jacobian: the strain enters through `R_n` and `T_n` alone.
///
/// Means of `u` and `w` are held ([`Hold`]), all else relaxes; the energy per length `W(kappa, sigma)` is
/// that of the bonds of the cell over `P rise`. Its derivatives are the couple and the force in
/// body axes.
///
/// The cell knows no waves longer than itself, and no ends.
///
/// ```
/// use actin_ellipsoid::{Cell, EllipsoidModel, EllipsoidParameters, Hold, SixVector};
/// let model = EllipsoidModel::new(EllipsoidParameters::default()).unwrap();
/// let cell = Cell::new(&model, 13, Hold::Means).unwrap();
/// // Stretched by 1e-3 without turning: force over strain is the rigidity S3.
/// let strain = SixVector::new(0.0, 0.0, 0.0, 0.0, 0.0, 1e-3);
/// let response = cell.relax(&strain, None).unwrap();
/// assert!((response.loads[5] / 1e-3 / 3.45e4 - 1.0).abs() < 0.01);
/// ```
///
/// # Source
/// The Cauchy-Born rule with relaxation, for helical structures: R. D. James, J. Mech. Phys. Solids
/// 54 (2006) 2354.
#[derive(Clone, Debug)]
pub struct Cell {
    offsets: Vec<Vector3>,
    pairs: Vec<pairs::CellPair>,
    rise: f64,
    /// Orthonormal rows: combinations of displacements that are held at zero.
    held: DMatrix<f64>,
}

impl Cell {
    /// The cell of `monomers` monomers from lattice index 0 on.
    ///
    /// # Errors
    /// Fewer than three monomers, so many that they do not return to the azimuth of the first (whole
    /// numbers of 13 do with the default helix), and bonds that cannot be found.
    pub fn new(model: &EllipsoidModel, monomers: usize, hold: Hold) -> Result<Self, CellError> {
        Self::with_turn(model, monomers, model.parameters().turn, hold)
    }

    /// The same of a filament that has been twisted: each monomer is turned about the axis by `turn` (rad) from the one before,
    /// its bonds are those of the built filament. Strains are in frames that do not turn with it.
    ///
    /// With a curvature that is constant in these frames it is bent in a plane. One that is twisted by its strain is bent along
    /// a helix: its curvature turns with its frames.
    ///
    /// # Errors
    /// As [`new`](Self::new): the monomers have to return to the azimuth of the first with this turn.
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
                let rigidity = kind.parameters(model.parameters()).rigidity;
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
    pub fn monomers(&self) -> usize {
        self.offsets.len()
    }

    /// Length of the cell in the built filament (nm).
    pub fn length(&self) -> f64 {
        self.monomers() as f64 * self.rise
    }

    /// Number of coordinates of its monomers.
    fn coordinates(&self) -> usize {
        PER_MONOMER * self.monomers()
    }
}

#[cfg(test)]
mod tests;
