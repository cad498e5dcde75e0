//! Tests of the properties of networks.

use super::super::tests::{build, observe, value};
use super::cluster_sizes;
use super::quantiles;
use crate::Assembly;
use std::f64::consts::PI;

const BUNDLE: &str = "Scene(
    arrangements: [Bundle(
        filament: Filament(
            sections: [Rod(from_nm: 0.0, to_nm: 300.0)], rod: (law: Constant), direction: (0.0, 1.0, 1.0),
        ),
        count: 7, spacing_nm: 12.0, mixed_polarity: true, seed: 2,
    )],
    linker_sets: [LinkersBetween(
        per_filament: 2.0, reach_nm: 15.0, stiffness_pn_per_nm: 3.0, rest_length_nm: 11.0, seed: 1,
    )],
    observe: [Network],
    task: Brownian(duration_ms: 0.001, temperature_k: 298.0, seed: 1),
)";

/// Bound crosslinkers join the filaments of their hands.
#[test]
fn crosslinkers_form_clusters() {
    let text = "Scene(
        filaments: [
            Filament(rod: (law: Constant), sections: [Rod(from_nm: 0.0, to_nm: 100.0, segments: 2)]),
            Filament(rod: (law: Constant), sections: [Rod(from_nm: 0.0, to_nm: 100.0, segments: 2)], at_nm: (500.0, 0.0, 0.0)),
            Filament(rod: (law: Constant), sections: [Rod(from_nm: 0.0, to_nm: 100.0, segments: 2)], at_nm: (512.0, 0.0, 0.0)),
        ],
        crosslinkers: [Crosslinkers(count: 3, stiffness_pn_per_nm: 0.2, rest_length_nm: 10.0,
            attach_per_ns: 1e-4, bind_per_ns: 1e-4, unbinds: Breaking(rate_per_ns: 1e-7), seed: 8)],
        clamps: [Clamp(end: Start), Clamp(filament: 1, end: Start), Clamp(filament: 2, end: Start)],
        observe: [Network],
        task: Brownian(duration_ms: 0.1, temperature_k: 298.0, time_step_ns: 500.0, seed: 1),
    )";
    let assembly = build(text);
    let (trajectory, _) = crate::Plan::new(&assembly).unwrap().run().unwrap();
    let last = &trajectory.records.last().unwrap().state;
    let observed = observe(&assembly, last);
    assert!(value(&assembly, &observed, "network_bound_linkers") > 0.0);
    assert!((value(&assembly, &observed, "network_clusters") - 2.0).abs() < 1e-12);
}

/// Crosslinkers bind across a face of a periodic box, to sites 20 nm away.
#[test]
fn crosslinkers_bind_to_nearest_images() {
    let text = "Scene(
        filaments: [
            Filament(rod: (law: Constant), sections: [Rod(from_nm: 0.0, to_nm: 100.0, segments: 2)]),
            Filament(rod: (law: Constant), sections: [Rod(from_nm: 0.0, to_nm: 100.0, segments: 2)], at_nm: (180.0, 0.0, 400.0)),
        ],
        crosslinkers: [Crosslinkers(count: 3, stiffness_pn_per_nm: 0.2, rest_length_nm: 20.0, reach_nm: 20.0,
            attach_per_ns: 1e-4, bind_per_ns: 1e-4, unbinds: Breaking(rate_per_ns: 1e-7), seed: 8)],
        periodic: PeriodicBox(size_nm: (200.0, 200.0, 200.0)),
        clamps: [Clamp(end: Start), Clamp(filament: 1, end: Start)],
        observe: [Network],
        task: Brownian(duration_ms: 0.1, temperature_k: 298.0, time_step_ns: 500.0, seed: 1),
    )";
    let assembly = build(text);
    let (trajectory, _) = crate::Plan::new(&assembly).unwrap().run().unwrap();
    let row = &trajectory.records.last().unwrap().row.observed;
    assert!(value(&assembly, row, "network_bound_linkers") > 0.0);
    // 0.2 pN/nm times at most the reach and thermal motion.
    assert!(value(&assembly, row, "network_linker_tension_largest_pn") < 8.0);
}

/// A bundle has order parameter 1, the polarity of its directions, and linkers with known tensions.
#[test]
fn a_bundle_is_ordered_and_linked() {
    let assembly = build(BUNDLE);
    let row = observe(&assembly, &assembly.rest);
    let column = |name: &str| value(&assembly, &row, &format!("network_{name}"));
    assert!((column("order_parameter") - 1.0).abs() < 1e-9);
    let directions = assembly
        .scene
        .filaments()
        .map(|one| one.direction[2].signum());
    let polarity = directions.sum::<f64>().abs() / 7.0;
    assert!((column("polarity") - polarity).abs() < 1e-9);
    assert!((column("bound_linkers") - 14.0).abs() < 0.5);
    // Sites at equal arc length are 12 nm apart, others further, up to the reach.
    assert!((column("linker_tension_smallest_pn") - 3.0).abs() < 1e-6);
    assert!(column("linker_tension_largest_pn") <= 12.0);
    let [along, across] = [300.0_f64.powi(2) / 12.0, 3.0 / 7.0 * 144.0];
    let radius = (along + 2.0 * across).sqrt();
    assert!((column("gyration_radius_nm") - radius).abs() < 1e-6);
    let volume = 4.0 / 3.0 * PI * (125.0 * along * across * across).sqrt();
    // Cancellation in the gyration tensor: 1e-16 of 1e4 nm^2 relative to 60 nm^2.
    let mesh = (volume / 700.0).sqrt();
    assert!((column("mesh_size_nm") / mesh - 1.0).abs() < 1e-9);
}

