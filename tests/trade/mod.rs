//! `actin_sim::trade`: errors against independent runs, choice of the compared quantities, limits of the budget.

use actin_sim::mechanics::Vector3;
use actin_sim::trade::{Measure, Options, Trade, TradeCallbacks, TradeError, trade};
use actin_sim::{Assembly, End, Plan, Scene, Section};
use std::time::Duration;

const CANTILEVER: &str = "Scene(
    filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 98.585)]),
    clamps: [Clamp(end: Start)],
    loads: [
        EndForce(end: End, force_pn: (0.4, 0.0, 8.0)),
        Couple(end: End, couple_pn_nm: (0.0, 0.0, -90.0)),
    ],
    task: Equilibrium(),
)";

const SWINGING: &str = "Scene(
    filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 108.0)]),
    clamps: [Clamp(end: Start)],
    loads: [EndForce(end: End, force_pn: (-2.0, 0.0, 0.0))],
    task: Dynamics(duration_ns: 2.0, record_every_ns: 0.1),
)";

const PUSHED: &str = "Scene(
    filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 151.3)]),
    clamps: [Clamp(end: Start), Clamp(end: End)],
    path: [Stage(set: [Shift(end: End, shift_nm: (0.0, 0.0, -5.0))])],
    task: Equilibrium(leave_saddles: 10, accept_jumps: true),
)";

fn traded(text: &str, change: impl FnOnce(&mut Options)) -> Trade {
    let mut options = Options::default();
    change(&mut options);
    trade(
        &Scene::from_ron(text).unwrap(),
        &options,
        &TradeCallbacks::NONE,
    )
    .unwrap()
}

fn tip(scene: &Scene) -> [f64; 3] {
    let assembly = actin_sim::build(scene).unwrap();
    let (trajectory, _) = Plan::new(&assembly).unwrap().run().unwrap();
    let state = &trajectory.records.last().unwrap().state;
    let moved = assembly.tip_nm(state, End::End) - assembly.tip_nm(&assembly.rest, End::End);
    moved.into()
}

fn apart(a: [f64; 3], b: [f64; 3]) -> f64 {
    let squares = a.iter().zip(b).map(|(a, b)| (a - b).powi(2));
    squares.sum::<f64>().sqrt()
}

/// Errors of vectors include the direction: the tip displacement of rods has the correct size
/// within 1 %, but an error of a quarter.
#[test]
fn errors_of_the_table_match_independent_runs() {
    let found = traded(CANTILEVER, |options| {
        options.measures = vec![Measure::Tip];
        options.error = 0.05;
    });
    let reference = tip(&found.reference.scene);
    let size = apart(reference, [0.0; 3]);
    assert!(found.candidates.len() >= 8);
    for candidate in &found.candidates {
        let alone = apart(tip(&candidate.scene), reference) / size;
        let reported = candidate.errors[0].unwrap();
        assert!(
            (alone - reported).abs() < 1e-6,
            "{}: {alone} {reported}",
            candidate.name
        );
    }
    let rod = found
        .candidates
        .iter()
        .find(|c| c.name == "rod Homogenised 20 nm");
    assert!(rod.unwrap().errors[0].unwrap() > 0.2);
    let best = apart(tip(found.best_scene()), reference) / size;
    assert!(best <= 0.05, "{best}");
}

#[test]
fn rods_are_as_long_as_the_monomers() {
    let found = traded(CANTILEVER, |options| options.load_shares.clear());
    let whole = Assembly::build(&found.reference.scene).unwrap().length_nm();
    assert!((whole - 99.954).abs() < 1e-3);
    let of_trade = found.candidates.iter().filter(|c| c.name != "as written");
    for candidate in of_trade {
        let sections = &candidate.scene.filament.sections;
        let length = Assembly::build(&candidate.scene).unwrap().length_nm();
        assert!(
            (length - whole).abs() < 1e-9,
            "{}: {sections:?}",
            candidate.name
        );
    }
}

/// Position Verlet at 0.9 of the stability limit agrees with half of the default step within 0.1 %.
/// The best candidate resolves every monomer or has a larger error.
#[test]
fn headings_are_whole_names() {
    let observed = CANTILEVER.replace("task:", "observe: [Contour()], task:");
    let found = traded(&observed, |options| options.load_shares.clear());
    let table = found.to_string();
    let mut lines = table.lines().map(str::trim_end);
    let heading = lines.find(|line| line.starts_with("errors in %")).unwrap();
    let names = ["length_nm", "gyration_radius_nm", "largest_distance_nm"];
    for name in names.map(|name| format!(" contour[0]_{name} ")) {
        assert!(heading.contains(&name), "{heading}");
    }
    // Errors end below the ends of their names.
    let after = heading.find(" contour[0]_length_nm").unwrap() + " contour[0]_length_nm".len();
    let row = lines.next().unwrap();
    assert!(
        row[..after].ends_with(|last: char| last.is_ascii_digit()),
        "{row}"
    );
    assert!(row[after..].starts_with(' '), "{row}");
}

