//! Sections of a filament and their altered parameters.

use super::RodLaw;
use super::model::{Material, Monomers, RodModel};
use actin_cosserat::RigidityFactors;
use actin_mechanics::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Section of a filament with one resolution.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum Section {
    /// Monomers as rigid ellipsoids. Boundaries are moved to the nearest position half a rise after a monomer.
    Ellipsoids {
        /// Arc length of the start; at least 0.
        from_nm: f64,
        /// Arc length of the end; greater than `from_nm`, by at least two monomers.
        to_nm: f64,
        /// Parameters that differ from `monomers` of the filament. They differ between adjacent sections of
        /// monomers.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        altered: Option<MonomerChanges>,
    },
    /// Cosserat rod.
    Rod {
        /// Arc length of the start; at least 0.
        from_nm: f64,
        /// Arc length of the end; greater than `from_nm`.
        to_nm: f64,
        /// Number of segments; at least 1. By default segments are as close to 10 nm as possible.
        #[serde(default)]
        segments: Option<usize>,
        /// Parameters that differ from `rod` of the filament. They differ between adjacent rods. Adjacent rods
        /// share the cross-section at the boundary, where half a segment of each bends in series.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        altered: Option<Box<RodChanges>>,
    },
}

/// Parameters of a rod that differ from `rod` of the filament.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
#[serde(rename = "AlteredRod")]
pub struct RodChanges {
    /// Constitutive law; by default the law of the filament.
    pub law: Option<RodLaw>,
    /// Rigidities; by default the rigidities of the filament. The same laws require the default material.
    pub material: Option<Material>,
    /// Factor of the bending rigidity; positive. Under the `Homogenised` laws, equal factors multiply the energy. A
    /// smaller factor of bending or shear moves its nonlinearity to larger strains. In a heat bath, factors multiply the
    /// free energy of unaltered monomers.
    pub bend_rigidity_factor: f64,
    /// Factor of the twisting rigidity; positive.
    pub twist_rigidity_factor: f64,
    /// Factor of the stretching rigidity; positive.
    pub stretch_rigidity_factor: f64,
    /// Factor of the shear rigidity; positive.
    pub shear_rigidity_factor: f64,
    /// Rest curvature about the transverse axes d1 and d2, which are x and y for a filament along lab z, turned by
    /// the rest twist before; finite. The radius of curvature is greater than the radius of the filament, 3.5 nm.
    pub rest_curvature_per_nm: [f64; 2],
    /// Rest twist; finite. Together with the rest curvature it defines a helix. The rod is built with this
    /// twist. For altered monomers, it is the change of `turn_deg` over `rise_nm`.
    pub rest_twist_per_nm: f64,
}

impl Default for RodChanges {
    fn default() -> Self {
        Self {
            law: None,
            material: None,
            bend_rigidity_factor: 1.0,
            twist_rigidity_factor: 1.0,
            stretch_rigidity_factor: 1.0,
            shear_rigidity_factor: 1.0,
            rest_curvature_per_nm: [0.0; 2],
            rest_twist_per_nm: 0.0,
        }
    }
}

impl RodChanges {
    /// Returns the factors of the rigidities.
    pub fn factors(&self) -> RigidityFactors {
        RigidityFactors {
            shear: self.shear_rigidity_factor,
            stretch: self.stretch_rigidity_factor,
            bend: self.bend_rigidity_factor,
            twist: self.twist_rigidity_factor,
        }
    }

    /// Returns the rest curvature and twist (rad/nm, body axes).
    pub fn rest_curvature(&self) -> Vector3 {
        let [x, y] = self.rest_curvature_per_nm;
        Vector3::new(x, y, self.rest_twist_per_nm)
    }
}

/// Parameters of monomers that differ from `monomers` of the filament, for example of monomers with another
/// protein bound.
///
/// An interface belongs to the section of its lower monomer. Equal factors for both rigidities multiply every
/// rigidity of the filament. A smaller lateral factor reduces twisting more than bending, and more at large
/// twist. Factors of 0.03 (lateral) and 0.23 (longitudinal) approximate cofilin: bending is 5 times softer,
/// twisting 5 times at small twist, 7 times in over-twist and 13 times in under-twist at 0.01 rad/nm. At 298 K,
/// factors of 0.02 and 0.45 have the measured ratio of persistence lengths with and without cofilin, 0.22.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
#[serde(rename = "Altered")]
pub struct MonomerChanges {
    /// Factor of the rigidity of lateral interfaces; positive.
    pub lateral_rigidity_factor: f64,
    /// Factor of the rigidity of longitudinal interfaces; positive.
    pub longitudinal_rigidity_factor: f64,
    /// Bonds per lateral interface; by default the number of the filament.
    pub lateral_bonds: Option<usize>,
    /// Bonds per longitudinal interface; by default the number of the filament.
    pub longitudinal_bonds: Option<usize>,
    /// Turn about the axis per monomer at rest; within 30 degrees of `turn_deg` of the filament, which is the
    /// default. The section is built with this helix. The turn changes half a rise after the last monomer. With
    /// cofilin it is about -162 degrees (J. Cell Biol. 138 (1997) 771).
    pub turn_deg: Option<f64>,
    /// Factor of the mass and moments of inertia of a monomer; positive.
    pub mass_factor: f64,
}

