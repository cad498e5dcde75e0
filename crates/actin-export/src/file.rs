//! Output files and their formats.

use crate::{ExportError, simularium_meshes, write_gsd, write_simularium};
use actin_rundir::{FinishedRun, replace_file};
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// File format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// GSD with the schema of HOOMD: OVITO, `MDAnalysis`, HOOMD-blue, freud.
    Gsd,
    /// JSON of the Simularium viewer.
    Simularium,
}

impl Format {
    /// Returns the file name extension.
    pub(crate) fn extension(self) -> &'static str {
        match self {
            Self::Gsd => "gsd",
            Self::Simularium => "simularium",
        }
    }

    /// Returns the default file for a run directory: `runs/bent.gsd` for `runs/bent`.
    ///
    /// The file is outside the directory, since a new run replaces the directory.
    pub fn default_path(self, directory: &Path) -> PathBuf {
        let directory: PathBuf = directory.components().collect();
        let mut name = directory.into_os_string();
        name.push(".");
        name.push(self.extension());
        name.into()
    }
}

/// Exports a run to a file and returns the written files. [`Format::Simularium`] also writes meshes next to the file.
///
/// Files are written completely or not at all.
///
/// # Errors
/// If a file exists and `overwrite` is false, the states cannot be read, or the file cannot be written.
pub fn export(
    run: &FinishedRun,
    format: Format,
    path: &Path,
    overwrite: bool,
) -> Result<Vec<PathBuf>, ExportError> {
    let prefix = path.file_stem().unwrap_or_default().to_string_lossy();
    let meshes = match format {
        Format::Gsd => Vec::new(),
        Format::Simularium => simularium_meshes(run, &prefix),
    };
    let mut files = vec![path.to_owned()];
    files.extend(meshes.iter().map(|(name, _)| path.with_file_name(name)));
    for file in &files {
        ensure_free(file, overwrite)?;
    }
    for (file, (_, text)) in files[1..].iter().zip(&meshes) {
        write(file, |out| Ok(out.write_all(text.as_bytes())?))?;
    }
    write(path, |out| match format {
        Format::Gsd => write_gsd(run, out),
        Format::Simularium => write_simularium(run, &prefix, out),
    })?;
    Ok(files)
}

fn ensure_free(path: &Path, overwrite: bool) -> Result<(), ExportError> {
    if path.is_dir() {
        return Err(ExportError::IsDirectory { path: path.into() });
    }
    if !overwrite && fs::symlink_metadata(path).is_ok() {
        return Err(ExportError::Exists { path: path.into() });
    }
    Ok(())
}

fn write(
    path: &Path,
    fill: impl FnOnce(&mut BufWriter<File>) -> Result<(), ExportError>,
) -> Result<(), ExportError> {
    let mut unfinished = path.as_os_str().to_owned();
    unfinished.push(format!(".{}.part", std::process::id()));
    // Errors of the run are returned unchanged, errors of the file with its path.
    let mut of_run = None;
    let written = replace_file(path, Path::new(&unfinished), |out| {
        fill(out).map_err(|error| match error {
            ExportError::Output(source) => source,
            other => {
                of_run = Some(other);
                io::ErrorKind::InvalidInput.into()
            }
        })
    });
    match (written, of_run) {
        (Err(_), Some(error)) => Err(error),
        (written, _) => written.map_err(ExportError::io(path)),
    }
}
