//! Observed quantities against theory, summaries and profiles of the same state.

use super::{Memory, View, observed_columns, observed_values};
use crate::{Assembly, At, End, Plan, Record, Scene, Summary};
use actin_mechanics::{State, Vector3, Xorshift, perturb, rotation};

pub(super) fn build(text: &str) -> Assembly {
    Assembly::build(&Scene::from_ron(text).unwrap()).unwrap()
}

pub(super) fn observe(assembly: &Assembly, state: &State) -> Vec<f64> {
    let energies: Vec<f64> = assembly
        .system
        .interactions()
        .iter()
        .map(|i| i.energy(state))
        .collect();
    let view = View::new(assembly, (At::Time(0.0), state), (&energies, 0.25));
    observed_values(&view, &mut Memory::new(assembly))
}

/// The value of a column.
pub(super) fn value(assembly: &Assembly, row: &[f64], column: &str) -> f64 {
    let columns = observed_columns(assembly);
    let place = columns.iter().position(|name| name == column);
    row[place.unwrap_or_else(|| panic!("{column} is not in {columns:?}"))]
}

const ALL: &str = "Scene(
    filament: Filament(sections: [
        Ellipsoids(from_nm: 0.0, to_nm: 30.0), Rod(from_nm: 30.0, to_nm: 80.0),
    ]),
    clamps: [Clamp(end: Start)],
    loads: [EndForce(end: End, force_pn: (2.0, -1.0, 0.5))],
    linkers: [Linker(
        at_nm: 60.0, radius_nm: 2.0, displaced_nm: (3.0, 1.0, 0.0),
        stiffness_pn_per_nm: 10.0, rest_length_nm: 2.0,
    )],
    observe: [
        Tip(), Tip(end: Start), EndReaction(end: Start), Linker(linker: 0),
        Curvature(at_nm: 40.0), Twist(at_nm: 40.0), Strain(at_nm: 40.0),
        EndToEnd(), Contour(), Energies,
        SquaredDisplacement(of: Tip), SquaredDisplacement(of: Centre, lag_ns: 0.5),
        TangentCorrelation(over_nm: 20.0),
    ],
    task: Dynamics(duration_ns: 1.0, record_every_ns: 0.25),
)";

fn recorded(assembly: &Assembly) -> (Record, Summary) {
    let mut state = assembly.rest.clone();
    perturb(&mut state, &mut Xorshift::new(5), 0.05, 0.02);
    let mut record = Record::new(&assembly.system, At::Time(0.0), state);
    record.row.kinetic_pn_nm = 0.25;
    record.row.observed = observe(assembly, &record.state);
    let outcome = crate::Outcome::new(crate::Status::Completed, 0.0);
    let summary = Summary::new(assembly, &record, &outcome);
    (record, summary)
}

#[test]
fn observables_agree_with_the_summary() {
    let assembly = build(ALL);
    let (record, summary) = recorded(&assembly);
    let start = summary.end_reactions.start.unwrap();
    let (linker, shape) = (summary.linkers[0], summary.shape);
    for (column, expected) in [
        ("tip[0]_y_nm", summary.tip_nm[1]),
        ("reaction[0]_start_force_x_pn", start.force_pn[0]),
        ("reaction[0]_start_torque_z_pn_nm", start.torque_pn_nm[2]),
        ("linker[0]_force_x_pn", linker.force_pn[0]),
        ("linker[0]_tension_pn", 10.0 * linker.extension_nm),
        ("linker[0]_length_nm", 2.0 + linker.extension_nm),
        ("contour[0]_twist_turns", shape.twist_turns),
        ("contour[0]_largest_distance_nm", shape.largest_distance_nm),
        ("energy_potential_pn_nm", summary.energy_pn_nm.potential),
        ("energy_kinetic_pn_nm", 0.25),
        ("squared_displacement[0]_tip_nm2", 0.0),
    ] {
        let found = value(&assembly, &record.observed, column);
        assert_eq!(found.to_bits(), expected.to_bits(), "{column}");
        let report_extrapolation = summary.observables[column];
        assert_eq!(
            (report_extrapolation.last, report_extrapolation.mean),
            (Some(expected), None),
            "{column}"
        );
    }
}

