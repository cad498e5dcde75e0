//! Loads of a scene. Their validation is in `load_rules.rs`.

use super::{End, Factor, Scene};
use actin_mechanics::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Load on a filament. The path multiplies `factor` by its own load factor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum Load {
    /// Constant force on an end: on the last node of a rod, or half on each of the last two monomers. At a sliding
    /// end it acts on the inner held body. `Force` has more options.
    EndForce {
        /// Index of the filament.
        #[serde(default)]
        filament: usize,
        /// End of the filament; it must be free or slide.
        end: End,
        /// Force in the lab frame; finite. In `Equilibrium` the forces along unconstrained directions must balance.
        force_pn: [f64; 3],
    },
    /// Force at an end or at an arc length.
    Force(Force),
    /// Couple at an end or at an arc length.
    Couple(Couple),
    /// Force per length on an interval.
    ForcePerLength(ForcePerLength),
    /// Couple per length on an interval.
    CouplePerLength(CouplePerLength),
    /// Force proportional to mass, such as weight.
    Acceleration(Acceleration),
}

/// Force at one position of a filament.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Force {
    /// Index of the filament.
    #[serde(default)]
    pub filament: usize,
    /// End of the filament: the last node of a rod, or half on each of the last two monomers. It must be free or
    /// slide. Exactly one of `end` and `at_nm` is given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub end: Option<End>,
    /// Arc length, from 0 to the length of the filament. The force acts on the axis, shared by the two nodes of a
    /// segment, or on the nearest monomer.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_nm: Option<f64>,
    /// Force in the lab frame; finite. In `Equilibrium` the forces along unconstrained directions must balance.
    pub force_pn: [f64; 3],
    /// True if the force rotates with its segment or monomer, from the given direction as built. It has no
    /// potential: `Equilibrium` refuses it.
    #[serde(default)]
    pub follows: bool,
    /// Factor in time.
    #[serde(default)]
    pub factor: Factor,
}

/// Couple at one position of a filament.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Couple {
    /// Index of the filament.
    #[serde(default)]
    pub filament: usize,
    /// End of the filament: the cross-section at the last node of a rod, or half on each of the last two monomers.
    /// The cross-section is joined to the last segment by half a segment of bending, as at a wall. The end must be
    /// free or pinned. Exactly one of `end` and `at_nm` is given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub end: Option<End>,
    /// Arc length, from 0 to the length of the filament. The couple is shared by the two segments or monomers with
    /// the nearest midpoints, or by the last segment and the cross-section at the end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_nm: Option<f64>,
    /// Couple in the lab frame; finite. It has a potential: its magnitude times the twist about its axis. It is
    /// constant while the cross-section rotates about this axis. If the cross-section tilts by an angle, the
    /// couple tilts by half of it, with a constant component along the axis.
    pub couple_pn_nm: [f64; 3],
    /// True if the couple rotates with its segment or monomer, from the given axis as built. It has no
    /// potential: `Equilibrium` refuses it.
    #[serde(default)]
    pub follows: bool,
    /// Factor in time.
    #[serde(default)]
    pub factor: Factor,
}

/// Force per length of the filament at rest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ForcePerLength {
    /// Index of the filament.
    #[serde(default)]
    pub filament: usize,
    /// Arc length of the start; at least 0.
    #[serde(default)]
    pub from_nm: f64,
    /// Arc length of the end; greater than `from_nm`. By default the length of the filament.
    #[serde(default)]
    pub to_nm: Option<f64>,
    /// Force per length in the lab frame; finite.
    pub force_pn_per_nm: [f64; 3],
    /// True if the force rotates with its segments or monomers. `Equilibrium` refuses it.
    #[serde(default)]
    pub follows: bool,
    /// Factor in time.
    #[serde(default)]
    pub factor: Factor,
}

/// Couple per length of the filament at rest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CouplePerLength {
    /// Index of the filament.
    #[serde(default)]
    pub filament: usize,
    /// Arc length of the start; at least 0.
    #[serde(default)]
    pub from_nm: f64,
    /// Arc length of the end; greater than `from_nm`. By default the length of the filament.
    #[serde(default)]
    pub to_nm: Option<f64>,
    /// Couple per length in the lab frame; finite. It acts on each segment or monomer as described for `Couple`.
    pub couple_pn_nm_per_nm: [f64; 3],
    /// True if the couple rotates with its segments or monomers. `Equilibrium` refuses it.
    #[serde(default)]
    pub follows: bool,
    /// Factor in time.
    #[serde(default)]
    pub factor: Factor,
}

/// Force proportional to mass: weight, or the inertial force in an accelerated frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Acceleration {
    /// Index of the filament.
    #[serde(default)]
    pub filament: usize,
    /// Acceleration in the lab frame; finite. Gravity is 9.81e-9 nm/ns^2.
    pub acceleration_nm_per_ns2: [f64; 3],
    /// Factor in time.
    #[serde(default)]
    pub factor: Factor,
}

/// Resultant of a load on a filament at factor 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Resultant {
    /// A force (pN, lab frame).
    Force(Vector3),
    /// A couple (pN nm, lab frame).
    Couple(Vector3),
}

