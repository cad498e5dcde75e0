//! Names of the files of a run directory.

pub(crate) const SCENE: &str = "scene.ron";
pub(crate) const SUMMARY: &str = "summary.json";
pub(crate) const ENERGIES: &str = "energies.csv";
pub(crate) const OBSERVABLES: &str = "observables.csv";
pub(crate) const EVENTS: &str = "events.csv";
pub(crate) const PROFILE: &str = "profile.csv";
pub(crate) const STATES: &str = "states.npz";
pub(crate) const OTHER_STATES: &str = "other_states.npz";
pub(crate) const COLLECTION: &str = "run.pvd";
pub(crate) const MACRO: &str = "open_in_paraview.py";
pub(crate) const CHECKPOINT: &str = "checkpoint.bin";
pub(crate) const RECORDS: &str = "records.bin";
pub(crate) const END: &str = "end.bin";
pub(crate) const END_ROWS: &str = "end_rows.bin";
pub(crate) const STRETCHES: &str = "stretches.json";
pub(crate) const SWITCHES: &str = "switches.csv";
pub(crate) const PICTURES: &str = "vtk";

/// Manifest, a name that user files are unlikely to have.
pub(crate) const MANIFEST: &str = "actin-run.json";

/// Files of a run except pictures, manifest and lock.
pub(crate) const FILES: [&str; 16] = [
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
    END,
    END_ROWS,
    STRETCHES,
    SWITCHES,
];

/// Tables, which users may edit.
pub(crate) const TABLES: [&str; 4] = [ENERGIES, EVENTS, OBSERVABLES, PROFILE];

pub(crate) const BEFORE_RESULTS: [&str; 3] = [SCENE, CHECKPOINT, RECORDS];

pub(crate) fn picture_name(record: usize) -> String {
    format!("{PICTURES}/{record:04}.vtp")
}

/// Index of the record whose picture has this name.
pub(crate) fn picture_index(name: &str) -> Option<usize> {
    let rest = name.strip_prefix(PICTURES)?.strip_prefix('/')?;
    let index = rest.strip_suffix(".vtp")?.parse().ok()?;
    (picture_name(index) == name).then_some(index)
}
