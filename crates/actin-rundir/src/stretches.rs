//! Directory of a motion with adaptive sections: a chain of run directories and their common files.
//!
//! | file | contents |
//! |---|---|
//! | `scene.ron`, `summary.json` | scene; last record, with switches under `following` |
//! | `stretches/NNNN/` | run directory of each stretch between two switches, with explicit sections |
//! | `stretches.json` | start of each stretch |
//! | `switches.csv` | time, position and changes of energy and momentum of each switch |
//! | `energies.csv`, `observables.csv` | tables of all stretches, concatenated; without energies of parts |
//!
//! Each switch adds two records at its time, before and after it, to the regular ones: means over the rows of these
//! tables give moments of switches more weight.

use crate::RunDirectoryError;
use crate::atomic::unfinished;
use crate::directory::RunDirectory;
use crate::json::{read_json, write_json};
use crate::lock::LOCK;
use crate::manifest::remove_if_there;
use crate::names::{ENERGIES, MANIFEST, OBSERVABLES, PICTURES, STRETCHES, SUMMARY, SWITCHES};
use actin_sim::Summary;
use actin_sim::follow::StretchStart;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

const FOLDER: &str = "stretches";

/// Columns of `energies.csv` that do not depend on the resolution. The last three are written only
/// if energy is supplied from outside.
const COMMON: [&str; 10] = [
    "time_ns",
    "total_pn_nm",
    "potential_pn_nm",
    "elastic_pn_nm",
    "kinetic_pn_nm",
    "residual_force_pn",
    "residual_torque_pn_nm",
    "work_pn_nm",
    "heat_pn_nm",
    "events_pn_nm",
];

/// Directory of a chain of stretches.
#[derive(Clone, Debug)]
pub struct FollowedDirectory {
    directory: RunDirectory,
}

impl FollowedDirectory {
    /// Opens the directory at `path`, which is also a [`RunDirectory`].
    pub fn new(path: impl Into<PathBuf>) -> Self {
        Self {
            directory: RunDirectory::existing(path),
        }
    }

    /// Returns true if `path` contains a list of stretches.
    pub fn exists_at(path: &Path) -> bool {
        path.join(STRETCHES).is_file()
    }

    /// Path of the directory.
    pub fn path(&self) -> &Path {
        self.directory.path()
    }

    /// Path of a stretch.
    pub fn stretch(&self, index: usize) -> PathBuf {
        self.path().join(FOLDER).join(format!("{index:04}"))
    }

    /// Returns the starts of all stretches; empty without stretches.
    ///
    /// # Errors
    /// The file is unreadable or not a list of stretches.
    pub fn beginnings(&self) -> Result<Vec<StretchStart>, RunDirectoryError> {
        if !Self::exists_at(self.path()) {
            return Ok(Vec::new());
        }
        read_json(&self.path().join(STRETCHES))
    }

    /// Writes the starts of all stretches.
    ///
    /// # Errors
    /// A refusal of the file system.
    pub fn note(&self, beginnings: &[StretchStart]) -> Result<(), RunDirectoryError> {
        self.directory
            .replace(STRETCHES, |out| write_json(&beginnings, out))
    }

    /// Removes the run directories of stretch `first` and all later ones, in descending order.
    ///
    /// # Errors
    /// A directory contains files that no run has written, or the file system refuses an operation.
    pub fn remove_from(&self, first: usize) -> Result<(), RunDirectoryError> {
        let folder = self.path().join(FOLDER);
        let Ok(entries) = fs::read_dir(&folder) else {
            return Ok(());
        };
        let names = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
        let mut indices: Vec<usize> = names.filter_map(|name| name.parse().ok()).collect();
        indices.sort_unstable_by(|a, b| b.cmp(a));
        for index in indices.into_iter().filter(|&index| index >= first) {
            remove_run(&self.stretch(index))?;
        }
        Ok(())
    }

