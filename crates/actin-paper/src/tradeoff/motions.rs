//! Motions in time: integrators and steps on a free vibration, and damped motion against Newton's
//! method on the way to an equilibrium.

use super::pareto;
use super::row::Row;
use super::solve;
use crate::run::run_to_end;
use actin_mechanics::Vector3;
use actin_sim::advice::{FilamentSetting, scenes, table};
use actin_sim::cost::Evaluated;
use actin_sim::{
    Assembly, DragRates, Dynamics, End, Equilibrium, Integrator, Monomers, Outcome, Plan, RodLaw,
    Scene, Task,
};
use rayon::prelude::*;

/// Names of both parts.
pub(super) const VIBRATION: &str = "vibration";
pub(super) const REST: &str = "rest";

/// Time of the vibration (ns), and between the moments at which tips are compared.
const VIBRATION_NS: (f64, f64) = (20.0, 0.5);
/// Stability limit of the step relative to that of PEFRL, per integrator.
const INTEGRATORS: [(Integrator, f64); 5] = [
    (Integrator::PositionVerlet, 2.0 / 2.98945),
    (Integrator::Pefrl, 1.0),
    (Integrator::Vefrl, 3.46964 / 2.98945),
    (Integrator::ForestRuth, 1.57340 / 2.98945),
    (Integrator::Suzuki, 2.72097 / 2.98945),
];
/// Shares of the stability limit that are tried.
const SHARES: [f64; 4] = [0.9, 0.5, 0.25, 0.125];
/// Share of the limit of PEFRL in the reference.
const REFERENCE_SHARE: f64 = 0.06;
/// Drag rates of the damped motion (1/ns); the first flexural mode has 0.17 rad/ns.
const DRAGS: [f64; 3] = [0.1, 0.3, 0.6];
/// Distances from the equilibrium that are waited for, relative to the displacement of the tip.
const NEAR: [f64; 2] = [0.01, 0.001];
/// Longest damped motion (ns).
const LONGEST_NS: f64 = 300.0;

fn cantilever(monomers: Vec<[f64; 2]>) -> Result<Scene, String> {
    let all = scenes::all();
    let (_, scene) = all.first().ok_or("no scene")?;
    Ok(FilamentSetting::of(monomers, RodLaw::Constant).apply(scene))
}

/// A motion that has been run.
struct Run {
    tips: Vec<(f64, Vector3)>,
    /// Largest change of the whole energy, over the largest kinetic energy.
    energy_change: f64,
    report: Outcome,
    work: Evaluated,
    dofs: usize,
}

fn run(scene: &Scene, task: Task) -> Result<Run, String> {
    let mut scene = scene.clone();
    scene.task = task;
    let mut assembly = Assembly::build(&scene).map_err(|e| e.to_string())?;
    let (trajectory, report) = run_to_end(&mut assembly).map_err(|e| e.to_string())?;
    let rest = assembly.tip_nm(&assembly.rest, End::End);
    let tip = |state| assembly.tip_nm(state, End::End) - rest;
    let records = trajectory.records.iter();
    let energies = || {
        records
            .clone()
            .map(|r| (r.potential_pn_nm() + r.kinetic_pn_nm, r.kinetic_pn_nm))
    };
    let first = energies().next().map_or(0.0, |e| e.0);
    let most = |pick: &dyn Fn((f64, f64)) -> f64| energies().map(pick).fold(0.0, f64::max);
    Ok(Run {
        energy_change: most(&|e| (e.0 - first).abs()) / most(&|e| e.1),
        tips: records.map(|r| (r.at.value(), tip(&r.state))).collect(),
        work: Evaluated::of(&assembly),
        dofs: assembly.counts().dofs,
        report,
    })
}

fn row(scene: &str, factor: &str, setting: String, of: &Run) -> Row {
    let each = (of.work.bonds + of.work.elements) as f64;
    let evaluations = of.report.force_evaluations as f64;
    Row {
        scene: scene.into(),
        factor: factor.into(),
        setting,
        law: "Constant".into(),
        segment_nm: 10.0,
        bonds_per_interface: Monomers::default().lateral_bonds,
        weight: "Shared".into(),
        attached: 2,
        azimuths: 1,
        bonds: of.work.bonds,
        elements: of.work.elements,
        dofs: of.dofs,
        force_evaluations: Some(evaluations),
        element_evaluations: Some(evaluations * each),
        time_step_ns: of.report.time_step_ns,
        time_s: Some(of.report.wall_s),
        ..Row::default()
    }
}

/// Half monomers, half rod, let go under 2 pN without drag: the tip over 20 ns against the same
/// motion in steps of 0.06 of the limit.
pub(super) fn vibration(quick: bool) -> Result<Vec<Row>, String> {
    let scene = cantilever(vec![[0.0, 80.0]])?;
    let limit = limit(&scene)?;
    let reference = vibrate(&scene, Integrator::Pefrl, limit * REFERENCE_SHARE)?;
    let shares = if quick { &SHARES[1..2] } else { &SHARES[..] };
    let jobs: Vec<(Integrator, f64)> = INTEGRATORS
        .iter()
        .flat_map(|&(i, relative)| shares.iter().map(move |s| (i, s * relative * limit)))
        .collect();
    let runs: Result<Vec<Run>, String> = jobs
        .par_iter()
        .map(|&(integrator, step)| vibrate(&scene, integrator, step))
        .collect();
    let evaluations = reference.report.force_evaluations as f64;
    let described = |name: String, integrator: Integrator, run: &Run| Row {
        monomers_nm: "0-80".into(),
        integrator: Some(format!("{integrator:?}")),
        cost_motion: Some(run.report.force_evaluations as f64 / evaluations),
        error_displacement: Some(apart(run, &reference)),
        error_energy: Some(run.energy_change),
        ..row(VIBRATION, &format!("{integrator:?}"), name, run)
    };
    let mut rows = vec![Row {
        factor: "reference".into(),
        ..described("reference".into(), Integrator::Pefrl, &reference)
    }];
    for ((integrator, step), run) in jobs.iter().zip(runs?) {
        let name = format!("{integrator:?} {:.2} ps", 1e3 * step);
        rows.push(described(name, *integrator, &run));
    }
    mark(&mut rows);
    Ok(rows)
}

