//! Tests of the keys and the text of `summary.json`.

#[path = "../../../actin-rundir/src/fixture.rs"]
#[expect(dead_code, reason = "names of files are for run directories")]
mod fixture;

use super::*;
use crate::Scene;
pub(super) use fixture::{clamped_start, linked, outcome, pair, trajectory};
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

/// A rod clamped at its end, with a force at its start.
const CLAMPED_END: &str = r"Scene(
    filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 30.0, segments: 3)]),
    clamps: [Clamp(end: End)],
    loads: [EndForce(end: Start, force_pn: (2.0, -1.0, 0.5))],
    task: Dynamics(duration_ns: 1.0),
)";

pub(super) fn clamped_end() -> Assembly {
    Assembly::build(&Scene::from_ron(CLAMPED_END).unwrap()).unwrap()
}
