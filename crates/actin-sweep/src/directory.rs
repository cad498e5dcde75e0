//! The directory of a sweep: whose it is, and where its runs are.
//!
//! `sweep.ron` and `scene.ron` can be run again from there; `parameters.csv` lists all runs; `runs/17` is the
//! directory of run 17; `runs.csv` and `table.csv` are the results.

use crate::files::{self, MANIFEST, PARAMETERS, SCENE, SWEEP};
use crate::{Opened, SweepError};
use actin_sim::{Difference, RunLock, first_difference};
use std::fs;
use std::path::{Path, PathBuf};

/// A directory that holds the runs of one sweep.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SweepDirectory {
    path: PathBuf,
}

impl SweepDirectory {
    /// Makes the directory of a sweep, or continues that of the same one.
    ///
    /// The same sweep has the same scene and the same runs, by the same version of the program; its results may
    /// be others, for which no run is made again.
    ///
    /// # Errors
    /// A directory that holds another sweep or something else, the same sweep unless `resume`, or a refusal of
    /// the file system.
    pub fn create(
        path: impl AsRef<Path>,
        opened: &Opened,
        resume: bool,
    ) -> Result<Self, SweepError> {
        let path = path.as_ref();
        fs::create_dir_all(path).map_err(SweepError::io(path))?;
        let directory = Self {
            path: path.to_owned(),
        };
        if path.join(MANIFEST).exists() {
            if !resume {
                return Err(SweepError::NotEmpty {
                    path: path.to_owned(),
                });
            }
            directory.ensure_same(opened)?;
        } else if !directory.is_empty()? {
            return Err(SweepError::NotASweep {
                path: path.to_owned(),
            });
        }
        for (name, contents) in identity(opened) {
            if fs::read(path.join(name)).ok().as_ref() != Some(&contents) {
                files::replace(path, name, &contents)?;
            }
        }
        Ok(directory)
    }

    /// Where the directory is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The directory of a run.
    pub fn run(&self, run: usize) -> PathBuf {
        self.path.join("runs").join(run.to_string())
    }

    /// Keeps other sweeps out of the directory until it is dropped.
    ///
    /// # Errors
    /// If another process makes the runs of this sweep, or the file system refuses.
    pub fn lock(&self) -> Result<RunLock, SweepError> {
        Ok(RunLock::take(&self.path)?)
    }

    /// Whether nothing is there but hidden files.
    fn is_empty(&self) -> Result<bool, SweepError> {
        let entries = fs::read_dir(&self.path).map_err(SweepError::io(&self.path))?;
        let mut names = entries.filter_map(|entry| Some(entry.ok()?.file_name()));
        Ok(names.all(|name| name.to_string_lossy().starts_with('.')))
    }

    /// Refuses a directory whose scene, runs or program are others.
    fn ensure_same(&self, opened: &Opened) -> Result<(), SweepError> {
        for (name, given) in identity(opened) {
            if name == SWEEP {
                continue;
            }
            let path = self.path.join(name);
            // One that is missing was killed before it was written.
            let kept = fs::read(&path).unwrap_or_else(|_| given.clone());
            let [kept, given] = [&kept, &given].map(|bytes| String::from_utf8_lossy(bytes));
            if let Some(Difference { line, kept, given }) = first_difference(&kept, &given) {
                return Err(SweepError::Other {
                    path: self.path.clone(),
                    file: name,
                    line,
                    kept,
                    given,
                });
            }
        }
        Ok(())
    }
}

/// What says whose directory it is, by name; the manifest, which says that it is one of a sweep, comes first.
fn identity(opened: &Opened) -> [(&'static str, Vec<u8>); 4] {
    let mut sweep = opened.sweep.clone();
    SCENE.clone_into(&mut sweep.scene);
    let manifest = serde_json::json!({
        "format": "actin sweep directory",
        "version": 1,
        "program": env!("CARGO_PKG_VERSION"),
        "runs": opened.design.len(),
    });
    let manifest = format!("{manifest:#}\n");
    [
        (MANIFEST, manifest.into_bytes()),
        (SWEEP, sweep.to_ron().into_bytes()),
        (SCENE, opened.scene.clone().into_bytes()),
        (PARAMETERS, parameters(opened)),
    ]
}

/// All runs: number, point, values of the keys that are varied and of those that are set, seed.
fn parameters(opened: &Opened) -> Vec<u8> {
    let design = &opened.design;
    let set = &opened.sweep.set;
    let head = ["run", "point"].map(str::to_owned).into_iter();
    let fixed = set.iter().map(|one| one.key.clone());
    let head: Vec<String> = head
        .chain(design.keys.iter().cloned())
        .chain(fixed)
        .chain(["seed".to_owned()])
        .collect();
    let rows = (0..design.len()).map(|index| {
        let run = design.run(index);
        let seed = run.seed.map_or_else(String::new, |seed| seed.to_string());
        let numbers = [run.index, run.point].map(|n| n.to_string()).into_iter();
        let values = design.points[run.point].iter().cloned();
        let fixed = set.iter().map(|one| one.value.0.clone());
        numbers.chain(values).chain(fixed).chain([seed]).collect()
    });
    files::csv(std::iter::once(head).chain(rows))
}
