//! Equilibria in contact against closed forms and beam theory.

use super::common::{build, failure, run_anyway, solved};
use actin_mechanics::testing::resultant;
use actin_mechanics::{Loads, Vector3};
use actin_sim::{Assembly, Failure, Part, Summary, WallName};

fn pushed(assembly: &Assembly, part: Part) -> (Vector3, f64) {
    let term = assembly.terms.iter().position(|t| t.part == part).unwrap();
    let state = assembly.system.state();
    let mut loads = Loads::zeros(state);
    assembly.system.interactions()[term].add_loads(state, &mut loads);
    let (force, moment) = resultant(state, &loads);
    // A force along x at height z has the moment z F along y about the origin.
    (force, moment.y / force.x)
}

fn pressed(section: &str, wall: &str) -> String {
    format!(
        "Scene(
            filament: Filament(sections: [{section}], rod: RodModel(law: Constant)),
            clamps: [Clamp(end: Start)],
            repulsion: Repulsion(
                filaments: false, stiffness_pn_per_nm: 1e4,
                {wall},
            ),
            task: Equilibrium(),
        )"
    )
}

/// Beam theory gives the force `d / (s^3/3B + s/S)` for a deflection `d` at the contact.
/// Discretisation (0.03 %) and the contact width of 4 nm cause an error below half a percent.
#[test]
fn round_walls_press_a_cantilever_as_beam_theory_has_it() {
    // The surfaces meet at 13.7 nm.
    let place = "at_nm: (-12.7, 0.0, 120.0), radius_nm: 10.0, side: Outside";
    let sphere = format!("spheres: [Sphere({place})]");
    let cylinder = format!("cylinders: [Cylinder(axis: (0.0, -2.0, 0.0), {place})]");
    for (shape, wall) in [("sphere", sphere), ("cylinder", cylinder)] {
        check_press(WallName { shape, index: 0 }, &wall);
    }
}

fn check_press(name: WallName, wall: &str) {
    let rod = "Rod(from_nm: 0.0, to_nm: 160.0, segments: 32)";
    let (assembly, _) = solved(&pressed(rod, wall));
    let (force, z) = pushed(&assembly, Part::Wall(name));
    let state = assembly.system.state();
    let x = |k: usize| state.points.position.get(k);
    let k = (0..32).find(|&k| x(k + 1).z > z).unwrap();
    let share = (z - x(k).z) / (x(k + 1).z - x(k).z);
    let deflection = x(k).x + share * (x(k + 1).x - x(k).x);
    let expected = deflection / (z.powi(3) / (3.0 * 3.9e4) + z / 1.6e4);
    let error = force.x / expected - 1.0;
    assert!(force.x > 0.03 && error.abs() < 5e-3, "{error}");
}

/// A free filament on a plane, along a cylinder or in a box sinks to the depth `p` at which
/// `k p^3 / (6 R^3)` is its weight per length.
#[test]
fn a_filament_lies_on_a_wall_at_the_depth_of_its_weight() {
    for wall in [
        "planes: [Plane(at_nm: (0.0, 0.0, 0.0), normal: (3.0, 0.0, 0.0))]",
        "cylinders: [Cylinder(at_nm: (20.0, 0.0, 9.0), axis: (0.0, 0.0, 1.0), radius_nm: 20.0, side: Inside)]",
        "cuboids: [Cuboid(at_nm: (10.0, 0.0, 40.0), size_nm: (20.0, 20.0, 100.0))]",
    ] {
        check_depth(wall);
    }
}

fn check_depth(wall: &str) {
    let per_nm = 0.05;
    let depth = (6.0 * 3.7_f64.powi(3) * per_nm / 1e3).cbrt();
    for section in [
        "Rod(from_nm: 0.0, to_nm: 80.0)",
        "Ellipsoids(from_nm: 0.0, to_nm: 80.0)",
        "Ellipsoids(from_nm: 0.0, to_nm: 30.0), Rod(from_nm: 30.0, to_nm: 80.0)",
    ] {
        let text = format!(
            "Scene(
                filament: Filament(sections: [{section}], at_nm: (4.0, 0.0, 0.0), rod: RodModel(law: Constant)),
                clamps: [Clamp(end: Start, slides: Freely)],
                loads: [ForcePerLength(force_pn_per_nm: (-{per_nm:?}, 0.0, 0.0))],
                repulsion: Repulsion({wall}),
                task: Equilibrium(),
            )"
        );
        let (assembly, outcome) = solved(&text);
        let state = assembly.system.state();
        let gap = assembly.smallest_gap_nm(state).unwrap();
        // Ends of a clamped monomer filament extend a rise beyond the load: 3 % more length, 1 %
        // less depth.
        let bound = if section.starts_with("Rod") {
            1e-6
        } else {
            2e-2
        };
        assert!((gap / -depth - 1.0).abs() < bound, "{gap}");
        let at = actin_sim::At::Path(1.0);
        let last = actin_sim::Record::new(&assembly.system, at, state.clone());
        let summary = Summary::new(&assembly, &last, &outcome);
        assert_eq!(summary.smallest_gap_nm, Some(gap));
    }
}

