//! Runs without stored states: interrupted runs give bitwise equal files, and the files equal those
//! of runs with states.

use super::common::{Leaving, build, checkpoints, files};
use actin_rundir::RunDirectory;
use actin_sim::{Plan, Records, Scene, Status};
use std::fs;
use std::path::Path;

const HEATED: &str = "Scene(
    filament: Filament(sections: [Ellipsoids(from_nm: 0.0, to_nm: 12.0), Rod(from_nm: 12.0, to_nm: 42.0)],
        rod: RodModel(law: Fitted)),
    clamps: [Clamp(end: Start)],
    observe: [
        Tip(), EndReaction(end: Start), Curvature(at_nm: 20.0), Energies,
        TangentCorrelation(over_nm: 12.0),
        SquaredDisplacement(of: Tip, lag_ns: 0.06), SquaredDisplacement(of: Centre),
    ],
    burn_in_ns: 0.1,
    output: OUTPUT,
    task: Dynamics(
        duration_ns: 0.6, record_every_ns: 0.02,
        drag: (translational_per_ns: 1.0, rotational_per_ns: 1.0),
        thermal: (temperature_k: 298.0, seed: 4),
    ),
)";

const TURNED: &str = "Scene(
    filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 40.0)]),
    clamps: [Clamp(end: Start), Clamp(end: End, slides: AlongAxis)],
    path: [Stage(set: [Turn(end: End, turn_deg: (0.0, 0.0, 40.0))], duration_ns: 0.2)],
    observe: [EndReaction(end: End), Contour(), Twist(at_nm: 20.0)],
    output: OUTPUT,
    task: Dynamics(duration_ns: 0.3, record_every_ns: 0.02),
)";

const PATH: &str = "Scene(
    filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 40.0)], rod: RodModel(law: Fitted)),
    clamps: [Clamp(end: Start), Clamp(end: End, slides: AlongAxis)],
    path: [Stage(set: [Turn(end: End, turn_deg: (0.0, 0.0, 70.0))])],
    observe: [EndReaction(end: End), Strain(at_nm: 20.0), EndToEnd()],
    output: OUTPUT,
    task: Equilibrium(largest_step: 0.1),
)";

const SCENES: [&str; 3] = [HEATED, TURNED, PATH];
const BARE: &str = "(vtk: false, states: false)";

fn scene(text: &str, output: &str) -> Scene {
    Scene::from_ron(&text.replace("OUTPUT", output)).unwrap()
}

/// Runs a scene in pieces, interrupted after the given numbers of queries. Returns the largest size
/// of its records on the disk (bytes) and their number.
fn run(scene: &Scene, path: &Path, leave: &[u64]) -> (u64, usize) {
    let directory = RunDirectory::create(path, false).unwrap();
    let (mut resumes, mut pending) = (false, leave.iter().copied());
    loop {
        let assembly = build(scene);
        let plan = Plan::new(&assembly).unwrap();
        let mut files = checkpoints(&directory, &plan);
        let saved = resumes.then(|| files.resume(&plan).unwrap());
        let mut sink = Leaving {
            checkpoints: &mut files,
            left: pending.next().unwrap_or(u64::MAX),
        };
        let outcome = match saved {
            None => plan.run_into(&mut sink),
            Some(saved) => plan.resume_into(saved, &mut sink),
        };
        let outcome = outcome.unwrap();
        resumes = true;
        if files.count() > 0 {
            directory.write(&plan, &files, &outcome).unwrap();
        }
        if outcome.status != Status::Interrupted {
            let size = fs::metadata(path.join("records.bin")).unwrap().len();
            directory.remove_checkpoint().unwrap();
            return (size, files.count());
        }
    }
}

#[test]
fn runs_without_states_resume_to_the_same_bytes() {
    for text in SCENES {
        let scene = scene(text, BARE);
        let folder = tempfile::tempdir().unwrap();
        let whole = folder.path().join("whole");
        run(&scene, &whole, &[]);
        let expected = files(&whole);
        let table = String::from_utf8(expected["observables.csv"].clone()).unwrap();
        assert!(table.lines().count() > 10, "{table}");
        for (i, leave) in [&[2, 3, 2][..], &[5, 1, 4, 9], &[12], &[3, 3, 3, 3, 3, 3]]
            .iter()
            .enumerate()
        {
            let pieces = folder.path().join(i.to_string());
            run(&scene, &pieces, leave);
            assert!(
                files(&pieces) == expected,
                "a file differs: {text} {leave:?}"
            );
        }
    }
}

#[test]
fn files_do_not_depend_on_whether_states_are_kept() {
    for text in SCENES {
        let folder = tempfile::tempdir().unwrap();
        let of = |name: &str, output: &str| {
            let path = folder.path().join(name);
            let kept = run(&scene(text, output), &path, &[4]);
            (files(&path), path.join("vtk").exists(), kept)
        };
        let (all, pictures, (size, count)) = of("all", "(vtk: true, states: true)");
        let (bare, no_pictures, (row, same)) = of("bare", BARE);
        assert!(pictures && !no_pictures && count == same);
        assert!(row * 2 < size, "{row} bytes of {size}");
        let kept = |name: &str| bare.contains_key(name);
        assert!(!kept("states.npz") && !kept("run.pvd") && all.contains_key("run.pvd"));
        for name in [
            "observables.csv",
            "energies.csv",
            "profile.csv",
            "summary.json",
        ] {
            assert!(all[name] == bare[name], "{name} of {text}");
        }
        let (npz, pictures, _) = of("npz", "(vtk: false)");
        assert!(
            npz["states.npz"] == all["states.npz"] && !pictures && !npz.contains_key("run.pvd")
        );
        let (vtk, pictures, _) = of("vtk", "(states: false)");
        assert!(vtk["run.pvd"] == all["run.pvd"] && pictures && !vtk.contains_key("states.npz"));
    }
}
