//! Loads as a scene writes them, and what all of them have in common. Their rules are in
//! `load_rules.rs`, the interactions that they are in `assembly/build/loads.rs`.
//!
//! A load of a new kind is a variant here; other files ask these functions.

use super::{End, Factor, Scene};
use actin_mechanics::Vector3;
use serde::{Deserialize, Serialize};

/// A load on a filament. Every load has a factor: that of time, `factor`, times what the path sets, 1
/// where it sets none.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub enum Load {
    /// A constant force on a free end: on the last node of a rod, or half on each of the last two
    /// monomers. On an end that slides it acts on the inner held body. `Force` says more.
    EndForce {
        /// Index of the filament.
        #[serde(default)]
        filament: usize,
        /// Which end. It must be free or slide.
        end: End,
        /// Force in the lab frame; finite. In `Equilibrium` forces along unconstrained directions must
        /// balance.
        force_pn: [f64; 3],
    },
    /// A force at an end or at any arc length.
    Force(Force),
    /// A couple at an end or at any arc length.
    Couple(Couple),
    /// A force per length on an interval.
    ForcePerLength(ForcePerLength),
    /// A couple per length on an interval.
    CouplePerLength(CouplePerLength),
    /// A force on every mass, such as weight.
    Acceleration(Acceleration),
}

/// A force at one place of a filament.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Force {
    /// Index of the filament.
    #[serde(default)]
    pub filament: usize,
    /// Which end: the last node of a rod, or half on each of the last two monomers. It must be free or
    /// slide. Exactly one of `end` and `at_nm` is given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub end: Option<End>,
    /// Arc length, from 0 to the length of the filament: on the axis, between the two nodes of a segment or
    /// on the nearest monomer.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_nm: Option<f64>,
    /// Force in the lab frame; finite. In `Equilibrium` forces along unconstrained directions must
    /// balance.
    pub force_pn: [f64; 3],
    /// Whether it turns with the segment or monomer that it acts on, from the direction given for the
    /// filament as built. Such a force has no potential: `Equilibrium` refuses it.
    #[serde(default)]
    pub follows: bool,
    /// Its factor in time.
    #[serde(default)]
    pub factor: Factor,
}

/// A couple at one place of a filament.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Couple {
    /// Index of the filament.
    #[serde(default)]
    pub filament: usize,
    /// Which end: the cross-section at the last node of a rod, which half a segment of bending joins to the last
    /// segment as at a wall, or half on each of the last two monomers. It must be free or pinned. Exactly one of
    /// `end` and `at_nm` is given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub end: Option<End>,
    /// Arc length, from 0 to the length of the filament: shared between the two segments or monomers
    /// whose middles are next to it, or between the last segment and the cross-section at the end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_nm: Option<f64>,
    /// Couple in the lab frame; finite. Its work is its size times the twist about its axis, so it has a
    /// potential. It is constant as long as the cross-section turns about this axis alone; where that is
    /// swung away by an angle, the couple tilts half as far, and its component along the axis stays.
    pub couple_pn_nm: [f64; 3],
    /// Whether it turns with the segment or monomer that it acts on, from the axis given for the filament
    /// as built. Such a couple has no potential: `Equilibrium` refuses it.
    #[serde(default)]
    pub follows: bool,
    /// Its factor in time.
    #[serde(default)]
    pub factor: Factor,
}

/// A force per length of the filament at rest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct ForcePerLength {
    /// Index of the filament.
    #[serde(default)]
    pub filament: usize,
    /// Arc length at which it begins; at least 0, by default 0.
    #[serde(default)]
    pub from_nm: f64,
    /// Arc length at which it ends; greater than `from_nm`, at most the length of the filament. By default
    /// its end.
    #[serde(default)]
    pub to_nm: Option<f64>,
    /// Force per length in the lab frame; finite.
    pub force_pn_per_nm: [f64; 3],
    /// Whether it turns with the segments or monomers that it acts on. Such a force has no potential:
    /// `Equilibrium` refuses it.
    #[serde(default)]
    pub follows: bool,
    /// Its factor in time.
    #[serde(default)]
    pub factor: Factor,
}

