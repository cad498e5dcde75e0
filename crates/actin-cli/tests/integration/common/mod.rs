//! A folder with a scene, in which the program runs.
#![allow(dead_code, reason = "each test binary uses some of it")]

use std::collections::BTreeMap;
use std::env;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// A motion of a second or two: monomers, a junction and a rod under a ramped load.
pub(crate) const MOTION: &str = "Scene(
    title: \"kept\",
    filament: Filament(
        sections: [
            Ellipsoids(from_nm: 0.0, to_nm: 10.0),
            Rod(from_nm: 10.0, to_nm: 30.0),
        ],
        monomers: Monomers(anchors: Independent, lateral_bonds: 8, longitudinal_bonds: 8),
    ),
    clamps: [Clamp(end: Start)],
    loads: [EndForce(end: End, force_pn: (-2.0, 0.0, 0.0))],
    path: [Stage(set: [LoadFactor(load: 0, factor: 1.0)], duration_ns: 25.0)],
    task: Dynamics(
        duration_ns: 75.0,
        record_every_ns: 0.75,
        drag: (translational_per_ns: 0.01, rotational_per_ns: 0.01),
    ),
)";

/// A short rod, monomers and a junction under a force, with one record per ns. A duration of 2 ns takes about 0.01 s.
pub(crate) fn pushed(duration_ns: f64) -> String {
    format!(
        "Scene(
    filament: Filament(
        sections: [Ellipsoids(from_nm: 0.0, to_nm: 10.0), Rod(from_nm: 10.0, to_nm: 30.0)],
        monomers: Monomers(anchors: Independent, lateral_bonds: 8, longitudinal_bonds: 8),
    ),
    clamps: [Clamp(end: Start)],
    loads: [EndForce(end: End, force_pn: (-2.0, 0.0, 0.0))],
    task: Dynamics(duration_ns: {duration_ns:?}, record_every_ns: 1.0),
)"
    )
}

pub(crate) fn short_motion() -> String {
    let short = MOTION.replace("75.0", "1.0").replace("25.0", "0.5");
    short.replace("0.75", "0.25")
}

/// `MOTION` in a heat bath, with observables and without states.
pub(crate) fn observed() -> String {
    let observe = "observe: [Tip(), EndReaction(end: Start), Energies, SquaredDisplacement(of: Tip, lag_ns: 3.0)],
        output: (vtk: false, states: false),
        path:";
    let heat = "thermal: (temperature_k: 298.0, seed: 3),\n        drag:";
    MOTION.replace("path:", observe).replace("drag:", heat)
}

pub(crate) const PATH: &str = "Scene(
    filament: Filament(
        sections: [Ellipsoids(from_nm: 0.0, to_nm: 90.0), Rod(from_nm: 90.0, to_nm: 150.0)],
    ),
    clamps: [Clamp(end: Start), Clamp(end: End, slides: AlongAxis)],
    path: [
        Stage(set: [Turn(end: End, turn_deg: (0.0, 0.0, 90.0))]),
        Stage(set: [Turn(end: End, turn_deg: (0.0, 30.0, 90.0))]),
    ],
    task: Equilibrium(largest_step: 0.02, lowest_eigenvalue: true),
)";

pub(crate) const ATTEMPTS: usize = 5;

pub(crate) struct Workplace {
    pub(crate) folder: TempDir,
}

impl Workplace {
    pub(crate) fn with(scene: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("scene.ron"), scene).unwrap();
        Self { folder }
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub(crate) fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap()
    }

    pub(crate) fn write(&self, name: &str, text: impl AsRef<[u8]>) {
        fs::write(self.path(name), text).unwrap();
    }

    pub(crate) fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_actin"));
        command.args(arguments).current_dir(self.folder.path());
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        command
    }

    pub(crate) fn actin(&self, arguments: &[&str]) -> Output {
        self.command(arguments).output().unwrap()
    }

    pub(crate) fn succeed(&self, arguments: &[&str]) -> String {
        let output = self.actin(arguments);
        let told = || format!("{arguments:?}: {}{}", stdout(&output), stderr(&output));
        assert_eq!(code(&output), 0, "{}", told());
        stdout(&output).to_owned()
    }

    pub(crate) fn fail(&self, expected: i32, arguments: &[&str]) -> String {
        let output = self.actin(arguments);
        let told = || format!("{arguments:?}: {}{}", stdout(&output), stderr(&output));
        assert_eq!(code(&output), expected, "{}", told());
        stderr(&output).to_owned()
    }

    pub(crate) fn piped(&self, arguments: &[&str], input: &str) -> Output {
        let mut command = self.command(arguments);
        let mut child = command.stdin(Stdio::piped()).spawn().unwrap();
        let mut pipe = child.stdin.take().unwrap();
        pipe.write_all(input.as_bytes()).unwrap();
        drop(pipe);
        child.wait_with_output().unwrap()
    }

    pub(crate) fn assert_same(&self, [one, other]: [&str; 2], names: &[&str]) {
        for name in names {
            let [a, b] = [one, other].map(|folder| fs::read(self.path(folder).join(name)).unwrap());
            assert!(a == b, "{name} of {one} differs from {other}");
        }
    }

    pub(crate) fn run(&self, out: &str) -> String {
        self.succeed(&["run", "scene.ron", "--out", out])
    }

    pub(crate) fn resume(&self, out: &str) -> String {
        self.succeed(&["run", "scene.ron", "--out", out, "--resume"])
    }

    pub(crate) fn shell(&self, command: &str) -> Output {
        let mut shell = with_actin("sh", self.folder.path());
        shell.args(["-c", command]).output().unwrap()
    }

    pub(crate) fn start(&self, arguments: &[&str], name: &str) -> Child {
        let run = [&["run", "scene.ron"], arguments].concat();
        let mut child = self.command(&run).spawn().unwrap();
        let patience = Instant::now();
        while !self.path(name).exists() && child.try_wait().unwrap().is_none() {
            if patience.elapsed() > Duration::from_mins(2) {
                child.kill().unwrap();
                panic!("no {name}");
            }
            sleep(Duration::from_millis(2));
        }
        child
    }

    /// Starts a run into `out`, sends `signals` as soon as `out` contains `name`, and waits for its end. Repeats if
    /// the run ends earlier.
    pub(crate) fn interrupted(&self, out: &str, name: &str, signals: &[&str]) -> Output {
        for _ in 0..ATTEMPTS {
            let arguments = ["--out", out, "--checkpoint-every", "0.01"];
            let child = self.start(&arguments, &format!("{out}/{name}"));
            for name in signals {
                signal(&child, name);
            }
            let output = child.wait_with_output().unwrap();
            println!("{}", stderr(&output));
            if output.status.code() != Some(0) {
                return output;
            }
            fs::remove_dir_all(self.path(out)).unwrap();
        }
        panic!("{ATTEMPTS} runs got to their end in spite of {signals:?}");
    }
}

