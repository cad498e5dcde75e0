//! Filaments joined by linkers between two sites, and a filament joined to itself.

use super::common::{BEND, LENGTH, SHEAR, apart, build, cantilever, newton, rod_scene, solved, to};
use actin_equilibrium::{BodyOrder, Layout, Newton};
use actin_mechanics::Vector3;
use actin_sim::{Assembly, End};

/// `count` rods of [`cantilever`] side by side, 10 nm apart along lab x, with these linkers.
fn row(count: usize, linkers: &str, loads: &str, task: &str) -> String {
    let rod = |i: usize| {
        format!(
            "Filament(
                sections: [Rod(from_nm: 0.0, to_nm: {LENGTH:?}, segments: 16)],
                rod: RodModel(law: Constant, material: Rigidities(
                    shear_pn: ({SHEAR:?}, {SHEAR:?}, {SHEAR:?}),
                    bend_pn_nm2: ({BEND:?}, {BEND:?}, 1.3e4),
                )),
                at_nm: ({:?}, 0.0, 0.0),
            ),",
            10.0 * i as f64
        )
    };
    let rods: String = (0..count).map(rod).collect();
    let clamp = |i| format!("Clamp(filament: {i}, end: Start),");
    let clamps: String = (0..count).map(clamp).collect();
    format!(
        "Scene(filaments: [{rods}], clamps: [{clamps}], linkers: [{linkers}], loads: [{loads}],
            task: {task})"
    )
}

fn link(i: usize, s_nm: f64, stiffness: f64) -> String {
    format!(
        "Linker(filament: {i}, at_nm: {s_nm:?}, to: Site(filament: {}, at_nm: {s_nm:?}),
            stiffness_pn_per_nm: {stiffness:?}, rest_length_nm: 10.0),",
        i + 1
    )
}

fn moved(assembly: &Assembly, filament: usize) -> Vector3 {
    let tip = |state| assembly.tip_of(filament, state, End::End);
    tip(assembly.system.state()) - tip(&assembly.rest)
}

/// Two rods joined at their tips by a spring of stiffness `k`, with a force on one of them. The
/// spring carries `f = F / (2 + 1 / (k c))` with the compliance `c` of a single rod.
#[test]
fn two_rods_joined_at_their_tips_share_the_load() {
    let (force, k) = (0.4, 100.0);
    let tight = "Equilibrium(force_pn: 1e-10, torque_pn_nm: 1e-10)";
    let load = format!("EndForce(end: End, force_pn: ({:?}, 0.0, 0.0))", -force);
    let (mut pair, _) = solved(&row(2, &link(0, LENGTH, k), &load, tight));
    let alone = |force: f64| {
        let task = format!("task: {tight}");
        let (rod, _) = solved(&cantilever(16, [-force, 0.0, 0.0], &task));
        moved(&rod, 0)
    };
    let loads = pair.system.loads().clone();
    let state = pair.system.state();
    let borne = pair.linkers[0].force(state);
    let tips = [0, 1].map(|filament| moved(&pair, filament));
    println!("linker: {borne:?} pN; tips {:?} nm", tips.map(|t| t.x));
    // The ends stay level to 1e-4 of their distance.
    for (tip, bears) in tips.iter().zip([force - borne.x, borne.x]) {
        assert!((tip - alone(bears)).norm() < 1e-3);
    }
    let compliance = alone(0.5 * force).norm() / (0.5 * force);
    let share = force / (2.0 + 1.0 / (k * compliance));
    // Compliances decrease with the square of the deflection, 7 nm of 160.
    assert!((borne.x / share - 1.0).abs() < 1e-4);
    let half = 0.5 * force;
    let deflection = half * LENGTH.powi(3) / (3.0 * BEND) + half * LENGTH / SHEAR;
    assert!((tips[1].x / -deflection - 1.0).abs() < 0.01);
    let [one, other] = [0, 1].map(|i| pair.clamps[i].reaction(state, &loads).force_pn);
    let whole = Vector3::x() * -force;
    // Residuals of 1e-10 pN on about 60 bodies.
    assert!((other - borne).norm() < 1e-8 && (one + other + whole).norm() < 1e-8);
}

/// The loaded rod is pushed towards the other and rotates the spring, since the balance in line is
/// a saddle.
#[test]
fn a_spring_that_is_pushed_together_swings_round() {
    let load = "EndForce(end: End, force_pn: (0.4, 0.0, 0.0))";
    let (pair, report) = solved(&row(2, &link(0, LENGTH, 100.0), load, "Equilibrium()"));
    let report = report.equilibrium.unwrap();
    let energy: f64 = pair.system.energies().iter().sum();
    let tips = [0, 1].map(|filament| moved(&pair, filament));
    println!(
        "pushed: {} steps, {energy:.4} pN nm, tips {:?}",
        report.newton_iterations, tips
    );
    assert_eq!(report.certificate.negative, 0);
    // In line each carries half, with the energy -F^2 c / 4, c = 35 nm/pN.
    let in_line = -0.25 * 0.16 * (LENGTH.powi(3) / (3.0 * BEND) + LENGTH / SHEAR);
    assert!(energy < in_line, "{energy} above {in_line}");
    // The tips, 10 nm apart as built, have changed sides.
    assert!(tips[0].x - tips[1].x > 19.0);
}

