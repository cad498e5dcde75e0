//! Runs that are interrupted, killed or out of disk space, and resumed.
#![cfg(unix)]

use crate::common::{
    MOTION, PATH, Workplace, assert_has, assert_same_files, code, contents, files, observed,
    short_motion, signal, stderr,
};
use std::fs;
use std::os::unix::process::ExitStatusExt;
use std::process::{Child, Command};
use std::thread::sleep;
use std::time::Duration;

const LOCK: &str = "a/.actin-run.lock";

fn stop(child: &Child) {
    signal(child, "-STOP");
    let id = child.id().to_string();
    let state = || Command::new("ps").args(["-o", "stat=", "-p", &id]).output();
    while !matches!(state().unwrap().stdout.first(), None | Some(b'T' | b'Z')) {
        sleep(Duration::from_millis(2));
    }
}

/// After the first SIGINT, SIGTERM or SIGHUP: exit code 130, a checkpoint, the records, and the command that
/// continues to identical bytes. SIGHUP can arrive twice, from the terminal and from its shell.
#[test]
fn an_interrupted_run_resumes_to_the_same_bytes() {
    let hangup = ["-STOP", "-HUP", "-TERM", "-CONT", "-HUP"];
    let observed = observed();
    for (scene, signals) in [
        (MOTION, &["-INT"][..]),
        (&observed, &["-INT"]),
        (PATH, &["-TERM"]),
        (MOTION, &hangup),
    ] {
        let place = Workplace::with(scene);
        place.run("whole");
        let output = place.interrupted("parts", "checkpoint.bin", signals);
        assert_eq!(code(&output), 130);
        assert!(stderr(&output).contains("actin run scene.ron --out parts --resume"));
        assert_has(
            &place.read("parts/summary.json"),
            &["\"status\": \"interrupted\""],
        );
        let energies = place.read("parts/energies.csv");
        assert!(energies.lines().count() > 1);
        place.resume("parts");
        assert_same_files(&place.path("whole"), &place.path("parts"));
    }
}

#[test]
fn a_killed_run_can_be_viewed() {
    let observed = observed();
    for (scene, told) in [
        (MOTION, "record(s) up to its last checkpoint, at "),
        (
            &observed,
            "the page shows the last record before its last checkpoint",
        ),
    ] {
        let place = Workplace::with(scene);
        place.interrupted("a", "checkpoint.bin", &["-KILL"]);
        assert!(!place.path("a/summary.json").exists());
        let page = || {
            let output = place.shell("actin view a");
            assert_eq!(code(&output), 0, "{}", stderr(&output));
            place.read("a/view.html")
        };
        let before = contents(&place.path("a"));
        assert!(page().contains(told), "{told}");
        // The files needed to resume are unchanged.
        fs::remove_file(place.path("a/view.html")).unwrap();
        assert_eq!(before, contents(&place.path("a")));
        fs::remove_file(place.path("a/records.bin")).unwrap();
        assert!(page().contains("its checkpoint cannot be read"));
    }
}

#[test]
fn a_second_signal_kills() {
    let place = Workplace::with(MOTION);
    let output = place.interrupted("a", "scene.ron", &["-STOP", "-INT", "-TERM", "-CONT"]);
    assert_eq!(output.status.code(), None, "{}", stderr(&output));
    assert!(matches!(output.status.signal(), Some(2 | 15)));
}

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

#[test]
fn a_full_disk_loses_no_checkpoint() {
    let place = Workplace::with(MOTION);
    place.run("whole");
    let output =
        place.shell("ulimit -f 64; exec actin run scene.ron --out a --checkpoint-every 0.01");
    println!("{}", stderr(&output));
    assert_eq!(code(&output), 74);
    assert!(stderr(&output).contains("warning: no checkpoint: a/records.bin: "));
    assert!(stderr(&output).contains("a checkpoint is kept; once the cause is removed"));
    place.resume("a");
    assert_same_files(&place.path("whole"), &place.path("a"));
}

#[test]
fn resume_without_a_checkpoint_starts_the_run() {
    let place = Workplace::with(&short_motion());
    place.resume("a");
    place.run("b");
    assert_same_files(&place.path("a"), &place.path("b"));
    // As left by a run killed before its first checkpoint.
    for name in ["summary.json", "states.npz", "run.pvd"] {
        fs::remove_file(place.path("b").join(name)).unwrap();
    }
    place.resume("b");
    assert_same_files(&place.path("a"), &place.path("b"));
}