fn crossing(first: &str, shift_nm: f64) -> String {
    format!(
        "Scene(
            filaments: [
                Filament(sections: [{first}], rod: RodModel(law: Constant)),
                Filament(sections: [Rod(from_nm: 0.0, to_nm: 80.0, segments: 16)], at_nm: (9.0, -40.0, 40.0),
                    direction: (0.0, 1.0, 0.0), rod: RodModel(law: Constant)),
            ],
            clamps: [
                Clamp(end: Start), Clamp(end: End),
                Clamp(filament: 1, end: Start), Clamp(filament: 1, end: End),
            ],
            repulsion: Repulsion(),
            path: [Stage(set: [
                Shift(filament: 1, end: Start, shift_nm: ({shift_nm:?}, 0.0, 0.0)),
                Shift(filament: 1, end: End, shift_nm: ({shift_nm:?}, 0.0, 0.0)),
            ])],
            task: Equilibrium(),
        )"
    )
}

/// Each filament is bent by 4 nm. The contact force equals the derivative of the energy with
/// respect to the displacement of the ends.
#[test]
fn crossing_filaments_bend_each_other() {
    let rod = "Rod(from_nm: 0.0, to_nm: 80.0, segments: 16)";
    for first in [rod, "Ellipsoids(from_nm: 0.0, to_nm: 80.0)"] {
        let (assembly, outcome) = solved(&crossing(first, -12.0));
        let state = assembly.system.state();
        let gap = assembly.smallest_gap_nm(state).unwrap();
        assert_eq!(outcome.certificate().unwrap().negative, 0);
        let term = assembly
            .terms
            .iter()
            .position(|t| t.part == Part::Contacts)
            .unwrap();
        let mut loads = Loads::zeros(state);
        assembly.system.interactions()[term].add_loads(state, &mut loads);
        let on = |filament: usize| -> Vector3 {
            let points = assembly.filaments[filament].points.clone();
            points.map(|i| loads.force.get(i)).sum()
        };
        let energy = |shift: f64| solved(&crossing(first, shift)).0.system.potential_energy();
        let slope = (energy(-12.05) - energy(-11.95)) / 0.1;
        let error = on(1).x / slope - 1.0;
        println!(
            "{first}: gap {gap:.4} nm, force {:.3} pN, {error:e} from the work",
            on(1).x
        );
        assert!((on(0) + on(1)).norm() < 1e-10 * on(0).norm());
        // Square of the ratio of 0.05 nm to a few nm.
        assert!(
            error.abs() < 1e-3 && gap < -1.0 && gap > -2.0,
            "{error}, {gap}"
        );
    }
}

/// A filament and its neighbour's image move like a filament and a neighbour in the open. Rounding
/// of positions of 1 um grows by the ratio of contact stiffness to bending stiffness.
#[test]
fn contacts_across_faces_equal_contacts_in_the_open() {
    for task in [
        "Equilibrium()",
        "Dynamics(duration_ns: 0.02, drag: Water())",
        "Brownian(duration_ms: 2e-5, temperature_k: 298.0, seed: 3)",
    ] {
        let rod = "Rod(from_nm: 0.0, to_nm: 80.0, segments: 16)";
        let open = crossing(rod, -4.0)
            .replace("at_nm: (9.0,", "at_nm: (7.0,")
            .replace("task: Equilibrium()", &format!("task: {task}"))
            .replace("Stage(set", "Stage(duration_ns: 0.01, set");
        let open = match task {
            "Equilibrium()" => open.replace("duration_ns: 0.01, ", ""),
            _ => open,
        };
        let across = open
            .replace(
                "at_nm: (7.0, -40.0, 40.0)",
                "at_nm: (1007.0, -240.0, 340.0)",
            )
            .replace(
                "repulsion:",
                "periodic: PeriodicBox(size_nm: (500.0, 200.0, 100.0)), repulsion:",
            );
        let [(a, _), (b, _)] = [&open, &across].map(|text| solved(text));
        let (first, second) = (a.system.state(), b.system.state());
        let shift = Vector3::new(1000.0, -200.0, 300.0);
        let apart = (0..first.points.len()).map(|i| {
            let shift = if a.filaments[1].points.contains(&i) {
                shift
            } else {
                Vector3::zeros()
            };
            (first.points.position.get(i) + shift - second.points.position.get(i)).norm()
        });
        let largest = apart.fold(0.0, f64::max);
        let gap = b.smallest_gap_nm(second).unwrap();
        assert!(largest < 1e-8 && gap < -0.3, "{task}: {largest:e} {gap}");
    }
}

