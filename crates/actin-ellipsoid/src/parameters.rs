//! Parameters of the ellipsoid model.

use crate::{InterfaceKind, constants};
use actin_mechanics::InertiaError;
use thiserror::Error;

/// Minimum number of quadrature points: one more than the relative motions an interface resists at
/// rest.
pub const MIN_POINTS: usize = 4;
/// Maximum number of quadrature points; fewer match all moments.
pub const MAX_POINTS: usize = 64;

/// Parameters of the ellipsoid model. The default is Table 1 and Table 4 of the paper with
/// quadrature bonds and the choices documented in [`constants`]. [`Self::with_sampled_bonds`] has sampled bonds.
///
/// ```
/// let parameters = actin_ellipsoid::EllipsoidParameters::default();
/// assert!((parameters.rise - 2.7385).abs() < 1e-4);
/// assert!((parameters.turn.to_degrees() + 166.154).abs() < 1e-3);
/// assert!((parameters.lateral.rigidity - 2258.0).abs() < 1.0);
/// assert!((parameters.longitudinal.rigidity - 3354.0).abs() < 1.0);
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct EllipsoidParameters {
    /// Distance of the monomer centres from the axis (nm).
    pub radius: f64,
    /// Rise per monomer (nm).
    pub rise: f64,
    /// Turn about the axis per monomer (rad), positive if right-handed.
    pub turn: f64,
    /// Azimuth of lattice index 0 (rad).
    pub azimuth: f64,
    /// Semi-axes along the radial, tangential and axial direction (nm). Two must be equal.
    pub semi_axes: [f64; 3],
    /// Interface between monomers `i` and `i + 1`.
    pub lateral: InterfaceParameters,
    /// Interface between monomers `i` and `i + 2`.
    pub longitudinal: InterfaceParameters,
    /// Choice of bonds.
    pub anchors: Anchors,
    /// Seed of sampled bonds.
    pub seed: u64,
    /// Number of the independent sampling of this seed, one per filament of a scene.
    pub sampling: u64,
    /// Mass of a monomer (pN ns^2/nm = 1e-21 kg).
    pub mass: f64,
}

/// Parameters of one kind of interface.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct InterfaceParameters {
    /// Rigidity (pN/nm), divided equally among sampled bonds and by weight among quadrature bonds.
    pub rigidity: f64,
    /// Number of bonds.
    pub bonds: usize,
    /// Minimum bond length (nm); 0 for no bound.
    pub minimum_length: f64,
    /// Maximum bond length (nm).
    pub maximum_length: f64,
}

/// Choice of the bonds of an interface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Anchors {
    /// Different random bonds in each interface.
    Independent,
    /// The same random bonds in all interfaces of a kind.
    Identical,
    /// The same quadrature bonds in all interfaces of a kind, which represent the distribution of random bonds: the
    /// mean filament.
    #[default]
    Cubature,
}

impl Anchors {
    /// Returns `true` if all interfaces of a kind have the same bonds.
    pub(crate) fn are_shared(self) -> bool {
        match self {
            Self::Independent => false,
            Self::Identical | Self::Cubature => true,
        }
    }
}

/// Error of the validation of parameters.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum EllipsoidParameterError {
    /// A parameter violates its rule.
    #[error("{key} = {value}: must be {rule}")]
    OutOfRange {
        /// Name of the parameter.
        key: String,
        /// Value of the parameter.
        value: f64,
        /// Rule of the parameter.
        rule: &'static str,
    },
    /// The ellipsoid is not a symmetric top.
    #[error("semi_axes = {semi_axes:?}: {reason}")]
    NotATop {
        /// Semi-axes (nm).
        semi_axes: [f64; 3],
        /// Error of the moments of inertia.
        reason: InertiaError,
    },
}

