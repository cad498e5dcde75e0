//! Overdamped motion: equilibria, relaxation, time steps and noise.

use super::contact::pushed_across;
use crate::common::{build, ran, run_anyway};
use actin_sim::mechanics::Vector3;
use actin_sim::{Assembly, End, Plan, Record};

fn run(text: &str) -> (Assembly, Vec<Record>) {
    let (assembly, trajectory, _) = ran(text);
    (assembly, trajectory.records)
}

const SECTIONS: [&str; 3] = [
    "Rod(from_nm: 0.0, to_nm: 60.0, segments: 3)",
    "Ellipsoids(from_nm: 0.0, to_nm: 60.0)",
    "Ellipsoids(from_nm: 0.0, to_nm: 30.0), Rod(from_nm: 30.0, to_nm: 60.0)",
];

fn cantilever(sections: &str, task: &str) -> String {
    format!(
        "Scene(
            filament: Filament(sections: [{sections}], rod: RodModel(law: Constant)),
            clamps: [Clamp(end: Start)],
            loads: [EndForce(end: End, force_pn: (4.0, 0.0, 0.0))],
            task: {task},
        )"
    )
}

/// A cantilever of 60 nm relaxes to its equilibrium with the time constant `z L^3/(12.4 B/4)`, 143
/// ns. Here `z = zeta L/4 + e`, with drag 2.2 pN ns/nm^2 along it and 47 pN ns/nm at its tip.
#[test]
fn a_cantilever_relaxes_to_its_equilibrium() {
    for sections in SECTIONS {
        let task = "Brownian(duration_ms: 0.003, temperature_k: 0.0, time_step_ns: 1.0, record_every_ns: 150.0)";
        let (assembly, records) = run(&cantilever(sections, task));
        let tip = |record: &Record| assembly.tip_nm(&record.state, End::End).x;
        let (_, rest) = run(&cantilever(sections, "Equilibrium()"));
        let (start, rest) = (tip(&records[0]), tip(&rest[0]));
        let end = tip(&records[records.len() - 1]);
        let share = (tip(&records[1]) - start) / (rest - start);
        println!("{sections}: {start} to {end}, at rest {rest}; {share} after 150 ns");
        assert!((end - rest).abs() < 1e-6 * rest.abs().max(1.0));
        assert!((0.5..0.8).contains(&share), "{share}");
    }
}

#[test]
fn noise_depends_on_the_seed() {
    let tip = |temperature: f64, seed: u64| {
        let task = format!(
            "Brownian(duration_ms: 1e-5, temperature_k: {temperature:?}, seed: {seed},
                drag: Water(viscosity_mpa_s: 1.0))"
        );
        let (assembly, records) = run(&cantilever(SECTIONS[2], &task));
        assembly.tip_nm(&records[records.len() - 1].state, End::End)
    };
    assert_eq!(tip(298.0, 1), tip(298.0, 1));
    assert_ne!(tip(298.0, 1), tip(298.0, 2));
    assert_eq!(tip(0.0, 1), tip(0.0, 2));
}

/// A free filament moves with the flow. The tangent of its angle in a shear flow is rate times
/// time; in a sheared periodic box it is the strain.
#[test]
fn free_filaments_follow_a_flow() {
    for sections in SECTIONS {
        let moved_in = |flow: &str, scene: &str| {
            let (assembly, records) = run(&format!(
                "Scene(
                    filament: Filament(sections: [{sections}], rod: RodModel(law: Constant)), {scene}
                    task: Brownian(duration_ms: 1e-3, temperature_k: 0.0, time_step_ns: 1.0, flow: {flow}),
                )"
            ));
            let ends = |record: &Record| {
                [End::Start, End::End].map(|end| assembly.tip_nm(&record.state, end))
            };
            let [first, last] = [0, records.len() - 1].map(|k| ends(&records[k]));
            (last[0] - first[0], last[1] - last[0])
        };
        let moved = |flow: &str| moved_in(flow, "");
        let (drift, _) = moved("Stream(velocity_um_per_s: (2e3, -1e3, 5e2))");
        assert!(
            (drift - Vector3::new(2.0, -1.0, 0.5)).norm() < 1e-6,
            "{drift:?}"
        );
        let (_, along) =
            moved("Shear(rate_per_s: 5e5, along: (9.0, 0.0, 0.0), across: (0.0, 0.0, 1e-9))");
        let (_, with_box) = moved_in(
            "AtRest",
            "periodic: PeriodicBox(
                size_nm: (100.0, 100.0, 100.0), strain: 0.5, factor: Ramp(duration_ns: 800.0),
            ),",
        );
        for along in [along, with_box] {
            let tangent = along.x / along.z;
            println!("{sections}: {tangent}");
            assert!((tangent / 0.5 - 1.0).abs() < 0.01, "{tangent}");
        }
    }
}

