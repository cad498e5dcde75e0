//! Accuracy of motion whose resolution follows it, against all monomers.

use actin_sim::follow::Follower;
use actin_sim::{Assembly, End, Record, Scene, Solution, Solve};

const LOWER: f64 = 0.6;

/// Largest error for each upper threshold of curvature (1/nm). The error grows with the threshold,
/// up to 0.18 for a rod alone. Bounds exceed measured values by a third.
const BOUNDS: [(f64, f64); 3] = [(0.008, 0.09), (0.002, 0.06), (1e-4, 0.025)];

fn scene(sections: &str) -> Scene {
    let text = format!(
        "Scene(
            filament: Filament(sections: {sections}, rod: RodModel(law: Homogenised)),
            clamps: [Clamp(end: Start)],
            loads: [EndForce(end: End, force_pn: (-10.0, 0.0, 0.0))],
            task: Dynamics(duration_ns: 20.0, record_every_ns: 0.5),
        )"
    );
    Scene::from_ron(&text).unwrap()
}

fn tips<'a>(runs: impl Iterator<Item = (&'a Assembly, &'a [Record])>) -> Vec<(f64, [f64; 3])> {
    let all = runs.flat_map(|(assembly, records)| {
        let rest = assembly.tip_nm(&assembly.rest, End::End);
        let tip = move |record: &Record| {
            let displacement = assembly.tip_nm(&record.state, End::End) - rest;
            (record.at.value(), displacement.into())
        };
        records.iter().map(tip)
    });
    all.collect()
}

fn error(found: &[(f64, [f64; 3])], reference: &[(f64, [f64; 3])]) -> f64 {
    let (mut difference, mut size) = (0.0, 0.0);
    for (time, tip) in reference {
        let near = |other: &&(f64, [f64; 3])| (other.0 - time).abs() < 1e-3;
        let (_, other) = found.iter().find(near).expect("records at equal times");
        for (a, b) in tip.iter().zip(other) {
            difference += (a - b).powi(2);
            size += a.powi(2);
        }
    }
    (difference / size).sqrt()
}

fn unchanged(sections: &str) -> Vec<(f64, [f64; 3])> {
    let Solution {
        assembly,
        trajectory,
        ..
    } = scene(sections).solve().unwrap();
    tips([(&assembly, trajectory.records.as_slice())].into_iter())
}

#[test]
fn followed_motion_approaches_monomers_as_thresholds_fall() {
    let monomers = unchanged("[Ellipsoids(from_nm: 0.0, to_nm: 150.0)]");
    for (above, bound) in BOUNDS {
        let scene = scene(&format!(
            "Following(length_nm: 150.0, least_ns: 2.0,
                monomers_where: [Curvature(above_per_nm: {above:?}, below_per_nm: {:?})])",
            LOWER * above
        ));
        let run = Follower::new(&scene).unwrap().run().unwrap();
        let stretches = run.stretches.iter();
        let records = stretches.map(|one| {
            let records = one.trajectory.records.as_slice();
            (&one.stretch.assembly, records)
        });
        let found = error(&tips(records), &monomers);
        assert!(found < bound, "{above}: {found}");
    }
}
