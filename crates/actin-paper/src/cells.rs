//! Periodic cells of monomers, and their states under given strains and loads.

use actin_sim::ellipsoid::{
    Cell, CellResponse, Control, EllipsoidModel, EllipsoidParameters, Hold, SixVector,
};

/// Monomers of a cell of the mean filament: one period of its mean structure.
pub const PERIOD: usize = 13;
/// Drawn bonds per interface.
const DRAWN: usize = 64;

/// The cell of the mean filament, whose interfaces all have the default weighted bonds.
///
/// # Errors
/// Parameters without a cell.
pub fn mean() -> Result<Cell, String> {
    of(EllipsoidParameters::default(), PERIOD, Hold::Means)
}

/// The cell of a filament whose bonds are all drawn afresh.
///
/// # Errors
/// Parameters without a cell.
pub fn drawn(seed: u64, monomers: usize) -> Result<Cell, String> {
    of(
        EllipsoidParameters::drawn(DRAWN, seed),
        monomers,
        Hold::Means,
    )
}

/// A cell of any parameters.
///
/// # Errors
/// Parameters without a cell.
pub fn of(parameters: EllipsoidParameters, monomers: usize, hold: Hold) -> Result<Cell, String> {
    let model = EllipsoidModel::new(parameters).map_err(|e| e.to_string())?;
    Cell::new(&model, monomers, hold).map_err(|e| e.to_string())
}

/// A force or couple of zero.
pub const FREE: Control = Control::Load(0.0);
/// A strain of zero.
pub const NONE: Control = Control::Strain(0.0);

/// The response under some strains and loads, from `start`, by default from rest.
///
/// # Errors
/// A cell without an equilibrium.
pub fn relax(
    cell: &Cell,
    controls: [Control; 6],
    start: Option<&CellResponse>,
) -> Result<CellResponse, String> {
    cell.relax_under(&controls, start)
        .map_err(|e| e.to_string())
}

/// Steps in which twist is brought up (rad/nm).
const TWIST_STEP: f64 = 5e-3;

/// The straight filament of this twist (rad/nm) that is otherwise free.
///
/// # Errors
/// A cell without an equilibrium.
pub fn twisted(cell: &Cell, twist: f64) -> Result<CellResponse, String> {
    let controls = |twist: f64| [NONE, NONE, Control::Strain(twist), FREE, FREE, FREE];
    let mut reached = twist.abs().min(TWIST_STEP);
    let mut response = relax(cell, controls(reached.copysign(twist)), None)?;
    while reached < twist.abs() {
        reached = twist.abs().min(reached + TWIST_STEP);
        response = relax(cell, controls(reached.copysign(twist)), Some(&response))?;
    }
    Ok(response)
}

/// The strain of this curvature, at `angle` (rad) from the direction of shear, twist, shear and stretch.
pub fn strain([curvature, twist, shear, stretch, angle]: [f64; 5]) -> SixVector {
    let (sin, cos) = angle.sin_cos();
    SixVector::new(curvature * cos, curvature * sin, twist, shear, 0.0, stretch)
}

/// About how much shorter than the straight filament of the same twist one is that is bent (rad/nm) and sheared, without
/// tension: from 45 `kappa^2` + 3 `gamma^2` at rest to 15 and 2 at large twist.
pub fn shortening(curvature: f64, shear: f64) -> f64 {
    25.0 * curvature * curvature + 2.0 * shear * shear
}
