//! The stiffness of whole assemblies is the derivative of their loads.
//!
//! With unknowns `u`, `K v = -d f(u + t v)/dt`. For a frame, half the cross product of its torque
//! with its rotation is added, since `f` is expressed in rotating axes.

use super::common::{build, newton};
use actin_mechanics::testing::derivative;
use actin_mechanics::{Coordinates, Loads, Vector3};
use actin_mechanics::{Xorshift, perturb};
use actin_sim::Assembly;
use nalgebra::DVector;

/// Laws of the rods and scale of their strains; 1 is +-5 %, far beyond the data of a potential.
const LAWS: [(&str, f64); 2] = [("Constant", 1.0), ("Homogenised", 0.05)];

/// Largest differences relative to the largest entry of the same kind: force and torque.
fn errors(assembly: &Assembly, seed: u64, strained: f64) -> (f64, f64) {
    let mut noise = Xorshift::new(seed);
    let mut state = assembly.system.state().clone();
    perturb(&mut state, &mut noise, 0.05 * strained, 0.02 * strained);
    let interactions = assembly.system.interactions();
    let mut newton = newton(assembly, 1e-8);
    newton.certify(&state, interactions).unwrap();
    let v: Vec<f64> = (0..newton.layout().unknowns())
        .map(|_| noise.sample())
        .collect();
    // Bonds are as short as 0.1 nm and move by 4 h in the outermost of eight points. The potential
    // of weakly strained rods varies on a smaller scale.
    let slope = derivative(2e-4 * strained.powi(2), |t| {
        let mut moved = state.clone();
        newton.layout().apply(&mut moved, &v, t);
        DVector::from_vec(newton.generalised_loads(&moved, interactions))
    });
    let product = newton.stiffness_times(&state, interactions, &v).unwrap();
    let mut difference = DVector::from_vec(product.clone()) + slope;
    let mut loads = Loads::zeros(&state);
    for interaction in interactions {
        interaction.add_loads(&state, &mut loads);
    }
    let mut torques = vec![false; v.len()];
    for i in 0..state.frames.len() {
        let Some(range) = newton.layout().unknowns_of(Coordinates::Frame(i)) else {
            continue;
        };
        let turn = Vector3::from_column_slice(&v[range.clone()]);
        let half = 0.5 * loads.torque.get(i).cross(&turn);
        for (k, u) in range.enumerate() {
            difference[u] -= half[k];
            torques[u] = true;
        }
    }
    let largest = |of: &dyn Fn(usize) -> f64, kind: bool| {
        let unknowns = (0..v.len()).filter(|&u| torques[u] == kind);
        unknowns.map(of).fold(0.0, f64::max)
    };
    let relative =
        |kind| largest(&|u| difference[u].abs(), kind) / largest(&|u| product[u].abs(), kind);
    (relative(false), relative(true))
}

fn check(name: &str, sections: &str, clamps: &str) {
    for (law, strained) in LAWS {
        check_under(law, strained, (name, sections, clamps));
    }
}

fn check_under(law: &str, strained: f64, (name, sections, clamps): (&str, &str, &str)) {
    let assembly = build(&format!(
        "Scene(
            filament: Filament(
                sections: [{sections}],
                monomers: Monomers(anchors: Independent, lateral_bonds: 16, longitudinal_bonds: 16),
                rod: RodModel(law: {law}),
            ),
            clamps: [{clamps}],
            task: Equilibrium(),
        )"
    ));
    for seed in 0..3 {
        let (force, torque) = errors(&assembly, seed, strained);
        println!("{name}, {law}: forces {force:.1e}, torques {torque:.1e}");
        assert!(
            force < 1e-7 && torque < 1e-7,
            "{name}, {law}: {force:e} {torque:e}"
        );
    }
}

#[test]
fn the_stiffness_is_the_derivative_of_the_loads() {
    let wall = "Clamp(end: Start)";
    check(
        "monomers on a wall",
        "Ellipsoids(from_nm: 0.0, to_nm: 30.0)",
        wall,
    );
    check("free monomers", "Ellipsoids(from_nm: 0.0, to_nm: 30.0)", "");
    check(
        "rod between walls",
        "Rod(from_nm: 0.0, to_nm: 40.0, segments: 4)",
        "Clamp(end: Start), Clamp(end: End)",
    );
    check(
        "rod, monomers, rod between walls",
        "Rod(from_nm: 0.0, to_nm: 20.0), Ellipsoids(from_nm: 20.0, to_nm: 40.0),
         Rod(from_nm: 40.0, to_nm: 60.0)",
        "Clamp(end: Start), Clamp(end: End, hold: NodeAndFrame)",
    );
    check(
        "monomers, rod, monomers between walls",
        "Ellipsoids(from_nm: 0.0, to_nm: 20.0), Rod(from_nm: 20.0, to_nm: 40.0),
         Ellipsoids(from_nm: 40.0, to_nm: 60.0)",
        "Clamp(end: Start), Clamp(end: End)",
    );
}
