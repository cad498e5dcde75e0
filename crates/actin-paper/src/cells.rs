//! Periodic cells of monomers under prescribed strains and loads.

use actin_sim::ellipsoid::{
    Cell, CellResponse, Control, EllipsoidModel, EllipsoidParameters, Hold, SixVector,
};

/// Number of monomers in one period of the mean filament.
pub const PERIOD: usize = 13;
/// Sampled bonds per interface.
const SAMPLED_BONDS: usize = 64;

/// Cell of the mean filament, with the default quadrature bonds.
///
/// # Errors
/// The cell cannot be built.
pub fn mean() -> Result<Cell, String> {
    with_parameters(EllipsoidParameters::default(), PERIOD, Hold::Means)
}

/// Cell of a filament with 64 sampled bonds per interface.
///
/// # Errors
/// The cell cannot be built.
pub fn with_sampled_bonds(seed: u64, monomers: usize) -> Result<Cell, String> {
    with_parameters(
        EllipsoidParameters::with_sampled_bonds(SAMPLED_BONDS, seed),
        monomers,
        Hold::Means,
    )
}

/// Cell of `monomers` monomers with the given parameters.
///
/// # Errors
/// The parameters are invalid or the cell cannot be built.
pub fn with_parameters(
    parameters: EllipsoidParameters,
    monomers: usize,
    hold: Hold,
) -> Result<Cell, String> {
    let model = EllipsoidModel::new(parameters).map_err(|e| e.to_string())?;
    Cell::new(&model, monomers, hold).map_err(|e| e.to_string())
}

/// Zero force or torque.
pub const ZERO_LOAD: Control = Control::Load(0.0);
/// Zero strain.
pub const ZERO_STRAIN: Control = Control::Strain(0.0);

/// Equilibrium of a cell under strains and loads. The initial guess is `start`, by default the cell at rest.
///
/// # Errors
/// The iteration does not converge.
pub fn relax(
    cell: &Cell,
    controls: [Control; 6],
    start: Option<&CellResponse>,
) -> Result<CellResponse, String> {
    cell.relax_under(&controls, start)
        .map_err(|e| e.to_string())
}

/// Largest increment of twist (rad/nm).
const TWIST_STEP: f64 = 5e-3;

/// Equilibrium of the straight, otherwise free filament under `twist` (rad/nm), reached in increments.
///
/// # Errors
/// The iteration does not converge.
pub fn twisted(cell: &Cell, twist: f64) -> Result<CellResponse, String> {
    let controls = |twist: f64| {
        [
            ZERO_STRAIN,
            ZERO_STRAIN,
            Control::Strain(twist),
            ZERO_LOAD,
            ZERO_LOAD,
            ZERO_LOAD,
        ]
    };
    let mut reached = twist.abs().min(TWIST_STEP);
    let mut response = relax(cell, controls(reached.copysign(twist)), None)?;
    while reached < twist.abs() {
        reached = twist.abs().min(reached + TWIST_STEP);
        response = relax(cell, controls(reached.copysign(twist)), Some(&response))?;
    }
    Ok(response)
}

/// Strain vector of curvature and twist (rad/nm), shear and stretch. The curvature axis is at `angle` (rad) from the
/// shear direction.
pub fn strain([curvature, twist, shear, stretch, angle]: [f64; 5]) -> SixVector {
    let (sin, cos) = angle.sin_cos();
    SixVector::new(curvature * cos, curvature * sin, twist, shear, 0.0, stretch)
}

/// Approximate relative shortening due to curvature `kappa` (rad/nm) and shear `gamma` at constant twist and zero
/// tension.
///
/// The exact coefficients of `kappa^2` and `gamma^2` range from 45 and 3 at rest to 15 and 2 at large twist.
pub fn shortening(curvature: f64, shear: f64) -> f64 {
    25.0 * curvature * curvature + 2.0 * shear * shear
}
