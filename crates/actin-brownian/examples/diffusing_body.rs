//! Diffusion of a body that is ten times as fast along its axis as across.

use actin_brownian::{
    Brownian, Dashpot, Frame, Friction, Inertia, Layout, Point, State, Stepper, System,
    TurnDashpot, UnitQuaternion, Vector3,
};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // A body along z with tenfold transverse friction and large rotational friction.
    let (mut state, mass, arm) = (State::default(), 1.0, Vector3::zeros());
    let position = Vector3::zeros();
    let point = state.points.push(Point { position, mass });
    let inertia = Inertia::from_moments([1.0, 1.0, 1.0])?;
    let orientation = UnitQuaternion::identity();
    let frame = state.frames.push(Frame {
        orientation,
        inertia,
    });
    let of_place = Vector3::new(100.0, 100.0, 10.0);
    let dashpots = vec![Dashpot::of_body(point, frame, arm, of_place)];
    let friction = Vector3::repeat(1e9);
    let turns = vec![TurnDashpot {
        frame,
        friction,
        is_sphere: false,
    }];
    let friction = Friction { dashpots, turns };

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
    println!("kT/zeta: {:.4} and {:.4} nm^2/ns", 0.0411, 0.411);
    assert!((diffusion.z / 0.411 - 1.0).abs() < 0.05);
    Ok(())
}