    /// Writes the common files after all stretches were written; `last` is the summary of the last
    /// stretch.
    ///
    /// # Errors
    /// Files of a stretch are unreadable, or the file system refuses an operation.
    pub fn write(
        &self,
        beginnings: &[StretchStart],
        last: &Summary,
    ) -> Result<Summary, RunDirectoryError> {
        self.note(beginnings)?;
        self.directory
            .replace(SWITCHES, |out| switches(beginnings, out))?;
        let end_ns = self.join(ENERGIES, beginnings, |column| COMMON.contains(&column))?;
        if self.stretch(0).join(OBSERVABLES).exists() {
            self.join(OBSERVABLES, beginnings, |column| !is_of_a_part(column))?;
        }
        for one in beginnings {
            // Left where a process was killed after it had written the results of the stretch.
            remove_if_there(&unfinished(&self.stretch(one.index).join(MANIFEST)))?;
        }
        let stretches = beginnings.iter().map(|one| self.stretch(one.index));
        let stretches = stretches.map(|path| RunDirectory::existing(path).summary());
        let stretches = stretches.collect::<Result<_, _>>()?;
        let summary = Summary::from_stretches(beginnings, stretches, last, end_ns);
        let directory = &self.directory;
        directory.replace(SUMMARY, |out| write_json(&summary, out))?;
        Ok(summary)
    }

    /// Concatenates a table of all stretches and appends the cumulative energy of the switches.
    ///
    /// `is_kept` selects columns by name. Returns the last time (ns).
    fn join(
        &self,
        name: &str,
        beginnings: &[StretchStart],
        is_kept: fn(&str) -> bool,
    ) -> Result<f64, RunDirectoryError> {
        let mut end_ns = 0.0;
        self.directory.replace(name, |out| {
            let mut writer = csv::Writer::from_writer(out);
            for beginning in beginnings {
                let path = self.stretch(beginning.index).join(name);
                let mut reader = csv::Reader::from_path(path)?;
                let header = reader.headers()?.clone();
                let fields = |row: &csv::StringRecord| -> Vec<String> {
                    let kept = header.iter().zip(row).filter(|(name, _)| is_kept(name));
                    kept.map(|(_, field)| field.to_owned()).collect()
                };
                if beginning.index == 0 {
                    let mut names = fields(&header);
                    names.push("switches_pn_nm".to_owned());
                    writer.write_record(names)?;
                }
                for row in reader.records() {
                    let row = row?;
                    end_ns = row[0].parse().map_err(io::Error::other)?;
                    let mut fields = fields(&row);
                    fields.push(format!("{:?}", beginning.switches_pn_nm));
                    writer.write_record(fields)?;
                }
            }
            writer.flush()
        })?;
        Ok(end_ns)
    }
}

/// Returns true for energies of sections and junctions, which other stretches do not have.
fn is_of_a_part(column: &str) -> bool {
    ["energy_section_", "energy_junction_"]
        .iter()
        .any(|part| column.starts_with(part))
}

/// Removes a run directory with the files listed in its manifest.
fn remove_run(path: &Path) -> Result<(), RunDirectoryError> {
    let io = || RunDirectoryError::io(path);
    let lock = RunDirectory::create_locked(path, true)?;
    // Fails if the folder contains files of the user, which are detected below.
    let _ = fs::remove_dir(path.join(PICTURES));
    for entry in fs::read_dir(path).map_err(io())? {
        let name = entry.map_err(io())?.file_name();
        if name != MANIFEST && name != LOCK {
            return Err(RunDirectoryError::NotEmpty(path.into()));
        }
    }
    drop(lock);
    fs::remove_dir_all(path).map_err(io())
}

fn switches(beginnings: &[StretchStart], out: &mut dyn Write) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    writer.write_record([
        "time_ns",
        "from_nm",
        "to_nm",
        "becomes",
        "energy_pn_nm",
        "momentum_change",
        "angular_momentum_change",
    ])?;
    for switch in beginnings.iter().filter_map(|one| one.switch.as_ref()) {
        let kinds = [("monomers", &switch.to_monomers), ("rod", &switch.to_rod)];
        for (becomes, spans) in kinds {
            for [from_nm, to_nm] in spans {
                writer.write_record([
                    format!("{:?}", switch.time_ns),
                    format!("{from_nm:?}"),
                    format!("{to_nm:?}"),
                    becomes.to_owned(),
                    format!("{:?}", switch.energy_pn_nm),
                    format!("{:?}", switch.momentum_change),
                    format!("{:?}", switch.angular_momentum_change),
                ])?;
            }
        }
    }
    writer.flush()
}