impl Load {
    /// Returns the index of the filament.
    pub fn filament(&self) -> usize {
        match self {
            Self::EndForce { filament, .. }
            | Self::Force(Force { filament, .. })
            | Self::Couple(Couple { filament, .. })
            | Self::ForcePerLength(ForcePerLength { filament, .. })
            | Self::CouplePerLength(CouplePerLength { filament, .. })
            | Self::Acceleration(Acceleration { filament, .. }) => *filament,
        }
    }

    /// Factor in time.
    pub fn factor(&self) -> &Factor {
        match self {
            Self::EndForce { .. } => &Factor::Constant,
            Self::Force(Force { factor, .. })
            | Self::Couple(Couple { factor, .. })
            | Self::ForcePerLength(ForcePerLength { factor, .. })
            | Self::CouplePerLength(CouplePerLength { factor, .. })
            | Self::Acceleration(Acceleration { factor, .. }) => factor,
        }
    }

    /// Returns whether the load rotates with the filament and so has no potential.
    pub fn follows(&self) -> bool {
        match self {
            Self::EndForce { .. } | Self::Acceleration(_) => false,
            Self::Force(Force { follows, .. })
            | Self::Couple(Couple { follows, .. })
            | Self::ForcePerLength(ForcePerLength { follows, .. })
            | Self::CouplePerLength(CouplePerLength { follows, .. }) => *follows,
        }
    }

    /// Returns the key and the value of the load as written.
    pub fn written(&self) -> (&'static str, [f64; 3]) {
        match self {
            Self::EndForce { force_pn, .. } | Self::Force(Force { force_pn, .. }) => {
                ("force_pn", *force_pn)
            }
            Self::Couple(Couple { couple_pn_nm, .. }) => ("couple_pn_nm", *couple_pn_nm),
            Self::ForcePerLength(load) => ("force_pn_per_nm", load.force_pn_per_nm),
            Self::CouplePerLength(load) => ("couple_pn_nm_per_nm", load.couple_pn_nm_per_nm),
            Self::Acceleration(load) => ("acceleration_nm_per_ns2", load.acceleration_nm_per_ns2),
        }
    }

    /// Multiplies the load by a factor.
    pub fn scale(&mut self, share: f64) {
        let size = match self {
            Self::EndForce { force_pn, .. } | Self::Force(Force { force_pn, .. }) => force_pn,
            Self::Couple(Couple { couple_pn_nm, .. }) => couple_pn_nm,
            Self::ForcePerLength(load) => &mut load.force_pn_per_nm,
            Self::CouplePerLength(load) => &mut load.couple_pn_nm_per_nm,
            Self::Acceleration(load) => &mut load.acceleration_nm_per_ns2,
        };
        *size = size.map(|x| share * x);
    }

    /// Returns the end on which the load acts, if any.
    pub(crate) fn end(&self) -> Option<End> {
        match self {
            Self::EndForce { end, .. } => Some(*end),
            Self::Force(Force { end, .. }) | Self::Couple(Couple { end, .. }) => *end,
            Self::ForcePerLength(_) | Self::CouplePerLength(_) | Self::Acceleration(_) => None,
        }
    }

    /// Returns the arc lengths (nm) of the interval on which the load acts, if any.
    pub fn interval(&self, scene: &Scene) -> Option<[f64; 2]> {
        let (from, to) = match self {
            Self::EndForce { .. } | Self::Force(_) | Self::Couple(_) => return None,
            Self::ForcePerLength(load) => (load.from_nm, load.to_nm),
            Self::CouplePerLength(load) => (load.from_nm, load.to_nm),
            Self::Acceleration(_) => (0.0, None),
        };
        let filament = scene.filament_at(self.filament());
        let length = filament.map_or(0.0, super::Filament::length_nm);
        Some([from, to.unwrap_or(length)])
    }

    /// Returns the ratio of the resultant to the load as written: a length (nm), a mass (ag), or 1.
    pub(crate) fn extent(&self, scene: &Scene) -> f64 {
        let length = self.interval(scene).map_or(1.0, |[from, to]| to - from);
        match self {
            Self::Acceleration(load) => {
                let filament = scene.filament_at(load.filament);
                let density = filament.map_or(0.0, |f| f.monomers.mass_ag / f.monomers.rise_nm);
                let sections = filament.into_iter().flat_map(|f| &f.sections);
                // Length equivalent to the additional mass of altered monomers.
                let excess = sections.filter_map(|section| {
                    let (from, to) = section.span_nm();
                    Some((section.altered()?.mass_factor - 1.0) * (to - from))
                });
                density * (length + excess.sum::<f64>())
            }
            _ => length,
        }
    }

    /// Returns the resultant at factor 1, with the filament as built.
    pub fn resultant(&self, scene: &Scene) -> Resultant {
        let whole = Vector3::from(self.written().1) * self.extent(scene);
        match self {
            Self::Couple(_) | Self::CouplePerLength(_) => Resultant::Couple(whole),
            _ => Resultant::Force(whole),
        }
    }
}
