//! Slowest vibration of a chain of points and springs, integrated by PEFRL.

use actin_integrate::{
    PEFRL, Point, Run, SAFETY, Spring, Springs, State, System, Vector3, largest_frequency,
    stable_step,
};
use std::f64::consts::{PI, TAU};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Eleven points at unit distances with fixed ends, displaced along the chain.
    let (mass, stiffness, rest_length, amplitude) = (0.07_f64, 100.0, 1.0, 0.1);
    let mut state = State::default();
    for i in 0..=10 {
        let s = f64::from(i);
        let position = Vector3::x() * (s + amplitude * (PI * s / 10.0).sin());
        state.points.push(Point { position, mass });
    }
    state.points.hold(0);
    state.points.hold(10);
    let springs = (0..10).map(|i| Spring {
        points: [i, i + 1],
        stiffness,
        rest_length,
    });
    let springs = Springs::new(&state, springs.collect())?;
    let mut system = System::new(state, vec![Box::new(springs)]);

    // The displacement repeats after one period.
    let period = TAU / (2.0 * (stiffness / mass).sqrt() * (PI / 20.0).sin());
    let step = stable_step(&PEFRL, largest_frequency(&system)?, SAFETY)?;
    let outcome = Run::from_duration(&PEFRL, step, period)?.execute(&mut system, &mut [])?;
    let middle = system.state().points.position.get(5).x - 5.0;
    println!("after one period, {} steps: {middle:.6}", outcome.steps);
    println!("at the start: {amplitude:.6}");
    assert!((middle - amplitude).abs() < 1e-4);
    Ok(())
}
