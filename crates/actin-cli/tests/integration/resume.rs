//! Runs that are interrupted, killed or refused by the disk, and resumed: from the arguments to the
//! exit code and the bytes of the files.
#![cfg(unix)]

use crate::common;
use common::{
    MOTION, PATH, Workplace, assert_same_files, code, contents, files, observed, signal, stderr,
};
use std::fs;
use std::os::unix::process::ExitStatusExt;
use std::process::{Child, Command, Output};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// The lock of a run into `a`.
const LOCK: &str = "a/.actin-run.lock";

/// Stops a program, and waits until it has (or has ended): what the signal finds it doing is done
/// first.
fn stop(child: &Child) {
    signal(child, "-STOP");
    let id = child.id().to_string();
    let state = || Command::new("ps").args(["-o", "stat=", "-p", &id]).output();
    while !matches!(state().unwrap().stdout.first(), None | Some(b'T' | b'Z')) {
        sleep(Duration::from_millis(2));
    }
}

/// The first signal: 130, a checkpoint, what was recorded, and the command that goes on; which then
/// gives every byte of a run that was not interrupted. A motion and a path, SIGINT, SIGTERM and SIGHUP,
/// which may come twice: a terminal that closes sends it, and so does the shell in it.
#[test]
fn an_interrupted_run_goes_on_to_the_same_bytes() {
    let hangup = ["-STOP", "-HUP", "-TERM", "-CONT", "-HUP"];
    let observed = observed();
    for (scene, signals) in [
        (MOTION, &["-INT"][..]),
        (&observed, &["-INT"]),
        (PATH, &["-TERM"]),
        (MOTION, &hangup),
    ] {
        let place = Workplace::with(scene);
        assert_eq!(code(&place.actin(&["--out", "whole"])), 0);
        let output = place.interrupted("parts", "checkpoint.bin", signals);
        assert_eq!(code(&output), 130);
        assert!(stderr(&output).contains("actin run scene.ron --out parts --resume"));
        let summary = fs::read_to_string(place.path("parts/summary.json")).unwrap();
        assert!(summary.contains("\"status\": \"interrupted\""));
        let energies = fs::read_to_string(place.path("parts/energies.csv")).unwrap();
        assert!(energies.lines().count() > 1);
        let output = place.actin(&["--out", "parts", "--resume"]);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        assert_same_files(&place.path("whole"), &place.path("parts"));
    }
}

/// A run that was killed and has nothing but a checkpoint can be looked at: its records up to there, the last
/// where no states are kept, and what was built where nothing can be read.
#[test]
fn a_killed_run_can_be_looked_at() {
    let observed = observed();
    for (scene, told) in [
        (MOTION, "record(s) up to its last checkpoint, at "),
        (
            &observed,
            "this is its last record before its last checkpoint",
        ),
    ] {
        let place = Workplace::with(scene);
        place.interrupted("a", "checkpoint.bin", &["-KILL"]);
        assert!(!place.path("a/summary.json").exists());
        let page = || {
            let output = place.shell("actin view a");
            assert_eq!(code(&output), 0, "{}", stderr(&output));
            fs::read_to_string(place.path("a/view.html")).unwrap()
        };
        let before = contents(&place.path("a"));
        assert!(page().contains(told), "{told}");
        // Nothing that the run goes on from is touched.
        fs::remove_file(place.path("a/view.html")).unwrap();
        assert_eq!(before, contents(&place.path("a")));
        fs::remove_file(place.path("a/records.bin")).unwrap();
        assert!(page().contains("its checkpoint cannot be read"));
    }
}

/// Both signals wait while the program is stopped: when it goes on, the second kills it at once.
#[test]
fn a_second_signal_kills() {
    let place = Workplace::with(MOTION);
    let output = place.interrupted("a", "scene.ron", &["-STOP", "-INT", "-TERM", "-CONT"]);
    assert_eq!(output.status.code(), None, "{}", stderr(&output));
    assert!(matches!(output.status.signal(), Some(2 | 15)));
}

/// Numbers that look random and are the same every time.
fn next(seed: &mut u64) -> u64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
    *seed >> 33
}

/// Kills of one run that are so many that it will never get to its end.
const MOST_KILLS: usize = 200;
/// After as many kills patience doubles, for good.
const KILLS_PER_DOUBLING: usize = 16;

