//! States that are written and come back.

use super::*;
use crate::results::fixture;
use crate::results::states::States;
use std::fs::File;

/// A directory with the states of a made-up run, and that run.
fn written(assembly: &Assembly) -> (tempfile::TempDir, crate::Trajectory) {
    let folder = tempfile::tempdir().unwrap();
    let trajectory = fixture::trajectory(assembly);
    let mut file = File::create(folder.path().join(STATES)).unwrap();
    States::new(assembly).write(&trajectory, &mut file).unwrap();
    (folder, trajectory)
}

/// What was written comes back to the last bit, also of records between which others are left out. Without the
/// file there are none.
#[test]
fn states_come_back() {
    let assembly = fixture::clamped_start();
    let (folder, trajectory) = written(&assembly);
    let directory = RunDirectory::existing(folder.path());
    let stored = directory.stored_states(&assembly).unwrap().unwrap();
    assert!(
        stored
            .at()
            .iter()
            .eq(trajectory.records.iter().map(|r| &r.at))
    );
    let states = stored.states(&assembly, [0, 2]).unwrap();
    for (state, k) in states.zip([0, 2]) {
        let state = state.unwrap();
        let expected = &trajectory.records[k].state;
        assert_eq!(state.points.position, expected.points.position);
        assert_eq!(state.points.velocity, expected.points.velocity);
        assert_eq!(state.frames.orientation, expected.frames.orientation);
        let momenta = [&state, expected].map(|s| &s.frames.angular_momentum);
        assert_eq!(momenta[0], momenta[1]);
    }
    std::fs::remove_file(folder.path().join(STATES)).unwrap();
    assert!(directory.stored_states(&assembly).unwrap().is_none());
}
