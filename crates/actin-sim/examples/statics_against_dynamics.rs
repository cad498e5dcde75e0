//! Newton's method against damped dynamics on the cantilever of Figure 4 as monomers, and Newton's
//! time against length.
//!
//! `cargo run --release -p actin-sim --example statics_against_dynamics`
//!
//! Both start from the straight filament and end at a residual of 1e-6 pN and 1e-6 pN nm. The
//! dynamics uses position Verlet, the cheapest integrator per unit of time, at 0.95 of its
//! stability limit and five drag rates. Times exclude the build.

use actin_mechanics::{State, Vector3};
use actin_sim::{Assembly, Plan, Scene, Task};
use std::time::Instant;

/// Residual at which both stop (pN, pN nm).
const RESIDUAL: f64 = 1e-6;
/// Residual at which the equilibria are compared.
const TIGHT: f64 = 1e-8;
/// Time step of the dynamics over the stability limit.
const SAFETY: f64 = 0.95;
/// Drag rates (1/ns); the first flexural mode has 0.17 rad/ns.
const DRAGS: [f64; 5] = [0.05, 0.1, 0.2, 0.4, 0.8];
/// Longest motion (ns).
const LONGEST_NS: f64 = 20_000.0;
/// Lengths of the second table (nm).
const LENGTHS: [f64; 7] = [160.0, 320.0, 640.0, 1600.0, 4000.0, 8000.0, 16_000.0];

fn main() {
    let scene = figure_4();
    let newton = best_newton(&scene, 20, RESIDUAL);
    println!("cantilever of Figure 4, 160 nm, 2 pN, to {RESIDUAL:e} pN and pN nm");
    println!("{newton}");
    let mut best = f64::INFINITY;
    for drag in DRAGS {
        let motion = motion(&scene, drag, RESIDUAL);
        let apart = furthest(&motion.state, &newton.state);
        println!("{motion}; {apart:.1e} nm from Newton's");
        if motion.converged {
            best = best.min(motion.seconds);
        }
    }
    println!(
        "best motion over Newton: {:.0} times the time",
        best / newton.seconds
    );
    let motion = motion(&scene, 0.2, TIGHT);
    let exact = best_newton(&scene, 1, TIGHT);
    let apart = furthest(&exact.state, &motion.state);
    println!("both to {TIGHT:e} pN: {apart:.1e} nm apart; {motion}");
    println!();
    println!("Newton against length, 2 pN (160 nm / L)^2");
    let mut points = Vec::new();
    for length in LENGTHS {
        let run = best_newton(&cantilever(length), repeats(length), RESIDUAL);
        println!("{length:7} nm: {run}");
        points.push((length.ln(), run.seconds.ln()));
    }
    println!("time ~ length^{:.3} (least squares)", slope(&points));
}

/// Number of repetitions.
fn repeats(length: f64) -> usize {
    if length < 2000.0 { 5 } else { 2 }
}

struct Run {
    name: String,
    seconds: f64,
    evaluations: u64,
    iterations: u64,
    residual: (f64, f64),
    converged: bool,
    state: State,
    note: String,
}

impl std::fmt::Display for Run {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "{:22} {:10.3} ms {:9} force evaluations {:5} Newton steps, {:.1e} pN {:.1e} pN nm{}{}",
            self.name,
            self.seconds * 1e3,
            self.evaluations,
            self.iterations,
            self.residual.0,
            self.residual.1,
            if self.converged {
                ""
            } else {
                ", NOT CONVERGED"
            },
            self.note
        )
    }
}

/// Scene of Figure 4 as monomers.
fn figure_4() -> Scene {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../scenarios/figure-4/ellipsoids.ron"
    );
    let text = std::fs::read_to_string(path).expect("the scene is part of the workspace");
    Scene::from_ron(&text).expect("the scene is valid")
}