/// How a run ends, if it does within `patience`; it is killed if not.
fn end_or_kill(mut child: Child, patience: Duration) -> Option<Output> {
    let started = Instant::now();
    while child.try_wait().unwrap().is_none() {
        if started.elapsed() > patience {
            child.kill().unwrap();
            child.wait().unwrap();
            return None;
        }
        sleep(Duration::from_millis(1));
    }
    Some(child.wait_with_output().unwrap())
}

/// Kills a run after random times until it gets to its end; returns the number of kills that left a
/// checkpoint, from which the run went on.
///
/// On a busy machine a run may be killed before it has got any further: the next has twice the time.
fn kill_until_done(place: &Workplace, most_ms: u64, seed: &mut u64) -> usize {
    let checkpoint = || fs::read(place.path("a/checkpoint.bin")).ok();
    let (mut survived, mut stalls) = (0, 0);
    for kills in 0..MOST_KILLS {
        let before = checkpoint();
        let go_on = match before {
            Some(_) => "--resume",
            None => "--overwrite",
        };
        let mut command = place.command(&["--out", "a", "--checkpoint-every", "0.02", go_on]);
        command.env("RAYON_NUM_THREADS", (1 + kills % 4).to_string());
        let factor = 1 << (stalls + kills / KILLS_PER_DOUBLING).min(10);
        let patience = Duration::from_millis(factor * (20 + next(seed) % most_ms));
        if let Some(output) = end_or_kill(command.spawn().unwrap(), patience) {
            assert_eq!(code(&output), 0, "{}", stderr(&output));
            return survived;
        }
        let after = checkpoint();
        survived += usize::from(after.is_some());
        stalls = if after == before { stalls + 1 } else { 0 };
    }
    panic!("not done after {MOST_KILLS} kills, {survived} of them with a checkpoint");
}

/// SIGKILL cannot be caught: whatever is on the disk then must do. The runs go on to the bytes of
/// one that was not killed.
fn assert_survives(scenes: &[&str], rounds: usize, most_ms: u64) {
    let mut seed = 8;
    let mut kills = 0;
    for round in 0..rounds {
        let place = Workplace::with(scenes[round % scenes.len()]);
        assert_eq!(code(&place.actin(&["--out", "whole"])), 0);
        kills += kill_until_done(&place, most_ms, &mut seed);
        assert_same_files(&place.path("whole"), &place.path("a"));
    }
    println!("{kills} kills survived in {rounds} runs");
    assert!(kills > 0, "no run was killed after a checkpoint");
}

#[test]
fn a_killed_run_goes_on_to_the_same_bytes() {
    assert_survives(&[MOTION, &observed()], 1, 400);
}

/// The same some hundred times, in a minute or more.
#[test]
#[ignore = "takes a minute; run by hand with --ignored --nocapture"]
fn many_killed_runs_go_on_to_the_same_bytes() {
    assert_survives(&[MOTION, PATH], 40, 100);
}

/// Under `nohup` SIGHUP is ignored, and stays so: the run gets to its end.
#[test]
fn a_hangup_that_was_ignored_before_is_ignored() {
    let place = Workplace::with(MOTION);
    let output = place.shell(
        "trap '' HUP
         actin run scene.ron --out a --checkpoint-every 0.01 & id=$!
         while ! test -e a/checkpoint.bin; do sleep 0.01; done
         kill -HUP $id; wait $id",
    );
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(place.path("a/summary.json").exists());
}

