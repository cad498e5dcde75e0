//! Collisions of filaments: order, energy, momenta, time step.

use crate::common::{apart, build, ran, run_anyway};
use actin_integrate::{Drag, PEFRL, POSITION_VERLET, advance};
use actin_mechanics::{State, System, Vector3, segments};
use actin_sim::{Assembly, Plan};

const TASK: &str = "task: Dynamics(duration_ns: 1.0)";

/// A free short rod that hits another free rod off its middle within 0.1 ns.
fn colliding() -> System {
    let text = format!(
        "Scene(
            filaments: [
                Filament(sections: [Rod(from_nm: 0.0, to_nm: 40.0, segments: 4)], rod: RodModel(law: Constant)),
                Filament(sections: [Ellipsoids(from_nm: 0.0, to_nm: 14.0), Rod(from_nm: 14.0, to_nm: 34.0, segments: 2)],
                    at_nm: (8.0, -14.0, 13.0), direction: (0.0, 1.0, 0.1), rod: RodModel(law: Constant)),
            ],
            repulsion: Repulsion(stiffness_pn_per_nm: 3000.0),
            {TASK},
        )"
    );
    let assembly = build(&text);
    let points = assembly.filaments[1].points.clone();
    let mut system = assembly.system;
    let state = system.state_mut();
    for i in points {
        state.points.velocity.set(i, Vector3::new(-60.0, 5.0, 10.0));
    }
    system
}

const TIME: f64 = 0.08;

fn after(scheme: &actin_integrate::Composition, steps: u32) -> System {
    let mut system = colliding();
    let h = TIME / f64::from(steps);
    advance(&mut system, scheme, h, steps.into(), &Drag::NONE);
    system
}

/// Requires three continuous derivatives and an up-to-date neighbour list. Round-off dominates
/// below 1e-11 nm.
#[test]
fn methods_keep_their_order_through_a_hit() {
    let reference = after(&PEFRL, 6400);
    let start = colliding();
    let contact = |system: &System| {
        let terms = system.interactions().iter();
        let energies = terms.zip(system.energies());
        let repelled = energies.filter(|(term, _)| term.term() == "repulsion");
        repelled.map(|(_, energy)| energy).sum::<f64>()
    };
    let half = {
        let mut system = colliding();
        advance(&mut system, &PEFRL, TIME / 800.0, 400, &Drag::NONE);
        contact(&system)
    };
    assert!(
        contact(&start) <= 0.0 && half > 10.0,
        "{half} pN nm half way"
    );
    for (scheme, steps, bound) in [(&POSITION_VERLET, 400, 0.1), (&PEFRL, 100, 0.15)] {
        let errors = [1, 2, 4].map(|n| apart(after(scheme, n * steps).state(), reference.state()));
        let orders = [errors[0] / errors[1], errors[1] / errors[2]].map(f64::log2);
        let expected = f64::from(scheme.order());
        assert!((orders[1] - expected).abs() < bound, "{orders:?}");
    }
}

#[test]
fn a_hit_conserves_energy_and_momenta() {
    let start = colliding();
    let (energy, p, l) = (
        start.total_energy(),
        start.state().momentum(),
        start.state().angular_momentum(),
    );
    let drift = |steps: u32| {
        let system = after(&PEFRL, steps);
        assert!((system.state().momentum() - p).norm() < 1e-12 * p.norm());
        assert!((system.state().angular_momentum() - l).norm() < 1e-11 * l.norm());
        (system.total_energy() / energy - 1.0).abs()
    };
    let errors = [200, 400].map(drift);
    assert!(errors[1] < 1e-6, "{errors:?}");
}

