//! Directory of a motion with adaptive sections: a chain of run directories and their common files.
//!
//! | file | contents |
//! |---|---|
//! | `scene.ron`, `summary.json` | scene; last record, with switches under `following` |
//! | `stretches/NNNN/` | run directory of each stretch between two switches, with explicit sections |
//! | `stretches.json` | start of each stretch |
//! | `switches.csv` | time, position and changes of energy and momentum of each switch |
//! | `energies.csv`, `observables.csv` | tables of all stretches, concatenated |
//!
//! Each switch has two records at the same time, before and after it.

use super::atomic;
use super::directory::RunDirectory;
use super::lock::LOCK;
use super::manifest::Manifest;
use super::names::{ENERGIES, MANIFEST, OBSERVABLES, PICTURES, STRETCHES, SUMMARY, SWITCHES};
use super::{RunDirectoryError, Summary};
use crate::assembly::worst_of;
use crate::follow::StretchStart;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

const FOLDER: &str = "stretches";

/// Columns of `energies.csv` that do not depend on the resolution.
const COMMON: [&str; 7] = [
    "time_ns",
    "total_pn_nm",
    "potential_pn_nm",
    "elastic_pn_nm",
    "kinetic_pn_nm",
    "residual_force_pn",
    "residual_torque_pn_nm",
];

/// Optional columns for energy supplied from outside.
const BOOKED: [&str; 3] = ["work_pn_nm", "heat_pn_nm", "events_pn_nm"];

/// Effect of all switches of cells during a motion.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FollowingSummary {
    /// Number of switches; one switch may change several cells.
    pub switches: usize,
    /// Total energy added by switches (pN nm).
    pub switches_pn_nm: f64,
    /// Largest momentum change of a switch (ag nm/ns), due to round-off.
    pub largest_momentum_change: f64,
    /// Fraction of cells resolved by monomers, averaged over time.
    pub share_of_monomers: f64,
}

/// Directory of a chain of stretches.
#[derive(Clone, Debug)]
pub struct FollowedDirectory {
    path: PathBuf,
}

impl FollowedDirectory {
    /// Opens the directory at `path`, which is also a [`RunDirectory`].
    pub fn new(path: impl Into<PathBuf>) -> Self {
        Self { path: path.into() }
    }

    /// Returns true if `path` contains a list of stretches.
    pub fn exists_at(path: &Path) -> bool {
        path.join(STRETCHES).is_file()
    }

    /// Path of the directory.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Path of a stretch.
    pub fn stretch(&self, index: usize) -> PathBuf {
        self.path.join(FOLDER).join(format!("{index:04}"))
    }

    /// Returns the starts of all stretches; empty without stretches.
    ///
    /// # Errors
    /// The file is unreadable or not a list of stretches.
    pub fn beginnings(&self) -> Result<Vec<StretchStart>, RunDirectoryError> {
        if !Self::exists_at(&self.path) {
            return Ok(Vec::new());
        }
        let path = self.path.join(STRETCHES);
        let read = fs::read_to_string(&path).and_then(|text| Ok(serde_json::from_str(&text)?));
        read.map_err(RunDirectoryError::io(&path))
    }

    /// Writes the starts of all stretches.
    ///
    /// # Errors
    /// A refusal of the file system.
    pub fn note(&self, beginnings: &[StretchStart]) -> Result<(), RunDirectoryError> {
        self.replace(STRETCHES, |out| Ok(serde_json::to_writer(out, beginnings)?))
    }

    /// Removes the run directories of stretch `first` and all later ones, in descending order.
    ///
    /// # Errors
    /// A directory contains files that no run has written, or the file system refuses an operation.
    pub fn remove_from(&self, first: usize) -> Result<(), RunDirectoryError> {
        let folder = self.path.join(FOLDER);
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
        self.replace(SWITCHES, |out| switches(beginnings, out))?;
        let spans = self.join(ENERGIES, beginnings, &|header| {
            let common = COMMON.iter().map(|name| column(header, name));
            let booked = BOOKED.iter().filter_map(|name| column(header, name).ok());
            common.chain(booked.map(Ok)).collect()
        })?;
        let observed = self.stretch(0).join(OBSERVABLES);
        if observed.exists() {
            self.join(OBSERVABLES, beginnings, &|header| {
                Ok((0..header.len()).collect())
            })?;
        }
        let summary = Summary {
            following: Some(summarised(beginnings, &spans)),
            observables: BTreeMap::new(),
            thermal: None,
            ..self.with_remarks(beginnings, last)?
        };
        self.replace(SUMMARY, |out| {
            Ok(serde_json::to_writer_pretty(out, &summary)?)
        })?;
        Ok(summary)
    }

