//! Observed quantities in a heat bath against statistical mechanics, within their standard errors.

use crate::common::build;
use actin_rundir::RunDirectory;
use actin_sim::statistics::BlockAverages;
use actin_sim::{Assembly, BOLTZMANN_PN_NM_PER_K, MeanSummary, Plan, Record, Summary};

/// Tolerance of a mean in standard errors.
const ERRORS: f64 = 4.5;

fn run(text: &str) -> (Assembly, Vec<Record>, Summary) {
    let folder = tempfile::tempdir().unwrap();
    let directory = RunDirectory::create(folder.path(), false).unwrap();
    let assembly = build(text);
    let plan = Plan::new(&assembly).unwrap();
    let (trajectory, outcome) = plan.run().unwrap();
    let summary = directory.write(&plan, &trajectory, &outcome).unwrap();
    (assembly, trajectory.records, summary)
}

fn mean(summary: &Summary, column: &str) -> MeanSummary {
    let mean = summary.observables[column].mean.unwrap();
    assert!(mean.levelled_off, "{column}");
    mean
}

#[test]
fn energies_satisfy_equipartition() {
    let (assembly, records, summary) = run("Scene(
        filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 40.0, segments: 4)], rod: RodModel(law: Constant)),
        clamps: [Clamp(end: Start)],
        observe: [Energies],
        burn_in_ns: 20.0,
        output: (vtk: false, states: false),
        task: Dynamics(
            duration_ns: 420.0, record_every_ns: 0.2, step_safety: 0.25,
            drag: (translational_per_ns: 5.0, rotational_per_ns: 5.0),
            thermal: (temperature_k: 3.0, seed: 7),
        ),
    )");
    assert_eq!(records[0].kinetic_pn_nm.to_bits(), 0.0_f64.to_bits());
    let expected = 0.5 * assembly.counts().dofs as f64 * BOLTZMANN_PN_NM_PER_K * 3.0;
    for column in ["energy_kinetic_pn_nm", "energy_section_0_pn_nm"] {
        let found = mean(&summary, column);
        assert_eq!(found.records, 2001);
        let (value, error) = (found.mean.unwrap(), found.error.unwrap());
        assert!(
            (value - expected).abs() < ERRORS * error,
            "{column}: {value} {expected}"
        );
        // The scatter must not hide errors.
        assert!(error < 0.05 * expected, "{column}: {error}");
        assert!(found.independent_samples.unwrap() < 2001.0);
    }
}

const LENGTH: f64 = 100.0;

fn free_rod() -> String {
    let rigidity = BOLTZMANN_PN_NM_PER_K * 298.0 * LENGTH;
    format!(
        "Scene(
            filament: Filament(
                sections: [Rod(from_nm: 0.0, to_nm: {LENGTH:?}, segments: 10)],
                rod: RodModel(law: Constant, material: Rigidities(
                    shear_pn: (1e3, 1e3, 1e3), bend_pn_nm2: ({rigidity:?}, {rigidity:?}, {rigidity:?}),
                )),
            ),
            observe: [EndToEnd(), TangentCorrelation(over_nm: 30.0)],
            output: (vtk: false, states: false),
            task: Dynamics(
                duration_ns: 6000.0, record_every_ns: 1.0, integrator: PositionVerlet,
                drag: (translational_per_ns: 0.6, rotational_per_ns: 0.6),
                thermal: (temperature_k: 298.0, seed: 5),
            ),
        )"
    )
}

/// For a persistence length `p = B / kT` and length `L`, tangents decorrelate as `exp(-s / p)`. The
/// mean squared end-to-end distance is `2 p L (1 - p / L (1 - exp(-L / p)))` (Kratky and Porod
/// 1949). Ten segments of `p / 10` miss less than 0.5 % of either.
#[test]
fn a_free_rod_is_a_worm_like_chain() {
    let (_, records, summary) = run(&free_rod());
    let within = |value: f64, error: f64, expected: f64| {
        assert!(
            (value - expected).abs() < ERRORS * error + 0.005 * expected,
            "{value} {expected}"
        );
        assert!(error < 0.03 * expected, "{error}");
    };
    let cosine = mean(&summary, "tangent_correlation[0]_over_30nm");
    let exact = (-0.3_f64).exp();
    within(cosine.mean.unwrap(), cosine.error.unwrap(), exact);
    let derived = cosine.derived.unwrap();
    let (p, error) = (
        derived.persistence_length_nm.unwrap(),
        derived.persistence_length_error_nm.unwrap(),
    );
    // 0.5 % of the cosine are 1.7 % of the length.
    assert!((p - LENGTH).abs() < ERRORS * error + 1.7, "{p} {error}");
    let mut squares = BlockAverages::default();
    // The default burn-in is a fifth of the run.
    for record in records.iter().filter(|r| r.at.value() >= 1200.0) {
        squares.push(record.observed[3].powi(2));
    }
    let square = squares.estimate().unwrap();
    assert_eq!(square.values, cosine.records);
    let expected = 2.0 * LENGTH * LENGTH * (-1.0_f64).exp();
    within(square.mean, square.error.unwrap(), expected);
}

