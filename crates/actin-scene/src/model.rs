//! Parameters of monomers, rods and junctions.

use super::RodLaw;
use actin_cosserat::{Rigidities, RotaryInertia};
use actin_coupling::JunctionWeight;
use actin_ellipsoid::{Anchors, EllipsoidParameters, InterfaceParameters, constants};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Parameters of the monomers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct Monomers {
    /// Seed of sampled bonds. Must be omitted with `Cubature`.
    pub seed: u64,
    /// Choice of the bonds of an interface.
    pub anchors: Anchors,
    /// Bonds per lateral interface (monomer i to i + 1): 4 to 64 quadrature bonds, 12 by default; or 1 to 10,000
    /// sampled bonds, 64 by default.
    #[serde(default = "by_anchors")]
    #[schemars(extend("default" = 12))]
    pub lateral_bonds: usize,
    /// Bonds per longitudinal interface (monomer i to i + 2), with the ranges and defaults of `lateral_bonds`.
    #[serde(default = "by_anchors")]
    #[schemars(extend("default" = 12))]
    pub longitudinal_bonds: usize,
    /// Shortest bond of either kind; at least 0, less than both largest lengths. Shorter bonds are sampled again.
    pub min_bond_nm: f64,
    /// Rigidity of a lateral interface, shared by its bonds; positive.
    pub lateral_rigidity_pn_per_nm: f64,
    /// Rigidity of a longitudinal interface, shared by its bonds; positive.
    pub longitudinal_rigidity_pn_per_nm: f64,
    /// Longest lateral bond; greater than `min_bond_nm`.
    pub lateral_max_bond_nm: f64,
    /// Longest longitudinal bond; greater than `min_bond_nm`.
    pub longitudinal_max_bond_nm: f64,
    /// Distance of monomer centres from the axis; positive.
    pub radius_nm: f64,
    /// Semi-axes along the radial, tangential and axial direction; positive, two of them equal.
    pub semi_axes_nm: [f64; 3],
    /// Rise from monomer i to i + 1; positive.
    pub rise_nm: f64,
    /// Rotation about the axis from monomer i to i + 1, right-handed; finite.
    pub turn_deg: f64,
    /// Azimuth of lattice index 0; finite.
    pub azimuth_deg: f64,
    /// Mass of a monomer (ag = 1e-21 kg); positive. It also determines the mass per length of rods.
    pub mass_ag: f64,
}

/// Returns the default number of bonds of an interface.
fn usual_bonds(anchors: Anchors) -> usize {
    match anchors {
        Anchors::Independent | Anchors::Identical => constants::BONDS_PER_INTERFACE,
        Anchors::Cubature => constants::POINTS_PER_INTERFACE,
    }
}

/// Omitted number of bonds.
const BY_ANCHORS: usize = usize::MAX;

fn by_anchors() -> usize {
    BY_ANCHORS
}

/// Parameters of the rod.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct RodModel {
    /// Force law. `PaperBalance` requires the law `Constant` or `PublishedExtension`.
    pub force_law: ForceLaw,
    /// Rigidities.
    pub material: Material,
    /// Constitutive law. `Fitted` and the `Homogenised` laws require the default material; a custom material requires
    /// `law: Constant`.
    pub law: RodLaw,
    /// Transverse inertia of segments.
    pub rotary_inertia: RotaryInertia,
}

impl RodModel {
    /// Creates a rod model with this law and default parameters.
    pub fn with_law(law: RodLaw) -> Self {
        Self {
            law,
            ..Self::default()
        }
    }
}

/// Force law of the rod.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum ForceLaw {
    /// Forces and torques are minus the gradient of an energy.
    #[default]
    EnergyGradient,
    /// The balance equations as printed in the paper. They have no potential: `Dynamics` only.
    PaperBalance,
}

/// Rigidities of the rod.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum Material {
    /// Table 4 of the paper.
    #[default]
    Table4,
    /// Table 2 of the paper: parameters of the preceding paper with a cross-section of 38.5 nm^2.
    PrecedingPaper,
    /// Custom rigidities.
    Rigidities {
        /// Two shearing rigidities and the stretching rigidity; each positive.
        shear_pn: [f64; 3],
        /// Two bending rigidities and the twisting rigidity; each positive.
        bend_pn_nm2: [f64; 3],
    },
}

/// Parameters of the junctions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct JunctionModel {
    /// Weight of each bond.
    pub weight: JunctionWeight,
    /// Number of attached monomers: 1 or 2.
    pub attached_monomers: usize,
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

/// Bonds per interface of a quadrature that meets all moments.
const QUADRATURE_BONDS: usize = 12;

