//! Linker events in a constant state: rates, places and energies against closed forms. Tolerances
//! are 4.5 standard errors at fixed seeds.

use super::LinkerEvent;
use super::LinkerEventKind::{self, Formed, Left, Stepped};
use crate::Assembly;
use crate::scene::Scene;
use actin_mechanics::{State, Vector3};

/// Time step (ns), far beyond a stable step of a motion; the bodies are fixed here.
const STEP_NS: f64 = 1.0;

fn linkers(count: usize, linker: &str, kinetics: &str) -> Assembly {
    let one = format!("Linker({linker}, kinetics: Kinetics(seed: 5, {kinetics})),");
    let text = format!(
        "Scene(
            filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 80.0)]),
            linkers: [{}],
            task: Dynamics(duration_ns: 1.0),
        )",
        one.repeat(count)
    );
    Assembly::build(&Scene::from_ron(&text).unwrap_or_else(|e| panic!("{e}"))).unwrap()
}

fn events(assembly: &Assembly, state: &mut State, steps: std::ops::Range<u64>) -> Vec<LinkerEvent> {
    let kinetics = assembly.kinetics.as_ref().unwrap();
    let mut all = Vec::new();
    for step in steps {
        kinetics.end_step(state, step, STEP_NS, |event| all.push(event));
    }
    all
}

fn probability(rate: f64) -> f64 {
    1.0 - (-rate * STEP_NS).exp()
}

/// Mean and standard error of the lifetimes of linkers under 5 pN, and the expectation of the
/// geometric distribution.
fn lifetime(kinetics: &str, rate: f64) -> (f64, f64, f64) {
    let linker = "at_nm: 40.0, displaced_nm: (10.0, 0.0, 0.0), stiffness_pn_per_nm: 0.5";
    let count = 2000;
    let assembly = linkers(count, linker, kinetics);
    let broken = events(&assembly, &mut assembly.rest.clone(), 1..2000);
    assert_eq!(broken.len(), count, "each linker must break exactly once");
    for event in &broken {
        assert_eq!(event.what, LinkerEventKind::Broke);
        assert!((event.force_pn - 5.0).abs() < 1e-9 && (event.energy_pn_nm + 25.0).abs() < 1e-9);
    }
    let mean = broken.iter().map(|e| e.time_ns).sum::<f64>() / count as f64;
    let p = probability(rate);
    let error = (1.0 - p).sqrt() / p / (count as f64).sqrt();
    (mean, STEP_NS / p, error)
}

/// Bell's rate, a constant rate and a catch bond.
#[test]
fn lifetimes_under_force_agree_with_the_rates() {
    let e = std::f64::consts::E;
    for (kinetics, rate) in [
        ("breaks: Breaking(rate_per_ns: 0.02)", 0.02),
        (
            "breaks: Breaking(rate_per_ns: 0.01, force_pn: 5.0)",
            0.01 * e,
        ),
        (
            "breaks: Breaking(rate_per_ns: 0.005, force_pn: 5.0, catch: Catch(rate_per_ns: 0.05, force_pn: 2.5))",
            0.005 * e + 0.05 / (e * e),
        ),
    ] {
        let (mean, expected, error) = lifetime(kinetics, rate);
        assert!((mean - expected).abs() < 4.5 * error, "{mean}, {expected}");
    }
}

