//! A body on a spring under gravity, stepped by hand: period and amplitude compared with theory.

use actin_mechanics::{Point, Split, Spring, Springs, State, System, Vector3, Weight};
use std::f64::consts::TAU;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (mass, stiffness, rest_length, gravity): (f64, f64, f64, f64) = (2.0, 50.0, 1.0, 9.81);
    let mut state = State::default();
    let points = [0.0, -1.0].map(|height| {
        let position = Vector3::z() * height;
        state.points.push(Point { position, mass })
    });
    state.points.hold(points[0]);
    let spring = Spring {
        points,
        stiffness,
        rest_length,
    };
    let springs = Springs::new(&state, vec![spring])?;
    let weight = Weight::new(&mut state, Vector3::z() * -gravity)?;
    let mut system = System::new(state, vec![Box::new(springs), Box::new(weight)]);

    // Position Verlet over one period, in 1000 steps. The spring starts at its rest length.
    let h = TAU * (mass / stiffness).sqrt() / 1000.0;
    let (mut lowest, mut place) = (0.0_f64, 0.0);
    for _ in 0..1000 {
        system.drift(0.5 * h);
        system.kick(h, h);
        system.drift(0.5 * h);
        place = system.state().points.position.get(points[1]).z + 1.0;
        lowest = lowest.min(place);
    }
    let theory = -2.0 * mass * gravity / stiffness;
    println!("lowest at {lowest:.5}; 2 m g / k = {theory:.5}");
    println!("after one period at {place:.5}; it began at 0");
    assert!((lowest / theory - 1.0).abs() < 1e-4 && place.abs() < 1e-4);
    Ok(())
}
