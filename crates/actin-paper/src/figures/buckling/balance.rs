//! The balance of forces and torques as the paper prints it. It has no energy, so that no descent
//! finds its equilibria: damped motion does, from the equilibrium of the law that has one.

use super::case::Case;
use super::dynamics::{STOP, dynamics};
use super::group::{Group, Rods};
use super::outcome::{Evidence, Outcome, measure};
use crate::run::run_to_end;
use actin_draw::report::Row;
use actin_sim::{Assembly, DragRates, Task};
use actin_view::Pose;

/// Longest time (ns).
const LONGEST_NS: f64 = 1000.0;
/// Drag that brings the motion to rest. Loads without an energy feed rotations: with 0.3 per ns in
/// rotation as well, 10 of 32 filaments gain energy until they break and 4 never come to rest. Bending
/// hardly feels the drag on rotations, whose moments of inertia are small.
const DRAG: DragRates = DragRates {
    translational_per_ns: 1.0,
    rotational_per_ns: 30.0,
};

/// Follows `case` to rest, the ends staying where the path has put them.
///
/// # Errors
/// A path of the energy law that ends early, or a motion that fails: in words, with the case.
pub(super) fn rest(case: &Case) -> Result<Outcome, String> {
    let fail = |error: &dyn std::fmt::Display| format!("{}: {error}", case.name());
    let mut from = Assembly::build(&with_energy(case).scene()?).map_err(|e| fail(&e))?;
    run_to_end(&mut from).map_err(|e| fail(&e))?;
    let mut scene = case.scene()?;
    scene.path.clear();
    scene.task = Task::Dynamics(dynamics(LONGEST_NS, DRAG));
    let mut assembly = Assembly::build(&scene).map_err(|e| fail(&e))?;
    let mut start = from.system.state().clone();
    // A motion appends controls for what it books; the equilibrium has none of them.
    let booked = assembly.system.state().controls.values().len() - start.controls.values().len();
    for _ in 0..booked {
        start.add_control(0.0);
    }
    *assembly.system.state_mut() = start;
    let (trajectory, report) = run_to_end(&mut assembly).map_err(|e| fail(&e))?;
    let last = trajectory
        .records
        .last()
        .ok_or_else(|| fail(&"no record"))?;
    *assembly.system.state_mut() = last.state.clone();
    Ok(Outcome {
        case: *case,
        measured: measure(case, &mut assembly),
        evidence: Evidence::Motion {
            time_ns: last.at.value(),
            force_evaluations: report.force_evaluations,
        },
        states: None,
        residual: (last.residual_force_pn, last.residual_torque_pn_nm),
        pose: Pose::of(&assembly, &last.state).without_linkers(),
    })
}

/// The same filament with rods whose loads have an energy.
fn with_energy(case: &Case) -> Case {
    let group = Group {
        rods: Rods::Extended,
        ..case.group
    };
    Case { group, ..*case }
}

/// How far from rest the motions ended; nothing if there were none.
pub(super) fn row(artefact: &'static str, outcomes: &[Outcome]) -> Option<Row> {
    let residual = |o: &Outcome| f64::max(o.residual.0, o.residual.1);
    let all: Vec<&Outcome> = outcomes.iter().filter(|o| !o.is_solved()).collect();
    let worst = all
        .iter()
        .max_by(|a, b| residual(a).total_cmp(&residual(b)))?;
    let open = all.iter().filter(|o| residual(o) > STOP).count();
    let note = format!(
        "largest residual force (pN) or torque (pN nm) at the end of {} damped motions with the \
         balance as printed, at {}; {open} are not at rest to {STOP}",
        all.len(),
        worst.case.name()
    );
    let quantity = "paper-balance/residual";
    Some(Row::measured(artefact, quantity, "", residual(worst), note))
}
