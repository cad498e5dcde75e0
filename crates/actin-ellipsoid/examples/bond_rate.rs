//! Prints the evaluation rate of loads and second derivatives in bonds per second on one thread.
//!
//! `cargo run --release -p actin-ellipsoid --example bond_rate`

use actin_ellipsoid::{Bonds, EllipsoidModel, EllipsoidParameters, Placement};
use actin_mechanics::{Interaction, Loads, SecondOrder, State, Stiffness};
use actin_mechanics::{Xorshift, perturb};
use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    for monomers in [60, 1000] {
        for bonds in [10, 64] {
            let (state, bonds) =
                filament(monomers, EllipsoidParameters::with_sampled_bonds(bonds, 0))?;
            print_rates("drawn", &state, &bonds);
        }
        let (state, bonds) = filament(monomers, EllipsoidParameters::default())?;
        print_rates("weighted", &state, &bonds);
    }
    Ok(())
}

fn filament(
    count: usize,
    parameters: EllipsoidParameters,
) -> Result<(State, Bonds), Box<dyn Error>> {
    let model = EllipsoidModel::new(parameters)?;
    let mut state = State::default();
    let monomers = model
        .build(&mut state, &Placement::default(), 0, count)
        .unwrap();
    let bonds = model.bonds(&monomers)?;
    perturb(&mut state, &mut Xorshift::new(1), 0.05, 0.05);
    Ok((state, bonds))
}

fn print_rates(kind: &str, state: &State, bonds: &Bonds) {
    let number = bonds.number_of_bonds();
    let mut loads = Loads::zeros(state);
    let of_loads = seconds(500_000 / number, || {
        loads.clear();
        bonds.add_loads(black_box(state), black_box(&mut loads));
    });
    let mut stiffness = Stiffness::default();
    let of_stiffness = seconds(500_000 / number, || {
        stiffness.clear();
        bonds.add_stiffness(black_box(state), black_box(&mut stiffness));
    });
    let million_per_second = 1e-6 * number as f64;
    println!(
        "{:5} monomers, {:5} {kind} bonds: loads {:6.1}, second derivatives {:5.1} million bonds/s ({:.1} us)",
        bonds.monomers().count,
        number,
        million_per_second / of_loads,
        million_per_second / of_stiffness,
        1e6 * of_stiffness
    );
}

/// Seconds per evaluation: minimum over many short batches.
fn seconds(evaluations: usize, mut evaluate: impl FnMut()) -> f64 {
    let batch = || {
        let start = Instant::now();
        for _ in 0..evaluations {
            evaluate();
        }
        start.elapsed().as_secs_f64() / evaluations as f64
    };
    std::iter::repeat_with(batch)
        .take(400)
        .fold(f64::INFINITY, f64::min)
}
