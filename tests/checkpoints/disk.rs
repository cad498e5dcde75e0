//! Write errors: the last checkpoint stays, the run continues, and the next attempt succeeds.

use super::common::{Choice, advance, build, checkpoints};
use actin_rundir::RunDirectory;
use actin_sim::{Plan, RunPosition, Sink};
use std::fs;

const CHOICE: Choice = Choice {
    filament: 0,
    held: 0,
    integrator: 0,
    drag: 0.0,
    stops: false,
    noise: None,
    record_every_ns: 0.05,
    duration_ns: 0.4,
};

/// A directory in place of the file makes the write fail.
#[test]
fn a_failed_checkpoint_leaves_the_last_one() {
    let folder = tempfile::tempdir().unwrap();
    let directory = RunDirectory::create(folder.path().join("run"), false).unwrap();
    let scene = CHOICE.motion();
    advance(&scene, &directory, false, 5);
    let path = directory.path().join("checkpoint.bin");
    let before = fs::read(&path).unwrap();

    let assembly = build(&scene);
    let plan = Plan::new(&assembly).unwrap();
    let mut files = checkpoints(&directory, &plan);
    let saved = files.resume(&plan).unwrap();
    let RunPosition::Motion(position) = &saved.position else {
        panic!("a motion");
    };
    let mut later = position.clone();
    later.checkpoint.here.step += 1;
    let later = RunPosition::Motion(later);
    let obstacle = directory.path().join("checkpoint.bin.part");
    fs::create_dir(&obstacle).unwrap();
    files.checkpoint(&later, &saved.recorded, 1.0);
    assert!(files.last_failed());
    assert_eq!(fs::read(&path).unwrap(), before);

    fs::remove_dir(&obstacle).unwrap();
    files.checkpoint(&later, &saved.recorded, 1.0);
    assert!(!files.last_failed());
    let again = checkpoints(&directory, &plan).resume(&plan).unwrap();
    assert_eq!(again.position, later);
}