impl Default for EllipsoidParameters {
    fn default() -> Self {
        Self {
            radius: constants::RADIUS,
            rise: constants::RISE,
            turn: constants::TURN,
            azimuth: 0.0,
            semi_axes: constants::SEMI_AXES,
            lateral: InterfaceParameters {
                rigidity: constants::LATERAL_RIGIDITY,
                bonds: constants::POINTS_PER_INTERFACE,
                minimum_length: constants::MINIMUM_LENGTH,
                maximum_length: constants::LATERAL_MAXIMUM_LENGTH,
            },
            longitudinal: InterfaceParameters {
                rigidity: constants::LONGITUDINAL_RIGIDITY,
                bonds: constants::POINTS_PER_INTERFACE,
                minimum_length: constants::MINIMUM_LENGTH,
                maximum_length: constants::LONGITUDINAL_MAXIMUM_LENGTH,
            },
            anchors: Anchors::default(),
            seed: 0,
            sampling: 0,
            mass: constants::MASS,
        }
    }
}

impl EllipsoidParameters {
    /// Parameters of a kind of interface.
    pub(crate) fn interface(&self, kind: InterfaceKind) -> &InterfaceParameters {
        match kind {
            InterfaceKind::Lateral => &self.lateral,
            InterfaceKind::Longitudinal => &self.longitudinal,
        }
    }

    /// Default parameters with the given number of sampled bonds per interface, as in the paper.
    pub fn with_sampled_bonds(bonds: usize, seed: u64) -> Self {
        let mut parameters = Self {
            anchors: Anchors::Independent,
            seed,
            ..Self::default()
        };
        parameters.lateral.bonds = bonds;
        parameters.longitudinal.bonds = bonds;
        parameters
    }

    /// Validates all parameters; called by [`crate::EllipsoidModel::new`].
    ///
    /// # Errors
    /// The first parameter that violates its rule, or three different semi-axes.
    pub(crate) fn validate(&self) -> Result<(), EllipsoidParameterError> {
        if !(self.radius.is_finite() && self.radius >= 0.0) {
            return Err(out_of_range(
                "radius",
                self.radius,
                "finite and not negative",
            ));
        }
        finite("turn", self.turn)?;
        finite("azimuth", self.azimuth)?;
        positive("rise", self.rise)?;
        positive("mass", self.mass)?;
        for semi_axis in self.semi_axes {
            positive("semi_axes", semi_axis)?;
        }
        self.lateral.validate(InterfaceKind::Lateral)?;
        self.longitudinal.validate(InterfaceKind::Longitudinal)?;
        if self.anchors == Anchors::Cubature {
            for (kind, interface) in [
                (InterfaceKind::Lateral, &self.lateral),
                (InterfaceKind::Longitudinal, &self.longitudinal),
            ] {
                let key = kind.key("bonds");
                if !(MIN_POINTS..=MAX_POINTS).contains(&interface.bonds) {
                    let rule = "4 to 64 for quadrature bonds";
                    return Err(out_of_range(&key, interface.bonds as f64, rule));
                }
            }
        }
        Ok(())
    }
}

impl InterfaceParameters {
    fn validate(&self, kind: InterfaceKind) -> Result<(), EllipsoidParameterError> {
        positive(&kind.key("rigidity"), self.rigidity)?;
        positive(&kind.key("maximum_length"), self.maximum_length)?;
        if !(self.minimum_length >= 0.0 && self.minimum_length < self.maximum_length) {
            let rule = "at least 0 and less than the longest bond";
            return Err(out_of_range(
                &kind.key("minimum_length"),
                self.minimum_length,
                rule,
            ));
        }
        if self.bonds == 0 {
            return Err(out_of_range(&kind.key("bonds"), 0.0, "at least 1"));
        }
        Ok(())
    }
}

fn out_of_range(key: &str, value: f64, rule: &'static str) -> EllipsoidParameterError {
    let key = key.to_owned();
    EllipsoidParameterError::OutOfRange { key, value, rule }
}

fn positive(key: &str, value: f64) -> Result<(), EllipsoidParameterError> {
    if value.is_finite() && value > 0.0 {
        Ok(())
    } else {
        Err(out_of_range(key, value, "positive and finite"))
    }
}

