//! Damaged checkpoints are refused with a message and without a panic.

use super::common::{Choice, advance, build, checkpoints};
use actin_rundir::{CheckpointError, Damage, RunDirectory};
use actin_sim::{Plan, Scene, Status};
use std::fs;
use tempfile::TempDir;

const CHOICE: Choice = Choice {
    filament: 1,
    held: 1,
    integrator: 1,
    drag: 0.3,
    stops: false,
    noise: None,
    record_every_ns: 0.05,
    duration_ns: 0.4,
};

struct DamagedRun {
    _folder: TempDir,
    directory: RunDirectory,
    scene: Scene,
}

impl DamagedRun {
    fn new(scene: Scene) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let directory = RunDirectory::create(folder.path().join("run"), false).unwrap();
        let (.., report) = advance(&scene, &directory, false, 9);
        assert_eq!(report.status, Status::Interrupted);
        Self {
            _folder: folder,
            directory,
            scene,
        }
    }

    fn bytes(&self, name: &str) -> Vec<u8> {
        fs::read(self.directory.path().join(name)).unwrap()
    }

    fn replace(&self, name: &str, bytes: &[u8]) {
        fs::write(self.directory.path().join(name), bytes).unwrap();
    }

    fn resume(&self, scene: &Scene) -> Result<(), CheckpointError> {
        let assembly = build(scene);
        let plan = Plan::new(&assembly).unwrap();
        checkpoints(&self.directory, &plan).resume(&plan).map(drop)
    }

    fn refusal(&self) -> String {
        self.resume(&self.scene).unwrap_err().to_string()
    }
}

fn places(length: usize) -> impl Iterator<Item = usize> {
    let stride = (length / 300).max(1);
    (0..length.min(64)).chain((64..length).step_by(stride))
}

#[test]
fn every_flipped_byte_is_found() {
    let mut flipped = 0;
    for scene in [CHOICE.motion(), CHOICE.statics()] {
        let left = DamagedRun::new(scene);
        let assembly = build(&left.scene);
        let plan = Plan::new(&assembly).unwrap();
        let mut files = checkpoints(&left.directory, &plan);
        for name in ["checkpoint.bin", "records.bin"] {
            let whole = left.bytes(name);
            for place in places(whole.len()) {
                for mask in [1, 0xff] {
                    let mut bytes = whole.clone();
                    bytes[place] ^= mask;
                    left.replace(name, &bytes);
                    let message = files.resume(&plan).unwrap_err().to_string();
                    assert!(message.contains(name), "{place}: {message}");
                    flipped += 1;
                }
            }
            left.replace(name, &whole);
            files.resume(&plan).unwrap();
        }
    }
    println!("{flipped} flipped bytes were found");
}

#[test]
fn every_truncation_is_found() {
    let left = DamagedRun::new(CHOICE.motion());
    for name in ["checkpoint.bin", "records.bin"] {
        let whole = left.bytes(name);
        for length in places(whole.len()) {
            left.replace(name, &whole[..length]);
            let message = left.refusal();
            let says = ["bytes where its header says", "there is no checkpoint"];
            assert!(
                says.iter().any(|s| message.contains(s)),
                "{length}: {message}"
            );
        }
        left.replace(name, &whole);
    }
    let mut longer = left.bytes("checkpoint.bin");
    longer.push(0);
    left.replace("checkpoint.bin", &longer);
    assert!(left.refusal().contains("appended"));
}

#[test]
fn records_that_no_checkpoint_counts_are_ignored() {
    let left = DamagedRun::new(CHOICE.motion());
    let mut longer = left.bytes("records.bin");
    longer.extend_from_slice(&[0xab; 777]);
    left.replace("records.bin", &longer);
    let (_, trajectory, _) = advance(&left.scene, &left.directory, true, u64::MAX);
    let one = DamagedRun::new(CHOICE.motion());
    let (_, expected, _) = advance(&one.scene, &one.directory, true, u64::MAX);
    assert_eq!(trajectory.records.len(), expected.records.len());
    for (a, b) in trajectory.records.iter().zip(&expected.records) {
        assert_eq!(a.state, b.state);
    }
}

#[test]
fn another_scene_is_refused_with_the_line() {
    let left = DamagedRun::new(CHOICE.motion());
    let other = Choice {
        drag: 0.31,
        ..CHOICE
    };
    let error = left.resume(&other.motion()).unwrap_err();
    println!("{error}");
    assert!(matches!(error.damage, Damage::Scene { .. }));
    let message = error.to_string();
    assert!(
        message.contains("0.3,") && message.contains("0.31,"),
        "{message}"
    );
    // Different bodies.
    assert!(
        left.resume(
            &Choice {
                filament: 0,
                ..CHOICE
            }
            .motion()
        )
        .is_err()
    );
    assert!(left.resume(&CHOICE.statics()).is_err());
}

#[test]
fn other_formats_and_files_are_named() {
    let left = DamagedRun::new(CHOICE.motion());
    let mut bytes = left.bytes("checkpoint.bin");
    let known = bytes[8];
    bytes[8] += 1;
    let checksum = crc32fast::hash(&bytes[..24]);
    bytes[24..28].copy_from_slice(&checksum.to_le_bytes());
    left.replace("checkpoint.bin", &bytes);
    let message = left.refusal();
    let says = format!(
        "format version {}: this program reads version {known}",
        known + 1
    );
    assert!(message.ends_with(&says), "{message}");
    left.replace("checkpoint.bin", &[b'x'; 4000]);
    assert!(left.refusal().contains("not a checkpoint"));
    fs::remove_file(left.directory.path().join("checkpoint.bin")).unwrap();
    assert!(left.refusal().contains("there is nothing to resume from"));
}

#[test]
fn a_huge_length_is_refused() {
    let left = DamagedRun::new(CHOICE.motion());
    let mut bytes = left.bytes("checkpoint.bin");
    bytes[12..20].copy_from_slice(&(1_u64 << 63).to_le_bytes());
    let checksum = crc32fast::hash(&bytes[..24]);
    bytes[24..28].copy_from_slice(&checksum.to_le_bytes());
    left.replace("checkpoint.bin", &bytes);
    assert!(left.refusal().contains("truncated"));
}

#[test]
fn forged_contents_cause_no_panic() {
    let mut refused = 0;
    for scene in [CHOICE.motion(), CHOICE.statics()] {
        let left = DamagedRun::new(scene);
        let whole = left.bytes("checkpoint.bin");
        for place in places(whole.len()).filter(|&place| place >= 28) {
            let mut bytes = whole.clone();
            bytes[place] = bytes[place].wrapping_add(0x7f);
            let body = crc32fast::hash(&bytes[28..]);
            bytes[20..24].copy_from_slice(&body.to_le_bytes());
            let header = crc32fast::hash(&bytes[..24]);
            bytes[24..28].copy_from_slice(&header.to_le_bytes());
            left.replace("checkpoint.bin", &bytes);
            refused += usize::from(left.resume(&left.scene).is_err());
        }
    }
    println!("{refused} forgeries were refused");
    assert!(refused > 0);
}