/// The bound fraction is `k_on / (k_on + k_off)`, in terms of probabilities for long steps.
#[test]
fn bound_fraction_follows_detailed_balance() {
    let linker = "at_nm: 40.0, displaced_nm: (3.0, 0.0, 0.0), stiffness_pn_per_nm: 0.5";
    let kinetics = "bound: false, breaks: Breaking(rate_per_ns: 0.02),
        forms: Forming(rate_per_ns: 0.05, reach_nm: 3.5)";
    let count = 1000;
    let assembly = linkers(count, linker, kinetics);
    let mut state = assembly.rest.clone();
    let happened = events(&assembly, &mut state, 1..200);
    let net: f64 = happened.iter().map(|e| e.energy_pn_nm).sum();
    assert!((assembly.booked(&state).events_pn_nm - net).abs() < 1e-9);
    let (mut held, steps) = (0, 600_u64);
    for step in 200..200 + steps {
        events(&assembly, &mut state, step..step + 1);
        held += (0..count)
            .filter(|&i| assembly.switched(i, &state).unwrap().0)
            .count();
    }
    let (on, off) = (probability(0.05), probability(0.02));
    let (share, expected) = (held as f64 / (count as f64 * steps as f64), on / (on + off));
    // The states of a linker decorrelate within (1 + c)/(1 - c) steps, c = 1 - on - off.
    let c = 1.0 - on - off;
    let seen = count as f64 * steps as f64 * (1.0 - c) / (1.0 + c);
    let error = (expected * (1.0 - expected) / seen).sqrt();
    assert!(
        (share - expected).abs() < 4.5 * error,
        "{share}, {expected}"
    );
}

#[test]
fn linkers_out_of_reach_do_not_form() {
    let linker =
        "at_nm: 40.0, displaced_nm: (3.0, 0.0, 0.0), stiffness_pn_per_nm: 0.5, rest_length_nm: 1.0";
    let kinetics =
        |reach: f64| format!("bound: false, forms: Forming(rate_per_ns: 0.5, reach_nm: {reach:?})");
    for (reach, formed) in [(1.9, 0), (2.1, 10)] {
        let assembly = linkers(10, linker, &kinetics(reach));
        let happened = events(&assembly, &mut assembly.rest.clone(), 1..100);
        assert_eq!(happened.len(), formed);
        // k 2^2 / 2.
        assert!(happened.iter().all(|e| (e.energy_pn_nm - 1.0).abs() < 1e-9));
    }
}

fn stepped(step_nm: f64, from_nm: f64, force: f64) -> f64 {
    // Far enough that steps do not change the force.
    let (far, direction) = (2e5, -step_nm.signum());
    let linker = format!(
        "at_nm: {from_nm:?}, displaced_nm: (0.0, 0.0, {:?}), stiffness_pn_per_nm: {:?}",
        far * direction * force.signum(),
        force.abs() / far
    );
    let kinetics =
        format!("steps: Stepping(step_nm: {step_nm:?}, rate_per_ns: 0.05, stall_pn: 5.0)");
    let assembly = linkers(400, &linker, &kinetics);
    let mut state = assembly.rest.clone();
    let happened = events(&assembly, &mut state, 1..301);
    for (i, _) in assembly.linkers.iter().enumerate() {
        let own = happened.iter().filter(|e| e.linker == i);
        let at = from_nm + step_nm * own.count() as f64;
        assert!((assembly.switched(i, &state).unwrap().1 - at).abs() < 1e-9);
    }
    happened.len() as f64 / 400.0
}

/// Stepping rate: full without force, half at half the stall force, zero at stall, and not
/// increased by assisting force.
#[test]
fn sites_step_at_the_rate_and_stall() {
    for (step_nm, from_nm) in [(2.0, 0.0), (-2.0, 80.0)] {
        for (force, rate) in [(1e-9, 0.05), (2.5, 0.025), (-3.0, 0.05)] {
            let mean = stepped(step_nm, from_nm, force);
            let p = probability(rate);
            let (expected, error) = (300.0 * p, (300.0 * p * (1.0 - p) / 400.0).sqrt());
            assert!((mean - expected).abs() < 4.5 * error, "{mean}, {expected}");
        }
        assert!(stepped(step_nm, from_nm, 5.001) <= 0.0);
    }
}