fn limit(scene: &Scene) -> Result<f64, String> {
    let mut scene = scene.clone();
    scene.task = Task::Dynamics(solve::motion(1.0, Integrator::Pefrl, None));
    let assembly = Assembly::build(&scene).map_err(|e| e.to_string())?;
    let plan = Plan::new(&assembly).map_err(|e| e.to_string())?;
    let limit = plan.estimate().map(|e| e.stability_limit_ns);
    limit.ok_or_else(|| "no estimate".into())
}

/// The vibration in the nearest step not above `step_ns` that meets the moments of comparison.
fn vibrate(scene: &Scene, integrator: Integrator, step_ns: f64) -> Result<Run, String> {
    let (duration, every) = VIBRATION_NS;
    let step = every / (every / step_ns).ceil();
    let dynamics = Dynamics {
        record_every_ns: Some(every),
        ..solve::motion(duration, integrator, Some(step))
    };
    run(scene, Task::Dynamics(dynamics))
}

/// Rms distance of tips over rms displacement.
fn apart(run: &Run, reference: &Run) -> f64 {
    let pairs = run.tips.iter().zip(&reference.tips);
    let difference: f64 = pairs.map(|(a, b)| (a.1 - b.1).norm_squared()).sum();
    let size: f64 = reference.tips.iter().map(|t| t.1.norm_squared()).sum();
    (difference / size).sqrt()
}

/// The way to the equilibrium of two cantilevers: Newton's method and damped motions.
pub(super) fn rest(quick: bool) -> Result<Vec<Row>, String> {
    let mut rows = Vec::new();
    let whole = [0.0, scenes_length()?];
    for monomers in [vec![[0.0, 80.0]], vec![whole]] {
        let name = table::stretches(&monomers);
        let scene = cantilever(monomers)?;
        let newton = run(&scene, Task::Equilibrium(Equilibrium::default()))?;
        let end = newton.tips.last().ok_or("no record")?.1;
        rows.push(Row {
            monomers_nm: name.clone(),
            newton_steps: newton
                .report
                .equilibrium
                .as_ref()
                .map(|e| e.newton_iterations as f64),
            error_displacement: Some(0.0),
            time_relative: Some(1.0),
            ..row(REST, "Newton", format!("{name}/Newton"), &newton)
        });
        let drags = if quick { &DRAGS[1..2] } else { &DRAGS[..] };
        for &drag in drags {
            rows.extend(approach(&scene, &name, drag, end, newton.report.wall_s)?);
        }
    }
    Ok(rows)
}

fn scenes_length() -> Result<f64, String> {
    let scene = cantilever(Vec::new())?;
    let sections = scene.filament.sections.last();
    sections
        .map(|s| s.span_nm().1)
        .ok_or_else(|| "no section".into())
}

/// A damped motion: what it takes until the tip stays within each of [`NEAR`].
fn approach(
    scene: &Scene,
    name: &str,
    drag: f64,
    end: Vector3,
    newton_s: f64,
) -> Result<Vec<Row>, String> {
    let integrator = Integrator::PositionVerlet;
    let dynamics = Dynamics {
        drag: DragRates {
            translational_per_ns: drag,
            rotational_per_ns: drag,
        }
        .into(),
        step_safety: 0.9,
        record_every_ns: Some(0.5),
        ..solve::motion(LONGEST_NS, integrator, None)
    };
    let run = run(scene, Task::Dynamics(dynamics))?;
    let last = run.tips.last().map_or(0.0, |t| t.0);
    let rows = NEAR.iter().filter_map(|&near| {
        let is_out = |t: &&(f64, Vector3)| (t.1 - end).norm() > near * end.norm();
        let out = run.tips.iter().rev().find(is_out).map_or(0.0, |t| t.0);
        // Still out at the end: it takes longer than was looked at.
        let share = (out < last).then_some(out / last)?;
        let all = row(
            REST,
            "damped",
            format!("{name}/drag-{drag}/within-{near}"),
            &run,
        );
        let scaled = |value: Option<f64>| value.map(|v| v * share);
        Some(Row {
            monomers_nm: name.to_owned(),
            integrator: Some(format!("{integrator:?}")),
            force_evaluations: scaled(all.force_evaluations),
            element_evaluations: scaled(all.element_evaluations),
            time_s: scaled(all.time_s),
            time_relative: scaled(all.time_s).map(|t| t / newton_s),
            error_displacement: Some(near),
            ..all
        })
    });
    Ok(rows.collect())
}

fn mark(rows: &mut [Row]) {
    let of = |value: Option<f64>| value.unwrap_or(f64::INFINITY);
    let points: Vec<(f64, f64)> = rows
        .iter()
        .map(|row| (of(row.cost_motion), of(row.error_displacement)))
        .collect();
    for (row, on_front) in rows.iter_mut().zip(pareto::front(&points)) {
        row.on_front = on_front;
    }
}