#[test]
fn the_time_step_includes_contact_before_it_occurs() {
    for section in [
        "Rod(from_nm: 0.0, to_nm: 40.0)",
        "Ellipsoids(from_nm: 0.0, to_nm: 40.0)",
    ] {
        for stiffness in [1e3, 1e5] {
            let build = |x: f64| {
                build(&format!(
                    "Scene(
                        filaments: [
                            Filament(sections: [{section}], rod: RodModel(law: Constant)),
                            Filament(sections: [{section}], at_nm: ({x:?}, 0.0, 0.0), rod: RodModel(law: Constant)),
                            Filament(sections: [{section}], at_nm: (-{x:?}, 0.0, 0.0), rod: RodModel(law: Constant)),
                        ],
                        repulsion: Repulsion(stiffness_pn_per_nm: {stiffness:?}),
                        {TASK},
                    )"
                ))
            };
            let (apart, pressed) = (build(20.0), build(4.6));
            let plan = Plan::new(&apart).unwrap();
            let known = plan.estimate().unwrap().largest_frequency_rad_per_ns;
            let met = actin_integrate::largest_frequency(&pressed.system).unwrap();
            let alone = actin_integrate::largest_frequency(&apart.system).unwrap();
            // The limit is an upper bound. From 1e4 pN/nm contact dominates by more than a half.
            assert!(
                met <= known && (stiffness < 1e4 || met > 1.5 * alone),
                "{met}, {known}"
            );
        }
    }
}

pub(crate) fn pushed_across(stiffness: &str, task: &str) -> String {
    format!(
        "Scene(
            filaments: [
                Filament(sections: [Rod(from_nm: 0.0, to_nm: 60.0)], rod: RodModel(law: Constant)),
                Filament(sections: [Rod(from_nm: 0.0, to_nm: 60.0)], at_nm: (12.0, -30.0, 30.0),
                    direction: (0.0, 1.0, 0.0), rod: RodModel(law: Constant)),
            ],
            clamps: [Clamp(end: Start), Clamp(end: End)],
            loads: [ForcePerLength(filament: 1, from_nm: 0.0, to_nm: 60.0, force_pn_per_nm: (-30.0, 0.0, 0.0))],
            repulsion: Repulsion(stiffness_pn_per_nm: {stiffness}),
            task: {task},
        )"
    )
}

#[test]
fn passing_through_between_records_fails() {
    let run = |stiffness: &str| {
        let task = "Dynamics(duration_ns: 0.2, record_every_ns: 0.2)";
        let (trajectory, result) = run_anyway(&mut build(&pushed_across(stiffness, task)));
        (trajectory.records.len(), result)
    };
    let (records, result) = run("1.0");
    let failure = result.unwrap_err().to_string();
    assert!(
        failure.starts_with("bodies pass through each other despite their repulsion at step")
            && failure.contains("\"repulsion\"")
            && failure.contains("of filament"),
        "{failure}"
    );
    assert_eq!(records, 1);
    let (records, result) = run("1e4");
    assert_eq!(records, 2);
    result.unwrap();
}

/// Pairs of crossing filaments in water, 5 um apart. The upper one of each pair is pulled down by
/// linkers at its ends, through the lower one.
fn pressed_pairs(pairs: u32, anchor_nm: f64, task: &str) -> String {
    let filament = |at: [f64; 3], direction: &str| {
        let [x, y, z] = at;
        format!(
            "Filament(sections: [Rod(from_nm: 0.0, to_nm: 400.0, segments: 4)], rod: RodModel(law: Constant),
                at_nm: ({x:?}, {y:?}, {z:?}), direction: {direction}),"
        )
    };
    let linker = |filament: u32, s: f64, shift: f64| {
        format!(
            "Linker(filament: {filament}, at_nm: {s:?}, displaced_nm: (0.0, 0.0, {shift:?}), stiffness_pn_per_nm: 0.5),"
        )
    };
    let place = |pair: u32| 5000.0 * f64::from(pair);
    let filaments = (0..pairs).flat_map(|pair| {
        [
            filament([place(pair) - 200.0, 0.0, 0.0], "(1.0, 0.0, 0.0)"),
            filament([place(pair), -200.0, 20.0], "(0.0, 1.0, 0.0)"),
        ]
    });
    let filaments: String = filaments.collect();
    let linkers = (0..2 * pairs).flat_map(|k| {
        let shift = f64::from(k % 2) * (anchor_nm - 20.0);
        [0.0, 400.0].map(|s| linker(k, s, shift))
    });
    let linkers: String = linkers.collect();
    format!(
        "Scene(filaments: [{filaments}], linkers: [{linkers}], repulsion: Repulsion(),
            task: Brownian(temperature_k: 298.0, {task}))"
    )
}

