//! Export of finished runs to files of other programs.

use crate::{FinishedRun, RunDirectoryError, replace_file};
use actin_export::{Format, RecordedStates, StateStream};
use actin_sim::At;
use std::borrow::Cow;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Exports a run to a file and returns the written files: the file and its meshes.
///
/// Files are written completely or not at all. The run directory is not changed.
///
/// # Errors
/// If a file exists and `overwrite` is false, the states cannot be read, or a file cannot be
/// written.
pub fn export(
    run: &FinishedRun,
    format: Format,
    path: &Path,
    overwrite: bool,
) -> Result<Vec<PathBuf>, RunDirectoryError> {
    let prefix = path.file_stem().unwrap_or_default().to_string_lossy();
    let meshes = format.meshes(run.assembly(), &prefix);
    let names = meshes.iter().map(|(name, _)| path.with_file_name(name));
    let files: Vec<_> = std::iter::once(path.to_owned()).chain(names).collect();
    for file in &files {
        ensure_free(file, overwrite)?;
    }
    for (file, (_, text)) in files[1..].iter().zip(&meshes) {
        write(file, |out| out.write_all(text.as_bytes()))?;
    }
    write(path, |out| format.write(run.assembly(), run, &prefix, out))?;
    Ok(files)
}

/// Returns the default file of an export: `runs/bent.gsd` for `runs/bent`.
///
/// The file is outside the directory, since a new run replaces the directory.
pub fn default_export_path(directory: &Path, format: Format) -> PathBuf {
    let directory: PathBuf = directory.components().collect();
    let mut name = directory.into_os_string();
    name.push(".");
    name.push(format.extension());
    name.into()
}

impl RecordedStates for FinishedRun {
    fn at(&self) -> Vec<At> {
        self.at().to_vec()
    }

    fn states(&self) -> StateStream<'_> {
        match self.states() {
            Ok(states) => Box::new(states.map(|one| one.map(Cow::Owned).map_err(io::Error::other))),
            Err(error) => Box::new(std::iter::once(Err(io::Error::other(error)))),
        }
    }
}

fn ensure_free(path: &Path, overwrite: bool) -> Result<(), RunDirectoryError> {
    if path.is_dir() {
        return Err(RunDirectoryError::IsDirectory(path.into()));
    }
    if !overwrite && fs::symlink_metadata(path).is_ok() {
        return Err(RunDirectoryError::Exists(path.into()));
    }
    Ok(())
}

fn write(
    path: &Path,
    fill: impl FnOnce(&mut io::BufWriter<fs::File>) -> io::Result<()>,
) -> Result<(), RunDirectoryError> {
    let mut unfinished = path.as_os_str().to_owned();
    unfinished.push(format!(".{}.part", std::process::id()));
    let written = replace_file(path, Path::new(&unfinished), fill);
    // Errors of the run are returned unchanged, errors of the file with its path.
    written.map_err(|error| match RunDirectoryError::io(path)(error) {
        RunDirectoryError::Io { path, source } => RunDirectoryError::Export { path, source },
        error => error,
    })
}