#[test]
fn quantiles_are_linear_between_values() {
    let found = quantiles(vec![4.0, 1.0, 2.0, 3.0, 0.0]);
    let errors = found.iter().zip([0.2, 1.0, 2.0, 3.0, 3.8]);
    assert!(errors.map(|(a, b)| (a - b).abs()).all(|e| e < 1e-15));
    assert!(
        quantiles(vec![7.0])
            .iter()
            .all(|value| (value - 7.0).abs() < 1e-15)
    );
    assert!(quantiles(Vec::new()).iter().all(|value| value.is_nan()));
}

/// The virial is the derivative of the energy with respect to a uniform strain of all points.
#[test]
fn the_virial_is_a_derivative_with_respect_to_strain() {
    let assembly = build(BUNDLE);
    let row = observe(&assembly, &assembly.rest);
    let energy = |i: usize, j: usize, strain: f64| {
        let mut state = assembly.rest.clone();
        for k in 0..state.points.len() {
            let mut place = state.points.position.get(k);
            let (x, y) = (place[i], place[j]);
            place[i] += 0.5 * strain * y;
            place[j] += 0.5 * strain * x;
            state.points.position.set(k, place);
        }
        let interactions = assembly.system.interactions().iter();
        interactions.map(|one| one.energy(&state)).sum::<f64>()
    };
    // Central differences of energies near 100 pN nm are exact to 1e-16 * 100 / h from rounding and h^2 / 6 times a
    // third derivative of 1e6 pN nm.
    let h = 1e-5;
    for (name, i, j) in super::COMPONENTS {
        let slope = (energy(i, j, h) - energy(i, j, -h)) / (2.0 * h);
        let virial = value(&assembly, &row, &format!("network_virial_{name}_pn_nm"));
        assert!((slope - virial).abs() < 1e-4, "{name}: {slope} {virial}");
    }
}

const SHEARED: &str = "Scene(
    arrangements: [Random(
        filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 200.0, segments: 5)], rod: (law: Constant)),
        count: 8, box_nm: (150.0, 150.0, 150.0), seed: 1,
    )],
    linker_sets: [LinkersBetween(
        per_filament: 7.0, reach_nm: 60.0, site_spacing_nm: 9.0, stiffness_pn_per_nm: 3.0, radius_nm: 4.0, seed: 1,
    )],
    periodic: PeriodicBox(size_nm: (150.0, 150.0, 150.0), strain: 0.05),
    path: [Stage(set: [Shear(factor: 0.99)]), Stage(set: [Shear(factor: 1.0)]), Stage(set: [Shear(factor: 1.01)])],
    observe: [Network],
    task: Equilibrium(),
)";

/// The shear stress times the volume is the derivative of the energy of equilibria with respect to the strain.
#[test]
fn the_shear_stress_is_a_derivative_of_the_energy() {
    let assembly = build(SHEARED);
    let mut linkers = assembly.linkers.iter();
    assert!(linkers.any(|linker| linker.image().is_some()));
    check_shear_stress(&assembly);
    let angular = SHEARED.replace(
        "radius_nm: 4.0,",
        "radius_nm: 4.0, tilt_pn_nm: 2000.0, twist_pn_nm: 1000.0,",
    );
    let assembly = build(&angular);
    let mut linkers = assembly.linkers.iter();
    assert!(linkers.all(|linker| linker.angles().is_some()));
    check_shear_stress(&assembly);
    let repelled = SHEARED
        .replace(
            "seed: 1,\n    )],\n    linker_sets",
            "seed: 1, apart_nm: 15.0,\n    )],\n    linker_sets",
        )
        .replace(
            "observe:",
            "repulsion: Repulsion(radius_nm: 10.0), observe:",
        );
    let assembly = build(&repelled);
    let contacts = assembly.repelled.as_ref().unwrap().contacts.as_ref();
    let across = contacts.unwrap().periodic_virial(&assembly.rest);
    assert!(across.amax() > 100.0, "{across}");
    check_shear_stress(&assembly);
}

