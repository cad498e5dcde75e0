//! Unknowns of an equilibrium, their order, and the tolerances.

use crate::Assembly;
use crate::scene::{Equilibrium as Settings, SceneProblem};
use actin_assembly::problem_at;
use actin_coupling::{Linker, LinkerEnd};
use actin_equilibrium::{BodyOrder, Layout, Newton, NewtonOptions, Residual};

/// Offset between the arc lengths of successive filaments (nm), larger than any rise or segment
/// beyond an end.
const BETWEEN_FILAMENTS_NM: f64 = 1e3;

/// Largest displacement per step over the radius of repelling filaments. Two filaments then
/// approach by at most one radius and cannot pass through each other.
const DISPLACEMENT: f64 = 0.5;

/// Creates the Newton solver of an assembly, with unknowns ordered by filament and arc length.
///
/// With linkers, unknowns are eliminated in an order with less fill-in if one exists, and joined
/// bodies may rotate freely about each other. The same holds for repelling bodies. Their order is
/// determined in the state as built, and steps are limited by the thickness of the filaments.
///
/// # Errors
/// If the solver refuses tolerances or bodies.
pub fn newton(assembly: &Assembly, settings: &Settings) -> Result<Newton, SceneProblem> {
    let layout = layout(assembly)?;
    let options = NewtonOptions {
        tolerance: Residual {
            force: settings.force_pn,
            torque: settings.torque_pn_nm,
        },
        iterations: settings.iterations,
        ..NewtonOptions::default()
    };
    match &assembly.repelled {
        None => Newton::new(layout, options).map_err(problem_at("task")),
        Some(repelled) => {
            let options = NewtonOptions {
                largest_displacement: DISPLACEMENT * repelled.radius_nm,
                ..options
            };
            let mut newton = Newton::new(layout, options).map_err(problem_at("task"))?;
            newton.determine_order(&assembly.rest, assembly.system.interactions());
            Ok(newton)
        }
    }
}

pub(crate) fn layout(assembly: &Assembly) -> Result<Layout, SceneProblem> {
    let layout =
        Layout::new(&assembly.rest, Some(&order(assembly))).map_err(problem_at("filament"))?;
    let is_between_sites = |linker: &Linker| matches!(linker.end(), LinkerEnd::Site(_));
    let has_links = assembly.repelled.is_some() || assembly.linkers.iter().any(is_between_sites);
    Ok(if has_links {
        layout.with_links()
    } else {
        layout
    })
}

pub(crate) fn order(assembly: &Assembly) -> BodyOrder {
    let mut order = BodyOrder::default();
    let mut behind = 0.0;
    for filament in &assembly.filaments {
        let points = assembly.points[filament.points.clone()].iter();
        let frames = assembly.frames[filament.frames.clone()].iter();
        let first = order.points.len();
        order.points.extend(points.map(|p| behind + p.s_nm));
        order.frames.extend(frames.map(|f| behind + f.s_nm));
        let furthest = order.points[first..].iter().copied().fold(behind, f64::max);
        // Held monomers of the next filament lie one rise before its arc length 0.
        behind = furthest + BETWEEN_FILAMENTS_NM;
    }
    order
}