/// Signed distances (nm) of the pairs of [`pressed_pairs`]: positive if the upper filament is
/// above.
fn heights(assembly: &Assembly, state: &State) -> Vec<f64> {
    let axis = |filament: usize| -> Vec<[Vector3; 2]> {
        let x = &state.points.position;
        let points = assembly.filaments[filament].points.clone();
        let points: Vec<Vector3> = points.map(|i| x.get(i)).collect();
        points.windows(2).map(|pair| [pair[0], pair[1]]).collect()
    };
    let height = |pair: usize| {
        let (lower, upper) = (axis(2 * pair), axis(2 * pair + 1));
        let both = lower
            .iter()
            .flat_map(|a| upper.iter().map(move |b| (*a, *b)));
        let nearest = both.map(|(a, b)| (segments::nearest_points(a, b), a, b));
        let (nearest, a, b) = nearest
            .min_by(|one, other| one.0.squared.total_cmp(&other.0.squared))
            .expect("filaments have segments");
        let place = |[from, to]: [Vector3; 2], share: f64| from + (to - from) * share;
        let apart = place(b, nearest.shares[1]) - place(a, nearest.shares[0]);
        let sense = (a[1] - a[0]).cross(&(b[1] - b[0])).dot(&apart);
        nearest.squared.sqrt().copysign(sense)
    };
    (0..assembly.filaments.len() / 2).map(height).collect()
}

/// Smallest height (nm) and mean height of all records of pressed pairs.
fn pressed(pairs: u32, steps: u32, anchor_nm: f64, seed: u32) -> [f64; 2] {
    let task = format!(
        "seed: {seed}, duration_ms: {:?}, time_step_ns: 5000.0, record_every_ns: 5000.0",
        5e-3 * f64::from(steps)
    );
    let (assembly, trajectory, _) = ran(&pressed_pairs(pairs, anchor_nm, &task));
    let records = trajectory.records.iter();
    let all: Vec<f64> = records
        .flat_map(|record| heights(&assembly, &record.state))
        .collect();
    let mean = all.iter().sum::<f64>() / all.len() as f64;
    [all.into_iter().fold(f64::INFINITY, f64::min), mean]
}

/// Linkers pull with up to 0.5 pN/nm x 65 nm = 33 pN, the largest force of repulsion is 2600 pN. In
/// a step of 5 us segments diffuse by 12 nm, more than the contact distance of 7.4 nm.
#[test]
fn filaments_pressed_in_water_do_not_pass_through_each_other() {
    for anchor_nm in [0.0, -60.0] {
        let [least, mean] = pressed(5, 40, anchor_nm, 5);
        assert!(least > 4.0 && mean > 7.0, "{least}");
    }
}

#[test]
fn a_motion_that_begins_late_continues() {
    let text = "Scene(
        filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 60.0)], direction: (1.0, 1.0, 0.3), rod: RodModel(law: Constant)),
        clamps: [Clamp(end: Start)],
        loads: [Force(end: End, force_pn: (0.0, 0.0, 5.0), factor: Ramp(begin_ns: 0.21, duration_ns: 0.1))],
        task: Dynamics(duration_ns: 0.8, record_every_ns: 0.8),
    )";
    let (_, trajectory, _) = ran(text);
    assert!(trajectory.records[1].kinetic_pn_nm > 1e-4);
}
