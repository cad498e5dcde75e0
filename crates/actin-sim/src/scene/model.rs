//! Parameters of the models, as a scene writes them.

use super::RodLaw;
use actin_cosserat::Rigidities;
use actin_ellipsoid::EllipsoidParameters;
use serde::{Deserialize, Serialize};

/// Parameters of the monomers. Every default is that of [`EllipsoidParameters`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Monomers {
    /// Seed of the bond anchors.
    pub seed: u64,
    /// Whether each interface draws its own anchors or all share one pattern.
    pub anchors: Anchors,
    /// Bonds per lateral interface (monomer i to i + 1).
    pub lateral_bonds: usize,
    /// Bonds per longitudinal interface (monomer i to i + 2).
    pub longitudinal_bonds: usize,
    /// Rigidity of a lateral interface, shared by its bonds (pN/nm).
    pub lateral_rigidity_pn_per_nm: f64,
    /// Rigidity of a longitudinal interface, shared by its bonds (pN/nm).
    pub longitudinal_rigidity_pn_per_nm: f64,
    /// Longest lateral bond that is accepted (nm).
    pub lateral_max_bond_nm: f64,
    /// Longest longitudinal bond that is accepted (nm).
    pub longitudinal_max_bond_nm: f64,
    /// Distance of monomer centres from the axis (nm).
    pub radius_nm: f64,
    /// Semi-axes along the radial, tangential and axial direction (nm).
    pub semi_axes_nm: [f64; 3],
    /// Rise from monomer i to i + 1 (nm).
    pub rise_nm: f64,
    /// Turn about the axis from monomer i to i + 1 (deg).
    pub turn_deg: f64,
    /// Azimuth of lattice index 0 (deg).
    pub azimuth_deg: f64,
    /// Mass of a monomer (ag = 1e-21 kg); rods take their mass per length from it.
    pub mass_ag: f64,
}

/// How bond anchors are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Anchors {
    /// Each interface has anchors of its own.
    Independent,
    /// All interfaces of a kind share one pattern.
    Identical,
}

/// Parameters of the rod.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RodModel {
    /// How strains and curvatures become loads.
    pub force_law: ForceLaw,
    /// Rigidities.
    pub material: Material,
    /// How the rod departs from these rigidities.
    pub law: RodLaw,
}

/// The two force laws of the rod.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum ForceLaw {
    /// Loads are the gradient of an energy.
    #[default]
    EnergyGradient,
    /// The balance equations as the paper prints them; they have no potential.
    PaperBalance,
}

/// Rigidities of the rod.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Material {
    /// Table 4 of the paper.
    #[default]
    Table4,
    /// Table 2 of the paper: the preceding paper's parameters with a section of 38.5 nm^2.
    PrecedingPaper,
    /// Numbers of one's own.
    Rigidities {
        /// Shearing (twice) and stretching rigidity (pN).
        shear_pn: [f64; 3],
        /// Bending (twice) and twisting rigidity (pN nm^2).
        bend_pn_nm2: [f64; 3],
    },
}

/// Parameters of the junctions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct JunctionModel {
    /// Weight of each bond.
    pub weight: JunctionWeight,
    /// Number of monomers attached, 1 or 2.
    pub attached_monomers: usize,
}

/// Weight of each bond of a junction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum JunctionWeight {
    /// The bonds of a junction share the rod's rigidity.
    Shared,
    /// Every bond has the rod's full rigidity, as the paper's text has it.
    Full,
}

impl Default for JunctionModel {
    fn default() -> Self {
        Self {
            weight: JunctionWeight::Shared,
            attached_monomers: 2,
        }
    }
}

impl Default for Monomers {
    fn default() -> Self {
        Self::from(&EllipsoidParameters::default())
    }
}

impl Material {
    /// The rigidities that the name stands for, not yet validated.
    pub fn rigidities(&self) -> Rigidities {
        match *self {
            Self::Table4 => Rigidities::table4(),
            Self::PrecedingPaper => Rigidities::preceding_paper(),
            Self::Rigidities {
                shear_pn,
                bend_pn_nm2,
            } => Rigidities {
                shear: shear_pn.into(),
                bend: bend_pn_nm2.into(),
            },
        }
    }
}
