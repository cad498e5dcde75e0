//! Small mixed filaments and synthetic runs for tests of this crate and of summaries in `actin-sim`.

use actin_sim::mechanics::{Xorshift, perturb, randomise_velocities};
use actin_sim::{Assembly, At, Outcome, Record, Scene, Status, Trajectory};
use std::path::{Path, PathBuf};

/// Monomers at a clamped start, followed by a rod, with more keys of the scene. The title needs XML
/// escapes.
fn build(more: &str) -> Assembly {
    let text = format!(
        r#"Scene(
            title: "A tip <force> & \"two\" models",
            clamps: [Clamp(end: Start)],
            loads: [EndForce(end: End, force_pn: (2.0, -1.0, 0.5))],
            task: Dynamics(duration_ns: 1.0),
            {more}
        )"#
    );
    Assembly::build(&Scene::from_ron(&text).unwrap()).unwrap()
}

const FILAMENT: &str = "sections: [
    Ellipsoids(from_nm: 0.0, to_nm: 12.0),
    Rod(from_nm: 12.0, to_nm: 42.0, segments: 3),
]";
const MONOMERS: &str = "anchors: Independent, seed: 18446744073709551615";

pub(crate) fn clamped_start() -> Assembly {
    build(&format!(
        "filament: Filament({FILAMENT}, monomers: Monomers({MONOMERS}))"
    ))
}

pub(crate) fn linked() -> Assembly {
    build(&format!(
        "filament: Filament({FILAMENT}, monomers: Monomers({MONOMERS})),
         linkers: [Linker(at_nm: 25.0, radius_nm: 1.8, azimuth_deg: 30.0, displaced_nm: (1.0, 0.5, -0.3),
            stiffness_pn_per_nm: 3.0, rest_length_nm: 0.4)]"
    ))
}

/// Builds the filament of [`clamped_start`] and a second mixed one, joined by a linker.
pub(crate) fn pair() -> Assembly {
    build(&format!(
        "filaments: [
            Filament({FILAMENT}, monomers: Monomers({MONOMERS})),
            Filament({FILAMENT}, monomers: Monomers({MONOMERS}, semi_axes_nm: (2.0, 2.0, 2.0)),
                at_nm: (9.0, 0.0, 2.0), direction: (0.2, 0.0, 1.0)),
         ],
         linkers: [Linker(filament: 1, to: Site(filament: 0, at_nm: 25.0, radius_nm: 1.8, azimuth_deg: 30.0),
            at_nm: 8.0, radius_nm: 1.8, stiffness_pn_per_nm: 3.0, rest_length_nm: 0.4)]"
    ))
}

pub(crate) fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<_> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

/// Paths in a folder and its subfolders, with the bytes of files.
pub(crate) fn contents(folder: &Path) -> Vec<(PathBuf, Option<Vec<u8>>)> {
    let (mut all, mut folders) = (Vec::new(), vec![folder.to_owned()]);
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let entry = entry.unwrap();
            if entry.file_type().unwrap().is_dir() {
                folders.push(entry.path());
            }
            all.push((entry.path(), std::fs::read(entry.path()).ok()));
        }
    }
    all.sort();
    all
}

/// Three records of random states near rest. All numbers of free bodies differ.
pub(crate) fn trajectory(assembly: &Assembly) -> Trajectory {
    let mut noise = Xorshift::new(7);
    let records = [0.0, 0.1, 1.0 / 3.0].map(|time_ns| {
        let mut state = assembly.rest.clone();
        perturb(&mut state, &mut noise, 0.1, 0.05);
        randomise_velocities(&mut state, &mut noise, 2.0, 1.5);
        Record::new(&assembly.system, At::Time(time_ns), state)
    });
    Trajectory {
        records: records.into(),
    }
}

pub(crate) fn outcome() -> Outcome {
    Outcome {
        steps: 12,
        force_evaluations: 48,
        time_step_ns: Some(3.5e-3),
        largest_frequency_rad_per_ns: Some(569.25),
        ..Outcome::new(Status::Completed, 0.1)
    }
}