fn check_shear_stress(assembly: &Assembly) {
    let (trajectory, _) = crate::Plan::new(assembly).unwrap().run().unwrap();
    let records = &trajectory.records;
    let record = |path: f64| {
        let mut all = records.iter();
        let found = all.find(|record| (record.at.value() - path).abs() < 1e-9);
        found.expect("a stage ends here")
    };
    let energy = |path: f64| record(path).row.potential_pn_nm();
    let slope = (energy(3.0) - energy(1.0)) / (0.02 * 0.05);
    let row = &record(2.0).row.observed;
    let virial = value(assembly, row, "network_virial_xz_pn_nm");
    let stress = value(assembly, row, "network_stress_xz_pa");
    println!("{slope} {virial} pN nm, {stress} Pa");
    // Truncation: strains differ by 1 %.
    assert!((slope / virial - 1.0).abs() < 1e-3 && stress > 0.0);
    assert!((stress * 150.0_f64.powi(3) / (virial * 1e6) - 1.0).abs() < 1e-12);
}

/// Two rods across the plane of shear, joined by symmetric linkers to images, are a Maxwell element:
///
/// ```text
/// G' = G x^2 / (1 + x^2),   G'' = G x / (1 + x^2),   G = k h^2 / V
/// ```
///
/// `x` is the frequency in units of the relaxation rate, and `h` the distance of the joined sites along z.
#[test]
fn moduli_of_a_maxwell_element() {
    let text = "Scene(
        filaments: [
            Filament(sections: [Rod(from_nm: 0.0, to_nm: 40.0, segments: 2)], rod: (law: Constant),
                direction: (0.0, 1.0, 0.0), at_nm: (0.0, 0.0, 40.0)),
            Filament(sections: [Rod(from_nm: 0.0, to_nm: 40.0, segments: 2)], rod: (law: Constant),
                direction: (0.0, 1.0, 0.0), at_nm: (-30.0, 0.0, 0.0)),
        ],
        linkers: [
            Linker(at_nm: 20.0, to: Site(filament: 1, at_nm: 20.0), image: (0, 0, 1), stiffness_pn_per_nm: 0.02,
                rest_length_nm: 50.0),
            Linker(at_nm: 20.0, to: Site(filament: 1, at_nm: 20.0), image: (1, 0, 1), stiffness_pn_per_nm: 0.02,
                rest_length_nm: 50.0),
        ],
        periodic: PeriodicBox(size_nm: (60.0, 100.0, 80.0), strain: 0.01, factor: Sine(period_ns: 40000.0)),
        observe: [Network],
        task: Brownian(
            duration_ms: 0.4, temperature_k: 0.0, time_step_ns: 100.0, record_every_ns: 2000.0,
            drag: Water(viscosity_mpa_s: 1.0),
        ),
    )";
    let assembly = build(text);
    let (trajectory, _) = crate::Plan::new(&assembly).unwrap().run().unwrap();
    let records = &trajectory.records;
    let mean = |column: &str| {
        let periods = &records[records.len() - 40..];
        let values = periods
            .iter()
            .map(|one| value(&assembly, &one.row.observed, column));
        values.sum::<f64>() / 40.0
    };
    let [storage, loss] = super::MODULI.map(mean);
    // Two linkers at slopes of 3 : 4, k = 2 * 0.02 * 0.36 pN/nm, h = 40 nm.
    let plateau = 2.0 * 0.02 * 0.36 * 40.0_f64.powi(2) / (60.0 * 100.0 * 80.0) * 1e6;
    let frequency = storage / loss;
    println!("{storage} {loss} Pa, plateau {plateau} Pa, relative frequency {frequency}");
    assert!((0.2..5.0).contains(&frequency));
    // The linkers turn by 0.02 rad. Rods bend by 0.1 % of their displacement.
    let expected = plateau * frequency.powi(2) / (1.0 + frequency.powi(2));
    assert!((storage / expected - 1.0).abs() < 3e-3, "{expected}");
}

#[test]
fn moduli_that_are_missing_or_have_no_error_are_noted() {
    let notes = |duration_ms: f64, path: &str| {
        let text = format!(
            "Scene(
                filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 40.0, segments: 2)], rod: (law: Constant)),
                periodic: PeriodicBox(size_nm: (90.0, 90.0, 90.0), strain: 0.01, factor: Sine(period_ns: 40000.0)),
                path: [{path}],
                observe: [Network],
                burn_in_ns: 40000.0,
                task: Brownian(duration_ms: {duration_ms:?}, temperature_k: 298.0, record_every_ns: 4000.0, seed: 1),
            )"
        );
        let assembly = build(&text);
        let notes = crate::Plan::new(&assembly).unwrap().notes();
        let messages = notes.into_iter().map(|note| note.message);
        messages
            .filter(|note| note.contains("loss modulus"))
            .collect::<String>()
    };
    assert!(notes(0.08, "").contains("of one period"));
    assert_eq!(notes(0.12, ""), "");
    let path = "Stage(set: [Shear(factor: 1.0)], duration_ns: 40000.0)";
    assert!(notes(0.12, path).contains("Shear"));
}

#[test]
fn clusters_are_sets_of_joined_filaments() {
    let mut sizes = cluster_sizes(6, &[[0, 1], [4, 5], [1, 4], [5, 0]]);
    sizes.sort_unstable();
    assert_eq!(sizes, [1, 1, 4]);
}
