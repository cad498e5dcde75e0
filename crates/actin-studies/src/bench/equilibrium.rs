//! Run times of equilibria of all-monomer filaments.

use super::{Timings, median};
use actin_sim::{Assembly, End, Plan, RunError, Scene, Task};
use std::time::Instant;

/// Tolerance of the residual (pN, and pN nm).
const RESIDUAL: f64 = 1e-7;
/// Largest residual that is accepted as round-off.
const HIGHEST_FLOOR: f64 = 1e-5;
/// Largest accepted relative change of the tip displacement in a tighter solve.
const TIP_ERROR: f64 = 1e-3;
/// Time for repeats of a case (s); at least one solve is made.
const BUDGET_S: f64 = 2.0;
const REPEATS: usize = 50;

struct TimedSolution {
    assembly: Assembly,
    seconds: f64,
    residual: f64,
    iterations: u64,
}

pub(super) fn measure(length_nm: f64) -> Result<Timings, String> {
    let mut tolerance = RESIDUAL;
    let first = loop {
        match solve(length_nm, tolerance) {
            Ok(solved) => break solved,
            Err(error) if tolerance * 10.0 > HIGHEST_FLOOR => return Err(error),
            Err(_) => tolerance *= 10.0,
        }
    };
    let mut times = vec![first.seconds];
    while times.len() < REPEATS && times.iter().sum::<f64>() < BUDGET_S {
        times.push(solve(length_nm, tolerance)?.seconds);
    }
    let floor = if tolerance > RESIDUAL {
        format!(" (tolerance {tolerance:.0e}, limited by round-off)")
    } else {
        String::new()
    };
    let (iterations, residual) = (first.iterations, first.residual);
    let tip = tighter(first, tolerance)?;
    let note = format!("{iterations} iterations, residual {residual:.1e} pN{floor}; tip {tip}");
    Ok(Timings {
        best: times.iter().copied().fold(f64::INFINITY, f64::min),
        median: median(times),
        note,
    })
}

fn solve(length_nm: f64, tolerance: f64) -> Result<TimedSolution, String> {
    let scene = Scene::from_ron(&scene(length_nm, tolerance)).map_err(|e| e.to_string())?;
    let assembly = Assembly::build(&scene).map_err(|error| error.to_string())?;
    solve_on(assembly).map_err(|error| error.to_string())
}

fn solve_on(mut assembly: Assembly) -> Result<TimedSolution, RunError> {
    let started = Instant::now();
    let (trajectory, report) = Plan::new(&assembly)?.run()?;
    let seconds = started.elapsed().as_secs_f64();
    let last = trajectory.records.last();
    if let Some(last) = last {
        *assembly.system.state_mut() = last.state.clone();
    }
    Ok(TimedSolution {
        assembly,
        seconds,
        residual: last.map_or(f64::NAN, |record| record.residual_force_pn),
        iterations: report.equilibrium.map_or(0, |e| e.newton_iterations),
    })
}

/// Continues the solve to a tenth of the tolerance. Returns a text with the relative change of the tip displacement.
fn tighter(solved: TimedSolution, tolerance: f64) -> Result<String, String> {
    let before = displacement(&solved.assembly);
    let mut assembly = solved.assembly;
    if let Task::Equilibrium(task) = &mut assembly.scene.task {
        task.force_pn = 0.1 * tolerance;
        task.torque_pn_nm = 0.1 * tolerance;
    }
    let Ok(tight) = solve_on(assembly) else {
        return Ok("no tighter solve: the residual is round-off".to_owned());
    };
    let change = (displacement(&tight.assembly) / before - 1.0).abs();
    if change > TIP_ERROR {
        return Err(format!("a tighter solve moves the tip by {change:.1e}"));
    }
    Ok(format!(
        "within {change:.0e} of a solve to {:.1e} pN",
        tight.residual
    ))
}

/// Returns the displacement of the tip (nm).
fn displacement(assembly: &Assembly) -> f64 {
    let now = assembly.tip_nm(assembly.system.state(), End::End);
    (now - assembly.tip_nm(&assembly.rest, End::End)).norm()
}

/// Returns a cantilever of monomers with a tip force that gives the same tip angle for every length.
fn scene(length_nm: f64, tolerance: f64) -> String {
    let force = -2.0 * (160.0 / length_nm).powi(2);
    format!(
        "Scene(
            filament: Filament(sections: [Ellipsoids(from_nm: 0.0, to_nm: {length_nm:?})]),
            clamps: [Clamp(end: Start)],
            loads: [EndForce(end: End, force_pn: ({force:?}, 0.0, 0.0))],
            task: Equilibrium(
                force_pn: {tolerance:?}, torque_pn_nm: {tolerance:?}, iterations: 2000,
            ),
        )"
    )
}