    /// Summary of the last stretch with the notes and the worst values of all stretches.
    fn with_remarks(
        &self,
        beginnings: &[StretchStart],
        last: &Summary,
    ) -> Result<Summary, RunDirectoryError> {
        let mut all = last.clone();
        for beginning in beginnings {
            let one = RunDirectory::existing(self.stretch(beginning.index)).summary()?;
            let notes = one.coded_notes();
            all.beyond_use.extend(one.beyond_use);
            all.unstable_twist.extend(one.unstable_twist);
            for beyond in one.beyond_range {
                let mut known = all.beyond_range.iter_mut();
                match known.find(|known| known.quantity == beyond.quantity) {
                    Some(known) if known.value.abs() >= beyond.value.abs() => {}
                    Some(known) => *known = beyond,
                    None => all.beyond_range.push(beyond),
                }
            }
            for note in notes {
                if !all.notes.iter().any(|text| is_alike(text, &note.message)) {
                    all.add_note(note);
                }
            }
        }
        all.beyond_use = worst_of(std::mem::take(&mut all.beyond_use));
        all.unstable_twist
            .sort_by(|a, b| b.compression_pn.total_cmp(&a.compression_pn));
        all.unstable_twist.truncate(1);
        if !last.observables.is_empty() || last.thermal.is_some() {
            let note =
                "means over records are available per stretch only, in stretches/*/summary.json";
            all.notes.push(note.to_owned());
        }
        Ok(all.with_derived_warnings())
    }

    /// Concatenates a table of all stretches and appends the cumulative energy of the switches.
    ///
    /// `of` selects columns by the header. Returns the first and last time of each stretch (ns).
    fn join(
        &self,
        name: &str,
        beginnings: &[StretchStart],
        of: &dyn Fn(&csv::StringRecord) -> io::Result<Vec<usize>>,
    ) -> Result<Vec<[f64; 2]>, RunDirectoryError> {
        let mut spans = Vec::new();
        self.replace(name, |out| {
            let mut writer = csv::Writer::from_writer(out);
            for beginning in beginnings {
                let path = self.stretch(beginning.index).join(name);
                let mut reader = csv::Reader::from_path(path)?;
                let header = reader.headers()?.clone();
                let columns = of(&header)?;
                let fields = |row: &csv::StringRecord| -> Vec<String> {
                    columns.iter().map(|&i| row[i].to_owned()).collect()
                };
                if beginning.index == 0 {
                    let mut names = fields(&header);
                    names.push("switches_pn_nm".to_owned());
                    writer.write_record(names)?;
                }
                let mut times = Vec::new();
                for row in reader.records() {
                    let row = row?;
                    times.push(row[0].parse().map_err(io::Error::other)?);
                    let mut fields = fields(&row);
                    fields.push(format!("{:?}", beginning.switches_pn_nm));
                    writer.write_record(fields)?;
                }
                let ends = [times.first(), times.last()];
                spans.push(ends.map(|time| time.copied().unwrap_or_default()));
            }
            writer.flush()
        })?;
        Ok(spans)
    }

    fn replace(
        &self,
        name: &str,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), RunDirectoryError> {
        let mut manifest = Manifest::read(&self.path)?.unwrap_or_else(Manifest::new);
        manifest.ensure_own(&self.path)?;
        manifest.add([name]);
        manifest.write(&self.path)?;
        let path = self.path.join(name);
        let written = atomic::replace_durably(&path, |out| write(out));
        written.map_err(RunDirectoryError::io(&path))
    }
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
            return Err(RunDirectoryError::NotEmpty { path: path.into() });
        }
    }
    drop(lock);
    fs::remove_dir_all(path).map_err(io())
}

fn is_alike(one: &str, other: &str) -> bool {
    let words = |note: &str| -> String { note.chars().filter(|c| !c.is_ascii_digit()).collect() };
    words(one) == words(other)
}

fn column(header: &csv::StringRecord, name: &str) -> io::Result<usize> {
    let place = header.iter().position(|column| column == name);
    place.ok_or_else(|| io::Error::other(format!("no column {name}")))
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

fn summarised(beginnings: &[StretchStart], spans_ns: &[[f64; 2]]) -> FollowingSummary {
    let switches = || beginnings.iter().filter_map(|one| one.switch.as_ref());
    let end = spans_ns.last().map_or(0.0, |span| span[1]);
    let starts = beginnings.iter().map(|one| {
        let switch = one.switch.as_ref();
        switch.map_or(0.0, |switch| switch.time_ns)
    });
    let ends = starts.clone().skip(1).chain([end]);
    let weighted = beginnings
        .iter()
        .zip(starts.zip(ends))
        .map(|(one, (from, to))| {
            let monomers = one.is_monomers.iter().filter(|resolved| **resolved).count();
            (to - from) * monomers as f64 / one.is_monomers.len() as f64
        });
    FollowingSummary {
        switches: switches().count(),
        switches_pn_nm: beginnings.last().map_or(0.0, |one| one.switches_pn_nm),
        largest_momentum_change: switches().fold(0.0, |most, s| most.max(s.momentum_change)),
        share_of_monomers: if end > 0.0 {
            weighted.sum::<f64>() / end
        } else {
            0.0
        },
    }
}