fn default_step(rest: &str, task: &str) -> f64 {
    let text = format!(
        "Scene(
            filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 120.0, segments: 6)], rod: RodModel(law: Constant)),
            clamps: [Clamp(end: Start)],{rest}
            task: Brownian(duration_ms: 1.0, temperature_k: 298.0{task}),
        )"
    );
    let assembly = build(&text);
    let plan = Plan::new(&assembly).unwrap();
    plan.estimate().unwrap().time_step_ns
}

/// The default step is the bending time of a segment, `3.0 x 20^4 / 4e4` = 12 ns. Fast changes or
/// strong loads reduce it, down to 50 times the fastest relaxation time.
#[test]
fn default_steps_resolve_changes() {
    let usual = default_step("", "");
    assert!((9.0..14.0).contains(&usual), "{usual}");
    let pulled =
        |force: &str| format!("loads: [EndForce(end: End, force_pn: (0.0, 0.0, {force}))],");
    let gently = default_step(&pulled("1.0"), "");
    assert!((gently / usual - 1.0).abs() < 1e-9, "{gently}");
    let hard = default_step(&pulled("20.0"), "");
    println!("{usual} ns, {hard} ns under 20 pN");
    assert!((0.9..1.4).contains(&hard), "{hard}");
    let stage =
        "path: [(set: [Shift(end: Start, shift_nm: (1.0, 0.0, 0.0))], duration_ns: 100.0)],";
    let staged = default_step(stage, "");
    assert!(staged <= 1.0 && staged > 0.1, "{staged}");
    let recorded = default_step("", ", record_every_ns: 2.0");
    assert!(recorded <= 2.0, "{recorded}");
    let shear = "Shear(rate_per_s: 2e7, along: (1.0, 0.0, 0.0), across: (0.0, 0.0, 1.0))";
    let sheared = default_step("", &format!(", flow: {shear}"));
    assert!(sheared <= 5.0, "{sheared}");
    let repelled = default_step("repulsion: Repulsion(),", "");
    assert!((repelled / usual - 1.0).abs() < 1e-9, "{repelled}");
}

/// Time step (ns) of a motion without heat and its tip (nm) in ten records.
fn athermal_tips(scene: &str, duration_ns: f64, step: &str) -> (f64, Vec<Vector3>) {
    let task = format!(
        "task: Brownian(duration_ms: {:e}, temperature_k: 0.0, record_every_ns: {:?}{step})",
        1e-6 * duration_ns,
        0.1 * duration_ns
    );
    let assembly = build(&format!("Scene({scene}{task})"));
    let plan = Plan::new(&assembly).unwrap();
    let records = plan.run().unwrap().0.records;
    let tips = records.iter().map(|r| assembly.tip_nm(&r.state, End::End));
    (plan.estimate().unwrap().time_step_ns, tips.collect())
}

/// The default step without heat resolves the tip to 0.1 % of its displacement. The reference has a
/// quarter of the step.
#[test]
fn default_steps_without_heat_resolve_the_tip() {
    let rod = |nm: f64, law: &str| {
        format!(
            "filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: {nm:?})], rod: RodModel(law: {law})),
            clamps: [Clamp(end: Start)],"
        )
    };
    let at_once = "loads: [EndForce(end: End, force_pn: (2.0, 0.0, 0.0))],";
    let swings =
        "loads: [Force(end: End, force_pn: (2.0, 0.0, 0.0), factor: Sine(period_ns: 500.0))],";
    let shaken =
        "path: [Stage(set: [Shift(end: Start, shift_nm: (5.0, 0.0, 0.0))], duration_ns: 500.0)],";
    let monomers = "filament: Filament(sections: [Ellipsoids(from_nm: 0.0, to_nm: 40.0)]), clamps: [Clamp(end: Start)],";
    for (filament, rest, duration_ns, of_largest) in [
        (rod(160.0, "Constant"), at_once, 2e3, false),
        (rod(160.0, "Homogenised"), at_once, 2e3, false),
        // Ten records over many relaxation times: steps of 500 ns.
        (rod(160.0, "Homogenised"), at_once, 1e5, false),
        (rod(100.0, "Homogenised"), swings, 2e3, true),
        (rod(100.0, "Constant"), shaken, 2e3, true),
        (monomers.to_owned(), at_once, 200.0, false),
    ] {
        let scene = format!("{filament}{rest}");
        let (step, own) = athermal_tips(&scene, duration_ns, "");
        let finer = format!(", time_step_ns: {:?}", 0.25 * step);
        let (_, fine) = athermal_tips(&scene, duration_ns, &finer);
        let gone = |k: usize| (fine[k] - fine[0]).norm();
        let largest = (1..fine.len()).map(gone).fold(0.0, f64::max);
        let errors = (1..fine.len()).map(|k| {
            let size = if of_largest { largest } else { gone(k) };
            (own[k] - fine[k]).norm() / size
        });
        let error = errors.fold(0.0, f64::max);
        println!("{filament}{rest} {step} ns: {error:.1e}");
        assert!(error < 1e-3, "{filament}{rest}: {error}");
    }
}

