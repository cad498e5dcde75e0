//! Directory of a sweep.
//!
//! | file | contents |
//! |---|---|
//! | `sweep.ron`, `scene.ron` | the sweep and its scene, which can be run again |
//! | `parameters.csv` | all runs with their values and seeds |
//! | `runs/17` | directory of run 17 |
//! | `runs.csv`, `table.csv` | results |

use crate::files::{self, MANIFEST, PARAMETERS, SCENE, SWEEP};
use crate::{SweepError, ValidatedSweep};
use actin_rundir::{Difference, RunLock, first_difference};
use std::fs;
use std::path::{Path, PathBuf};

/// Directory of the runs of one sweep.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SweepDirectory {
    path: PathBuf,
}

impl SweepDirectory {
    /// Creates the directory of a sweep, or opens it to continue the same sweep.
    ///
    /// Two sweeps are the same if scene, runs and program version are equal. Their `results` may differ, which
    /// requires no new runs.
    ///
    /// # Errors
    /// If the directory contains another sweep or other files, contains the same sweep and `resume` is false, or a
    /// file system operation fails.
    pub fn create(
        path: impl AsRef<Path>,
        opened: &ValidatedSweep,
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

    /// Returns the path of the directory.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Returns the directory of a run.
    pub(crate) fn run(&self, run: usize) -> PathBuf {
        self.path.join("runs").join(run.to_string())
    }

    /// Locks the directory until the result is dropped.
    ///
    /// # Errors
    /// If another process holds the lock, or a file system operation fails.
    pub(crate) fn lock(&self) -> Result<RunLock, SweepError> {
        Ok(RunLock::acquire(&self.path)?)
    }

    fn is_empty(&self) -> Result<bool, SweepError> {
        let entries = fs::read_dir(&self.path).map_err(SweepError::io(&self.path))?;
        let mut names = entries.filter_map(|entry| Some(entry.ok()?.file_name()));
        Ok(names.all(|name| name.to_string_lossy().starts_with('.')))
    }

    fn ensure_same(&self, opened: &ValidatedSweep) -> Result<(), SweepError> {
        for (name, given) in identity(opened) {
            if name == SWEEP {
                continue;
            }
            let path = self.path.join(name);
            // A missing file was not yet written when the process was killed.
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

/// Returns the files that identify the sweep. The manifest, which marks the directory as a sweep, is the first.
fn identity(opened: &ValidatedSweep) -> [(&'static str, Vec<u8>); 4] {
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

/// Returns the table of all runs: index, point, varied values, set values, seed.
fn parameters(opened: &ValidatedSweep) -> Vec<u8> {
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
