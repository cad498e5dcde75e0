use super::capsule::{Capsule, Row};
use actin_mechanics::{Interaction, Loads, State, Vector3};

/// Springs from all points of the axes to their positions in a given state: term `repulsion`, one
/// element.
///
/// Tethers with the largest contact stiffness per length bound the frequencies of a system with
/// contacts:
///
/// ```text
/// w^2 <= w_0^2 + w_t^2
/// ```
///
/// `w` is the largest frequency with contacts, `w_0` without contacts, and `w_t` the largest
/// frequency of tethers alone.
#[derive(Clone, Debug)]
pub struct Tethers {
    capsules: Vec<Capsule>,
    rows: Vec<Row>,
    places: Vec<[Vector3; 2]>,
    stiffness: f64,
}

impl Tethers {
    /// Creates tethers with a stiffness per length (pN/nm^2) for capsules of a radius (nm).
    pub fn new(state: &State, capsules: &[Capsule], radius: f64, stiffness: f64) -> Self {
        Self {
            rows: capsules.iter().map(|c| Row::new(c, radius)).collect(),
            places: capsules.iter().map(|c| c.ends(state)).collect(),
            capsules: capsules.to_vec(),
            stiffness,
        }
    }
}

impl Interaction for Tethers {
    fn term(&self) -> &'static str {
        "repulsion"
    }

    fn add_loads(&self, state: &State, loads: &mut Loads) {
        for ((capsule, row), places) in self.capsules.iter().zip(&self.rows).zip(&self.places) {
            let ends = capsule.ends(state);
            let apart = [ends[0] - places[0], ends[1] - places[1]];
            let mut forces = [Vector3::zeros(); 2];
            for k in 0..row.count {
                let share = row.share(k);
                let force = apart[0] * (1.0 - share) + apart[1] * share;
                let force = force * (-self.stiffness * row.weight);
                forces[0] += force * (1.0 - share);
                forces[1] += force * share;
            }
            capsule.add_forces(forces, state, loads);
        }
    }

    fn elements(&self) -> usize {
        1
    }

    fn write_energies(&self, state: &State, energies: &mut [f64]) {
        assert_eq!(energies.len(), 1, "all tethers are one element");
        let mut energy = 0.0;
        for ((capsule, row), places) in self.capsules.iter().zip(&self.rows).zip(&self.places) {
            let ends = capsule.ends(state);
            let apart = [ends[0] - places[0], ends[1] - places[1]];
            for k in 0..row.count {
                let share = row.share(k);
                let by = apart[0] * (1.0 - share) + apart[1] * share;
                energy += 0.5 * self.stiffness * row.weight * by.norm_squared();
            }
        }
        energies[0] = energy;
    }
}
