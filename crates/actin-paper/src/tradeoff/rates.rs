//! Rates behind the estimates of time: `cargo xtask tradeoff rates`. The constants in
//! `crates/actin-sim/src/cost/rates.rs` are what it prints.

use super::solve;
use crate::Tell;
use crate::run::run_to_end;
use actin_sim::advice::{FilamentSetting, scenes};
use actin_sim::cost::Evaluated;
use actin_sim::{Assembly, Equilibrium, Integrator, RodLaw, Scene, Task};

/// How often each is measured; the best counts.
const REPEATS: usize = 7;
/// Time of the motions (ns).
const MOTION_NS: f64 = 4.0;

/// Measures and prints all rates.
pub(super) fn print(tell: Tell<'_>) -> Result<(), String> {
    let all = scenes::all();
    let (_, cantilever) = all.first().ok_or("no scene")?;
    let whole = cantilever
        .filament
        .sections
        .last()
        .map_or(0.0, |s| s.span_nm().1);
    let monomers = FilamentSetting::of(vec![[0.0, whole]], RodLaw::Constant).apply(cantilever);
    let rod = |law| {
        FilamentSetting {
            segment_nm: 2.5,
            ..FilamentSetting::of(vec![], law)
        }
        .apply(cantilever)
    };
    for (name, scene) in [
        ("bonds", monomers),
        ("elements, Constant", rod(RodLaw::Constant)),
        ("elements, Fitted", rod(RodLaw::Fitted)),
        ("elements, Homogenised", rod(RodLaw::Homogenised)),
    ] {
        let motion = Task::Dynamics(solve::motion(MOTION_NS, Integrator::PositionVerlet, None));
        let newton = Task::Equilibrium(Equilibrium::default());
        tell(format_args!(
            "{name}: {:.2e} per s in whole steps, {:.2e} per s of a Newton step",
            best(&scene, &motion)?,
            best(&scene, &newton)?
        ));
    }
    let rod = rod(RodLaw::Constant);
    tell(format_args!(
        "points and frames in the bath: {:.2e} per s",
        noise(&rod)?
    ));
    Ok(())
}

/// Points and frames per second that half a step of thermal noise moves: what a motion takes longer
/// in the bath than with drag alone.
fn noise(scene: &Scene) -> Result<f64, String> {
    let damped = actin_sim::Dynamics {
        drag: actin_sim::DragRates {
            translational_per_ns: 1.0,
            rotational_per_ns: 1.0,
        }
        .into(),
        ..solve::motion(MOTION_NS, Integrator::PositionVerlet, None)
    };
    let heated = actin_sim::Dynamics {
        thermal: Some(actin_sim::Thermal {
            temperature_k: 298.0,
            seed: 1,
        }),
        ..damped.clone()
    };
    let assembly = Assembly::build(scene).map_err(|e| e.to_string())?;
    let (counts, work) = (assembly.counts(), Evaluated::of(&assembly));
    let of_step = |task| -> Result<f64, String> {
        let rate = best(scene, &Task::Dynamics(task))?;
        Ok((work.bonds + work.elements) as f64 / rate)
    };
    let noise = of_step(heated)? - of_step(damped)?;
    Ok(2.0 * counts.dofs as f64 / 3.0 / noise)
}

/// Bonds and elements per second of a run, the best of some.
fn best(scene: &Scene, task: &Task) -> Result<f64, String> {
    let mut scene = scene.clone();
    scene.task = task.clone();
    let mut best: f64 = 0.0;
    for _ in 0..REPEATS {
        let mut assembly = Assembly::build(&scene).map_err(|e| e.to_string())?;
        let work = Evaluated::of(&assembly);
        let (_, report) = run_to_end(&mut assembly).map_err(|e| e.to_string())?;
        let steps = report
            .equilibrium
            .map_or(report.force_evaluations, |e| e.newton_iterations);
        let rate = steps as f64 * (work.bonds + work.elements) as f64 / report.wall_s;
        best = best.max(rate);
    }
    Ok(best)
}
