//! A chain of points and springs of one's own swings in its slowest mode, stepped by PEFRL.

use actin_integrate::{
    PEFRL, Point, Run, SAFETY, Spring, Springs, State, System, Vector3, largest_frequency,
    stable_step,
};
use std::f64::consts::{PI, TAU};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Eleven points one apart, the ends held, the others displaced along the chain.
    let (links, mass, stiffness, rest_length) = (10_u8, 0.07_f64, 100.0, 1.0);
    let amplitude = |i: u8| 0.1 * (PI * f64::from(i) / f64::from(links)).sin();
    let mut state = State::default();
    for i in 0..=links {
        let position = Vector3::x() * (f64::from(i) + amplitude(i));
        state.points.push(Point { position, mass });
    }
    [0, 10].map(|end| state.points.hold(end));
    let springs = (0..10).map(|i| Spring {
        points: [i, i + 1],
        stiffness,
        rest_length,
    });
    let springs = Springs::new(&state, springs.collect())?;
    let mut system = System::new(state, vec![Box::new(springs)]);

    // Over one period of theory the middle comes back to where it began.
    let frequency = 2.0 * (stiffness / mass).sqrt() * (PI / (2.0 * f64::from(links))).sin();
    let energy = system.total_energy();
    let step = stable_step(&PEFRL, largest_frequency(&system)?, SAFETY)?;
    let outcome = Run::over(&PEFRL, step, TAU / frequency)?.execute(&mut system, &mut [])?;

    let middle = system.state().points.position.get(5).x - 5.0;
    let drift = system.total_energy() / energy - 1.0;
    println!(
        "{} steps: middle at {middle:.6}, began at {:.6}",
        outcome.steps,
        amplitude(5)
    );
    println!("relative change of the energy: {drift:.1e}");
    assert!((middle - amplitude(5)).abs() < 1e-4 && drift.abs() < 1e-4);
    Ok(())
}