fn finite(key: &str, value: f64) -> Result<(), EllipsoidParameterError> {
    if value.is_finite() {
        Ok(())
    } else {
        Err(out_of_range(key, value, "finite"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::EllipsoidModel;

    type Setter = fn(&mut EllipsoidParameters, f64);

    fn refused(set: Setter, value: f64) -> Option<String> {
        let mut parameters = EllipsoidParameters::default();
        set(&mut parameters, value);
        match EllipsoidModel::new(parameters) {
            Err(EllipsoidParameterError::OutOfRange { key, value: v, .. }) => {
                assert_eq!(v.to_bits(), value.to_bits());
                Some(key)
            }
            _ => None,
        }
    }

    #[test]
    fn numbers_that_break_their_rule_are_refused_by_name() {
        let positive: [(&str, Setter); 9] = [
            ("rise", |p, v| p.rise = v),
            ("mass", |p, v| p.mass = v),
            ("semi_axes", |p, v| p.semi_axes[0] = v),
            ("semi_axes", |p, v| p.semi_axes[1] = v),
            ("semi_axes", |p, v| p.semi_axes[2] = v),
            ("lateral.rigidity", |p, v| p.lateral.rigidity = v),
            ("lateral.maximum_length", |p, v| {
                p.lateral.maximum_length = v;
            }),
            ("longitudinal.rigidity", |p, v| p.longitudinal.rigidity = v),
            ("longitudinal.maximum_length", |p, v| {
                p.longitudinal.maximum_length = v;
            }),
        ];
        for (key, set) in positive {
            for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
                assert_eq!(refused(set, bad), Some(key.to_owned()), "{key} = {bad}");
            }
        }
        let finite: [(&str, Setter); 2] = [
            ("turn", |p, v| p.turn = v),
            ("azimuth", |p, v| p.azimuth = v),
        ];
        for (key, set) in finite {
            assert_eq!(refused(set, f64::NAN), Some(key.to_owned()));
            assert_eq!(refused(set, -1.0), None);
        }
        assert_eq!(
            refused(|p, v| p.radius = v, -0.1),
            Some("radius".to_owned())
        );
        assert_eq!(refused(|p, v| p.radius = v, 0.0), None);
    }

    #[test]
    fn an_interface_needs_a_bond() {
        for (key, set) in [
            ("lateral.bonds", (|p, _| p.lateral.bonds = 0) as Setter),
            ("longitudinal.bonds", |p, _| p.longitudinal.bonds = 0),
        ] {
            assert_eq!(refused(set, 0.0), Some(key.to_owned()));
        }
    }

    #[test]
    fn the_shortest_bond_is_shorter_than_the_longest() {
        for (key, set, most) in [
            (
                "lateral.minimum_length",
                (|p, v| p.lateral.minimum_length = v) as Setter,
                1.6,
            ),
            (
                "longitudinal.minimum_length",
                |p, v| p.longitudinal.minimum_length = v,
                2.2,
            ),
        ] {
            for bad in [-1e-9, most, f64::NAN, f64::INFINITY] {
                assert_eq!(refused(set, bad), Some(key.to_owned()), "{key} = {bad}");
            }
            for good in [0.0, 0.2, 0.999 * most] {
                assert_eq!(refused(set, good), None, "{key} = {good}");
            }
        }
    }

    #[test]
    fn quadrature_bonds_are_4_to_64() {
        let message = |anchors, bonds| {
            let mut parameters = EllipsoidParameters {
                anchors,
                ..EllipsoidParameters::default()
            };
            parameters.longitudinal.bonds = bonds;
            let refused = EllipsoidModel::new(parameters).err();
            refused.map_or_else(String::new, |error| error.to_string())
        };
        for good in [4, 12, 64] {
            assert_eq!(message(Anchors::Cubature, good), "");
        }
        for bad in [3, 65] {
            let refused = message(Anchors::Cubature, bad);
            let expected = format!("longitudinal.bonds = {bad}: must be 4 to 64");
            assert!(refused.starts_with(&expected), "{refused}");
            assert_eq!(message(Anchors::Independent, bad), "");
        }
    }

    #[test]
    fn messages_say_what_is_wrong() {
        let parameters = EllipsoidParameters {
            rise: -2.0,
            ..EllipsoidParameters::default()
        };
        let message = EllipsoidModel::new(parameters).unwrap_err().to_string();
        assert_eq!(message, "rise = -2: must be positive and finite");
    }

    #[test]
    fn three_different_semi_axes_are_refused() {
        let parameters = EllipsoidParameters {
            semi_axes: [1.9, 2.4, 2.7],
            ..EllipsoidParameters::default()
        };
        assert!(matches!(
            EllipsoidModel::new(parameters),
            Err(EllipsoidParameterError::NotATop { .. })
        ));
    }
}