#[test]
fn candidates_of_motions_include_longer_steps() {
    let found = traded(SWINGING, |_| {});
    let best = &found.candidates[found.best.unwrap()];
    assert!(
        best.scene
            .filament
            .sections
            .iter()
            .all(|s| matches!(s, Section::Ellipsoids { .. }))
            || best.error() > 1e-3
    );
    let quick = found
        .candidates
        .iter()
        .find(|c| c.name.contains("Verlet"))
        .unwrap();
    assert!(quick.error() < 1e-3, "{}", quick.error());
    assert!(
        found
            .reference
            .own_errors
            .iter()
            .all(|error| error.unwrap() < 1e-4)
    );
    let records = |scene: &Scene| {
        let assembly = actin_sim::build(scene).unwrap();
        Plan::new(&assembly)
            .unwrap()
            .estimate()
            .unwrap()
            .record_every_ns
    };
    let [one, other] = [&found.reference.scene, found.best_scene()].map(records);
    assert_eq!(one.to_bits(), other.to_bits());
}

/// A straight filament under compression buckles in an undetermined direction: axial and transverse
/// parts are compared.
#[test]
fn undetermined_directions_are_left_out() {
    let found = traded(PUSHED, |options| {
        options.measures = ["height", "end-force"]
            .map(|name| name.parse().unwrap())
            .into();
        options.load_shares.clear();
    });
    assert!(
        found.left_out[0].contains("directions across the axis"),
        "{:?}",
        found.left_out
    );
    let fine = found
        .candidates
        .iter()
        .find(|c| c.name == "rod Homogenised 10 nm")
        .unwrap();
    assert!(fine.error() < 0.15, "{:?}", fine.errors);
}

fn with_sections(sections: &str, scene: &str) -> Scene {
    let written = "sections: [Rod(from_nm: 0.0, to_nm: 108.0)]";
    Scene::from_ron(&scene.replace(written, &format!("sections: {sections}"))).unwrap()
}

fn chosen(sections: &str, scene: &str) -> Assembly {
    actin_sim::build(&with_sections(sections, scene)).unwrap()
}

/// Without a limit of monomers every monomer is resolved. With too small a limit the resolution
/// with the smallest error is chosen, with a warning.
#[test]
fn sections_of_an_equilibrium_are_every_monomer_or_the_nearest() {
    let still = SWINGING.replace(
        "Dynamics(duration_ns: 2.0, record_every_ns: 0.1)",
        "Equilibrium()",
    );
    let whole = chosen("Adaptive(length_nm: 108.0, want: Tip(error: 0.02))", &still);
    assert_eq!((whole.counts().segments, whole.counts().monomers), (0, 42));
    let few = "Adaptive(length_nm: 108.0, want: Tip(error: 1e-6), also: [Energy(error: 0.02)], monomers: 13)";
    let few = chosen(few, &still);
    let found = few.chosen.as_ref().unwrap();
    assert!(few.counts().monomers <= 13 && !found.is_met && found.errors.len() == 2);
    let note = few
        .notes()
        .into_iter()
        .find(|n| n.message.contains("sections chosen"))
        .unwrap();
    assert!(
        note.message
            .contains("not reached with at most this number of monomers"),
        "{}",
        note.message
    );
}

#[test]
fn automatic_sections_are_refused_without_their_choice() {
    let adaptive = "Adaptive(length_nm: 108.0, want: Tip(error: 0.05))";
    let refused = Assembly::build(&with_sections(adaptive, SWINGING)).unwrap_err();
    let expected = "filament.sections = Adaptive(..): must be chosen before the scene is built: use `actin_sim::build`";
    assert_eq!(refused.to_string(), expected);
}