pub(crate) fn with_actin(program: &str, folder: &Path) -> Command {
    let own = Path::new(env!("CARGO_BIN_EXE_actin")).parent().unwrap();
    let path = env::var_os("PATH").unwrap_or_default();
    let folders = [own.to_owned()].into_iter().chain(env::split_paths(&path));
    let mut command = Command::new(program);
    command.env("PATH", env::join_paths(folders).unwrap());
    command.current_dir(folder);
    command
}

/// Returns a Python that can import `packages`. If there is none, prints that the test of `what` is skipped, or fails
/// if the environment variable `required` is set, as in `.ci/run`.
pub(crate) fn python(packages: &str, required: &str, what: &str) -> Option<String> {
    let named = env::var("PYTHON").ok();
    let usual = ["python3", "/usr/bin/python3"].map(str::to_owned);
    let has_packages = |python: &String| {
        let mut command = Command::new(python);
        let output = command.args(["-c", &format!("import {packages}")]).output();
        output.is_ok_and(|output| output.status.success())
    };
    let found = named.into_iter().chain(usual).find(has_packages);
    if found.is_none() {
        let message = format!("no python3 with {packages}: {what} NOT TESTED");
        assert!(env::var_os(required).is_none(), "{message}");
        eprintln!("{message}");
    }
    found
}

pub(crate) fn code(output: &Output) -> i32 {
    output.status.code().unwrap_or(-1)
}

pub(crate) fn stdout(output: &Output) -> &str {
    std::str::from_utf8(&output.stdout).unwrap()
}

pub(crate) fn stderr(output: &Output) -> &str {
    std::str::from_utf8(&output.stderr).unwrap()
}

pub(crate) fn signal(child: &Child, name: &str) {
    let id = child.id().to_string();
    let sent = Command::new("kill").args([name, &id]).status().unwrap();
    assert!(sent.success());
}

pub(crate) fn assert_has(text: &str, parts: &[&str]) {
    for part in parts {
        assert!(text.contains(part), "{part:?} is not in {text}");
    }
}

pub(crate) fn contents(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let entries = fs::read_dir(folder).unwrap();
    let paths = entries.map(|entry| entry.unwrap().path());
    let files = paths.filter(|path| path.is_file());
    files
        .map(|path| (path.clone(), fs::read(path).unwrap()))
        .collect()
}

pub(crate) fn files(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut files = Vec::new();
    let folders = [folder.to_owned(), folder.join("vtk")];
    for folder in folders.iter().filter(|folder| folder.exists()) {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if !path.is_file() {
                continue;
            }
            let name = path.file_name().unwrap().to_str().unwrap().to_owned();
            let mut bytes = fs::read(&path).unwrap();
            if name == "summary.json" {
                let text = String::from_utf8(bytes).unwrap();
                let lines = text.lines().filter(|line| !line.contains("\"wall_s\""));
                bytes = lines.collect::<String>().into_bytes();
            }
            files.push((name, bytes));
        }
    }
    files.sort();
    files
}

pub(crate) fn assert_same_files(one: &Path, other: &Path) {
    let (one, other) = (files(one), files(other));
    let names = |files: &[(String, Vec<u8>)]| -> Vec<String> {
        files.iter().map(|(name, _)| name.clone()).collect()
    };
    assert_eq!(names(&one), names(&other));
    for ((name, a), (_, b)) in one.iter().zip(&other) {
        assert!(a == b, "{name} differs");
    }
}