impl Default for MonomerChanges {
    fn default() -> Self {
        Self {
            lateral_rigidity_factor: 1.0,
            longitudinal_rigidity_factor: 1.0,
            lateral_bonds: None,
            longitudinal_bonds: None,
            turn_deg: None,
            mass_factor: 1.0,
        }
    }
}

impl MonomerChanges {
    /// Returns altered monomers.
    pub(crate) fn applied_to(&self, monomers: &Monomers) -> Monomers {
        let mut altered = monomers.clone();
        altered.lateral_rigidity_pn_per_nm *= self.lateral_rigidity_factor;
        altered.longitudinal_rigidity_pn_per_nm *= self.longitudinal_rigidity_factor;
        altered.lateral_bonds = self.lateral_bonds.unwrap_or(altered.lateral_bonds);
        altered.longitudinal_bonds = self
            .longitudinal_bonds
            .unwrap_or(altered.longitudinal_bonds);
        altered.turn_deg = self.turn_deg.unwrap_or(altered.turn_deg);
        altered.mass_ag *= self.mass_factor;
        altered
    }
}

impl Section {
    /// Returns whether the section is a rod.
    pub fn is_rod(&self) -> bool {
        matches!(self, Self::Rod { .. })
    }

    /// Returns the altered parameters of a rod.
    pub fn altered_rod(&self) -> Option<&RodChanges> {
        match self {
            Self::Rod { altered, .. } => altered.as_deref(),
            Self::Ellipsoids { .. } => None,
        }
    }

    /// Returns the altered parameters of a rod, mutably.
    pub fn altered_rod_mut(&mut self) -> Option<&mut RodChanges> {
        match self {
            Self::Rod { altered, .. } => altered.as_deref_mut(),
            Self::Ellipsoids { .. } => None,
        }
    }

    /// Returns whether parameters differ from those in the filament.
    pub fn is_altered(&self) -> bool {
        self.altered().is_some() || self.altered_rod().is_some()
    }

    /// Returns the rod model of the section, without rigidity factors and rest curvature.
    pub fn rod_model(&self, filament: &RodModel) -> RodModel {
        let altered = self.altered_rod();
        let law = altered.and_then(|altered| altered.law.clone());
        let material = altered.and_then(|altered| altered.material);
        RodModel {
            force_law: filament.force_law,
            rotary_inertia: filament.rotary_inertia,
            law: law.unwrap_or_else(|| filament.law.clone()),
            material: material.unwrap_or(filament.material),
        }
    }

    /// Returns the altered parameters of monomers.
    pub(crate) fn altered(&self) -> Option<MonomerChanges> {
        match self {
            Self::Ellipsoids { altered, .. } => *altered,
            Self::Rod { .. } => None,
        }
    }

    /// Returns the monomers of the section.
    pub fn monomers(&self, filament: &Monomers) -> Monomers {
        match self.altered() {
            Some(altered) => altered.applied_to(filament),
            None => filament.clone(),
        }
    }

    /// Returns the rest curvature and twist (rad/nm, body axes) relative to the straight filament.
    pub fn rest_curvature(&self, filament: &Monomers) -> Vector3 {
        match self {
            Self::Rod { altered, .. } => {
                let altered = altered.as_deref();
                altered.map_or_else(Vector3::zeros, RodChanges::rest_curvature)
            }
            Self::Ellipsoids { .. } => {
                let turn_deg = self.monomers(filament).turn_deg - filament.turn_deg;
                Vector3::z() * (turn_deg.to_radians() / filament.rise_nm)
            }
        }
    }

    /// Returns the arc lengths (nm) of start and end, as written.
    pub fn span_nm(&self) -> (f64, f64) {
        match *self {
            Self::Ellipsoids { from_nm, to_nm, .. } | Self::Rod { from_nm, to_nm, .. } => {
                (from_nm, to_nm)
            }
        }
    }
}