/// A couple per length of the filament at rest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct CouplePerLength {
    /// Index of the filament.
    #[serde(default)]
    pub filament: usize,
    /// Arc length at which it begins; at least 0, by default 0.
    #[serde(default)]
    pub from_nm: f64,
    /// Arc length at which it ends; greater than `from_nm`, at most the length of the filament. By default
    /// its end.
    #[serde(default)]
    pub to_nm: Option<f64>,
    /// Couple per length in the lab frame; finite. Each segment or monomer takes its part as under
    /// `Couple`.
    pub couple_pn_nm_per_nm: [f64; 3],
    /// Whether it turns with the segments or monomers that it acts on. Such a couple has no potential:
    /// `Equilibrium` refuses it.
    #[serde(default)]
    pub follows: bool,
    /// Its factor in time.
    #[serde(default)]
    pub factor: Factor,
}

/// A force on each mass in proportion to it: weight, or what a filament feels in an accelerated frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Acceleration {
    /// Index of the filament.
    #[serde(default)]
    pub filament: usize,
    /// Acceleration in the lab frame; finite. That of gravity is 9.81e-9 nm/ns^2.
    pub acceleration_nm_per_ns2: [f64; 3],
    /// Its factor in time.
    #[serde(default)]
    pub factor: Factor,
}

/// What a load puts on a filament as a whole, at factor 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Resultant {
    /// A force (pN, lab frame).
    Force(Vector3),
    /// A couple (pN nm, lab frame).
    Couple(Vector3),
}

impl Load {
    /// The filament that it acts on.
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

    /// Its factor in time.
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

    /// Whether it turns with what it acts on, and so has no potential.
    pub fn follows(&self) -> bool {
        match self {
            Self::EndForce { .. } | Self::Acceleration(_) => false,
            Self::Force(Force { follows, .. })
            | Self::Couple(Couple { follows, .. })
            | Self::ForcePerLength(ForcePerLength { follows, .. })
            | Self::CouplePerLength(CouplePerLength { follows, .. }) => *follows,
        }
    }

    /// The key of its size, and the size as written.
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

    /// Multiplies its size.
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

    /// The end that it acts on, if it acts on one.
    pub fn end(&self) -> Option<End> {
        match self {
            Self::EndForce { end, .. } => Some(*end),
            Self::Force(Force { end, .. }) | Self::Couple(Couple { end, .. }) => *end,
            Self::ForcePerLength(_) | Self::CouplePerLength(_) | Self::Acceleration(_) => None,
        }
    }

    /// The arc lengths between which it acts (nm), if it acts on an interval.
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

    /// By what its size as written is multiplied in its resultant: a length (nm), a mass (ag), or 1.
    pub fn extent(&self, scene: &Scene) -> f64 {
        let length = self.interval(scene).map_or(1.0, |[from, to]| to - from);
        match self {
            Self::Acceleration(load) => {
                let filament = scene.filament_at(load.filament);
                let density = filament.map_or(0.0, |f| f.monomers.mass_ag / f.monomers.rise_nm);
                let sections = filament.into_iter().flat_map(|f| &f.sections);
                // Lengths by which the masses of altered monomers exceed those of the others.
                let excess = sections.filter_map(|section| {
                    let (from, to) = section.span_nm();
                    Some((section.altered()?.mass_factor - 1.0) * (to - from))
                });
                density * (length + excess.sum::<f64>())
            }
            _ => length,
        }
    }

    /// Its resultant at factor 1; of one that follows as if the filament were as built.
    pub fn resultant(&self, scene: &Scene) -> Resultant {
        let whole = Vector3::from(self.written().1) * self.extent(scene);
        match self {
            Self::Couple(_) | Self::CouplePerLength(_) => Resultant::Couple(whole),
            _ => Resultant::Force(whole),
        }
    }
}
