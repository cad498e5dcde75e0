//! A body diffuses in a fluid, ten times as fast along its axis as across.

use actin_brownian::{
    Brownian, Dashpot, Frame, Friction, Inertia, Layout, Point, State, Stepper, System,
    TurnDashpot, UnitQuaternion, Vector3,
};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // A body along z that is ten times as hard to move across as along, and hardly turns.
    let mut state = State::default();
    let (position, mass) = (Vector3::zeros(), 1.0);
    let point = state.points.push(Point { position, mass });
    let (orientation, inertia) = (
        UnitQuaternion::identity(),
        Inertia::from_moments([1.0, 1.0, 1.0])?,
    );
    let frame = state.frames.push(Frame {
        orientation,
        inertia,
    });
    let along_and_across = Vector3::new(100.0, 100.0, 10.0);
    let friction = Friction {
        dashpots: vec![Dashpot::of_body(
            point,
            frame,
            Vector3::zeros(),
            along_and_across,
        )],
        turns: vec![TurnDashpot {
            frame,
            friction: Vector3::repeat(1e9),
        }],
    };

    let (thermal_energy, seed, h, steps) = (4.11, 1, 1.0, 20_000);
    let mut system = System::new(state, vec![]);
    let layout = Layout::free(system.state());
    let mut brownian = Brownian::new(&system, layout, friction, (thermal_energy, seed))?;
    let (mut before, mut squares) = (position, Vector3::zeros());
    for step in 0..steps {
        brownian.step(&mut system, step, h)?;
        let here = system.state().points.position.get(point);
        squares += (here - before).component_mul(&(here - before));
        before = here;
    }
    let diffusion = squares / (2.0 * h * steps as f64);
    println!(
        "across {:.4}, along {:.4} nm^2/ns",
        diffusion.x, diffusion.z
    );
    println!("kT/zeta is {:.4} and {:.4}", 4.11 / 100.0, 4.11 / 10.0);
    assert!((diffusion.z / 0.411 - 1.0).abs() < 0.05);
    Ok(())
}