#[test]
fn columns_belong_together() {
    let assembly = build(ALL);
    let (record, summary) = recorded(&assembly);
    let columns = observed_columns(&assembly);
    assert_eq!(record.observed.len(), columns.len());
    let mut names = columns.clone();
    names.sort();
    names.dedup();
    assert_eq!(names.len(), columns.len());
    let of = |column: &str| value(&assembly, &record.observed, column);
    assert!(of("squared_displacement[0]_centre_over_0.5ns_nm2").is_nan());
    let parts = ["section_0", "junction_0_1", "section_1"];
    let parts = parts.map(|part| of(&format!("energy_{part}_pn_nm")));
    let elastic = summary.energy_pn_nm.elastic - summary.energy_pn_nm.terms["linker"];
    // Round-off of a different order of summation.
    assert!((parts.iter().sum::<f64>() / elastic - 1.0).abs() < 1e-12);
    let reach = ["x", "y", "z"].map(|axis| of(&format!("end_to_end[0]_{axis}_nm")));
    let length = of("end_to_end[0]_nm");
    assert!((Vector3::from(reach).norm() - length).abs() < 1e-12 && length > 70.0);
    let bend = ["_x", "_y", ""].map(|axis| of(&format!("curvature[0]_at_40nm{axis}_rad_per_nm")));
    assert!((bend[0].hypot(bend[1]) - bend[2]).abs() < 1e-15 && bend[2] > 1e-4);
}

/// In uniform bending, twist and stretch, tangents at a distance `d` enclose the angle `kappa d`.
#[test]
fn an_even_curve_has_its_curvature_twist_and_correlation() {
    for sections in [
        "Rod(from_nm: 0.0, to_nm: 80.0)",
        "Ellipsoids(from_nm: 0.0, to_nm: 80.0)",
        "Ellipsoids(from_nm: 0.0, to_nm: 30.0), Rod(from_nm: 30.0, to_nm: 80.0)",
    ] {
        let assembly = build(&format!(
            "Scene(filament: Filament(sections: [{sections}]),
             observe: [Curvature(at_nm: 33.3), Twist(at_nm: 33.3), TangentCorrelation(over_nm: 25.0)],
             task: Dynamics(duration_ns: 1.0))"
        ));
        let rate = Vector3::new(0.003, -0.004, 0.0);
        let mut state = assembly.rest.clone();
        for (i, info) in assembly.frames.iter().enumerate() {
            let q = rotation::exp(rate * info.s_nm) * state.frames.orientation.get(i);
            state.frames.orientation.set(i, q);
        }
        let row = observe(&assembly, &state);
        let of = |column: &str| value(&assembly, &row, column);
        assert!((of("curvature[0]_at_33.3nm_rad_per_nm") - 0.005).abs() < 1e-12);
        assert!(of("twist[0]_at_33.3nm_rad_per_nm").abs() < 1e-12);
        // Linear interpolation between two frames misses `kappa^2 h^2 / 8` of the cosine, 3e-4 at
        // 10 nm.
        let cosine = of("tangent_correlation[0]_over_25nm");
        assert!((cosine - 0.125_f64.cos()).abs() < 4e-4, "{cosine}");
    }
}

#[test]
fn a_straight_filament_has_its_length() {
    let assembly = build(
        "Scene(filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 90.0)]),
         observe: [Strain(at_nm: 12.0), Contour(), EndToEnd(), SquaredDisplacement(of: Centre)],
         task: Dynamics(duration_ns: 1.0))",
    );
    let mut state = assembly.rest.clone();
    for (i, info) in assembly.points.iter().enumerate() {
        let place = Vector3::new(0.02 * info.s_nm, 0.0, 1.1 * info.s_nm);
        state.points.position.set(i, place);
    }
    let length = 90.0 * 1.1_f64.hypot(0.02);
    let row = observe(&assembly, &state);
    for (column, expected) in [
        ("strain[0]_at_12nm_x", 0.02),
        ("strain[0]_at_12nm_y", 0.0),
        ("strain[0]_at_12nm_z", 0.1),
        ("contour[0]_length_nm", length),
        ("contour[0]_gyration_radius_nm", length / 12.0_f64.sqrt()),
        ("end_to_end[0]_nm", length),
    ] {
        let found = value(&assembly, &row, column);
        assert!((found - expected).abs() < 1e-12, "{column}: {found}");
    }
}

