//! Small mixed filaments and synthetic runs for tests of summaries.

use crate::{Assembly, At, Linker, LinkerSite, Outcome, Record, Scene, Status, Trajectory};
use actin_mechanics::State;
use actin_mechanics::{Xorshift, perturb, randomise_velocities};

/// Monomers at a clamped start, followed by a rod. The title needs XML escapes.
const CLAMPED_START: &str = r#"Scene(
    title: "A tip <force> & \"two\" models",
    filament: Filament(sections: [
        Ellipsoids(from_nm: 0.0, to_nm: 12.0),
        Rod(from_nm: 12.0, to_nm: 42.0, segments: 3),
    ], monomers: Monomers(anchors: Independent, seed: 18446744073709551615)),
    clamps: [Clamp(end: Start)],
    loads: [EndForce(end: End, force_pn: (2.0, -1.0, 0.5))],
    task: Dynamics(duration_ns: 1.0),
)"#;

/// A rod clamped at its end, with a force at its start.
const CLAMPED_END: &str = r"Scene(
    filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 30.0, segments: 3)]),
    clamps: [Clamp(end: End)],
    loads: [EndForce(end: Start, force_pn: (2.0, -1.0, 0.5))],
    task: Dynamics(duration_ns: 1.0),
)";

fn build(text: &str) -> Assembly {
    let scene = Scene::from_ron(text).unwrap();
    Assembly::build(&scene).unwrap()
}

pub(super) fn clamped_start() -> Assembly {
    build(CLAMPED_START)
}

pub(super) fn linked() -> Assembly {
    let mut scene = Scene::from_ron(CLAMPED_START).unwrap();
    scene.linkers.push(Linker {
        filament: 0,
        to: None,
        at_nm: 25.0,
        radius_nm: 1.8,
        azimuth_deg: 30.0,
        image: [0; 3],
        anchor_nm: None,
        displaced_nm: Some([1.0, 0.5, -0.3]),
        stiffness_pn_per_nm: 3.0,
        rest_length_nm: 0.4,
        tilt_pn_nm: 0.0,
        twist_pn_nm: 0.0,
        kinetics: None,
    });
    Assembly::build(&scene).unwrap()
}

/// Builds the filament of [`clamped_start`] and a second mixed one, joined by a linker.
pub(super) fn pair() -> Assembly {
    let mut scene = Scene::from_ron(CLAMPED_START).unwrap();
    let mut beside = scene.filament.clone();
    beside.at_nm = [9.0, 0.0, 2.0];
    beside.direction = [0.2, 0.0, 1.0];
    beside.monomers.semi_axes_nm = [2.0, 2.0, 2.0];
    scene.other_filaments.push(beside);
    scene.linkers.push(Linker {
        filament: 1,
        to: Some(LinkerSite {
            filament: 0,
            at_nm: 25.0,
            radius_nm: 1.8,
            azimuth_deg: 30.0,
        }),
        at_nm: 8.0,
        radius_nm: 1.8,
        azimuth_deg: 0.0,
        image: [0; 3],
        anchor_nm: None,
        displaced_nm: None,
        stiffness_pn_per_nm: 3.0,
        rest_length_nm: 0.4,
        tilt_pn_nm: 0.0,
        twist_pn_nm: 0.0,
        kinetics: None,
    });
    Assembly::build(&scene).unwrap()
}

pub(super) fn clamped_end() -> Assembly {
    build(CLAMPED_END)
}

/// Three records of random states near rest. All numbers differ, except those of fixed bodies.
pub(super) fn trajectory(assembly: &Assembly) -> Trajectory {
    let mut noise = Xorshift::new(7);
    let records = [0.0, 0.1, 1.0 / 3.0].map(|time_ns| {
        let mut state = assembly.rest.clone();
        perturb(&mut state, &mut noise, 0.1, 0.05);
        randomise_velocities(&mut state, &mut noise, 2.0, 1.5);
        record(assembly, time_ns, state)
    });
    Trajectory {
        records: records.into(),
    }
}

pub(super) fn record(assembly: &Assembly, time_ns: f64, state: State) -> Record {
    Record::new(&assembly.system, At::Time(time_ns), state)
}

pub(super) fn outcome() -> Outcome {
    Outcome {
        steps: 12,
        force_evaluations: 48,
        time_step_ns: Some(3.5e-3),
        largest_frequency_rad_per_ns: Some(569.25),
        ..Outcome::new(Status::Completed, 0.1)
    }
}