/// A limit on the size of files is a disk that is full for some: records do not fit any more. The
/// run goes on with a warning, the results cannot be written either, and the last checkpoint that
/// fitted is there when there is room again.
#[test]
fn a_full_disk_loses_no_checkpoint() {
    let place = Workplace::with(MOTION);
    assert_eq!(code(&place.actin(&["--out", "whole"])), 0);
    let output =
        place.shell("ulimit -f 64; exec actin run scene.ron --out a --checkpoint-every 0.01");
    println!("{}", stderr(&output));
    assert_eq!(code(&output), 74);
    assert!(stderr(&output).contains("warning: no checkpoint: a/records.bin: "));
    assert!(stderr(&output).contains("a checkpoint is kept; once the cause is removed"));
    let output = place.actin(&["--out", "a", "--resume"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert_same_files(&place.path("whole"), &place.path("a"));
}

/// Where there is nothing to go on from, a run begins.
#[test]
fn what_has_not_begun_begins() {
    let place = Workplace::with(
        &MOTION
            .replace("150.0", "1.0")
            .replace("50.0", "0.5")
            .replace("1.5", "0.5"),
    );
    let absent = place.actin(&["--out", "a", "--resume"]);
    assert_eq!(code(&absent), 0, "{}", stderr(&absent));
    assert_eq!(code(&place.actin(&["--out", "b"])), 0);
    assert_same_files(&place.path("a"), &place.path("b"));
    // What a run leaves that is killed before it has a checkpoint.
    for name in ["summary.json", "states.npz", "run.pvd"] {
        fs::remove_file(place.path("b").join(name)).unwrap();
    }
    assert_eq!(code(&place.actin(&["--out", "b", "--resume"])), 0);
    assert_same_files(&place.path("a"), &place.path("b"));
}

/// Another scene, a damaged file, arguments without meaning: exit code 2 and the reason. A run that is
/// finished says so and is left alone.
#[test]
fn what_cannot_be_resumed_is_refused() {
    let place = Workplace::with(
        &MOTION
            .replace("150.0", "1.0")
            .replace("50.0", "0.5")
            .replace("1.5", "0.5"),
    );
    assert_eq!(code(&place.actin(&["--out", "a"])), 0);
    assert!(!place.path("a/checkpoint.bin").exists());
    let before = files(&place.path("a"));
    let finished = place.actin(&["--out", "a", "--resume"]);
    assert_eq!(code(&finished), 0);
    let said = std::str::from_utf8(&finished.stdout).unwrap();
    assert!(
        said.ends_with("a is finished (time is up): nothing to resume\n"),
        "{said}"
    );
    assert!(files(&place.path("a")) == before);
    fs::write(
        place.path("a/checkpoint.bin"),
        "nonsense of some length, at least 28 bytes",
    )
    .unwrap();
    let damaged = place.actin(&["--out", "a", "--resume"]);
    assert_eq!(code(&damaged), 2);
    assert!(stderr(&damaged).contains("a/checkpoint.bin: not a checkpoint"));
    for arguments in [
        ["--resume", "--overwrite"],
        ["--checkpoint-every", "-1"],
        ["--checkpoint-every", "NaN"],
    ] {
        assert_eq!(code(&place.actin(&arguments)), 2);
    }
}

/// Thrice the stability limit: exit code 3 with a checkpoint of the last good state, from which the
/// run fails again in the same words.
#[test]
fn a_failed_run_fails_again_in_the_same_words() {
    let unstable = "duration_ns: 100.0, time_step_ns: 0.0105, allow_unstable_step: true";
    let scene = MOTION.replace("duration_ns: 150.0", unstable);
    let place = Workplace::with(&scene.replace("duration_ns: 50.0", "duration_ns: 5.0"));
    let first = place.actin(&["--out", "a"]);
    assert_eq!(code(&first), 3);
    assert!(place.path("a/checkpoint.bin").exists());
    let again = place.actin(&["--out", "a", "--resume"]);
    assert_eq!((code(&again), stderr(&again)), (3, stderr(&first)));
}

/// A force that is smaller than the rounding of others: exit code 3, with the place in the scene, and
/// the equilibrium on the disk; taken up again, the same words and the same files.
#[test]
fn an_equilibrium_with_a_load_below_the_residual_is_kept() {
    let place = Workplace::with(
        "Scene(
            filament: Filament(sections: [Ellipsoids(from_nm: 0.0, to_nm: 60.0)]),
            clamps: [Clamp(end: Start)],
            loads: [EndForce(end: End, force_pn: (0.0, 0.0, 1e-12))],
            task: Equilibrium(force_pn: 1e-13, torque_pn_nm: 1e-12),
        )",
    );
    let first = place.actin(&["--out", "a"]);
    assert_eq!(code(&first), 3, "{}", stderr(&first));
    let message = stderr(&first);
    println!("{message}");
    for part in [
        "error: scene.ron:4:",
        "loads[0].force_pn = [0.0, 0.0, 1e-12]: is below 100 times the residual of",
        "; the equilibria are in a",
    ] {
        assert!(message.contains(part), "{part:?} in {message}");
    }
    let summary = fs::read_to_string(place.path("a/summary.json")).unwrap();
    assert!(summary.contains("\"status\": \"failed\""), "{summary}");
    assert!(summary.contains("\"negative_eigenvalues\": 0"), "{summary}");
    let energies = fs::read_to_string(place.path("a/energies.csv")).unwrap();
    assert_eq!(energies.lines().count(), 2, "{energies}");
    // The checkpoint holds the time that the run has taken.
    let results = || {
        let mut all = files(&place.path("a"));
        all.retain(|(name, _)| name != "checkpoint.bin");
        all
    };
    let before = results();
    let again = place.actin(&["--out", "a", "--resume"]);
    assert_eq!((code(&again), stderr(&again)), (3, message));
    assert!(results() == before);
}

/// Whatever a second run would do in the directory of one that goes on (here: is stopped half way),
/// it is refused and touches nothing. When the first has been killed, its lock keeps no other run out, and
/// afterwards the file of it is empty.
#[test]
fn a_directory_in_use_is_left_alone() {
    let place = Workplace::with(&MOTION.replace("duration_ns: 150.0", "duration_ns: 1500.0"));
    let arguments = ["--out", "a", "--checkpoint-every", "0.01"];
    let mut first = place.start(&arguments, "a/checkpoint.bin");
    stop(&first);
    assert!(first.try_wait().unwrap().is_none(), "the run is over");
    let id = first.id();
    let before = contents(&place.path("a"));
    for flag in ["--resume", "--overwrite", "--checkpoint-every=1"] {
        let second = place.actin(&["--out", "a", flag]);
        assert_eq!(code(&second), 2);
        assert_eq!(
            stderr(&second),
            format!(
                "error: a is in use: another run (process {id}) is writing into it; wait for its \
                 end, or name another directory\n"
            )
        );
    }
    assert!(contents(&place.path("a")) == before);
    first.kill().unwrap();
    first.wait().unwrap();
    assert!(place.path(LOCK).exists());
    let short = MOTION.replace("150.0", "1.0").replace("50.0", "0.5");
    fs::write(place.path("scene.ron"), short).unwrap();
    let other_scene = place.actin(&["--out", "a", "--resume"]);
    assert!(
        !stderr(&other_scene).contains("in use"),
        "{}",
        stderr(&other_scene)
    );
    let done = place.actin(&["--out", "a", "--overwrite"]);
    assert_eq!(code(&done), 0, "{}", stderr(&done));
    assert_eq!(fs::read(place.path(LOCK)).unwrap(), b"");
}

/// Files of others are left alone by whatever is refused, `lock` among them, and a file that no run has
/// written where the lock belongs is refused itself.
#[test]
fn files_of_others_are_left_alone() {
    let place = Workplace::with(
        &MOTION
            .replace("150.0", "1.0")
            .replace("50.0", "0.5")
            .replace("1.5", "0.5"),
    );
    fs::write(place.path("notes.txt"), "mine").unwrap();
    fs::write(place.path("lock"), "mine").unwrap();
    let before = contents(place.folder.path());
    for arguments in [&["--out", "."][..], &["--out", ".", "--resume"]] {
        assert_eq!(code(&place.actin(arguments)), 2);
        assert!(contents(place.folder.path()) == before, "{arguments:?}");
    }
    fs::create_dir(place.path("a")).unwrap();
    fs::write(place.path(LOCK), "mine").unwrap();
    for flag in ["--resume", "--overwrite", "--checkpoint-every=1"] {
        let refused = place.actin(&["--out", "a", flag]);
        assert_eq!(code(&refused), 2);
        let message = stderr(&refused);
        assert!(message.contains("was not written by a run"), "{message}");
        assert_eq!(fs::read(place.path(LOCK)).unwrap(), b"mine");
    }
}

/// What needs no writing is said before anything is locked. (A folder in the place of the lock keeps
/// everybody from it, as a folder without permission to write does, and even an administrator.)
#[test]
fn what_writes_nothing_needs_no_lock() {
    let place = Workplace::with(
        &MOTION
            .replace("150.0", "1.0")
            .replace("50.0", "0.5")
            .replace("1.5", "0.5"),
    );
    assert_eq!(code(&place.actin(&["--out", "a"])), 0);
    fs::remove_file(place.path(LOCK)).unwrap();
    fs::create_dir(place.path(LOCK)).unwrap();
    let again = place.actin(&["--out", "a", "--resume"]);
    assert_eq!(code(&again), 0, "{}", stderr(&again));
    let said = String::from_utf8_lossy(&again.stdout);
    assert!(
        said.ends_with("a is finished (time is up): nothing to resume\n"),
        "{said}"
    );
    let refused = place.actin(&["--out", "a"]);
    assert_eq!(code(&refused), 2);
    assert!(
        stderr(&refused).contains("is not empty"),
        "{}",
        stderr(&refused)
    );
}
