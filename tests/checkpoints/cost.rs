//! Cost of checks, without assertions. `cost_of_checks` prints the table of checks in
//! `docs/measured/motion.md`.

use super::common::build;
use actin_integrate::{DEFAULT_CHECK_EVERY, Run, advance, stable_step};
use actin_mechanics::System;
use actin_sim::Scene;
use std::time::Instant;

#[rustfmt::skip]
const FILAMENTS: [(&str, &str); 4] = [
    ("rod, 16 segments", "Rod(from_nm: 0.0, to_nm: 160.0, segments: 16)"),
    ("rod, 64 segments", "Rod(from_nm: 0.0, to_nm: 640.0, segments: 64)"),
    ("rod, 1024 segments", "Rod(from_nm: 0.0, to_nm: 10240.0, segments: 1024)"),
    ("60 monomers", "Ellipsoids(from_nm: 0.0, to_nm: 163.0)"),
];

fn scene(section: &str) -> Scene {
    let text = format!(
        "Scene(filament: Filament(sections: [{section}]), clamps: [Clamp(end: Start)],
         loads: [EndForce(end: End, force_pn: (-0.1, 0.0, 0.0))],
         task: Dynamics(duration_ns: 1.0, integrator: PositionVerlet))"
    );
    Scene::from_ron(&text).unwrap()
}

/// Shortest time (s) of several repetitions, which excludes other load on the machine.
fn least(mut work: impl FnMut()) -> f64 {
    let once = |work: &mut dyn FnMut()| {
        let start = Instant::now();
        work();
        start.elapsed().as_secs_f64()
    };
    let times = (0..15).map(|_| once(&mut work));
    times.fold(f64::INFINITY, f64::min)
}

fn steps_with(system: &mut System, h: f64, steps: u64, every: u64) -> f64 {
    let run = Run::new(&actin_integrate::POSITION_VERLET, h, steps)
        .and_then(|run| run.checking_every(every))
        .and_then(|run| run.observing_every(u64::MAX / 2))
        .unwrap();
    least(|| {
        let outcome = run.execute(system, &mut []);
        assert!(outcome.is_ok());
    })
}

/// Times of a step, of a step without merged kicks, and of a step with a check; relative cost at
/// the default interval of checks.
#[test]
#[ignore = "prints times; run by hand with --ignored --nocapture"]
fn cost_of_checks() {
    println!(
        "| filament | step, us | steps made one by one | with a check at each | share at one in \
         {DEFAULT_CHECK_EVERY} steps |"
    );
    println!("|---|---|---|---|---|");
    for (name, section) in FILAMENTS {
        let mut assembly = build(&scene(section));
        let system = &mut assembly.system;
        let frequency = actin_integrate::largest_frequency(system).unwrap();
        let h = stable_step(&actin_integrate::POSITION_VERLET, frequency, 0.5).unwrap();
        let steps = 400_000 / system.state().frames.len() as u64;
        let none = actin_integrate::Drag::NONE;
        let scheme = &actin_integrate::POSITION_VERLET;
        let bare = least(|| advance(system, scheme, h, steps, &none));
        let apart = least(|| (0..steps).for_each(|_| advance(system, scheme, h, 1, &none)));
        let often = steps_with(system, h, steps, 1);
        let [step, apart, often] = [bare, apart, often].map(|time| time / steps as f64);
        println!(
            "| {name} | {:.2} | {:.2} | {:.2} | {:.2} % |",
            1e6 * step,
            1e6 * apart,
            1e6 * often,
            100.0 * (often - step) / (step * DEFAULT_CHECK_EVERY as f64)
        );
    }
}
