//! A folder with a scene, the program in it, and the files that a run leaves.
#![allow(dead_code, reason = "each test binary uses some of it")]

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// A second or so of monomers, a junction and a rod under a load that is ramped up.
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
    path: [Stage(set: [LoadFactor(load: 0, factor: 1.0)], duration_ns: 50.0)],
    task: Dynamics(
        duration_ns: 150.0,
        record_every_ns: 1.5,
        drag: (translational_per_ns: 0.01, rotational_per_ns: 0.01),
    ),
)";

/// The same in a heat bath, observed, with no states kept.
pub(crate) fn observed() -> String {
    let observe = "observe: [Tip(), EndReaction(end: Start), Energies, SquaredDisplacement(of: Tip, lag_ns: 3.0)],
        output: (vtk: false, states: false),
        path:";
    let heat = "thermal: (temperature_k: 298.0, seed: 3),\n        drag:";
    MOTION.replace("path:", observe).replace("drag:", heat)
}

/// A hundred equilibria.
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

/// How often a run is begun that is to be interrupted.
pub(crate) const ATTEMPTS: usize = 5;

/// A folder with one scene.
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

    pub(crate) fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_actin"));
        command.args(["run", "scene.ron"]).args(arguments);
        command.current_dir(self.folder.path());
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        command
    }

    pub(crate) fn actin(&self, arguments: &[&str]) -> Output {
        self.command(arguments).output().unwrap()
    }

    /// What a shell makes of a command, in which `actin` is the program.
    pub(crate) fn shell(&self, command: &str) -> Output {
        let program = Path::new(env!("CARGO_BIN_EXE_actin"));
        let path = std::env::var("PATH").unwrap();
        let folder = program.parent().unwrap().display();
        Command::new("sh")
            .args(["-c", command])
            .env("PATH", format!("{folder}:{path}"))
            .current_dir(self.folder.path())
            .output()
            .unwrap()
    }

    /// Starts a run and waits until its directory holds `name`, or it has ended.
    pub(crate) fn start(&self, arguments: &[&str], name: &str) -> Child {
        let mut child = self.command(arguments).spawn().unwrap();
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

    /// Starts a run into `out`, sends it `signals` as soon as that holds `name`, and waits for its
    /// end. On a machine so busy that the run is done before, it is tried again.
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

/// The exit code; -1 of a program that a signal has ended.
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

/// The files of a folder itself.
pub(crate) fn contents(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let entries = fs::read_dir(folder).unwrap();
    let paths = entries.map(|entry| entry.unwrap().path());
    let files = paths.filter(|path| path.is_file());
    files
        .map(|path| (path.clone(), fs::read(path).unwrap()))
        .collect()
}

/// Every file of a run directory; of the summary all lines but the time it took.
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
