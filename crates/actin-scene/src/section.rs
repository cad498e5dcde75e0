//! What a scene says of the stretches of a filament: how each is resolved, and in what it differs.

use super::RodLaw;
use super::model::{Material, Monomers, RodModel};
use actin_cosserat::RigidityFactors;
use actin_mechanics::Vector3;
use serde::{Deserialize, Serialize};

/// A stretch of filament resolved in one way.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub enum Section {
    /// Every monomer as a rigid ellipsoid. Boundaries move to the nearest place half a rise
    /// beyond a monomer.
    Ellipsoids {
        /// Arc length at which the section starts; at least 0.
        from_nm: f64,
        /// Arc length at which it ends; greater than `from_nm`, by two monomers or more.
        to_nm: f64,
        /// In what its monomers differ from those of the filament. Neighbouring sections of monomers
        /// differ from each other in this.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        altered: Option<Altered>,
    },
    /// A Cosserat rod.
    Rod {
        /// Arc length at which the section starts; at least 0.
        from_nm: f64,
        /// Arc length at which it ends; greater than `from_nm`.
        to_nm: f64,
        /// Number of segments, at least 1. By default the number that makes them most nearly 10 nm long.
        #[serde(default)]
        segments: Option<usize>,
        /// In what its rod differs from that of the filament. Neighbouring rods differ from each other in
        /// this; they share the cross-section at the boundary, where half a segment of either bends in series.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        altered: Option<Box<AlteredRod>>,
    },
}

/// In what the rod of a section differs from that of the filament.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct AlteredRod {
    /// Its constitutive law, instead of the filament's.
    pub law: Option<RodLaw>,
    /// Its rigidities, instead of the filament's; laws as for the filament.
    pub material: Option<Material>,
    /// Factor of the rigidity of bending; positive. The laws `Homogenised` take no factors.
    pub bend_rigidity_factor: f64,
    /// Factor of the rigidity of twist; positive.
    pub twist_rigidity_factor: f64,
    /// Factor of the rigidity of stretch; positive.
    pub stretch_rigidity_factor: f64,
    /// Factor of the rigidity of shear; positive.
    pub shear_rigidity_factor: f64,
    /// Curvature at rest about the two axes across, d1 and d2 (of a filament along lab z, x and y); finite,
    /// its radius greater than that of the filament, 3.5 nm.
    pub rest_curvature_per_nm: [f64; 2],
    /// Twist at rest; finite. Together with the curvature it makes a helix.
    pub rest_twist_per_nm: f64,
}

impl Default for AlteredRod {
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

impl AlteredRod {
    /// The factors of its rigidities.
    pub fn factors(&self) -> RigidityFactors {
        RigidityFactors {
            shear: self.shear_rigidity_factor,
            stretch: self.stretch_rigidity_factor,
            bend: self.bend_rigidity_factor,
            twist: self.twist_rigidity_factor,
        }
    }

    /// Curvature and twist at rest (rad/nm, body axes).
    pub fn rest_curvature(&self) -> Vector3 {
        let [x, y] = self.rest_curvature_per_nm;
        Vector3::new(x, y, self.rest_twist_per_nm)
    }
}

/// In what the monomers of a section differ from those of the filament, for example where they are
/// decorated by another protein.
///
/// An interface belongs to the section of its lower monomer. Bending and twist come from the same bonds: with
/// both factors of rigidity the same, every rigidity of the filament is multiplied by it. Softer lateral bonds
/// take more from twist than from bending, and the more the larger the twist: with 0.03 (lateral) and 0.23
/// bending is 5 times softer, twist 5 times at little of it, and at 0.01 rad/nm 7 times in over-twist and 13
/// times in under-twist: about cofilin's 5 and 10.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct Altered {
    /// Factor of the rigidity of lateral interfaces; positive.
    pub lateral_rigidity_factor: f64,
    /// Factor of the rigidity of longitudinal interfaces; positive.
    pub longitudinal_rigidity_factor: f64,
    /// Bonds per lateral interface, instead of those of the filament.
    pub lateral_bonds: Option<usize>,
    /// Bonds per longitudinal interface, instead of those of the filament.
    pub longitudinal_bonds: Option<usize>,
    /// Factor of the mass of a monomer, and so of its moments of inertia; positive.
    pub mass_factor: f64,
}

