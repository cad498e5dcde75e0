//! Conversion of scene parameters to the models of the lower crates.

use crate::scene::{self, End, Hold, Monomers, SceneProblem};
use actin_cosserat::{RodClamp, RodEnd, RotaryInertia};
use actin_ellipsoid::{
    EllipsoidKey, EllipsoidModel, EllipsoidParameterError, EllipsoidParameters, InterfaceError,
    InterfaceKey, InterfaceKind, InterfaceParameters,
};

impl From<scene::Anchors> for actin_ellipsoid::Anchors {
    fn from(anchors: scene::Anchors) -> Self {
        match anchors {
            scene::Anchors::Independent => Self::Independent,
            scene::Anchors::Identical => Self::Identical,
            scene::Anchors::Cubature => Self::Cubature,
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
            anchors: m.anchors.into(),
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
            anchors: match p.anchors {
                actin_ellipsoid::Anchors::Independent => scene::Anchors::Independent,
                actin_ellipsoid::Anchors::Identical => scene::Anchors::Identical,
                actin_ellipsoid::Anchors::Cubature => scene::Anchors::Cubature,
            },
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

/// Monomer model of filament `index`. Bonds of different filaments are sampled independently.
/// Errors name the keys of the scene.
pub(crate) fn ellipsoids(
    monomers: &Monomers,
    index: usize,
) -> Result<EllipsoidModel, SceneProblem> {
    let parameters = EllipsoidParameters {
        sampling: index as u64,
        ..monomers.into()
    };
    EllipsoidModel::new(parameters).map_err(|error| match error {
        EllipsoidParameterError::OutOfRange { key, value, rule } => {
            SceneProblem::new(scene_key(key), value, format!("must be {rule}"))
        }
        EllipsoidParameterError::NotATop { semi_axes, reason } => SceneProblem::new(
            scene_key(EllipsoidKey::SemiAxes),
            format!("{semi_axes:?}"),
            reason.to_string(),
        ),
    })
}

fn scene_key(parameter: EllipsoidKey) -> String {
    let key = match parameter {
        EllipsoidKey::Radius => "radius_nm",
        EllipsoidKey::Rise => "rise_nm",
        EllipsoidKey::Turn => "turn_deg",
        EllipsoidKey::Azimuth => "azimuth_deg",
        EllipsoidKey::SemiAxes => "semi_axes_nm",
        EllipsoidKey::Mass => "mass_ag",
        EllipsoidKey::Interface(InterfaceKind::Lateral, key) => match key {
            InterfaceKey::Rigidity => "lateral_rigidity_pn_per_nm",
            InterfaceKey::Bonds => "lateral_bonds",
            InterfaceKey::MinimumLength => "min_bond_nm",
            InterfaceKey::MaximumLength => "lateral_max_bond_nm",
        },
        EllipsoidKey::Interface(InterfaceKind::Longitudinal, key) => match key {
            InterfaceKey::Rigidity => "longitudinal_rigidity_pn_per_nm",
            InterfaceKey::Bonds => "longitudinal_bonds",
            InterfaceKey::MinimumLength => "min_bond_nm",
            InterfaceKey::MaximumLength => "longitudinal_max_bond_nm",
        },
    };
    format!("filament.monomers.{key}")
}

pub(super) fn unbonded(error: &InterfaceError, monomers: &Monomers) -> SceneProblem {
    let kind = match error {
        InterfaceError::NoBonds { kind, .. } | InterfaceError::FewBonds { kind, .. } => kind,
        InterfaceError::NoCubature { .. } => {
            let value = format!("{:?}", monomers.anchors);
            return SceneProblem::new("filament.monomers.anchors", value, error.to_string());
        }
    };
    let (key, value) = match kind {
        InterfaceKind::Lateral => ("lateral_max_bond_nm", monomers.lateral_max_bond_nm),
        InterfaceKind::Longitudinal => (
            "longitudinal_max_bond_nm",
            monomers.longitudinal_max_bond_nm,
        ),
    };
    SceneProblem::new(
        format!("filament.monomers.{key}"),
        format!("{value:?}"),
        error.to_string(),
    )
}

impl From<scene::JunctionWeight> for actin_coupling::JunctionWeight {
    fn from(weight: scene::JunctionWeight) -> Self {
        match weight {
            scene::JunctionWeight::Shared => Self::Shared,
            scene::JunctionWeight::Full => Self::Full,
        }
    }
}

pub(super) fn rod_clamp(hold: Hold) -> RodClamp {
    match hold {
        Hold::Wall => RodClamp::Wall,
        Hold::NodeAndFrame => RodClamp::NodeAndFrame,
        Hold::TwoNodesAndFrame => RodClamp::TwoNodesAndFrame,
        Hold::Pin => RodClamp::Pin,
    }
}

pub(super) fn rotary_inertia(of_scene: scene::RotaryInertia) -> RotaryInertia {
    match of_scene {
        scene::RotaryInertia::CrossSection => RotaryInertia::CrossSection,
        scene::RotaryInertia::RigidSegment => RotaryInertia::RigidSegment,
    }
}

pub(super) fn rod_end(end: End) -> RodEnd {
    match end {
        End::Start => RodEnd::Start,
        End::End => RodEnd::End,
    }
}