#[test]
fn sections_of_a_motion_meet_the_wanted_error() {
    let adaptive = "Adaptive(length_nm: 108.0, want: Tip(error: 0.05))";
    let [one, other] = [(); 2].map(|()| chosen(adaptive, SWINGING));
    assert_eq!(one.scene.to_ron(), other.scene.to_ron());
    let found = one.chosen.as_ref().unwrap();
    assert!(found.is_met && found.tried >= 3 && found.errors[0] <= 0.05);
    assert!(one.counts().segments > 0, "{found:?}");
    let every = chosen("[Ellipsoids(from_nm: 0.0, to_nm: 108.0)]", SWINGING);
    let tips = |assembly: &Assembly| {
        let (trajectory, _) = Plan::new(assembly).unwrap().run().unwrap();
        let rest = assembly.tip_nm(&assembly.rest, End::End);
        let records = trajectory.records.into_iter();
        records
            .map(|r| assembly.tip_nm(&r.state, End::End) - rest)
            .collect::<Vec<_>>()
    };
    let (tips, reference) = (tips(&one), tips(&every));
    let apart: f64 = tips
        .iter()
        .zip(&reference)
        .map(|(a, b)| (a - b).norm_squared())
        .sum();
    let size: f64 = reference.iter().map(Vector3::norm_squared).sum();
    assert!(((apart / size).sqrt() - found.errors[0]).abs() < 1e-9);
}

#[test]
fn error_of_is_the_difference_from_every_monomer() {
    let still = SWINGING.replace(
        "Dynamics(duration_ns: 2.0, record_every_ns: 0.1)",
        "Equilibrium(error_of: Tip)",
    );
    let of = |sections: &str| {
        let assembly = chosen(sections, &still);
        let (_, outcome) = Plan::new(&assembly).unwrap().run().unwrap();
        (
            tip(&assembly.scene),
            outcome.model_error().unwrap(),
            outcome.scatter().unwrap(),
        )
    };
    let (here, error, scatter) = of("[Rod(from_nm: 0.0, to_nm: 108.0)]");
    let (there, none, _) = of("[Ellipsoids(from_nm: 0.0, to_nm: 108.0)]");
    let size = apart(there, [0.0; 3]);
    assert!((error.value + error.error - size).abs() < 1e-6);
    assert!((error.relative - apart(here, there) / size).abs() < 1e-6);
    assert!(none.relative < 1e-9 && scatter.deviation > 0.0);
}

#[test]
fn a_budget_is_kept() {
    let scene = CANTILEVER
        .replace("98.585", "9858.5")
        .replace("(0.4, 0.0, 8.0)", "(4e-5, 0.0, 8e-4)")
        .replace("-90.0", "-0.9");
    let options = Options {
        budget: Duration::from_millis(10),
        ..Options::default()
    };
    match trade(
        &Scene::from_ron(&scene).unwrap(),
        &options,
        &TradeCallbacks::NONE,
    ) {
        Ok(found) => assert!(found.reference.name.contains("rod")),
        Err(error) => assert!(
            error.to_string().contains("the budget of 0.01 s"),
            "{error}"
        ),
    }
}

/// Means over seeds are compared with their standard errors; rods fluctuate as their monomers
/// within the bound.
#[test]
fn means_over_seeds_are_compared_in_heat() {
    let hot = "Scene(
        filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 108.0)]),
        clamps: [Clamp(end: Start)],
        task: Brownian(duration_ms: 0.001, temperature_k: 298.0, interfaces: QuasiHarmonic(sampled_ns: 2.0)),
    )";
    let found = traded(hot, |options| options.error = 0.1);
    let names: Vec<&str> = found.items.iter().map(|item| item.name.as_str()).collect();
    assert_eq!(names, ["tip mean", "tip rms"]);
    assert!(
        found
            .left_out
            .iter()
            .any(|left| left.contains("of 4 seeds")),
        "{:?}",
        found.left_out
    );
    let rod = found
        .candidates
        .iter()
        .find(|c| c.name == "rod Homogenised 20 nm")
        .unwrap();
    let (error, standard) = (rod.errors[1].unwrap(), rod.standard_errors[1]);
    assert!(
        standard > 0.0 && error < 0.05 + 3.0 * standard,
        "{error} {standard}"
    );
    assert!(rod.error() >= error + standard);
}

#[test]
fn missing_quantities_and_invalid_errors_are_refused() {
    let refused = |text: &str, options: &Options| {
        let scene = Scene::from_ron(text).unwrap();
        match trade(&scene, options, &TradeCallbacks::NONE) {
            Err(TradeError::Refused(problem)) => problem.to_string(),
            other => panic!("{other:?}"),
        }
    };
    let by = |name: &str| Options {
        measures: vec![name.parse().unwrap()],
        ..Options::default()
    };
    assert!(refused(CANTILEVER, &by("linker-force")).contains("the scene has no linker-force"));
    assert!(refused(PUSHED, &by("tip")).contains("the scene has no tip"));
    let error = Options {
        error: 1.5,
        ..Options::default()
    };
    assert!(refused(CANTILEVER, &error).contains("below 1"));
    let pinned = CANTILEVER.replace("Clamp(end: Start)", "Clamp(end: Start, hold: NodeAndFrame)");
    let message = refused(&pinned, &Options::default());
    assert!(
        message.contains("no other resolution to compare with"),
        "{message}"
    );
}