/// Cantilever of monomers with a tip force that bends it by the same angle at every length.
fn cantilever(length: f64) -> Scene {
    let force = -2.0 * (160.0 / length).powi(2);
    let text = format!(
        "Scene(
            filament: Filament(sections: [Ellipsoids(from_nm: 0.0, to_nm: {length:?})]),
            clamps: [Clamp(end: Start)],
            loads: [EndForce(end: End, force_pn: ({force:?}, 0.0, 0.0))],
            task: Equilibrium(),
        )"
    );
    Scene::from_ron(&text).expect("the scene is well formed")
}

/// Fastest of several Newton solves, each of a new assembly.
fn best_newton(scene: &Scene, repeats: usize, residual: f64) -> Run {
    let mut scene = scene.clone();
    scene.task = Task::Equilibrium(actin_sim::Equilibrium {
        force_pn: residual,
        torque_pn_nm: residual,
        iterations: 1000,
        ..actin_sim::Equilibrium::default()
    });
    (0..repeats)
        .map(|_| newton(&scene))
        .min_by(|a, b| a.seconds.total_cmp(&b.seconds))
        .expect("there is at least one")
}

fn newton(scene: &Scene) -> Run {
    let assembly = Assembly::build(scene).expect("the scene can be built");
    let clock = Instant::now();
    let result = Plan::new(&assembly).expect("the scene can run").run();
    let seconds = clock.elapsed().as_secs_f64();
    let (trajectory, report) = result.expect("the cantilever has an equilibrium");
    let last = trajectory.records.last().expect("it was recorded");
    let found = report.equilibrium.as_ref().expect("it was certified");
    Run {
        name: "Newton".to_owned(),
        seconds,
        evaluations: report.force_evaluations,
        iterations: found.newton_iterations,
        residual: (last.residual_force_pn, last.residual_torque_pn_nm),
        converged: report.has_converged(),
        state: last.state.clone(),
        note: format!(", {:?}", found.certificate.stability()),
    }
}

fn motion(scene: &Scene, drag: f64, residual: f64) -> Run {
    let mut scene = scene.clone();
    let text = format!(
        "Scene(
            filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 1.0)]),
            task: Dynamics(
                duration_ns: {LONGEST_NS:?},
                integrator: PositionVerlet,
                step_safety: {SAFETY:?},
                drag: (translational_per_ns: {drag:?}, rotational_per_ns: {drag:?}),
                stop: (force_pn: {residual:?}, torque_pn_nm: {residual:?}, kinetic_pn_nm: 1.0),
                record_every_ns: 1.0,
            ),
        )"
    );
    scene.task = Scene::from_ron(&text)
        .expect("the task is well formed")
        .task;
    let assembly = Assembly::build(&scene).expect("the scene can be built");
    let clock = Instant::now();
    let result = Plan::new(&assembly).expect("the scene can run").run();
    let seconds = clock.elapsed().as_secs_f64();
    let (trajectory, report) = result.expect("the motion is stable");
    let last = trajectory.records.last().expect("it was recorded");
    Run {
        name: format!("drag {drag} per ns"),
        seconds,
        evaluations: report.force_evaluations,
        iterations: 0,
        residual: (last.residual_force_pn, last.residual_torque_pn_nm),
        converged: report.has_converged(),
        state: last.state.clone(),
        note: format!(
            ", {:.0} ns in steps of {:.2} ps",
            last.at.value(),
            report.time_step_ns.unwrap_or(f64::NAN) * 1e3
        ),
    }
}

/// Largest distance between corresponding points (nm).
fn furthest(a: &State, b: &State) -> f64 {
    let distance = |(x, y): (Vector3, Vector3)| (x - y).norm();
    let pairs = a.points.position.iter().zip(b.points.position.iter());
    pairs.map(distance).fold(0.0, f64::max)
}

/// Slope of the least-squares line.
fn slope(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / n;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let covariance: f64 = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    let variance: f64 = points.iter().map(|p| (p.0 - x).powi(2)).sum();
    covariance / variance
}
