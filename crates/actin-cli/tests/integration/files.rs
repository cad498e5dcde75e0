//! Closed pipes, overwritten directories and full disks: no results are lost, and only files of runs are removed.
#![cfg(unix)]

use crate::common::{
    ATTEMPTS, MOTION, Workplace, assert_has, assert_same_files, code, contents, short_motion,
    stderr,
};
use std::fs;
use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::Command;

const EQUILIBRIUM: &str = "Scene(
    filament: Filament(
        sections: [Ellipsoids(from_nm: 0.0, to_nm: 30.0), Rod(from_nm: 30.0, to_nm: 60.0)],
    ),
    clamps: [Clamp(end: Start)],
    loads: [EndForce(end: End, force_pn: (-2.0, 0.0, 0.0))],
    task: Equilibrium(lowest_eigenvalue: true),
)";

const SHORT_PATH: &str = "Scene(
    filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 60.0)]),
    clamps: [Clamp(end: Start)],
    loads: [EndForce(end: End, force_pn: (-2.0, 0.0, 0.0))],
    path: [Stage(set: [LoadFactor(load: 0, factor: 1.0)])],
    task: Equilibrium(largest_step: 0.5),
)";

#[test]
fn a_closed_pipe_ends_nothing() {
    let place = Workplace::with(&short_motion());
    place.run("whole");
    // The program starts writing after the reader has closed the pipe.
    let closed = "| { exec <&-; echo gone > gone; }";
    let after = "until test -e gone; do sleep 0.01; done;";
    for (reader, wait) in [(closed, after), ("| head -n 1", "")] {
        for command in [
            "check scene.ron",
            "run scene.ron --out a",
            "--help",
            "run --help",
        ] {
            let _ = fs::remove_dir_all(place.path("a"));
            let _ = fs::remove_file(place.path("gone"));
            let line = format!("{{ {wait} actin {command}; echo $? > code; }} {reader}");
            let output = place.shell(&line);
            assert_eq!(stderr(&output), "", "{line}");
            let code = place.read("code");
            assert_eq!(code, "0\n", "{line}");
            if command.starts_with("run scene.ron") {
                assert_same_files(&place.path("whole"), &place.path("a"));
            }
        }
    }
}

#[test]
fn closed_standard_error_changes_no_exit_code() {
    let place = Workplace::with(&short_motion());
    place.run("whole");
    let limit = "ulimit -f 8;";
    for (limit, command, expected) in [
        ("", "check absent.ron", "2\n"),
        ("", "run scene.ron --out a", "0\n"),
        ("", "run scene.ron --out a", "2\n"),
        (limit, "run scene.ron --out b --checkpoint-every 0", "74\n"),
    ] {
        let line =
            format!("{{ sleep 0.1; ({limit} actin {command}); echo $? > code; }} 2>&1 | true");
        place.shell(&line);
        let code = place.read("code");
        assert_eq!(code, expected, "{line}");
    }
    assert_same_files(&place.path("whole"), &place.path("a"));
}

#[cfg(target_os = "linux")]
#[test]
fn lost_output_is_an_error() {
    let place = Workplace::with(&short_motion());
    for command in ["check scene.ron", "run scene.ron --out a"] {
        let output = place.shell(&format!("actin {command} > /dev/full"));
        assert_eq!(code(&output), 74, "{}", stderr(&output));
        assert!(stderr(&output).starts_with("error: standard output: "));
    }
    assert!(place.path("a/summary.json").exists());
}

fn refusal(place: &Workplace, arguments: &str, folders: &[&str]) -> String {
    let all = || -> Vec<_> {
        let folders = folders.iter().map(|folder| place.path(folder));
        folders.map(|folder| contents(&folder)).collect()
    };
    let before = all();
    let output = place.shell(&format!("actin run {arguments}"));
    assert_eq!(code(&output), 2, "{}", stderr(&output));
    assert!(all() == before, "{arguments}: {}", stderr(&output));
    println!("{arguments}: {}", stderr(&output));
    stderr(&output).to_owned()
}

#[test]
fn a_read_only_directory_stays() {
    let place = Workplace::with(EQUILIBRIUM);
    place.run("a");
    let chmod = |mode: &str| place.shell(&format!("chmod {mode} a a/vtk"));
    chmod("555");
    if fs::write(place.path("a/probe"), "").is_ok() {
        println!("SKIPPED: permissions do not bind this user");
    } else {
        let message = refusal(&place, "scene.ron --out a --overwrite", &["a", "a/vtk"]);
        assert_has(&message, &["ermission denied"]);
    }
    chmod("755");
}

