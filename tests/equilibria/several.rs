//! Several filaments: independence, invariance under rigid motion, and separate paths.

use super::common::{build, run, solved};
use actin_mechanics::Xorshift;
use actin_mechanics::{UnitQuaternion, Vector3, rotation};
use actin_sim::{Assembly, End, Filament, FreeTranslation, Load, Scene, Setting, Stage};

const TIGHT: &str = "Equilibrium(force_pn: 1e-9, torque_pn_nm: 1e-9)";

const MIXED: &str = "sections: [
    Ellipsoids(from_nm: 0.0, to_nm: 20.0), Rod(from_nm: 20.0, to_nm: 40.0, segments: 2),
], monomers: Monomers(anchors: Independent, lateral_bonds: 16, longitudinal_bonds: 16)";

const ASKEW: &str =
    "rod: RodModel(law: Constant), sections: [Rod(from_nm: 0.0, to_nm: 50.0, segments: 5)],
    at_nm: (5.0, -20.0, 3.0), direction: (1.0, -0.4, 0.7), roll_deg: 25.0";

fn pull(filament: usize, force: [f64; 3]) -> String {
    let [x, y, z] = force;
    format!("EndForce(filament: {filament}, end: End, force_pn: ({x:?}, {y:?}, {z:?})),")
}

fn scene(filaments: &str, clamps: &str, loads: &str, rest: &str) -> String {
    format!("Scene({filaments}, clamps: [{clamps}], loads: [{loads}], {rest})")
}

fn energy(assembly: &Assembly) -> f64 {
    assembly.system.energies().iter().sum()
}

/// Largest distance (nm) of the points of two assemblies from indices `a` and `b`, after the rigid
/// motion `to`.
fn apart(
    (one, a): (&Assembly, usize),
    (other, b): (&Assembly, usize),
    count: usize,
    to: impl Fn(Vector3) -> Vector3,
) -> f64 {
    let place = |assembly: &Assembly, i| assembly.system.state().points.position.get(i);
    let distance = |k| (place(one, a + k) - to(place(other, b + k))).norm();
    (0..count).map(distance).fold(0.0, f64::max)
}

#[test]
fn unlinked_filaments_are_each_alone() {
    let task = format!("task: {TIGHT}");
    let forces = [[-2.0, 0.5, 0.0], [0.3, 0.2, 0.9]];
    let (both, report) = solved(&scene(
        &format!("filaments: [({MIXED}), ({ASKEW})]"),
        "Clamp(end: Start), Clamp(filament: 1, end: Start)",
        &[pull(0, forces[0]), pull(1, forces[1])].concat(),
        &task,
    ));
    let alone = |filament: &str, force| {
        let filament = format!("filament: ({filament})");
        solved(&scene(
            &filament,
            "Clamp(end: Start)",
            &pull(0, force),
            &task,
        ))
        .0
    };
    let (first, second) = (alone(MIXED, forces[0]), alone(ASKEW, forces[1]));
    let counts = [&first, &second].map(|a| a.points.len());
    let distances = [
        apart((&both, 0), (&first, 0), counts[0], |x| x),
        apart((&both, counts[0]), (&second, 0), counts[1], |x| x),
    ];
    let excess = energy(&both) - energy(&first) - energy(&second);
    let shown = distances.map(|d| format!("{d:.1e}")).join(" ");
    println!("unlinked: {shown} nm, {excess:.1e} pN nm");
    assert!(report.equilibrium.unwrap().certificate.negative == 0);
    // Round-off of Newton's last step, 1e-12 (measured); energies are second order in it.
    assert!(distances.iter().all(|d| *d < 1e-10));
    assert!(excess.abs() < 1e-10);
    let tips = [0, 1].map(|f| both.tip_of(f, both.system.state(), End::End));
    for (tip, alone) in tips.iter().zip([&first, &second]) {
        let moved = alone.tip_nm(alone.system.state(), End::End);
        assert!((tip - moved).norm() < 1e-10);
        assert!((moved - alone.tip_nm(&alone.rest, End::End)).norm() > 0.1);
    }
}

/// Forces in another order, next to a vanishing one, or halved.
#[test]
fn forces_with_the_same_sum_have_the_same_equilibrium() {
    let (one, other) = ([-2.0, 0.5, 0.0], [0.3, 0.2, 0.9]);
    let half = one.map(|x| 0.5 * x);
    let task = format!("task: {TIGHT}");
    let under = |forces: &[[f64; 3]]| {
        let loads: String = forces.iter().map(|force| pull(0, *force)).collect();
        let filament = format!("filament: ({MIXED})");
        solved(&scene(&filament, "Clamp(end: Start)", &loads, &task)).0
    };
    let both = under(&[one, other]);
    for forces in [[other, one, [0.0; 3]], [half, other, half]] {
        let found = under(&forces);
        let distance = apart((&both, 0), (&found, 0), both.points.len(), |x| x);
        let excess = energy(&found) - energy(&both);
        assert!(
            distance < 1e-10 && excess.abs() < 1e-10,
            "{distance:e} {excess:e}"
        );
    }
}

#[test]
fn filaments_alike_are_sampled_independently() {
    let bonds = |assembly: &Assembly, section| {
        let bonds = assembly.bonds_of(section).unwrap();
        let pair = &bonds.pairs()[0];
        bonds.bonds_of(pair).next().unwrap().rest_length
    };
    let task = "task: Equilibrium()";
    let alone = build(&scene(&format!("filament: ({MIXED})"), "", "", task));
    let pair = build(&scene(
        &format!("filaments: [({MIXED}), ({MIXED})]"),
        "",
        "",
        task,
    ));
    assert_eq!(bonds(&pair, 0).to_bits(), bonds(&alone, 0).to_bits());
    assert!((bonds(&pair, 2) - bonds(&alone, 0)).abs() > 1e-6);
}

