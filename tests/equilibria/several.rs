//! Several filaments: independent where nothing joins them, the same wherever they lie, and moved
//! along a path each by itself.

use super::common::{build, run, solved};
use actin_mechanics::Xorshift;
use actin_mechanics::{UnitQuaternion, Vector3, rotation};
use actin_sim::{Assembly, End, Filament, Load, Scene, Setting, Slides, Stage};

const TIGHT: &str = "Equilibrium(force_pn: 1e-9, torque_pn_nm: 1e-9)";

/// Monomers and rod, clamped, a force on the tip.
const MIXED: &str = "sections: [
    Ellipsoids(from_nm: 0.0, to_nm: 20.0), Rod(from_nm: 20.0, to_nm: 40.0, segments: 2),
], monomers: Monomers(anchors: Independent, lateral_bonds: 16, longitudinal_bonds: 16)";

/// A rod elsewhere, askew.
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

/// The largest distance (nm) of the points of two assemblies from place `a` and `b` on, the second
/// brought to the first by `to`.
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

/// Filaments that nothing joins end where each would end alone, and their energies add up. A block
/// that reached from one to the other, or a place counted from the wrong origin, would show.
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
    // Round-off of Newton's last step, 1e-12 as measured; energies are of second order in it.
    assert!(distances.iter().all(|d| *d < 1e-10));
    assert!(excess.abs() < 1e-10);
    let tips = [0, 1].map(|f| both.tip_of(f, both.system.state(), End::End));
    for (tip, alone) in tips.iter().zip([&first, &second]) {
        let moved = alone.tip_nm(alone.system.state(), End::End);
        assert!((tip - moved).norm() < 1e-10);
        assert!((moved - alone.tip_nm(&alone.rest, End::End)).norm() > 0.1);
    }
}

/// Filaments of the same seed have bonds of their own: the second of two alike differs from the
/// first, which has those that it would have alone.
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

/// A linked pair of which everything can be moved: an end that slides, a load, an anchor.
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

/// Turns a filament about the origin and shifts it.
fn move_filament(filament: &mut Filament, turn: UnitQuaternion, shift: Vector3) {
    let wanted = turn * filament.rotation();
    filament.at_nm = (turn * Vector3::from(filament.at_nm) + shift).into();
    filament.direction = (turn * filament.axis()).into();
    filament.roll_deg = 0.0;
    // What is left is a turn about the axis as it was before tilting.
    let roll = rotation::log(filament.rotation().inverse() * wanted);
    assert!(roll.xy().norm() < 1e-12);
    filament.roll_deg = roll.z.to_degrees();
}

fn solve(scene: &Scene) -> Assembly {
    let mut assembly = Assembly::build(scene).unwrap();
    run(&mut assembly).unwrap();
    assembly
}

/// Moved as a whole, everything ends moved as a whole: places, energies, and what holds the ends.
/// Any site, clamp, slide or azimuth that was left in axes of the lab would show.
#[test]
fn where_a_scene_lies_does_not_matter() {
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
        // Round-off of places of 50 nm, 4e-14 as measured, and what Newton's last step leaves.
        assert!(distance < 1e-9 && excess.abs() < 1e-9);
        let tips = [0, 1].map(|f| here.tip_of(f, &here.rest, End::End));
        let ends = [0, 1].map(|f| here.tip_of(f, here.system.state(), End::End));
        assert!((0..2).all(|f| (tips[f] - ends[f]).norm() > 0.5));
    }
}

/// Settings that turn and shift the start of filament 1 and shift the anchor of linker 1.
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

/// A path that turns and shifts the clamp of filament 1 ends in the equilibrium of the scene in
/// which that filament is built there; so does one that moves the anchor that it hangs on. A
/// setting that found the clamp of filament 0 would turn that one.
#[test]
fn a_path_moves_the_end_of_the_filament_that_it_names() {
    let mut scene = linked();
    scene.clamps[1].slides = Slides::Nowhere;
    let (turn, shift) = (Vector3::new(0.3, -0.2, 0.4), Vector3::new(2.0, 3.0, -1.0));
    let place = Vector3::from(scene.further[0].at_nm);

    let mut built = scene.clone();
    let rotated = rotation::exp(turn);
    // The clamped point, where arc length begins, is shifted only.
    move_filament(
        &mut built.further[0],
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
        pace: actin_sim::Pace::Smooth,
    }];
    let moved = solve(&scene);
    let distance = apart((&moved, 0), (&built, 0), moved.points.len(), |x| x);
    println!("path of filament 1: {distance:.1e} nm");
    assert!(distance < 1e-9, "{distance:e} nm apart");
    let held = moved.clamp_at(1, End::Start).unwrap();
    let point = held.point_nm(moved.system.state());
    assert!((point - place - shift).norm() < 1e-12);
}