/// Resumes a run that met a limit, without the limit, and asserts the files of an undisturbed run. Returns the exit
/// code and whether there was a checkpoint.
fn assert_nothing_is_lost(
    place: &Workplace,
    limited: &str,
    resume: impl Fn() -> String,
) -> (i32, bool) {
    let output = place.shell(limited);
    let (message, a) = (stderr(&output), place.path("out/a"));
    let kept = a.join("checkpoint.bin").exists();
    match code(&output) {
        0 => assert_same_files(&place.path("whole"), &a),
        2 => assert!(!kept, "{message}"),
        74 => {
            let names = names(&a);
            let unfinished = names.iter().any(|name| name.contains(".part"));
            assert!(!unfinished && !a.join("summary.json").exists(), "{names:?}");
            let says = if kept {
                "a checkpoint is kept"
            } else {
                "so they are lost"
            };
            assert!(message.contains(says), "{message}");
        }
        other => panic!("exit code {other}: {message}"),
    }
    let go_on = resume();
    if code(&output) != 0 {
        let flag = if kept { "--resume" } else { "--overwrite" };
        let again = place.shell(&format!("{go_on} actin run scene.ron --out out/a {flag}"));
        assert_eq!(code(&again), 0, "{message}{}", stderr(&again));
        assert_same_files(&place.path("whole"), &a);
    }
    (code(&output), kept)
}

fn names(folder: &Path) -> Vec<String> {
    let folders = [folder.to_owned(), folder.join("vtk")];
    let there = folders.iter().filter(|folder| folder.exists());
    let paths = there.flat_map(|folder| contents(folder).into_keys());
    paths.map(|path| path.display().to_string()).collect()
}

/// Runs under every file size limit, in steps of 1 KiB: the program is never killed by SIGXFSZ, leaves no partial
/// files, and its results are available once the limit is removed.
#[test]
fn a_limit_on_the_size_of_files_loses_nothing() {
    let mut kept = [0, 0];
    for scene in [EQUILIBRIUM, SHORT_PATH, &short_motion()] {
        let place = Workplace::with(scene);
        place.run("whole");
        let mut codes = Vec::new();
        for limit in (0..40).step_by(2).chain([60, 100, 1000, 4000]) {
            let _ = fs::remove_dir_all(place.path("out"));
            let limited = format!("ulimit -f {limit}; actin run scene.ron --out out/a");
            let (code, is_kept) = assert_nothing_is_lost(&place, &limited, String::new);
            codes.push(code);
            kept[usize::from(is_kept)] += usize::from(code == 74);
        }
        assert_eq!((codes[0], codes.last()), (2, Some(&0)));
    }
    println!("results that could not be written: {kept:?} without and with a checkpoint");
    assert!(kept[1] > 0, "no checkpoint was left by a limit");
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_loses_nothing() {
    let mut codes = Vec::new();
    for scene in [EQUILIBRIUM, &short_motion()] {
        let place = Workplace::with(scene);
        place.run("whole");
        fs::create_dir(place.path("out")).unwrap();
        for kilobytes in (8..96).step_by(4).chain([160, 1600]) {
            let mount = place.shell(&format!("mount -t tmpfs -o size={kilobytes}k none out"));
            if !mount.status.success() {
                println!("SKIPPED: no right to mount a disk");
                return;
            }
            let disk = Mounted(&place);
            let limited = "actin run scene.ron --out out/a";
            let grow = || "mount -o remount,size=64m out;".to_owned();
            codes.push(assert_nothing_is_lost(&place, limited, grow));
            drop(disk);
        }
    }
    assert!(codes.contains(&(74, true)) && codes.contains(&(0, false)));
}

struct Mounted<'a>(&'a Workplace);

impl Drop for Mounted<'_> {
    fn drop(&mut self) {
        let out = self.0.path("out");
        let _ = Command::new("umount").arg(out).status();
    }
}

#[test]
fn a_run_killed_while_it_writes_results_loses_nothing() {
    let place = Workplace::with(MOTION);
    place.run("whole");
    for name in [
        "a/energies.csv.part",
        "a/vtk/0030.vtp.part",
        "a/summary.json.part",
    ] {
        let killed = (0..ATTEMPTS).any(|_| {
            let _ = fs::remove_dir_all(place.path("a"));
            let mut child = place.start(&["--out", "a"], name);
            child.kill().unwrap();
            child.wait().unwrap().code().is_none()
        });
        assert!(
            killed,
            "every run was done before it could be killed at {name}"
        );
        let summary = place.path("a/summary.json").exists();
        assert!(place.path("a/checkpoint.bin").exists() || summary, "{name}");
        place.resume("a");
        let _ = fs::remove_file(place.path("a/records.bin"));
        place.write("a/.actin-run.lock", "");
        assert_same_files(&place.path("whole"), &place.path("a"));
    }
}

/// A run does not replace its scene or the run from which it starts.
#[test]
fn sources_are_not_overwritten() {
    let place = Workplace::with(EQUILIBRIUM);
    place.run("a");
    symlink("a/scene.ron", place.path("link.ron")).unwrap();
    for scene in ["a/scene.ron", "./a/../a/scene.ron", "link.ron"] {
        let arguments = format!("{scene} --out a --overwrite");
        let message = refusal(&place, &arguments, &["a", "a/vtk"]);
        assert_has(&message, &["lies in a, which --overwrite would replace"]);
    }
    let start = "start: Run(directory: \"a\"), task:";
    fs::write(place.path("next.ron"), EQUILIBRIUM.replace("task:", start)).unwrap();
    let message = refusal(&place, "next.ron --out a --overwrite", &["a", "a/vtk"]);
    assert_has(&message, &["lies in a", "use another --out"]);
}
