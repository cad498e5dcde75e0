//! Tests of reading stored states.

use super::*;
use crate::fixture;
use crate::states::write;
use actin_sim::Trajectory;
use std::fs::File;

fn written(assembly: &Assembly) -> (tempfile::TempDir, Trajectory) {
    let folder = tempfile::tempdir().unwrap();
    let trajectory = fixture::trajectory(assembly);
    let mut file = File::create(folder.path().join(STATES)).unwrap();
    write(assembly, &trajectory, &mut file).unwrap();
    (folder, trajectory)
}

/// States are compared bit for bit, also for a subset of the records.
#[test]
fn states_survive_the_round_trip() {
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
