//! Conversion of scene parameters to the models of the lower crates.

use crate::scene::{End, Hold, Monomers, SceneProblem};
use actin_cosserat::{RodClamp, RodEnd};
use actin_ellipsoid::{
    EllipsoidKey, EllipsoidModel, EllipsoidParameterError, EllipsoidParameters, InterfaceError,
    InterfaceKey, InterfaceKind,
};

/// The monomers' model of filament `index`, whose bonds are sampled independently of those of
/// other filaments; what it refuses is named by the scene's keys.
///
/// # Errors
/// If a parameter is invalid; names it.
pub fn ellipsoids(monomers: &Monomers, index: usize) -> Result<EllipsoidModel, SceneProblem> {
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

pub(super) fn rod_clamp(hold: Hold) -> RodClamp {
    match hold {
        Hold::Wall => RodClamp::Wall,
        Hold::NodeAndFrame => RodClamp::NodeAndFrame,
        Hold::TwoNodesAndFrame => RodClamp::TwoNodesAndFrame,
        Hold::Pin => RodClamp::Pin,
    }
}

pub(super) fn rod_end(end: End) -> RodEnd {
    match end {
        End::Start => RodEnd::Start,
        End::End => RodEnd::End,
    }
}
