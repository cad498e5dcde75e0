//! Run directories with foreign files, and results that cannot be written: a message, and all files unchanged.

use super::row::{Expected, Outcome, Row};
use super::scenes::{CompletedRun, run};
use actin_rundir::{RunDirectory, RunDirectoryError};
use actin_sim::Plan;
use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

const SCENE: &str = "Scene(
    filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 30.0)], rod: RodModel(law: Constant)), clamps: [Clamp(end: Start)],
    loads: [EndForce(end: End, force_pn: (-2.0, 0.0, 0.0))], task: Equilibrium())";

type DamageFile = fn(&Path) -> io::Result<()>;

const OVERWRITE_OBSTACLES: [(&str, DamageFile); 7] = [
    ("no manifest: a folder of somebody else", |folder| {
        fs::remove_file(folder.join("run/actin-run.json"))
    }),
    ("the manifest of another program", |folder| {
        fs::write(folder.join("run/actin-run.json"), "{\"name\": \"app\"}")
    }),
    ("a manifest that lists a file outside", |folder| {
        let path = folder.join("run/actin-run.json");
        let text = fs::read_to_string(&path)?;
        fs::write(path, text.replace("states.npz", "../notes.txt"))
    }),
    ("a picture that the manifest does not list", |folder| {
        fs::write(folder.join("run/vtk/0001.vtp"), "mine")
    }),
    ("a scene that was changed after the run", |folder| {
        fs::write(folder.join("run/scene.ron"), "Scene(/* mine */)")
    }),
    ("a folder in the place of a file", |folder| {
        fs::remove_file(folder.join("run/profile.csv"))?;
        fs::create_dir(folder.join("run/profile.csv"))
    }),
    ("pictures behind a link", |folder| {
        fs::rename(folder.join("run/vtk"), folder.join("pictures"))?;
        link("../pictures", &folder.join("run/vtk"))
    }),
];

/// Obstacles to writing results: directories with the names of unfinished files.
const OBSTACLES: [&str; 3] = ["scene.ron.part", "states.npz.part", "summary.json.part"];

pub(super) fn rows() -> Vec<Row> {
    let overwritten = OVERWRITE_OBSTACLES.map(|(case, spoil)| {
        let tried = overwritten(spoil).map_err(|e| not_tried(&e));
        Row::new("overwrite", case, tried).expecting(Expected::Refused)
    });
    let refused = OBSTACLES.map(|name| {
        let case = format!("no room for {}", name.trim_end_matches(".part"));
        let tried = refused_by_the_disk(name).map_err(|e| not_tried(&e));
        Row::new("results", case, tried).expecting(Expected::Fails(&[]))
    });
    overwritten.into_iter().chain(refused).collect()
}

fn not_tried(error: &str) -> Outcome {
    Outcome::Wrong(format!("not tried: {error}"))
}

struct RunFixture {
    folder: tempfile::TempDir,
    ran: CompletedRun,
}

impl RunFixture {
    fn new() -> Result<Self, String> {
        let made = Self {
            folder: tempfile::tempdir().map_err(|e| e.to_string())?,
            ran: run(SCENE).map_err(|outcome| outcome.words())?,
        };
        let directory = RunDirectory::create(made.run(), false).map_err(|e| e.to_string())?;
        made.write(&directory).map_err(|e| e.to_string())?;
        fs::write(made.folder.path().join("notes.txt"), "mine").map_err(|e| e.to_string())?;
        Ok(made)
    }

    fn run(&self) -> PathBuf {
        self.folder.path().join("run")
    }

    fn write(&self, directory: &RunDirectory) -> Result<(), RunDirectoryError> {
        let plan = Plan::new(&self.ran.assembly).expect("the scene has run");
        let CompletedRun {
            trajectory, report, ..
        } = &self.ran;
        directory.write(&plan, trajectory, report).map(drop)
    }

    fn message(&self, error: &RunDirectoryError) -> String {
        let folder = format!("{}/", self.folder.path().display());
        error.to_string().replace(&folder, "")
    }
}

fn overwritten(spoil: DamageFile) -> Result<Outcome, String> {
    let made = RunFixture::new()?;
    spoil(made.folder.path()).map_err(|e| e.to_string())?;
    let before = contents(made.folder.path())?;
    let taken = RunDirectory::create(made.run(), true);
    let is_untouched = contents(made.folder.path())? == before;
    Ok(match taken {
        Err(error) if is_untouched => Outcome::Refused(made.message(&error)),
        Err(error) => Outcome::Wrong(format!("files are gone: {}", made.message(&error))),
        Ok(_) => Outcome::Wrong("overwritten".into()),
    })
}

fn refused_by_the_disk(name: &str) -> Result<Outcome, String> {
    let made = RunFixture::new()?;
    let before = contents(&made.run())?;
    let obstacle = made.run().join(name);
    fs::create_dir(&obstacle).map_err(|e| e.to_string())?;
    let written = made.write(&RunDirectory::existing(made.run()));
    fs::remove_dir(&obstacle).map_err(|e| e.to_string())?;
    let is_untouched = contents(&made.run())? == before;
    Ok(match written {
        Err(error) if is_untouched => Outcome::Fails(made.message(&error)),
        Err(error) => Outcome::Wrong(format!("files changed: {}", made.message(&error))),
        Ok(()) => Outcome::Wrong("written".into()),
    })
}

fn contents(folder: &Path) -> Result<BTreeMap<PathBuf, Vec<u8>>, String> {
    let mut all = BTreeMap::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).map_err(|e| e.to_string())? {
            let path = entry.map_err(|e| e.to_string())?.path();
            if path.ends_with(".actin-run.lock") {
                continue;
            }
            let bytes = if let Ok(target) = fs::read_link(&path) {
                target.to_string_lossy().into_owned().into_bytes()
            } else if path.is_dir() {
                folders.push(path);
                continue;
            } else {
                fs::read(&path).map_err(|e| e.to_string())?
            };
            all.insert(path, bytes);
        }
    }
    Ok(all)
}

#[cfg(unix)]
fn link(target: &str, path: &Path) -> io::Result<()> {
    std::os::unix::fs::symlink(target, path)
}

#[cfg(not(unix))]
fn link(target: &str, path: &Path) -> io::Result<()> {
    std::os::windows::fs::symlink_dir(target, path)
}