fn linked() -> Scene {
    let text = scene(
        &format!("filaments: [({MIXED}), ({ASKEW})]"),
        "Clamp(end: Start), Clamp(filament: 1, end: Start, slides: AlongAxis)",
        &[pull(0, [-2.0, 0.5, 0.0]), pull(1, [0.3, 0.2, 0.9])].concat(),
        &format!(
            "linkers: [
                Linker(at_nm: 12.0, radius_nm: 1.8, azimuth_deg: 40.0, stiffness_pn_per_nm: 1.0,
                    to: Site(filament: 1, at_nm: 38.0, radius_nm: 1.8, azimuth_deg: -70.0),
                    rest_length_nm: 20.0),
                Linker(filament: 1, at_nm: 20.0, stiffness_pn_per_nm: 5.0,
                    displaced_nm: (1.0, 2.0, -1.0)),
            ],
            task: {TIGHT}"
        ),
    );
    Scene::from_ron(&text).unwrap()
}

fn move_filament(filament: &mut Filament, turn: UnitQuaternion, shift: Vector3) {
    let wanted = turn * filament.rotation();
    filament.at_nm = (turn * Vector3::from(filament.at_nm) + shift).into();
    filament.direction = (turn * filament.axis()).into();
    filament.roll_deg = 0.0;
    // The remaining rotation is about the axis before tilting.
    let roll = rotation::log(filament.rotation().inverse() * wanted);
    assert!(roll.xy().norm() < 1e-12);
    filament.roll_deg = roll.z.to_degrees();
}

fn solve(scene: &Scene) -> Assembly {
    let mut assembly = Assembly::build(scene).unwrap();
    run(&mut assembly).unwrap();
    assembly
}

#[test]
fn equilibria_are_invariant_under_rigid_motion() {
    let mut noise = Xorshift::new(4);
    let scene = linked();
    let here = solve(&scene);
    for _ in 0..3 {
        let (turn, shift) = (rotation::exp(noise.vector() * 2.0), noise.vector() * 30.0);
        let mut moved = scene.clone();
        moved
            .filaments_mut()
            .for_each(|f| move_filament(f, turn, shift));
        for load in &mut moved.loads {
            let Load::EndForce { force_pn, .. } = load else {
                panic!("only ends are loaded");
            };
            *force_pn = (turn * Vector3::from(*force_pn)).into();
        }
        for place in moved
            .linkers
            .iter_mut()
            .filter_map(|l| l.displaced_nm.as_mut())
        {
            *place = (turn * Vector3::from(*place)).into();
        }
        let there = solve(&moved);
        let back = |x: Vector3| turn.inverse() * (x - shift);
        let distance = apart((&here, 0), (&there, 0), here.points.len(), back);
        let excess = energy(&there) - energy(&here);
        println!("moved: {distance:.1e} nm, {excess:.1e} pN nm");
        // Round-off of positions of 50 nm, 4e-14 (measured), and Newton's last step.
        assert!(distance < 1e-9 && excess.abs() < 1e-9);
        let tips = [0, 1].map(|f| here.tip_of(f, &here.rest, End::End));
        let ends = [0, 1].map(|f| here.tip_of(f, here.system.state(), End::End));
        assert!((0..2).all(|f| (tips[f] - ends[f]).norm() > 0.5));
    }
}

fn moving(turn: Vector3, shift: Vector3, anchor: Vector3) -> Vec<Setting> {
    let (filament, end) = (1, End::Start);
    vec![
        Setting::Turn {
            filament,
            end,
            turn_deg: turn.map(f64::to_degrees).into(),
        },
        Setting::Shift {
            filament,
            end,
            shift_nm: shift.into(),
        },
        Setting::Anchor {
            linker: 1,
            shift_nm: anchor.into(),
        },
    ]
}

#[test]
fn a_path_moves_the_end_of_the_filament_that_it_names() {
    let mut scene = linked();
    scene.clamps[1].slides = FreeTranslation::Nowhere;
    let (turn, shift) = (Vector3::new(0.3, -0.2, 0.4), Vector3::new(2.0, 3.0, -1.0));
    let place = Vector3::from(scene.other_filaments[0].at_nm);

    let mut built = scene.clone();
    let rotated = rotation::exp(turn);
    move_filament(
        &mut built.other_filaments[0],
        rotated,
        place + shift - rotated * place,
    );
    built.linkers[1].displaced_nm = None;
    let at_rest = Assembly::build(&scene).unwrap();
    let anchor = at_rest.linkers[1].end_position(&at_rest.rest);
    let further = Vector3::new(0.0, -2.0, 1.0);
    built.linkers[1].anchor_nm = Some((anchor + further).into());
    let built = solve(&built);

    scene.path = vec![Stage {
        set: moving(turn, shift, further),
        duration_ns: None,
        pace: actin_sim::TimeCourse::Smooth,
    }];
    let moved = solve(&scene);
    let distance = apart((&moved, 0), (&built, 0), moved.points.len(), |x| x);
    assert!(distance < 1e-9, "{distance:e} nm apart");
    let held = moved.clamp_at(1, End::Start).unwrap();
    let point = held.point_nm(moved.system.state());
    assert!((point - place - shift).norm() < 1e-12);
}
