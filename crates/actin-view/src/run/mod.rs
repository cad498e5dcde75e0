//! Run directories and their pages.
//!
//! A directory must contain a valid `scene.ron`. Other missing or damaged files are reported on the page. Records of
//! a running or interrupted run are read from its checkpoint. Without any states, the page shows the initial shape.

mod curves;
mod data;
mod page;
mod source;
mod thin;

use curves::Curve;
use source::Source;

use actin_rundir::FollowedDirectory;
use actin_sim::mechanics::State;
use actin_sim::{Assembly, At, Scene, SceneProblem, Summary};
use std::fs;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Error of opening a run directory.
#[derive(Debug, Error)]
pub enum ViewError {
    /// The path is not a run directory.
    #[error("{}: {reason}", .path.display())]
    NotARun {
        /// The path.
        path: PathBuf,
        /// Reason.
        reason: String,
    },
    /// The scene cannot be read or built.
    #[error("{}:{reason}", .path.display())]
    Scene {
        /// `scene.ron`.
        path: PathBuf,
        /// Line, column and problem.
        reason: String,
    },
}

/// Folder of the stretches of a run with time-dependent resolution.
const STRETCHES: &str = "stretches";
const MOST_STRETCHES: usize = 1_000_000;

/// Limits on the size of a page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Largest size of all states in bytes. Records are thinned evenly to fit.
    pub bytes: usize,
    /// Largest number of rows of curves, which are thinned likewise.
    pub rows: usize,
}

impl Default for Limits {
    /// 12 MB of states (16 MB on the page) and 4000 rows.
    fn default() -> Self {
        Self {
            bytes: 12_000_000,
            rows: 4000,
        }
    }
}

/// Contents of a run directory.
#[derive(Debug)]
pub struct Run {
    path: PathBuf,
    pub(crate) assembly: Assembly,
    /// Assemblies of all stretches but the first, for time-dependent resolution.
    later: Vec<Assembly>,
    /// Indices into `later` for the records after the first stretch.
    of_later: Vec<usize>,
    summary: Option<Summary>,
    /// Missing, damaged or omitted data, as sentences.
    remarks: Vec<String>,
    records: usize,
    which: Vec<usize>,
    pub(crate) at: Vec<At>,
    pub(crate) states: Vec<State>,
    curves: Vec<Curve>,
}

impl Run {
    /// Creates the run of a scene without records, whose page shows the initial shape.
    ///
    /// # Errors
    /// If the scene cannot be built.
    pub fn initial(scene: &Scene) -> Result<Self, SceneProblem> {
        let assembly = actin_sim::build(scene)?;
        Ok(Self {
            path: PathBuf::new(),
            at: vec![At::Path(0.0)],
            summary: None,
            remarks: Vec::new(),
            records: 1,
            which: vec![0],
            states: vec![assembly.rest.clone()],
            curves: Vec::new(),
            assembly,
            later: Vec::new(),
            of_later: Vec::new(),
        })
    }

    /// Returns whether the run is a scene without a directory.
    pub(crate) fn is_initial(&self) -> bool {
        self.path.as_os_str().is_empty()
    }

    /// Reads a run directory.
    ///
    /// # Errors
    /// If the path is not a directory, or contains no valid scene.
    pub fn open(path: &Path, limits: Limits) -> Result<Self, ViewError> {
        if FollowedDirectory::exists_at(path) {
            return Self::open_stretches(path, limits);
        }
        let assembly = assembly(path)?;
        let mut source = Source::new(path, &assembly);
        let each = data::bytes_per_record(&assembly);
        let which = thin::evenly(source.at.len(), limits.bytes / each);
        let states = source.states(&assembly, &which);
        let (which, states) = match states {
            Some(states) => (which, states),
            None => (vec![0], vec![assembly.rest.clone()]),
        };
        let records = source.at.len();
        if which.len() < records {
            let shown = which.len();
            source.remarks.push(format!(
                "{shown} of {records} records are shown, evenly spaced, including the first and the last: all would \
                 make a page of {:.0} MB.",
                1.4e-6 * (each * records) as f64
            ));
        }
        let curves = curves::thinned(source.curves, limits.rows);
        let at_of = |&i: &usize| source.at.get(i).copied().unwrap_or(At::Path(0.0));
        let at = which.iter().map(at_of);
        Ok(Self {
            path: path.to_owned(),
            at: at.collect(),
            summary: source.summary,
            remarks: source.remarks,
            records,
            which,
            states,
            curves,
            assembly,
            later: Vec::new(),
            of_later: Vec::new(),
        })
    }

    fn open_stretches(path: &Path, limits: Limits) -> Result<Self, ViewError> {
        let folder = |index: usize| path.join(STRETCHES).join(format!("{index:04}"));
        let folders: Vec<PathBuf> = (0..MOST_STRETCHES)
            .map(folder)
            .take_while(|folder| folder.is_dir())
            .collect();
        let limits = Limits {
            bytes: limits.bytes / folders.len().max(1),
            ..limits
        };
        let mut all = Self::open(&folder(0), limits)?;
        for folder in folders.iter().skip(1) {
            let next = Self::open(folder, limits)?;
            all.of_later
                .extend(next.states.iter().map(|_| all.later.len()));
            all.later.push(next.assembly);
            all.at.extend(next.at);
            all.states.extend(next.states);
            all.which.extend(next.which.iter().map(|i| all.records + i));
            all.records += next.records;
            all.remarks.extend(next.remarks);
            all.summary = next.summary;
        }
        path.clone_into(&mut all.path);
        Ok(all)
    }

    /// Returns whether the resolution changes with time. A film can show such a run, a page cannot.
    pub fn has_changing_resolution(&self) -> bool {
        !self.later.is_empty()
    }

    pub(crate) fn assembly_of(&self, shown: usize) -> &Assembly {
        let first = self.states.len() - self.of_later.len();
        match shown.checked_sub(first) {
            None => &self.assembly,
            Some(behind) => &self.later[self.of_later[behind]],
        }
    }

    /// Returns sentences on missing, damaged or omitted data.
    pub fn remarks(&self) -> &[String] {
        &self.remarks
    }

    /// Returns the number of loaded records and of all records.
    pub fn shown(&self) -> (usize, usize) {
        (self.at.len(), self.records)
    }
}

/// Returns whether a file was made by [`Run::page`].
pub fn is_page(bytes: &[u8]) -> bool {
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(512)]);
    head.contains(&format!(
        "<meta name=\"generator\" content=\"{}\">",
        page::GENERATOR
    ))
}

fn assembly(path: &Path) -> Result<Assembly, ViewError> {
    let not_a_run = |reason: String| ViewError::NotARun {
        path: path.to_owned(),
        reason,
    };
    match fs::metadata(path) {
        Err(error) => return Err(not_a_run(error.to_string())),
        Ok(data) if !data.is_dir() => {
            return Err(not_a_run("not a directory: name a run directory".into()));
        }
        Ok(_) => {}
    }
    let file = path.join("scene.ron");
    if !file.exists() {
        let reason = "no scene.ron in it: not a run directory";
        return Err(not_a_run(reason.into()));
    }
    let refused = |reason: String| ViewError::Scene {
        path: file.clone(),
        reason,
    };
    let text = fs::read_to_string(&file).map_err(|error| refused(format!(" {error}")))?;
    let scene = Scene::from_ron(&text).map_err(|error| refused(error.to_string()))?;
    actin_sim::build(&scene).map_err(|problem| refused(format!(" {problem}")))
}
