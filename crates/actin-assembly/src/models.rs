//! Conversion of scene parameters to the models of the lower crates.

use crate::scene::{Hold, Monomers, SceneProblem};
use actin_cosserat::RodClamp;
use actin_ellipsoid::{
    EllipsoidModel, EllipsoidParameterError, EllipsoidParameters, InterfaceError, InterfaceKind,
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
    EllipsoidModel::new(parameters).map_err(|error| match &error {
        EllipsoidParameterError::NotATop { semi_axes, reason } => SceneProblem::new(
            "filament.monomers.semi_axes_nm",
            format!("{semi_axes:?}"),
            reason.to_string(),
        ),
        EllipsoidParameterError::OutOfRange { .. } => {
            SceneProblem::new("filament.monomers", "", error.to_string())
        }
    })
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