/// A point in uniform motion has a constant displacement over a lag. A record off the regular times
/// has none.
#[test]
fn displacements_are_over_their_lag() {
    let assembly = build(
        "Scene(filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 90.0)]),
         observe: [SquaredDisplacement(of: Tip, lag_ns: 0.5), SquaredDisplacement(of: Centre)],
         task: Dynamics(duration_ns: 3.0, record_every_ns: 0.25))",
    );
    let mut memory = Memory::new(&assembly);
    let energies = vec![0.0; assembly.terms.len()];
    let mut at = |time: f64| {
        let mut state = assembly.rest.clone();
        for i in 0..state.points.len() {
            state.points.position.add(i, Vector3::x() * (2.0 * time));
        }
        let view = View::new(&assembly, (At::Time(time), &state), (&energies, 0.0));
        observed_values(&view, &mut memory)
    };
    let [first, second] = [at(0.0), at(0.25)];
    assert!(first[0].is_nan() && second[0].is_nan());
    for k in 2..8 {
        let time = 0.25 * f64::from(k);
        let row = at(time);
        // Round-off of positions of 90 nm.
        assert!((row[0] - 1.0).abs() < 1e-12, "{row:?}");
        assert!((row[1] - (2.0 * time).powi(2)).abs() < 1e-10, "{row:?}");
    }
    assert!(at(1.9)[0].is_nan());
    // Memory is limited to the lag.
    assert!(memory.pasts().next().unwrap().recent.len() <= 4);
}

#[test]
fn invalid_distances_and_lags_are_refused() {
    let refusal = |observe: &str, task: &str| {
        let assembly = build(&format!(
            "Scene(filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 60.0)]),
             clamps: [Clamp(end: Start)], observe: [Tip(), {observe}], task: {task})"
        ));
        Plan::new(&assembly)
            .err()
            .map(|problem| problem.to_string())
    };
    let statics = "Equilibrium()";
    let timed = "Dynamics(duration_ns: 2.0, record_every_ns: 0.25)";
    assert_eq!(refusal("TangentCorrelation(over_nm: 50.0)", statics), None);
    assert_eq!(
        refusal("TangentCorrelation(over_nm: 50.5)", statics).unwrap(),
        "observe[1].over_nm = 50.5: must be at most 50.0, from the first cross-section to the last"
    );
    assert_eq!(
        refusal("SquaredDisplacement(of: Tip, lag_ns: 0.75)", timed),
        None
    );
    assert_eq!(
        refusal("SquaredDisplacement(of: Tip, lag_ns: 0.3)", timed).unwrap(),
        "observe[1].lag_ns = 0.3: must be a multiple of the time between records, 0.25"
    );
}

#[test]
fn tangents_correlate_over_any_distance() {
    for over in ["1e-60", "1e-10", "1e-9", "1e-3"] {
        let scene = |segments| {
            build(&format!(
                "Scene(filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 60.0, segments: {segments})]),
                 observe: [TangentCorrelation(over_nm: {over})], task: Equilibrium())"
            ))
        };
        let assembly = scene(6);
        assert!(Plan::new(&assembly).is_ok());
        // Straight: all cosines are 1.
        let row = observe(&assembly, &assembly.rest);
        assert!((row[0] - 1.0).abs() < 1e-12, "{over}: {row:?}");
        assert!(Plan::new(&scene(1)).is_err());
    }
}

#[test]
fn ends_are_distinguished() {
    let assembly = build(ALL);
    let row = observe(&assembly, &assembly.rest);
    let start = assembly.tip_nm(&assembly.rest, End::Start);
    assert_eq!(
        value(&assembly, &row, "start[0]_z_nm").to_bits(),
        start.z.to_bits()
    );
}