impl Monomers {
    /// Returns these monomers with quadrature bonds in place of sampled bonds.
    #[must_use]
    pub fn with_quadrature_bonds(&self) -> Self {
        if self.anchors == Anchors::Cubature {
            return self.clone();
        }
        Self {
            seed: 0,
            anchors: Anchors::Cubature,
            lateral_bonds: QUADRATURE_BONDS,
            longitudinal_bonds: QUADRATURE_BONDS,
            ..self.clone()
        }
    }

    /// Creates default monomers with this number of sampled bonds per interface.
    pub fn with_sampled_bonds(bonds: usize, seed: u64) -> Self {
        Self {
            seed,
            anchors: Anchors::Independent,
            lateral_bonds: bonds,
            longitudinal_bonds: bonds,
            ..Self::default()
        }
    }

    /// Returns the harmonic mean of the numbers of lateral and longitudinal bonds for `Independent` bonds, otherwise
    /// `None`.
    pub fn sampled_bonds(&self) -> Option<usize> {
        let (a, b) = (self.lateral_bonds, self.longitudinal_bonds);
        (self.anchors == Anchors::Independent).then(|| 2 * a * b / (a + b))
    }

    pub(super) fn resolve(&mut self) {
        let usual = usual_bonds(self.anchors);
        for bonds in [&mut self.lateral_bonds, &mut self.longitudinal_bonds] {
            if *bonds == BY_ANCHORS {
                *bonds = usual;
            }
        }
    }
}

impl Material {
    /// Returns the rigidities, not validated.
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

impl From<&Monomers> for EllipsoidParameters {
    fn from(m: &Monomers) -> Self {
        Self {
            radius: m.radius_nm,
            rise: m.rise_nm,
            turn: m.turn_deg.to_radians(),
            azimuth: m.azimuth_deg.to_radians(),
            semi_axes: m.semi_axes_nm,
            lateral: InterfaceParameters {
                rigidity: m.lateral_rigidity_pn_per_nm,
                bonds: m.lateral_bonds,
                minimum_length: m.min_bond_nm,
                maximum_length: m.lateral_max_bond_nm,
            },
            longitudinal: InterfaceParameters {
                rigidity: m.longitudinal_rigidity_pn_per_nm,
                bonds: m.longitudinal_bonds,
                minimum_length: m.min_bond_nm,
                maximum_length: m.longitudinal_max_bond_nm,
            },
            anchors: m.anchors,
            seed: m.seed,
            sampling: 0,
            mass: m.mass_ag,
        }
    }
}

impl From<&EllipsoidParameters> for Monomers {
    fn from(p: &EllipsoidParameters) -> Self {
        Self {
            seed: p.seed,
            anchors: p.anchors,
            lateral_bonds: p.lateral.bonds,
            longitudinal_bonds: p.longitudinal.bonds,
            min_bond_nm: p.lateral.minimum_length.min(p.longitudinal.minimum_length),
            lateral_rigidity_pn_per_nm: p.lateral.rigidity,
            longitudinal_rigidity_pn_per_nm: p.longitudinal.rigidity,
            lateral_max_bond_nm: p.lateral.maximum_length,
            longitudinal_max_bond_nm: p.longitudinal.maximum_length,
            radius_nm: p.radius,
            semi_axes_nm: p.semi_axes,
            rise_nm: p.rise,
            turn_deg: p.turn.to_degrees(),
            azimuth_deg: p.azimuth.to_degrees(),
            mass_ag: p.mass,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Scene;

    fn monomers(text: &str) -> Monomers {
        let text = format!(
            "Scene(
                filament: Filament(
                    sections: [Ellipsoids(from_nm: 0.0, to_nm: 30.0)],
                    monomers: Monomers({text}),
                ),
                clamps: [Clamp(end: Start)],
                task: Equilibrium(),
            )"
        );
        let scene = Scene::from_ron(&text).expect("the scene is valid");
        assert_eq!(Scene::from_ron(&scene.to_ron()).as_ref(), Ok(&scene));
        scene.filament.monomers
    }

    #[test]
    fn default_numbers_of_bonds_depend_on_anchors() {
        let bonds = |text| {
            let monomers = monomers(text);
            (monomers.lateral_bonds, monomers.longitudinal_bonds)
        };
        assert_eq!(bonds("anchors: Independent"), (64, 64));
        assert_eq!(bonds("anchors: Identical, lateral_bonds: 20"), (20, 64));
        assert_eq!(bonds("anchors: Cubature"), (12, 12));
        assert_eq!(bonds("anchors: Cubature, longitudinal_bonds: 16"), (12, 16));
        assert_eq!(bonds(""), (12, 12));
        assert_eq!(monomers(""), Monomers::default());
        assert_eq!(monomers("anchors: Cubature"), Monomers::default());
        let drawn = "anchors: Independent, lateral_bonds: 9, longitudinal_bonds: 9, seed: 4";
        assert_eq!(monomers(drawn), Monomers::with_sampled_bonds(9, 4));
    }
}
