//! Scenes of trials: scenes of the repository, and random valid scenes.

use super::spoil::{below, between, one_of};
use rand_chacha::ChaCha8Rng;
use std::fs;
use std::path::Path;

pub(super) fn repository(folder: &Path) -> Vec<String> {
    let mut paths: Vec<_> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    paths.sort();
    let texts = paths.iter().flat_map(|path| {
        if path.is_dir() {
            repository(path)
        } else {
            vec![fs::read_to_string(path).unwrap()]
        }
    });
    texts.collect()
}

/// Returns a motion or a path of equilibria of 30 to 60 nm with a run time of about a second.
pub(super) fn long(random: &mut ChaCha8Rng) -> String {
    let [a, b] = [between(random, 15.0, 35.0), between(random, 15.0, 25.0)];
    let c = a + b;
    let sections = match below(random, 4) {
        0 => format!("Rod(from_nm: 0.0, to_nm: {c:?})"),
        1 => format!("Ellipsoids(from_nm: 0.0, to_nm: {c:?})"),
        2 => format!("Ellipsoids(from_nm: 0.0, to_nm: {a:?}), Rod(from_nm: {a:?}, to_nm: {c:?})"),
        _ => format!("Rod(from_nm: 0.0, to_nm: {a:?}), Ellipsoids(from_nm: {a:?}, to_nm: {c:?})"),
    };
    let law = one_of(
        random,
        &["Constant", "PublishedExtension", "CouplingEnergy", "Fitted"],
    );
    let [x, y, z] = [(); 3].map(|()| between(random, -3.0, 3.0));
    let (pace, task) = if below(random, 2) == 0 {
        let noise = ["", ", thermal: (temperature_k: 298.0, seed: 3)"][below(random, 2)];
        let duration = between(random, 20.0, 60.0);
        let task = format!(
            "Dynamics(duration_ns: {duration:?}, record_every_ns: {:?},
        drag: (translational_per_ns: 0.1, rotational_per_ns: 0.1){noise})",
            0.01 * duration
        );
        (format!(", duration_ns: {:?}", 0.4 * duration), task)
    } else {
        (String::new(), "Equilibrium(largest_step: 0.004)".into())
    };
    format!(
        "Scene(
    filament: Filament(sections: [{sections}], rod: RodModel(law: {law})),
    clamps: [Clamp(end: Start)],
    loads: [EndForce(end: End, force_pn: ({x:?}, {y:?}, {z:?}))],
    path: [Stage(set: [LoadFactor(load: 0, factor: 1.0)]{pace})],
    task: {task},
)
"
    )
}