#[test]
fn the_end_of_the_filament_ends_the_steps() {
    let linker = "at_nm: 75.0, displaced_nm: (0.0, 0.0, 0.0), stiffness_pn_per_nm: 0.01";
    let steps = |leaves: bool| {
        format!(
            "steps: Stepping(step_nm: 2.5, rate_per_ns: 0.5, stall_pn: 5.0, leaves_at_end: {leaves}),
             forms: Forming(rate_per_ns: 0.5, reach_nm: 0.1)"
        )
    };
    let of = |leaves| {
        let assembly = linkers(1, linker, &steps(leaves));
        let happened = events(&assembly, &mut assembly.rest.clone(), 1..60);
        happened
            .iter()
            .map(|e| (e.what, e.at_nm))
            .collect::<Vec<_>>()
    };
    assert_eq!(of(false), [(Stepped, 77.5), (Stepped, 80.0)]);
    let cycle = [
        (Stepped, 77.5),
        (Stepped, 80.0),
        (Left, 80.0),
        (Formed, 75.0),
        (Stepped, 77.5),
    ];
    assert_eq!(of(true)[..5], cycle);
}

#[test]
fn events_belong_to_seed_step_and_linker() {
    let linker = "at_nm: 40.0, displaced_nm: (3.0, 0.0, 0.0), stiffness_pn_per_nm: 0.5";
    let kinetics =
        "breaks: Breaking(rate_per_ns: 0.02), forms: Forming(rate_per_ns: 0.05, reach_nm: 9.0)";
    let (few, many) = (linkers(3, linker, kinetics), linkers(50, linker, kinetics));
    let late = events(&few, &mut few.rest.clone(), 500..700);
    let mut of_many = events(&many, &mut many.rest.clone(), 500..700);
    of_many.retain(|e| e.linker < 3);
    assert_eq!(late, of_many);
    let mut scene = few.scene.clone();
    assert_eq!(scene.reseed(crate::scene::RandomPart::Linkers, 6), 3);
    let other = Assembly::build(&scene).unwrap();
    assert_ne!(late, events(&other, &mut other.rest.clone(), 500..700));
}

#[test]
fn great_tension_breaks() {
    let linker = "at_nm: 40.0, displaced_nm: (20.0, 0.0, 0.0), stiffness_pn_per_nm: 100.0";
    let kinetics = "breaks: Breaking(rate_per_ns: 1e-3, force_pn: 2.0)";
    let assembly = linkers(1, linker, kinetics);
    let broken = events(&assembly, &mut assembly.rest.clone(), 1..2);
    assert_eq!(broken.len(), 1);
    assert_eq!(broken[0].what, LinkerEventKind::Broke);
}

#[test]
fn forming_takes_the_place_of_least_strain() {
    let linker =
        "at_nm: 40.0, anchor_nm: (2.0, 0.0, 50.0), rest_length_nm: 10.0, stiffness_pn_per_nm: 1.0";
    let kinetics = "bound: false, forms: Forming(rate_per_ns: 50.0, reach_nm: 1.0),
        steps: Stepping(step_nm: 5.0, rate_per_ns: 1e-9, stall_pn: 5.0)";
    let assembly = linkers(1, linker, kinetics);
    let mut state = assembly.rest.clone();
    assert!(!assembly.linker_in(0, &state).1);
    let formed = events(&assembly, &mut state, 1..5);
    assert_eq!(formed[0].what, Formed);
    // At 40 and 60 nm its ends are 10.2 nm apart, at 50 nm 2 nm.
    assert!(assembly.linker_in(0, &state).1);
    let (_, at_nm) = assembly.switched(0, &state).unwrap();
    assert!((at_nm - 50.0).abs() > 9.0, "{at_nm}");
}