#[test]
fn invalid_resumes_are_refused() {
    let place = Workplace::with(&short_motion());
    place.run("a");
    assert!(!place.path("a/checkpoint.bin").exists());
    let before = files(&place.path("a"));
    let said = place.resume("a");
    assert!(
        said.ends_with("a is finished (end time reached): nothing to resume\n"),
        "{said}"
    );
    assert!(files(&place.path("a")) == before);
    place.write(
        "a/checkpoint.bin",
        "nonsense of some length, at least 28 bytes",
    );
    let damaged = place.fail(2, &["run", "scene.ron", "--out", "a", "--resume"]);
    assert_has(&damaged, &["a/checkpoint.bin: not a checkpoint"]);
    for arguments in [
        ["--resume", "--overwrite"],
        ["--checkpoint-every", "-1"],
        ["--checkpoint-every", "NaN"],
    ] {
        place.fail(2, &[&["run", "scene.ron"][..], &arguments].concat());
    }
}

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
    let message = place.fail(3, &["run", "scene.ron", "--out", "a"]);
    assert_has(
        &message,
        &[
            "error: scene.ron:4:",
            "loads[0].force_pn = [0.0, 0.0, 1e-12]: is below 100 times the residual of",
            "; the equilibria are in a",
        ],
    );
    assert_has(
        &place.read("a/summary.json"),
        &["\"status\": \"failed\"", "\"negative_eigenvalues\": 0"],
    );
    let energies = place.read("a/energies.csv");
    assert_eq!(energies.lines().count(), 2, "{energies}");
    // The checkpoint contains the elapsed time.
    let results = || {
        let mut all = files(&place.path("a"));
        all.retain(|(name, _)| name != "checkpoint.bin");
        all
    };
    let before = results();
    let again = place.fail(3, &["run", "scene.ron", "--out", "a", "--resume"]);
    assert_eq!(again, message);
    assert!(results() == before);
}

/// Any second run in the directory of a stopped run is refused and changes nothing. After the first is killed, its
/// lock does not block other runs and is emptied.
#[test]
fn a_directory_in_use_is_unchanged() {
    let place = Workplace::with(&MOTION.replace("duration_ns: 75.0", "duration_ns: 1500.0"));
    let arguments = ["--out", "a", "--checkpoint-every", "0.01"];
    let mut first = place.start(&arguments, "a/checkpoint.bin");
    stop(&first);
    assert!(first.try_wait().unwrap().is_none(), "the run is over");
    let id = first.id();
    let before = contents(&place.path("a"));
    for flag in ["--resume", "--overwrite", "--checkpoint-every=1"] {
        let second = place.fail(2, &["run", "scene.ron", "--out", "a", flag]);
        assert_eq!(
            second,
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
    let short = MOTION.replace("75.0", "1.0").replace("25.0", "0.5");
    place.write("scene.ron", short);
    let other_scene = place.actin(&["run", "scene.ron", "--out", "a", "--resume"]);
    assert!(
        !stderr(&other_scene).contains("in use"),
        "{}",
        stderr(&other_scene)
    );
    place.succeed(&["run", "scene.ron", "--out", "a", "--overwrite"]);
    assert_eq!(fs::read(place.path(LOCK)).unwrap(), b"");
}

#[test]
fn what_writes_nothing_needs_no_lock() {
    let place = Workplace::with(&short_motion());
    place.run("a");
    fs::remove_file(place.path(LOCK)).unwrap();
    fs::create_dir(place.path(LOCK)).unwrap();
    let said = place.resume("a");
    assert!(
        said.ends_with("a is finished (end time reached): nothing to resume\n"),
        "{said}"
    );
    let refused = place.fail(2, &["run", "scene.ron", "--out", "a"]);
    assert_has(&refused, &["is not empty"]);
}

/// A run continues only from the state that it began with, and an interrupted run is no start.
#[test]
fn a_changed_start_is_refused() {
    let (kept, task) = MOTION.split_at(MOTION.find("    path:").unwrap());
    let place = Workplace::with(&format!(
        "{kept}    start: Run(directory: \"before\"),\n{task}"
    ));
    place.write("before.ron", format!("{kept}    task: Equilibrium(),\n)"));
    place.succeed(&["run", "before.ron", "--out", "before"]);
    let output = place.interrupted("a", "checkpoint.bin", &["-INT"]);
    assert_eq!(code(&output), 130);
    let pull = "loads[0].force_pn=(-1.0,0.0,0.0)";
    let again = ["run", "before.ron", "--out", "before", "--overwrite"];
    place.succeed(&[&again[..], &["--set", pull]].concat());
    let refused = place.fail(2, &["run", "scene.ron", "--out", "a", "--resume"]);
    assert_has(
        &refused,
        &["start.directory has changed since this run began"],
    );
    place.succeed(&again);
    let next = "start.directory=\"a\"";
    let refused = place.fail(2, &["check", "scene.ron", "--set", next]);
    assert_has(
        &refused,
        &["is an interrupted run: continue it with --resume"],
    );
    place.resume("a");
}