impl Default for Altered {
    fn default() -> Self {
        Self {
            lateral_rigidity_factor: 1.0,
            longitudinal_rigidity_factor: 1.0,
            lateral_bonds: None,
            longitudinal_bonds: None,
            mass_factor: 1.0,
        }
    }
}

impl Altered {
    /// Monomers of a filament, altered.
    pub fn applied_to(&self, monomers: &Monomers) -> Monomers {
        let mut altered = monomers.clone();
        altered.lateral_rigidity_pn_per_nm *= self.lateral_rigidity_factor;
        altered.longitudinal_rigidity_pn_per_nm *= self.longitudinal_rigidity_factor;
        altered.lateral_bonds = self.lateral_bonds.unwrap_or(altered.lateral_bonds);
        altered.longitudinal_bonds = self
            .longitudinal_bonds
            .unwrap_or(altered.longitudinal_bonds);
        altered.mass_ag *= self.mass_factor;
        altered
    }
}

impl Section {
    /// A rod that differs in nothing from that of its filament.
    pub fn rod(from_nm: f64, to_nm: f64, segments: Option<usize>) -> Self {
        Self::Rod {
            from_nm,
            to_nm,
            segments,
            altered: None,
        }
    }

    /// Whether it is a rod.
    pub fn is_rod(&self) -> bool {
        matches!(self, Self::Rod { .. })
    }

    /// In what its rod differs from that of its filament; nothing of monomers.
    pub fn altered_rod(&self) -> Option<&AlteredRod> {
        match self {
            Self::Rod { altered, .. } => altered.as_deref(),
            Self::Ellipsoids { .. } => None,
        }
    }

    /// The same, to be changed.
    pub fn altered_rod_mut(&mut self) -> Option<&mut AlteredRod> {
        match self {
            Self::Rod { altered, .. } => altered.as_deref_mut(),
            Self::Ellipsoids { .. } => None,
        }
    }

    /// Whether it differs from its filament.
    pub fn is_altered(&self) -> bool {
        self.altered().is_some() || self.altered_rod().is_some()
    }

    /// The rod of a section of a filament of this rod, but for factors and what it is like at rest.
    pub fn rod_model(&self, of_filament: &RodModel) -> RodModel {
        let altered = self.altered_rod();
        let law = altered.and_then(|altered| altered.law.clone());
        let material = altered.and_then(|altered| altered.material);
        RodModel {
            force_law: of_filament.force_law,
            rotary_inertia: of_filament.rotary_inertia,
            law: law.unwrap_or_else(|| of_filament.law.clone()),
            material: material.unwrap_or(of_filament.material),
        }
    }

    /// In what its monomers differ from those of its filament; nothing of a rod.
    pub fn altered(&self) -> Option<Altered> {
        match self {
            Self::Ellipsoids { altered, .. } => *altered,
            Self::Rod { .. } => None,
        }
    }

    /// The monomers of a section of a filament of these monomers.
    pub fn monomers(&self, of_filament: &Monomers) -> Monomers {
        match self.altered() {
            Some(altered) => altered.applied_to(of_filament),
            None => of_filament.clone(),
        }
    }

    /// Arc lengths of start and end as written (nm).
    pub fn span_nm(&self) -> (f64, f64) {
        match *self {
            Self::Ellipsoids { from_nm, to_nm, .. } | Self::Rod { from_nm, to_nm, .. } => {
                (from_nm, to_nm)
            }
        }
    }
}
