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

/// What was written comes back to the last bit, also of records between which others are left out.
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
}

/// Half a file, another scene's, and none.
#[test]
fn what_cannot_be_read_is_refused() {
    let assembly = fixture::clamped_start();
    let (folder, _) = written(&assembly);
    let directory = RunDirectory::existing(folder.path());
    let pair = fixture::pair();
    let message = directory.stored_states(&pair).unwrap_err().to_string();
    assert!(message.contains("position_nm has the shape"), "{message}");
    let path = folder.path().join(STATES);
    let bytes = std::fs::read(&path).unwrap();
    std::fs::write(&path, &bytes[..bytes.len() / 2]).unwrap();
    let message = directory.stored_states(&assembly).unwrap_err().to_string();
    assert!(message.contains("states.npz is damaged"), "{message}");
    std::fs::remove_file(&path).unwrap();
    assert!(directory.stored_states(&assembly).unwrap().is_none());
}