/// A crosslinker on two fixed filaments 12 nm apart, with three sites each, binds its second hand in detailed
/// balance. States have the weights `(k_b/k_u) exp(-U/kT)` of both hands bound, for each ordered pair of sites, and 1 of
/// one hand bound, for each hand and site.
#[test]
fn crosslinkers_bind_in_detailed_balance() {
    let (plain, torsion) = ("", "radius_nm: 3.5, tilt_pn_nm: 6.0, twist_pn_nm: 30.0,");
    for (breaks, keys) in [
        ("Breaking(rate_per_ns: 0.02)", plain),
        ("Breaking(rate_per_ns: 0.02, force_pn: 2.0)", plain),
        ("Breaking(rate_per_ns: 0.02)", torsion),
    ] {
        let text = format!(
            "Scene(
                filaments: [
                    Filament(sections: [Rod(from_nm: 0.0, to_nm: 30.0)]),
                    Filament(sections: [Rod(from_nm: 0.0, to_nm: 30.0)], at_nm: (12.0, 0.0, 4.0),
                        direction: (0.1, 0.3, 1.0)),
                ],
                crosslinkers: [Crosslinkers(count: 1, stiffness_pn_per_nm: 0.2, rest_length_nm: 10.0, {keys}
                    attach_per_ns: 0.05, bind_per_ns: 0.03, site_spacing_nm: 10.0, averaging_ns: 0.0,
                    unbinds: {breaks}, seed: 8)],
                task: Brownian(duration_ms: 1e-3, temperature_k: 298.0, seed: 1),
            )"
        );
        let assembly = Assembly::build(&Scene::from_ron(&text).unwrap()).unwrap();
        let mut state = assembly.rest.clone();
        let kt = assembly.scene.thermal_energy_pn_nm();
        let pairs = (0..3).flat_map(|i| (0..3).map(move |j| [i, j]));
        let weights = pairs.map(|pair| (-energy_of_crosslinker(&assembly, pair) / kt).exp());
        let expected = 2.0 * weights.sum::<f64>() * (0.03 / 0.02) / 12.0;
        let switching = &assembly.kinetics.as_ref().unwrap().all[0];
        let mut counts = [0.0; 3];
        for step in 1..200_000 {
            events(&assembly, &mut state, step..step + 1);
            let hands = switching.linker.hands();
            counts[hands.filter(|hand| hand.is_bound(&state)).count()] += 1.0;
        }
        let ratio = counts[2] / counts[1];
        // The states decorrelate within about 30 steps, and events are up to half a step late.
        assert!((ratio / expected - 1.0).abs() < 0.1, "{ratio}, {expected}");
    }
}

/// Energy (pN nm) of the first linker with its first hand at one site of filament 0 and its second hand at one of
/// filament 1.
fn energy_of_crosslinker(assembly: &Assembly, sites: [usize; 2]) -> f64 {
    let linker = assembly.scene.linkers[0];
    let [one, other] = [0, 1].map(|filament| {
        let own = assembly.scene.filament_at(filament).unwrap();
        let at_nm = 5.0 + 10.0 * sites[filament] as f64;
        let azimuth = own.azimuth_at_radius_deg(at_nm, linker.radius_nm);
        let (sine, cosine) = azimuth.to_radians().sin_cos();
        let mut frames = 0..assembly.rest.frames.len();
        let frame = frames.find(|&frame| assembly.filament_of_frame(frame) == filament);
        let frame = frame.unwrap();
        let turn = assembly.rest.frames.orientation.get(frame);
        let axis = assembly.axis_site(filament, at_nm).unwrap();
        let axis = axis.position(&assembly.rest);
        let normal = turn * Vector3::new(cosine, sine, 0.0);
        (
            axis + normal * linker.radius_nm,
            normal,
            turn * Vector3::z(),
        )
    });
    let reach = other.0 - one.0;
    let stretch = 0.5 * linker.stiffness_pn_per_nm * (reach.norm() - linker.rest_length_nm).powi(2);
    let along = reach.normalize();
    let tilt = 2.0 - along.dot(&one.1) + along.dot(&other.1);
    stretch + linker.tilt_pn_nm * tilt + linker.twist_pn_nm * (1.0 - one.2.dot(&other.2))
}