/// A free rod with a string between its ends is the elastica under a thrust along the string. With
/// `p` the sine of half the angle at the ends, thrust and chord are `P = 4 K^2 B / L^2` and `d = L
/// (2 E / K - 1) - P L / S`. The string is a spring without rest length of stiffness `P / d`.
#[test]
fn a_string_between_its_ends_bends_a_rod_to_an_elastica() {
    // K and E at the angle of 60 deg at the ends, p^2 = 0.25 (Abramowitz and Stegun, table 17.1).
    let (first, second) = (1.685_750_354_812_596, 1.467_462_209_339_427);
    let thrust = 4.0 * first * first * BEND / LENGTH.powi(2);
    let chord = LENGTH * (2.0 * second / first - 1.0) - thrust * LENGTH / SHEAR;
    let mut errors = [16, 32, 64].map(|segments| {
        let string = format!(
            "linkers: [Linker(at_nm: 0.0, to: Site(at_nm: {LENGTH:?}), stiffness_pn_per_nm: {:?})],
             task: Equilibrium(),",
            thrust / chord
        );
        let (bow, report) = solved(&rod_scene(segments, (SHEAR, 1.3e4), "", &string));
        let certificate = report.equilibrium.unwrap().certificate;
        println!("bow of {segments}: {certificate:?}");
        // Six rigid motions, and the rotation of a round rod about its bent centre line.
        assert_eq!(
            (certificate.negative, certificate.unresolved <= 7),
            (0, true)
        );
        let force = bow.linkers[0].force(bow.system.state()).norm();
        force / thrust - 1.0
    });
    let orders = [errors[0] / errors[1], errors[1] / errors[2]].map(f64::log2);
    assert!(
        orders.iter().all(|order| (order - 2.0).abs() < 0.1),
        "{orders:?}"
    );
    errors.reverse();
    assert!(((4.0 * errors[0] - errors[1]) / 3.0).abs() < 1e-5);
}

fn one_by_one(assembly: &Assembly) -> BodyOrder {
    let mut order = BodyOrder::default();
    for (i, span) in assembly.filaments.iter().enumerate() {
        let place = |s_nm: f64| 1000.0 * i as f64 + s_nm;
        let points = assembly.points[span.points.clone()].iter();
        let frames = assembly.frames[span.frames.clone()].iter();
        order.points.extend(points.map(|p| place(p.s_nm)));
        order.frames.extend(frames.map(|f| place(f.s_nm)));
    }
    order
}

#[test]
fn the_order_of_elimination_changes_the_fill_only() {
    let assembly = bundle();
    let layout = || Layout::new(assembly.system.state(), Some(&one_by_one(&assembly)));
    let solve = |mut newton: Newton| {
        let mut state = assembly.rest.clone();
        let interactions = assembly.system.interactions();
        let equilibrium = newton.solve(&mut state, interactions).unwrap();
        let certificate = equilibrium.certificate.unwrap();
        assert_eq!((certificate.negative, certificate.unresolved), (0, 0));
        let lowest = newton.lowest_mode(&state, interactions).unwrap().unwrap();
        (state, newton.work().factor_entries, lowest.eigenvalue)
    };
    let ordered = solve(Newton::new(layout().unwrap(), to(1e-10)).unwrap());
    let along = solve(newton(&assembly, 1e-10));
    let least = solve(Newton::new(layout().unwrap().with_links(), to(1e-10)).unwrap());
    println!(
        "entries: {} one by one, {} along, {} least",
        ordered.1, along.1, least.1
    );
    // Measured: 11469, 8634 and 6222 entries.
    assert!(3 * least.1 < 2 * ordered.1 && 4 * least.1 < 3 * along.1);
    for other in [&ordered, &along] {
        let apart = apart(&least.0, &other.0);
        println!("{apart:.1e} nm apart, eigenvalue {:.6e}", other.2);
        // Residuals of 1e-10 pN at compliances of up to 10 nm/pN; 3e-12 (measured).
        assert!(apart < 1e-9);
        assert!((other.2 / least.2 - 1.0).abs() < 1e-6);
    }
}

fn bundle() -> Assembly {
    let places = [40.0, 80.0, 120.0, 160.0];
    let linkers: String = (0..3)
        .flat_map(|i| places.map(|s| link(i, s, 50.0)))
        .collect();
    let load = "EndForce(end: End, force_pn: (1.0, 0.5, 0.0))";
    build(&row(4, &linkers, load, "Equilibrium()"))
}
