//! Cost of Newton's method against length: cantilevers of monomers bent by the same angle, solved
//! from the initial guess of a run, for several kinds of bonds.
//!
//! `cargo run --release -p actin-sim --example newton_against_length [longest (nm) [bonds]]`
//!
//! Each line has steps, excursions, factorisations, evaluations, energy, certificate and time
//! without the build.

use actin_equilibrium::{Equilibrium as Found, Verdict};
use actin_sim::{Assembly, Equilibrium, Scene, Task, near_equilibrium, solver};
use std::time::Instant;

/// Residual at which a solve ends (pN, pN nm).
const RESIDUAL: f64 = 1e-6;
/// Lengths (nm).
const LENGTHS: [f64; 7] = [160.0, 320.0, 640.0, 1600.0, 4000.0, 8000.0, 16_000.0];
const BONDS: [(&str, &str); 4] = [
    ("weighted", "anchors: Cubature"),
    (
        "identical",
        "anchors: Identical, lateral_bonds: 10, longitudinal_bonds: 10",
    ),
    (
        "independent",
        "anchors: Independent, lateral_bonds: 10, longitudinal_bonds: 10",
    ),
    ("independent-64", "anchors: Independent"),
];

fn main() {
    let mut arguments = std::env::args().skip(1);
    let longest = arguments.next().map_or(16_000.0, |text| {
        text.parse().expect("the longest length is a number of nm")
    });
    let wanted: Vec<String> = arguments.collect();
    for (name, bonds) in BONDS {
        if !wanted.is_empty() && !wanted.iter().any(|one| one == name) {
            continue;
        }
        println!("{name}");
        let mut points = Vec::new();
        for length in LENGTHS.into_iter().filter(|length| *length <= longest) {
            let (found, seconds) = solve(length, bonds);
            println!("{length:7} nm {}, {:9.1} ms", line(&found), seconds * 1e3);
            points.push((length.ln(), seconds.ln()));
        }
        println!("time ~ length^{:.2} (least squares)", slope(&points));
    }
}

/// Cantilever of monomers with a tip force that bends it by the same angle at every length.
fn cantilever(length: f64, bonds: &str) -> Scene {
    let force = -2.0 * (160.0 / length).powi(2);
    let text = format!(
        "Scene(
            filament: Filament(
                sections: [Ellipsoids(from_nm: 0.0, to_nm: {length:?})],
                monomers: Monomers({bonds}),
            ),
            clamps: [Clamp(end: Start)],
            loads: [EndForce(end: End, force_pn: ({force:?}, 0.0, 0.0))],
            task: Equilibrium(force_pn: {RESIDUAL:?}, torque_pn_nm: {RESIDUAL:?}),
        )"
    );
    Scene::from_ron(&text).expect("the scene is well formed")
}

/// Equilibrium and its time (s).
fn solve(length: f64, bonds: &str) -> (Found, f64) {
    let scene = cantilever(length, bonds);
    let assembly = Assembly::build(&scene).expect("the scene can be built");
    let Task::Equilibrium(task) = &scene.task else {
        unreachable!("the scene asks for an equilibrium")
    };
    let mut newton = solver(&assembly, task).expect("the scene has a solver");
    let attempts = Equilibrium::default().leave_saddles;
    let clock = Instant::now();
    let near = near_equilibrium(&assembly);
    newton.carry_along(near.is_some());
    let mut state = near.unwrap_or_else(|| assembly.system.state().clone());
    let found = newton.minimize(&mut state, assembly.system.interactions(), attempts);
    let seconds = clock.elapsed().as_secs_f64();
    (found.expect("the cantilever has an equilibrium"), seconds)
}

fn line(found: &Found) -> String {
    let is_outing = |verdict| matches!(verdict, Verdict::Excursion | Verdict::Return);
    let outings = found.history.iter().filter(|step| is_outing(step.verdict));
    let work = found.work;
    format!(
        "{:5} steps {:4} outings {:5} factorisations {:5} evaluations, {:+.8e} pN nm {:?}",
        work.iterations,
        outings.count(),
        work.factorizations,
        work.evaluations,
        found.energy,
        found.certificate.map(|certificate| certificate.stability()),
    )
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
