//! Damped motion along the same path: whether it ends in the equilibrium that statics finds.

use super::case::Case;
use super::lists::Plan;
use super::outcome::{Measured, Outcome, measure, outcome};
use super::resolved::Resolved;
use super::results::{OBSERVABLES, Results};
use super::starts::is_same;
use crate::run::run_to_end;
use actin_draw::report::{Origin, Row};
use actin_sim::{
    Assembly, DragRates, Dynamics, Equilibrium, Integrator, Record, StopTolerances, Task,
};

/// Where damped motion ended.
#[derive(Clone, Debug)]
pub(super) struct Motion {
    pub case: Case,
    /// The state in which the motion was stopped.
    pub end: Measured,
    /// Residual force (pN) and torque (pN nm) there.
    pub residual: (f64, f64),
    pub time_ns: f64,
    pub force_evaluations: u64,
    /// The equilibrium that Newton's method finds from that state.
    pub nearest: Outcome,
}

/// Drag rates (1/ns): about critical for the slowest mode of bending.
const DRAG_PER_NS: f64 = 0.3;
/// Residual at which the motion is stopped (pN, pN nm). The plane of buckling may still turn then:
/// what is compared does not depend on it.
pub(super) const STOP: f64 = 1e-3;
/// Longest time (ns).
const LONGEST_NS: f64 = 3000.0;
/// Tolerances of what is compared between the end of the motion and the equilibrium: the residual
/// over the softest stiffness against a change of height (about 0.1 pN/nm) is 0.01 nm; couple,
/// thrust and energy follow.
const TOLERANCES: [f64; 4] = [0.02, 0.3, 0.02, 0.05];

/// The cases that are moved in time: one mixed resolution in both directions, or none.
pub(super) fn cases(plan: &Plan) -> Vec<Case> {
    let case = |turn| Case::new(plan.main(), Resolved::Mixed(140), turn, 0);
    if plan.moving {
        [180, -180].map(case).into()
    } else {
        Vec::new()
    }
}

/// Moves the filament along its path in time, then solves from where it came to rest.
pub(super) fn run(case: &Case) -> Result<Motion, String> {
    let fail = |error: &dyn std::fmt::Display| format!("{}: dynamics: {error}", case.name());
    let mut scene = case.scene()?;
    scene.task = Task::Dynamics(dynamics(
        LONGEST_NS,
        DragRates {
            translational_per_ns: DRAG_PER_NS,
            rotational_per_ns: DRAG_PER_NS,
        },
    ));
    let mut assembly = Assembly::build(&scene).map_err(|e| fail(&e))?;
    let (trajectory, report) = run_to_end(&mut assembly).map_err(|e| fail(&e))?;
    let last = trajectory
        .records
        .last()
        .ok_or_else(|| fail(&"no record"))?;
    *assembly.system.state_mut() = last.state.clone();
    Ok(Motion {
        case: *case,
        end: measure(case, &mut assembly),
        residual: (last.residual_force_pn, last.residual_torque_pn_nm),
        time_ns: last.at.value(),
        force_evaluations: report.force_evaluations,
        nearest: nearest(case, last)?,
    })
}

/// Damped motion of at most so many ns.
pub(super) fn dynamics(duration_ns: f64, drag: DragRates) -> Dynamics {
    Dynamics {
        duration_ns,
        integrator: Integrator::PositionVerlet,
        time_step_ns: None,
        step_safety: 0.9,
        allow_unstable_step: false,
        drag: drag.into(),
        thermal: None,
        stop: Some(StopTolerances {
            force_pn: STOP,
            torque_pn_nm: STOP,
            kinetic_pn_nm: 1e-6,
        }),
        leave_saddles: 0,
        record_every_ns: None,
    }
}

/// The equilibrium that Newton's method finds from `record`, the ends staying where they are.
fn nearest(case: &Case, record: &Record) -> Result<Outcome, String> {
    let mut scene = case.scene()?;
    scene.path.clear();
    scene.task = Task::Equilibrium(Equilibrium::default());
    let mut assembly =
        Assembly::build(&scene).map_err(|error| format!("{}: {error}", case.name()))?;
    *assembly.system.state_mut() = record.state.clone();
    outcome(case, &mut assembly)
}

/// Rows: how far the end of the motion is from its equilibrium, and which equilibrium that is.
pub(super) fn rows(plan: &Plan, results: &Results, motions: &[Motion]) -> Vec<Row> {
    motions
        .iter()
        .flat_map(|motion| {
            let mut rows = differences(motion);
            rows.push(which(plan, results, motion));
            rows
        })
        .collect()
}

fn differences(motion: &Motion) -> Vec<Row> {
    let name = format!(
        "{}/{}",
        Case::turn_name(motion.case.turn_deg),
        motion.case.resolved.name()
    );
    let pairs = OBSERVABLES.into_iter().zip(TOLERANCES);
    let row = |(observable, tolerance): (super::results::Observable, f64)| {
        let value = (observable.of)(&motion.end) - (observable.of)(&motion.nearest.measured);
        let note = format!(
            "end of damped motion ({:.0} ns, residual {:.1e} pN and {:.1e} pN nm, {} force \
             evaluations) minus the equilibrium that Newton's method finds from it; \
             certified stable: {}",
            motion.time_ns,
            motion.residual.0,
            motion.residual.1,
            motion.force_evaluations,
            motion.nearest.is_stable()
        );
        let quantity = format!("dynamics_difference/{}/{name}", observable.name);
        Row::measured(
            motion.case.group.figure.id(),
            quantity,
            observable.unit,
            value,
            note,
        )
        .against(0.0, tolerance)
        .of(Origin::Bound)
    };
    pairs.map(row).collect()
}

/// How many of the starts of statics lead to the equilibrium that the motion found.
fn which(plan: &Plan, results: &Results, motion: &Motion) -> Row {
    let turn = motion.case.turn_deg;
    let starts = plan.starts_at(turn);
    let found = results.started(motion.case, &starts);
    let same = found.iter().filter(|o| is_same(o, &motion.nearest)).count();
    let m = &motion.nearest.measured;
    let note = format!(
        "of {} starts of statics that end in the equilibrium that damped motion finds ({:.3} nm, \
         {:.2} pN nm, energy {:.3} pN nm)",
        found.len(),
        m.height_nm,
        m.couple_pn_nm,
        m.energy_pn_nm
    );
    let quantity = format!(
        "dynamics_same_as_statics/{}/{}",
        Case::turn_name(turn),
        motion.case.resolved.name()
    );
    Row::measured(plan.figure.id(), quantity, "", same as f64, note)
}