/// Rods of few segments have the persistence length of monomers, 11.6 um (`docs/measured/heat.md`): their joints next to free
/// and pinned ends as well. Without cross-sections at the ends it is 17.4 and 23.4 um for three and two segments.
#[test]
fn joints_at_ends_have_the_rigidity_of_others() {
    for (length_nm, segments, clamps) in [
        (120.0, 3, ""),
        (80.0, 2, ""),
        (80.0, 2, "clamps: [Clamp(end: Start, hold: Pin)],"),
    ] {
        let (_, _, summary) = run(&format!(
            "Scene(
                filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: {length_nm:?}, segments: {segments})]),
                {clamps}
                observe: [TangentCorrelation(over_nm: 40.0)],
                output: (vtk: false, states: false),
                task: Brownian(duration_ms: 0.5, temperature_k: 298.0, record_every_ns: 500.0, seed: 1),
            )"
        ));
        let cosine = mean(&summary, "tangent_correlation[0]_over_40nm");
        let (mean, error) = (cosine.mean.unwrap(), cosine.error.unwrap());
        let scale = -40.0 / mean.ln();
        let error = scale * error / (1.0 - mean);
        println!("{segments} segments {clamps}: {scale:.0} +- {error:.0} nm");
        assert!(
            (scale - 11_600.0).abs() < 3.0 * error + 200.0 && error < 900.0,
            "{scale} {error}"
        );
    }
}

fn heated(filament: &str, scene: &str, task: &str) -> String {
    format!(
        "Scene(
            filament: Filament(sections: [
                Rod(from_nm: 0.0, to_nm: 60.0{filament},
            {scene}
            observe: [TangentCorrelation(over_nm: 30.0)],
            output: (vtk: false, states: false),
            task: Dynamics(
                drag: (translational_per_ns: 1.0, rotational_per_ns: 1.0),
                thermal: (temperature_k: 298.0, seed: 5), {task}
            ),
        )"
    )
}

/// Keys of filament and scene that bend or straighten a rod, and the reason in the warning.
const BENDS: [(&str, &str, &str); 8] = [
    (
        ")])",
        "clamps: [Clamp(end: Start)], loads: [Force(end: End, force_pn: (0.0, 0.0, 5.0))],",
        "loads act on it",
    ),
    (
        ")])",
        "clamps: [Clamp(end: Start), Clamp(end: End, hold: Pin, slides: AlongAxis)],",
        "both its ends are held",
    ),
    (")], shape: Arc(radius_nm: 100.0))", "", "it has a shape"),
    (
        ", altered: (rest_curvature_per_nm: (0.0, 0.01)))])",
        "",
        "it is curved at rest",
    ),
    (
        ")])",
        "linkers: [Linker(at_nm: 60.0, displaced_nm: (0.0, 0.0, 0.0), stiffness_pn_per_nm: 1.0)],",
        "linkers hold it",
    ),
    (
        ")])",
        "repulsion: Repulsion(planes: [(at_nm: (0.0, 0.0, -9.0), normal: (0.0, 0.0, 1.0))]),",
        "walls repel it",
    ),
    (
        ")])",
        "clamps: [Clamp(end: Start)], path: [Stage(duration_ns: 0.1, set: [Turn(end: Start, turn_deg: (9.0, 0.0, 0.0))])],",
        "a clamped end is moved",
    ),
    (
        ", altered: (bend_rigidity_factor: 0.5)), Rod(from_nm: 60.0, to_nm: 100.0)])",
        "",
        "its sections are altered differently",
    ),
];

#[test]
fn persistence_lengths_require_bending_by_heat_alone() {
    let told = |filament: &str, scene: &str| {
        let task = "duration_ns: 0.2, record_every_ns: 0.02";
        let (_, _, summary) = run(&heated(filament, scene, task));
        let column = summary.observables["tangent_correlation[0]_over_30nm"];
        let mean = column.mean.unwrap();
        assert!(mean.mean.is_some());
        let is_of_it = |note: &String| note.starts_with("observe[0]: no persistence length");
        let notes = summary.notes.into_iter().filter(is_of_it);
        (mean.derived.is_some(), notes.collect::<Vec<_>>())
    };
    for (filament, scene, reason) in BENDS {
        let (is_given, notes) = told(filament, scene);
        assert!(!is_given && notes.len() == 1, "{reason}: {notes:?}");
        assert!(notes[0].contains(reason), "{notes:?}");
    }
    for (filament, scene) in [
        (")])", ""),
        (")])", "clamps: [Clamp(end: Start)],"),
        (", altered: (rest_twist_per_nm: 0.01))])", ""),
    ] {
        assert_eq!(
            told(filament, scene),
            (true, Vec::new()),
            "{filament} {scene}"
        );
    }
}

#[test]
fn means_of_one_record_are_noted() {
    let notes = |task: &str, scene: &str| {
        let text = heated(")])", scene, task);
        let assembly = build(&text);
        let notes = Plan::new(&assembly).unwrap().notes();
        notes
            .into_iter()
            .map(|note| note.message)
            .collect::<Vec<_>>()
    };
    // The burn-in of 0.4 ns leaves only the last record.
    let told = notes("duration_ns: 2.0, record_every_ns: 2.0", "");
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(
        told[0].starts_with("observe: means average 1 record(s)"),
        "{told:?}"
    );
    let told = notes("duration_ns: 2.0, record_every_ns: 5.0", "");
    assert_eq!(told.len(), 2, "{told:?}");
    assert!(told[0].contains("longer than the motion"), "{told:?}");
    assert!(
        told[1].starts_with("observe: means average 1 record(s)"),
        "{told:?}"
    );
    let told = notes("duration_ns: 2.0, record_every_ns: 0.5", "burn_in_ns: 1.6,");
    assert_eq!(told.len(), 1, "{told:?}");
    // Two records: at 1.5 ns and at the end.
    assert_eq!(
        notes("duration_ns: 2.0, record_every_ns: 0.5", "burn_in_ns: 1.5,"),
        [""; 0]
    );
}
