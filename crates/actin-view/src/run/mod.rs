//! A run directory to be looked at: what there is in it, and the page that shows it.
//!
//! A directory needs a `scene.ron` that can be built. What else is missing, damaged or not there yet is said
//! on the page, which shows the rest: the records of a run that goes on or was interrupted come from its
//! checkpoint, and where there are no states at all the filaments are shown as built.

mod curves;
mod data;
mod page;
mod source;
mod thin;

use curves::Curve;
use source::Source;

use actin_sim::mechanics::State;
use actin_sim::{Assembly, At, FollowedDirectory, Scene, Summary};
use std::fs;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Why a run cannot be looked at.
#[derive(Debug, Error)]
pub enum ViewError {
    /// Not a directory.
    #[error("{}: {reason}", .path.display())]
    NotARun {
        /// The path.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// The scene of the run cannot be read or built.
    #[error("{}:{reason}", .path.display())]
    Scene {
        /// `scene.ron`.
        path: PathBuf,
        /// Line, column and what is wrong there.
        reason: String,
    },
}

/// The folder of the stretches of a motion which sections follow.
const STRETCHES: &str = "stretches";
/// Stretches that are looked for.
const MOST_STRETCHES: usize = 1_000_000;

/// How much of a run a page holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Bytes of states: records are left out evenly above it.
    pub bytes: usize,
    /// Rows of curves, likewise.
    pub rows: usize,
}

impl Default for Limits {
    /// 12 MB of states, which are 16 MB on the page, and 4000 rows.
    fn default() -> Self {
        Self {
            bytes: 12_000_000,
            rows: 4000,
        }
    }
}

/// What a run directory holds, as far as it is shown.
#[derive(Debug)]
pub struct Run {
    path: PathBuf,
    pub(crate) assembly: Assembly,
    /// Of a motion which sections follow, the assemblies of all stretches but the first.
    later: Vec<Assembly>,
    /// To which of them the records behind those of the first stretch belong, in order.
    of_later: Vec<usize>,
    summary: Option<Summary>,
    /// What is missing, damaged or left out, a sentence or two each.
    remarks: Vec<String>,
    /// How many records the run has.
    records: usize,
    /// Those that are shown.
    which: Vec<usize>,
    pub(crate) at: Vec<At>,
    pub(crate) states: Vec<State>,
    curves: Vec<Curve>,
}

impl Run {
    /// Reads what there is in a run directory.
    ///
    /// # Errors
    /// A path that is no directory, and a directory without a scene that can be built.
    pub fn open(path: &Path, limits: Limits) -> Result<Self, ViewError> {
        if FollowedDirectory::is_at(path) {
            return Self::open_stretches(path, limits);
        }
        let assembly = assembly(path)?;
        let mut source = Source::of(path, &assembly);
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
                "Of {records} records {shown} are shown, evenly chosen, with the first and the last: all would \
                 make a page of {:.0} MB.",
                1.4e-6 * (each * records) as f64
            ));
        }
        let curves = curves::thinned(source.curves, limits.rows);
        let at = which.iter().filter_map(|&i| source.at.get(i).copied());
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

    /// Reads a motion which sections follow: its stretches one after the other.
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

    /// Whether sections follow the motion: its records are of filaments that are resolved differently, which a film shows
    /// and a page does not.
    pub fn is_followed(&self) -> bool {
        !self.later.is_empty()
    }

    /// The filament as it is resolved in a record that is shown.
    pub(crate) fn assembly_of(&self, shown: usize) -> &Assembly {
        let first = self.states.len() - self.of_later.len();
        match shown.checked_sub(first) {
            None => &self.assembly,
            Some(behind) => &self.later[self.of_later[behind]],
        }
    }

    /// What is missing, damaged or left out, a sentence or two each.
    pub fn remarks(&self) -> &[String] {
        &self.remarks
    }

    /// How many records are shown, and how many there are.
    pub fn shown(&self) -> (usize, usize) {
        (self.at.len(), self.records)
    }
}

/// Whether a file is a page that [`Run::page`] made.
pub fn is_page(bytes: &[u8]) -> bool {
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(512)]);
    head.contains(&format!(
        "<meta name=\"generator\" content=\"{}\">",
        page::GENERATOR
    ))
}

/// The scene of a run, built.
fn assembly(path: &Path) -> Result<Assembly, ViewError> {
    let not_a_run = |reason: String| ViewError::NotARun {
        path: path.to_owned(),
        reason,
    };
    match fs::metadata(path) {
        Err(error) => return Err(not_a_run(error.to_string())),
        Ok(data) if !data.is_dir() => {
            return Err(not_a_run("not a directory: name that of a run".into()));
        }
        Ok(_) => {}
    }
    let file = path.join("scene.ron");
    if !file.exists() {
        let reason = "no scene.ron in it: not the directory of a run";
        return Err(not_a_run(reason.into()));
    }
    let refused = |reason: String| ViewError::Scene {
        path: file.clone(),
        reason,
    };
    let text = fs::read_to_string(&file).map_err(|error| refused(format!(" {error}")))?;
    let scene = Scene::from_ron(&text).map_err(|error| refused(error.to_string()))?;
    Assembly::build(&scene).map_err(|problem| refused(format!(" {problem}")))
}
