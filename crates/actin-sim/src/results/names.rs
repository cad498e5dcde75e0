//! Names of the files of a run directory.

pub(super) const SCENE: &str = "scene.ron";
pub(super) const SUMMARY: &str = "summary.json";
pub(super) const ENERGIES: &str = "energies.csv";
pub(super) const OBSERVABLES: &str = "observables.csv";
pub(super) const EVENTS: &str = "events.csv";
pub(super) const PROFILE: &str = "profile.csv";
pub(super) const STATES: &str = "states.npz";
pub(super) const OTHER_STATES: &str = "other_states.npz";
pub(super) const COLLECTION: &str = "run.pvd";
pub(super) const MACRO: &str = "open_in_paraview.py";
pub(super) const CHECKPOINT: &str = "checkpoint.bin";
pub(super) const RECORDS: &str = "records.bin";
pub(super) const STRETCHES: &str = "stretches.json";
pub(super) const SWITCHES: &str = "switches.csv";
pub(super) const PICTURES: &str = "vtk";

/// Manifest, a name that user files are unlikely to have.
pub(super) const MANIFEST: &str = "actin-run.json";

/// Files of a run except pictures, manifest and lock.
pub(super) const FILES: [&str; 14] = [
    SCENE,
    SUMMARY,
    ENERGIES,
    EVENTS,
    OBSERVABLES,
    PROFILE,
    STATES,
    OTHER_STATES,
    COLLECTION,
    MACRO,
    CHECKPOINT,
    RECORDS,
    STRETCHES,
    SWITCHES,
];

/// Tables, which users may edit.
pub(super) const TABLES: [&str; 4] = [ENERGIES, EVENTS, OBSERVABLES, PROFILE];

pub(super) const BEFORE_RESULTS: [&str; 3] = [SCENE, CHECKPOINT, RECORDS];

pub(super) fn picture_name(record: usize) -> String {
    format!("{PICTURES}/{record:04}.vtp")
}

/// Index of the record whose picture has this name.
pub(super) fn picture_index(name: &str) -> Option<usize> {
    let rest = name.strip_prefix(PICTURES)?.strip_prefix('/')?;
    let index = rest.strip_suffix(".vtp")?.parse().ok()?;
    (picture_name(index) == name).then_some(index)
}