#[test]
fn long_steps_give_warnings() {
    let notes = |sections: &str, temperature: f64, step: &str| {
        let task = format!("Brownian(duration_ms: 1e-5, temperature_k: {temperature:?}{step})");
        let assembly = build(&cantilever(sections, &task));
        let notes = Plan::new(&assembly).unwrap().notes().into_iter();
        notes.map(|note| note.message).collect::<Vec<_>>()
    };
    let told = |notes: &[String]| {
        notes
            .iter()
            .any(|note| note.contains("sampled anew") || note.contains("exceed their thermal"))
    };
    for (sections, long) in SECTIONS.iter().zip([50.0, 0.022, 0.015]) {
        let long = format!(", time_step_ns: {long:?}");
        assert!(!told(&notes(sections, 298.0, "")));
        assert!(told(&notes(sections, 298.0, &long)), "{sections}");
        assert!(!told(&notes(sections, 0.0, &long)));
    }
}

fn mean_energy(law: &str, step_ns: f64, steps: u32) -> f64 {
    let duration = f64::from(steps) * step_ns * 1e-6;
    let text = format!(
        "Scene(
            filament: Filament(
                sections: [Rod(from_nm: 0.0, to_nm: 120.0, segments: 6)],
                rod: (law: {law}),
            ),
            task: Brownian(duration_ms: {duration:?}, temperature_k: 298.0, seed: 3,
                time_step_ns: {step_ns:?}, record_every_ns: {step_ns:?}),
        )"
    );
    let (assembly, records) = run(&text);
    let energy = |record: &Record| -> f64 {
        let interactions = assembly.system.interactions();
        interactions.iter().map(|i| i.energy(&record.state)).sum()
    };
    let settled = &records[records.len() / 10..];
    settled.iter().map(energy).sum::<f64>() / (settled.len() as f64 * 1.380_649e-2 * 298.0)
}

/// A free rod with 33 strain coordinates has an energy of 16.5 kT, in steps up to 10,000 times the
/// fastest relaxation time. The standard error of 4000 states with a correlation of ten steps is 1
/// %.
#[test]
fn rods_have_their_energy_in_long_steps() {
    for step in [5.0, 50.0] {
        let energy = mean_energy("Constant", step, 4000);
        println!("Constant, {step} ns: {energy} kT");
        assert!((energy / 16.5 - 1.0).abs() < 0.03, "{energy}");
    }
    let [short, long] = [5.0, 50.0].map(|step| mean_energy("HomogenisedAt298K", step, 4000));
    println!("HomogenisedAt298K: {short} and {long} kT");
    assert!((long / short - 1.0).abs() < 0.04);
}

#[test]
fn passage_through_a_filament_fails() {
    let task = "Brownian(duration_ms: 1e-5, temperature_k: 0.0, time_step_ns: 0.2)";
    let (_, outcome) = run_anyway(&mut build(&pushed_across("1.0", task)));
    let failure = outcome.unwrap_err().to_string();
    assert!(failure.contains("pass through each other"), "{failure}");
}

/// Twelve rods with thirty linkers of zero length, in steps of 2 us. The 33 coordinates of each rod
/// have kT/2 each, except its spin and six rigid motions of the network.
#[test]
fn linked_rods_have_their_energy_in_long_steps() {
    const RODS: usize = 12;
    let filaments: Vec<String> = (0..RODS)
        .map(|i| {
            format!(
                "Filament(sections: [Rod(from_nm: 0.0, to_nm: 500.0, segments: 5)], rod: (law: Constant),
                    at_nm: ({:?}, 0.0, 0.0)),",
                5.0 * i as f64
            )
        })
        .collect();
    let linkers: Vec<String> = (0..30)
        .map(|k| {
            let (one, other) = (k % RODS, (k + 1 + k / RODS) % RODS);
            let at_nm = 30.0 + 15.0 * k as f64;
            format!(
                "Linker(filament: {one}, at_nm: {at_nm:?}, to: Site(filament: {other}, at_nm: {at_nm:?}),
                    stiffness_pn_per_nm: 0.2),"
            )
        })
        .collect();
    let text = format!(
        "Scene(
            filaments: [{}],
            linkers: [{}],
            task: Brownian(duration_ms: 2.0, temperature_k: 298.0, seed: 4, time_step_ns: 2000.0,
                record_every_ns: 2000.0),
        )",
        filaments.concat(),
        linkers.concat()
    );
    let (_, records) = run(&text);
    let records = &records[records.len() / 10..];
    let sum: f64 = records.iter().map(|record| record.potential_pn_nm()).sum();
    let kt = 1.380_649e-2 * 298.0;
    let expected = 0.5 * kt * (32 * RODS - 6) as f64;
    let share = sum / records.len() as f64 / expected;
    println!("{share} of the thermal energy");
    // The standard error of 900 records is about 0.4 %.
    assert!((share - 1.0).abs() < 0.015, "{share}");
}