#[test]
fn passage_through_a_wall_fails() {
    let text = "Scene(
        filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 40.0)], at_nm: (4.0, 0.0, 0.0), rod: RodModel(law: Constant)),
        clamps: [Clamp(end: Start, slides: Freely)],
        loads: [ForcePerLength(force_pn_per_nm: (-500.0, 0.0, 0.0))],
        repulsion: Repulsion(planes: [Plane(at_nm: (0.0, 0.0, 0.0), normal: (1.0, 0.0, 0.0))]),
        task: Equilibrium(force_pn: 1e-5),
    )";
    let (failure, outcome) = failure(run_anyway(&mut build(text)).1);
    assert!(
        matches!(failure, Failure::ModelLimitExceeded(_)),
        "{failure}"
    );
    let beyond = &outcome.beyond_use[0];
    assert_eq!(
        (beyond.quantity.as_str(), beyond.filament, beyond.section),
        ("wall", 0, 0)
    );
    assert!(beyond.value > 1.0, "{beyond}");
}

#[test]
fn overlapping_filaments_are_refused_or_give_a_warning() {
    let scene = |x: f64| {
        format!(
            "Scene(
                filaments: [
                    Filament(sections: [Rod(from_nm: 0.0, to_nm: 80.0)], rod: RodModel(law: Fitted)),
                    Filament(sections: [Rod(from_nm: 0.0, to_nm: 80.0)], at_nm: ({x:?}, -40.0, 40.0),
                        rod: RodModel(law: Fitted),
                        direction: (0.0, 1.0, 0.0)),
                ],
                repulsion: Repulsion(),
                task: Dynamics(duration_ns: 1.0),
            )"
        )
    };
    let problem = |x| {
        let scene = actin_sim::Scene::from_ron(&scene(x)).unwrap();
        let notes = Assembly::build(&scene).map(|assembly| assembly.notes());
        notes.map(|notes| {
            let messages = notes.into_iter().map(|note| note.message);
            messages.collect::<Vec<_>>()
        })
    };
    let refused = problem(2.0).unwrap_err().to_string();
    assert!(
        refused.starts_with(
            "repulsion.radius_nm = 3.7: in the initial state filament 0 overlaps filament 1 by 5.40 nm at s = 40.00 and 40.00 nm"
        ),
        "{refused}"
    );
    let notes = problem(6.4).unwrap();
    assert_eq!(
        notes,
        [
            "repulsion: in the initial state filament 0 overlaps filament 1 by 1.00 nm at s = 40.00 and 40.00 nm, so it \
          is not an equilibrium"
        ]
    );
    assert!(problem(7.5).unwrap().is_empty());
}

/// A stable equilibrium without energy exists on the other side of a filament; the path must not
/// reach it.
#[test]
fn a_path_does_not_lead_filaments_through_each_other() {
    for (stiffness, largest_step) in [(20.0, 1.0), (20.0, 0.02), (600.0, 1.0)] {
        let text = format!(
            "Scene(
                filaments: [
                    Filament(sections: [Rod(from_nm: 0.0, to_nm: 60.0)], rod: RodModel(law: Constant)),
                    Filament(sections: [Rod(from_nm: 0.0, to_nm: 60.0)], at_nm: (7.5, -30.0, 30.0),
                        direction: (0.0, 1.0, 0.0), rod: RodModel(law: Constant)),
                ],
                clamps: [Clamp(end: Start), Clamp(end: End), Clamp(filament: 1, end: Start),
                    Clamp(filament: 1, end: End)],
                path: [Stage(set: [
                    Shift(filament: 1, end: Start, shift_nm: (-40.0, 0.0, 0.0)),
                    Shift(filament: 1, end: End, shift_nm: (-40.0, 0.0, 0.0)),
                ])],
                repulsion: Repulsion(stiffness_pn_per_nm: {stiffness:?}),
                task: Equilibrium(largest_step: {largest_step:?}),
            )"
        );
        let mut assembly = build(&text);
        let (trajectory, outcome) = run_anyway(&mut assembly);
        let (failure, _) = failure(outcome);
        let reason = failure.to_string();
        assert!(reason.contains("an interaction forbids"), "{reason}");
        let last = &trajectory.records.last().unwrap().state.points.position;
        let x = |filament: usize| {
            let points = assembly.filaments[filament].points.clone();
            last.get(points.start + points.len() / 2).x
        };
        assert!(x(1) > x(0), "{} and {}", x(0), x(1));
    }
}
