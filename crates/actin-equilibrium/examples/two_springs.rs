//! Weight between two springs: equilibrium position compared with the balance of forces.

use actin_equilibrium::{Point, Spring, Springs, State, Vector3, Weight, relax};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Ceiling and floor are held points.
    let (stiffness, rest_length, mass, acceleration) = (50.0, 0.5, 2.0, 9.81);
    let mut state = State::default();
    let [ceiling, body, floor] = [1.0, 0.0, -1.0].map(|height| {
        let position = Vector3::z() * height;
        state.points.push(Point { position, mass })
    });
    state.points.hold(ceiling);
    state.points.hold(floor);

    let springs = [[ceiling, body], [body, floor]].map(|points| Spring {
        points,
        stiffness,
        rest_length,
    });
    let springs = Springs::new(&state, springs.to_vec())?;
    let weight = Weight::new(&mut state, Vector3::z() * -acceleration)?;
    relax(&mut state, &[Box::new(springs), Box::new(weight)])?;

    let sinks = -state.points.position.get(body).z;
    let theory = mass * acceleration / (2.0 * stiffness);
    println!("the body sinks by {sinks:.9}; m g / 2 k = {theory:.9}");
    assert!((sinks - theory).abs() < 1e-9);
    Ok(())
}
