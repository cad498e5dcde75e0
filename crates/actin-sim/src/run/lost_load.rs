//! Detection of loads below the residual of an equilibrium.

use super::Record;
use crate::Assembly;
use crate::scene::{Resultant, SceneProblem};

/// Largest resolved ratio of residual to load.
const RESOLVED: f64 = 0.01;

/// Returns an error for the first load that is not large compared with the residual.
pub(super) fn lost_load(assembly: &Assembly, last: &Record) -> Option<SceneProblem> {
    let loads = assembly.scene.loads.iter().enumerate();
    loads.into_iter().find_map(|(i, load)| {
        let factor = last.state.controls[assembly.load_controls()[i]];
        let (size, residual, unit) = match load.resultant(&assembly.scene) {
            Resultant::Force(force) => (force.norm(), last.residual_force_pn, "pN"),
            Resultant::Couple(couple) => (couple.norm(), last.residual_torque_pn_nm, "pN nm"),
        };
        let size = size * factor.abs();
        let is_lost = size > 0.0 && residual > RESOLVED * size;
        is_lost.then(|| {
            let rule = format!(
                "is below 100 times the residual of {residual:.1e} {unit}, so the equilibrium does not \
                 resolve its effect; use a larger load"
            );
            load.problem(i, rule)
        })
    })
}
