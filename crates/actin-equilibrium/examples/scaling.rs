//! Time of a solve against the number of bodies.
//!
//! `cargo run --release -p actin-equilibrium --example scaling`

#[path = "../tests/integration/common/mod.rs"]
mod common;

use actin_equilibrium::{Layout, Newton, NewtonOptions};
use actin_mechanics::{Interaction, PointLoad, State, Vector3};
use common::{ACTIN, Rod, in_order};
use std::time::Instant;

fn main() {
    println!("rods (bodies: points and frames)");
    for segments in [16, 50, 500, 5_000, 50_000] {
        rod(segments, false);
    }
    println!("rods, one Newton step from the solution");
    for segments in [50, 500, 5_000, 50_000] {
        rod(segments, true);
    }
    println!("bonded filaments of 32 bonds per interface, 2 pN (160 nm / L)^2");
    for monomers in [30, 61, 122, 244] {
        filament(monomers);
    }
}

fn rod(segments: usize, again: bool) {
    let length = 10.0 * segments as f64;
    let rod = Rod {
        segments,
        length,
        ..ACTIN
    };
    let mut state = rod.state();
    let control = state.add_control(2.0 * (160.0 / length).powi(2));
    let load = PointLoad::new(&state, vec![(segments, 1.0)], Vector3::x(), control).unwrap();
    let mut terms = rod.interactions();
    terms.push(Box::new(load));
    let mut newton = rod.newton(&state);
    if again {
        if newton.solve(&mut state, &terms).is_err() {
            println!("no equilibrium");
            return;
        }
        state.controls[control] *= 1.0 + 1e-6;
    }
    report(2 * segments + 2, &mut newton, &mut state, &terms);
}

fn filament(monomers: usize) {
    let (mut state, bonds) = common::filament(monomers, 32, 5);
    let length = 160.0 * monomers as f64 / 60.0;
    let control = state.add_control(2.0 * (160.0 / length).powi(2));
    let shares = vec![(monomers - 1, 0.5), (monomers - 2, 0.5)];
    let load = PointLoad::new(&state, shares, Vector3::x(), control).unwrap();
    let terms: Vec<Box<dyn Interaction>> = vec![Box::new(bonds), Box::new(load)];
    let layout = Layout::new(&state, Some(&in_order(&state))).expect("it fits");
    let mut newton =
        Newton::new(layout, NewtonOptions::default()).expect("the default options are valid");
    report(2 * monomers, &mut newton, &mut state, &terms);
}

fn report(bodies: usize, newton: &mut Newton, state: &mut State, terms: &[Box<dyn Interaction>]) {
    let clock = Instant::now();
    let result = newton.solve(state, terms);
    let milliseconds = clock.elapsed().as_secs_f64() * 1e3;
    match result {
        Ok(equilibrium) => {
            let work = equilibrium.work;
            println!(
                "{bodies:7} bodies {milliseconds:9.2} ms {:4} steps {:5} factorisations {:9} entries {:?} {:.1e} pN {:?}",
                work.iterations,
                work.factorizations,
                work.factor_entries,
                equilibrium.ending,
                equilibrium.residual.force,
                equilibrium.certificate.map(|c| c.stability()),
            );
        }
        Err(failure) => println!("{bodies:7} bodies {milliseconds:9.2} ms: {failure}"),
    }
}
