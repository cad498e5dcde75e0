//! Bent cells that are free to shear, at given tension, with the turn free or held: what filaments under few loads
//! pass through. Bending shortens them, so that these states lie beyond the extensions of the grid.

use super::filament::{self, FREE, relax};
use super::rows::{self, Row};
use crate::Tell;
use actin_sim::ellipsoid::{Cell, CellResponse, Control, SixMatrix, SixVector};
use rayon::prelude::*;
use std::path::Path;

/// Curvatures (rad/nm) along a path.
pub(super) const CURVATURES: [f64; 11] = [
    1e-5, 3e-5, 1e-4, 3e-4, 6e-4, 1e-3, 1.7e-3, 2.5e-3, 4e-3, 7e-3, 0.01,
];
/// Tensions (pN).
const TENSIONS: [f64; 7] = [-15.0, -5.0, 0.0, 1.0, 5.0, 10.0, 40.0];
/// Twists that are held (rad/nm); beside them the turn is free.
const TWISTS: [f64; 11] = [
    -0.038, -0.021, -0.01, -5e-3, -2e-3, 0.0, 2e-3, 5e-3, 0.01, 0.021, 0.038,
];

/// All states that have an equilibrium, as rows; `natural` is the stretch of the free filament of each twist.
pub(super) fn compute(
    out: &Path,
    natural: impl Fn(f64) -> f64 + Sync,
    tell: Tell<'_>,
) -> Result<Vec<Row>, String> {
    let cell = filament::mean()?;
    let turns = TWISTS.map(Control::Strain).into_iter().chain([FREE]);
    let both = turns.flat_map(|turn| TENSIONS.map(|tension| (turn, tension)));
    let both: Vec<(Control, f64)> = both.collect();
    let path = |&(turn, tension): &(Control, f64)| path(&cell, turn, tension, &natural);
    let paths: Vec<Vec<Row>> = both.par_iter().map(path).collect();
    let all: Vec<Row> = paths.into_iter().flatten().collect();
    tell(format_args!(
        "paths: {} of {} states found",
        all.len(),
        both.len() * CURVATURES.len()
    ));
    rows::write(&out.join("paths.csv"), "free to shear", &all)?;
    Ok(all)
}

/// The states of one path, up to the first without an equilibrium.
fn path(cell: &Cell, turn: Control, tension: f64, natural: impl Fn(f64) -> f64) -> Vec<Row> {
    let mut rows = Vec::new();
    let mut last: Option<CellResponse> = match turn {
        Control::Strain(twist) => filament::twisted(cell, twist).ok(),
        Control::Load(_) => None,
    };
    for curvature in CURVATURES {
        let bend = [Control::Strain(curvature), Control::Strain(0.0)];
        let pull = Control::Load(tension);
        let controls = [bend[0], bend[1], turn, FREE, FREE, pull];
        let Ok(response) = relax(cell, controls, last.as_ref()) else {
            break;
        };
        rows.push(row(&response, &natural));
        last = Some(response);
    }
    rows
}

/// The state seen from axes of which the first is along the shear.
fn row(response: &CellResponse, natural: impl Fn(f64) -> f64) -> Row {
    let s = response.strain;
    let angle = s[4].atan2(s[3]);
    let turn = about_axis(angle);
    let [k1, k2, twist, shear, _, stretch]: [f64; 6] = (turn * s).into();
    Row {
        strain: [
            k1.hypot(k2),
            twist,
            shear,
            stretch,
            k2.atan2(k1).to_degrees(),
        ],
        extension: stretch - natural(twist),
        energy: response.energy,
        loads: turn * response.loads,
        tangent: turn * response.tangent * turn.transpose(),
    }
}

/// Strains and loads in axes that are turned by `angle` (rad) about the filament.
fn about_axis(angle: f64) -> SixMatrix {
    let (sin, cos) = angle.sin_cos();
    let mut turn = SixMatrix::from_diagonal(&SixVector::new(cos, cos, 1.0, cos, cos, 1.0));
    for k in [0, 3] {
        turn[(k, k + 1)] = sin;
        turn[(k + 1, k)] = -sin;
    }
    turn
}
