//! Tests of the keys and the text of `summary.json`, and small mixed filaments and synthetic runs for tests of
//! summaries.

use super::*;
use crate::{At, Linker, LinkerSite, Record, Scene, Trajectory};
use actin_mechanics::{State, Xorshift, perturb, randomise_velocities};
use serde_json::Value;

fn summary() -> Summary {
    let assembly = linked();
    let last = trajectory(&assembly).records.pop().unwrap();
    Summary::new(&assembly, &last, &outcome())
}

const KEYS: &str = "
    /scene /status /counts/monomers /counts/bonds /counts/segments /counts/junctions /counts/dofs
    /energy_pn_nm/total /energy_pn_nm/potential /energy_pn_nm/kinetic /energy_pn_nm/elastic
    /energy_pn_nm/bonds /energy_pn_nm/rod /energy_pn_nm/junction /energy_pn_nm/load /tip_nm/2
    /tip_displacement_nm/2 /end_reactions/start/force_pn/2 /end_reactions/start/torque_pn_nm/2
    /shape/twist_turns /shape/writhe /shape/link_turns /shape/largest_distance_nm
    /filaments/0/counts/monomers /filaments/0/tip_nm/2 /filaments/0/tip_displacement_nm/2
    /filaments/0/end_reactions/start/force_pn/2 /filaments/0/elastic_pn_nm
    /filaments/0/shape/twist_turns /filaments/0/seed /notes /warnings /beyond_range /unstable_twist
    /linkers/0/filament /linkers/0/to_filament /linkers/0/site_nm/2 /linkers/0/anchor_nm/2
    /linkers/0/force_pn/2 /linkers/0/extension_nm /residual/force_pn /residual/torque_pn_nm
    /lowest_stiffness_eigenvalue /stability /saddles_left /work/steps /work/force_evaluations
    /work/newton_iterations /wall_s /version /format /seed /time_ns /time_step_ns
    /largest_frequency_rad_per_ns /beyond_use /jumps
";

#[test]
fn keys_are_the_fixed_ones() {
    let json = serde_json::to_value(summary()).unwrap();
    for path in KEYS.split_whitespace() {
        assert!(json.pointer(path).is_some(), "{path} in {json:#}");
    }
    assert_eq!(json["status"], "completed");
    assert_eq!(json["lowest_stiffness_eigenvalue"], Value::Null);
    assert_eq!(json["version"], env!("CARGO_PKG_VERSION"));
    assert!(json["end_reactions"].get("end").is_none());
    // Larger than 2^53, so conversion to `f64` would change the seed.
    assert_eq!(json["seed"], u64::MAX);
}

#[test]
fn satisfied_stop_rule_means_converged() {
    let json = serde_json::to_value(crate::Status::Converged).unwrap();
    assert_eq!(json, "converged");
}

/// The text round-trips with `str::parse`. `serde_json` without `float_roundtrip` rounds to within
/// one unit.
#[test]
fn the_text_is_exact_and_reads_back() {
    let summary = summary();
    let text = serde_json::to_string_pretty(&summary).unwrap();
    let is_scalar = |(key, _): &(String, f64)| !key.ends_with(']');
    for (key, value) in summary.numbers().into_iter().filter(is_scalar) {
        let leaf = format!("\"{}\": ", key.rsplit('.').next().unwrap());
        let mut found = text.split(&leaf).skip(1).map(|after| {
            let end = after.find([',', '\n']).unwrap();
            after[..end].parse::<f64>()
        });
        assert!(found.any(|v| v == Ok(value)), "{key} = {value:?} in {text}");
    }
    let back: Summary = serde_json::from_str(&text).unwrap();
    for ((key, a), (_, b)) in summary.numbers().iter().zip(back.numbers()) {
        assert!(
            (a - b).abs() <= f64::EPSILON * a.abs(),
            "{key}: {a} and {b}"
        );
    }
    assert_eq!(back.counts, summary.counts);
    assert_eq!(back.work, summary.work);
    assert_eq!((back.scene, back.seed), (summary.scene, summary.seed));
}

/// Checks for finite values need all numbers, with the keys of the file.
#[test]
fn numbers_have_the_keys_of_the_file() {
    let summary = summary();
    let json = serde_json::to_value(&summary).unwrap();
    let numbers = summary.numbers();
    for (key, value) in &numbers {
        let path = key.replace('[', "/").replace(']', "").replace('.', "/");
        assert_eq!(
            json.pointer(&format!("/{path}")),
            Some(&Value::from(*value)),
            "{key}"
        );
    }
    let keys = [
        "tip_displacement_nm[1]",
        "energy_pn_nm.rod",
        "linkers[0].force_pn[2]",
    ];
    for key in keys {
        assert!(numbers.iter().any(|(name, _)| name == key), "{key}");
    }
}

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

/// Three records of random states near rest. All numbers differ, except the numbers of fixed bodies.
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
