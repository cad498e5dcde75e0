//! Minimum of a user-defined energy: a point between two wells moves to one of them.

use actin_equilibrium::{
    Coordinates, EquilibriumError, Interaction, Loads, Matrix3, Point, SecondOrder, State,
    Stiffness, Vector3, relax,
};

/// `E = (x^2 - 4)^2 + y^2 + z^2` of point 0, with minima at `x = -2` and `x = 2`.
#[derive(Debug)]
struct DoubleWell;

impl Interaction for DoubleWell {
    fn term(&self) -> &'static str {
        "double well"
    }
    fn elements(&self) -> usize {
        1
    }
    fn write_energies(&self, state: &State, energies: &mut [f64]) {
        let r = state.points.position.get(0);
        energies[0] = (r.x * r.x - 4.0).powi(2) + r.y * r.y + r.z * r.z;
    }
    fn add_loads(&self, state: &State, loads: &mut Loads) {
        let r = state.points.position.get(0);
        let gradient = Vector3::new(4.0 * r.x * (r.x * r.x - 4.0), 2.0 * r.y, 2.0 * r.z);
        loads.force.add(0, -gradient);
    }
    fn second_order(&self) -> Option<&dyn SecondOrder> {
        Some(self)
    }
}

impl SecondOrder for DoubleWell {
    fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
        let x = state.points.position.get(0).x;
        let diagonal = Vector3::new(12.0 * x * x - 16.0, 2.0, 2.0);
        let point = Coordinates::Point(0);
        stiffness.push(point, point, Matrix3::from_diagonal(&diagonal));
    }
}

fn main() -> Result<(), EquilibriumError> {
    let (mut state, mass) = (State::default(), 1.0);
    let position = Vector3::new(0.0, 0.3, -0.1);
    state.points.push(Point { position, mass });
    let found = relax(&mut state, &[Box::new(DoubleWell)])?;

    let r = state.points.position.get(0);
    println!("at ({:.6}, {:.6}, {:.6})", r.x, r.y, r.z);
    println!(
        "energy {:.1e}, after {} saddle(s)",
        found.energy, found.saddles_left
    );
    assert!((r.x.abs() - 2.0).abs() < 1e-9 && found.saddles_left == 1);
    Ok(())
}
