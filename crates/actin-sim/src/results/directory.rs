//! The directory itself: refusing to overwrite, and never leaving half a file. It does not know
//! what its files hold.

use super::RunDirectoryError;
use super::lock::{LOCK, RunLock, refuse_in_use};
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

pub(super) const SCENE: &str = "scene.ron";
pub(super) const SUMMARY: &str = "summary.json";
pub(super) const ENERGIES: &str = "energies.csv";
pub(super) const PROFILE: &str = "profile.csv";
pub(super) const STATES: &str = "states.npz";
pub(super) const COLLECTION: &str = "run.pvd";
pub(super) const CHECKPOINT: &str = "checkpoint.bin";
pub(super) const RECORDS: &str = "records.bin";
pub(super) const PICTURES: &str = "vtk";

/// Everything that a run directory holds beside its pictures.
const FILES: [&str; 8] = [
    SCENE, SUMMARY, ENERGIES, PROFILE, STATES, COLLECTION, CHECKPOINT, RECORDS,
];

/// Appended to the name of a file that is not whole yet.
const UNFINISHED: &str = ".part";

/// A directory that holds the results of one run.
///
/// Each file is written under another name and renamed when it is whole, so that a run that is
/// interrupted, or a disk that is full, leaves no half file under a final name. (Only checkpoints
/// are guarded against a loss of power.) `summary.json` comes last: where it is, the rest is complete.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RunDirectory {
    pub(super) path: PathBuf,
}

impl RunDirectory {
    /// Creates the directory, and those above it, if need be.
    ///
    /// With `overwrite`, an earlier run's files are removed at once, so that results of two runs
    /// never stand side by side; files that no run writes are left alone.
    ///
    /// # Errors
    /// A path that is no directory, a directory in which another run goes on or that is not empty
    /// (unless `overwrite`), or a refusal of the file system.
    pub fn create(path: impl AsRef<Path>, overwrite: bool) -> Result<Self, RunDirectoryError> {
        Self::create_locked(path, overwrite).map(|(directory, _)| directory)
    }

    /// The same, with what keeps other runs out of it.
    ///
    /// # Errors
    /// As [`create`](Self::create).
    pub fn create_locked(
        path: impl AsRef<Path>,
        overwrite: bool,
    ) -> Result<(Self, RunLock), RunDirectoryError> {
        let path = path.as_ref().to_owned();
        if path.exists() && !path.is_dir() {
            return Err(RunDirectoryError::NotADirectory { path });
        }
        fs::create_dir_all(&path).map_err(RunDirectoryError::io(&path))?;
        if !overwrite && !is_empty(&path)? {
            // Without a lock, for which one may have to be allowed to write.
            refuse_in_use(&path)?;
            return Err(RunDirectoryError::NotEmpty { path });
        }
        let lock = RunLock::take(&path)?;
        if !overwrite && !is_empty(&path)? {
            // Another run has been there in between.
            return Err(RunDirectoryError::NotEmpty { path });
        }
        let directory = Self { path };
        directory.remove_results()?;
        Ok((directory, lock))
    }

    /// Where the directory is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Writes the file `name` under another name and renames it when it is whole.
    pub(super) fn write_file(
        &self,
        name: &str,
        fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
    ) -> Result<(), RunDirectoryError> {
        let path = self.path.join(name);
        let unfinished = unfinished(&path);
        let written = File::create(&unfinished)
            .map(BufWriter::new)
            .and_then(|mut out| {
                fill(&mut out)?;
                out.flush()
            })
            .and_then(|()| fs::rename(&unfinished, &path));
        if written.is_err() {
            // The error that led here says more than one about the removal could.
            let _ = fs::remove_file(&unfinished);
        }
        written.map_err(RunDirectoryError::io(&path))
    }

    /// Removes what an earlier run has left.
    fn remove_results(&self) -> Result<(), RunDirectoryError> {
        for name in FILES {
            remove_if_there(&self.path.join(name))?;
            remove_if_there(&self.path.join(format!("{name}{UNFINISHED}")))?;
        }
        self.remove_pictures()
    }

    pub(super) fn remove_pictures(&self) -> Result<(), RunDirectoryError> {
        let folder = self.path.join(PICTURES);
        if !folder.is_dir() {
            return Ok(());
        }
        for entry in fs::read_dir(&folder).map_err(RunDirectoryError::io(&folder))? {
            let entry = entry.map_err(RunDirectoryError::io(&folder))?;
            if entry.file_name().to_str().is_some_and(is_picture) {
                remove_if_there(&entry.path())?;
            }
        }
        Ok(())
    }
}

/// Whether there is nothing in a directory but its lock.
fn is_empty(directory: &Path) -> Result<bool, RunDirectoryError> {
    let io = || RunDirectoryError::io(directory);
    for entry in fs::read_dir(directory).map_err(io())? {
        if entry.map_err(io())?.file_name() != LOCK {
            return Ok(false);
        }
    }
    Ok(true)
}

/// The name under which a file is written until it is whole.
pub(super) fn unfinished(path: &Path) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(UNFINISHED);
    name.into()
}

/// Removes a file that need not exist.
pub(super) fn remove_if_there(path: &Path) -> Result<(), RunDirectoryError> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => {
            Err(RunDirectoryError::io(path)(error))
        }
        _ => Ok(()),
    }
}

/// Whether a file of this name is a picture that a run writes, whole or not.
fn is_picture(name: &str) -> bool {
    let name = name.strip_suffix(UNFINISHED).unwrap_or(name);
    name.strip_suffix(".vtp")
        .is_some_and(|stem| stem.len() >= 4 && stem.bytes().all(|b| b.is_ascii_digit()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(path: &Path) -> Vec<String> {
        let entries = fs::read_dir(path).unwrap();
        let mut names: Vec<_> = entries
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn a_new_or_empty_directory_is_taken() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("runs/one");
        assert_eq!(RunDirectory::create(&path, false).unwrap().path(), path);
        assert!(RunDirectory::create(&path, false).is_ok());
    }

    /// The message names the directory and what to do; nothing in it is touched.
    #[test]
    fn a_directory_with_anything_in_it_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join(SUMMARY), "{}").unwrap();
        let error = RunDirectory::create(folder.path(), false).unwrap_err();
        assert!(matches!(error, RunDirectoryError::NotEmpty { .. }));
        let message = error.to_string();
        assert!(message.contains(&folder.path().display().to_string()));
        assert!(message.contains("never overwritten"));
        assert_eq!(fs::read(folder.path().join(SUMMARY)).unwrap(), b"{}");
    }

    /// That it is not empty is said before anything is locked, for which one may have to be allowed to
    /// write: here a lock can never be had. One in which a run goes on is in use, with whatever in it.
    #[test]
    fn what_is_not_empty_needs_no_lock() {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join(LOCK)).unwrap();
        let refusal = || RunDirectory::create(folder.path(), false).unwrap_err();
        assert!(matches!(refusal(), RunDirectoryError::Io { .. }));
        fs::write(folder.path().join("notes.txt"), "mine").unwrap();
        assert!(matches!(refusal(), RunDirectoryError::NotEmpty { .. }));
        fs::remove_dir(folder.path().join(LOCK)).unwrap();
        let lock = RunLock::take(folder.path()).unwrap();
        assert!(matches!(refusal(), RunDirectoryError::InUse { .. }));
        drop(lock);
        assert!(matches!(refusal(), RunDirectoryError::NotEmpty { .. }));
        assert_eq!(names(folder.path()), ["notes.txt"]);
    }

    /// Whatever a file is called, if no run has written it, it counts and stays.
    #[test]
    fn a_file_named_lock_is_not_the_lock() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("lock");
        fs::write(&path, "mine").unwrap();
        let error = RunDirectory::create(folder.path(), false).unwrap_err();
        assert!(matches!(error, RunDirectoryError::NotEmpty { .. }));
        assert!(RunDirectory::create(folder.path(), true).is_ok());
        assert_eq!(fs::read(&path).unwrap(), b"mine");
    }

    #[test]
    fn a_file_is_no_directory() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("file");
        fs::write(&path, "text").unwrap();
        for overwrite in [false, true] {
            let error = RunDirectory::create(&path, overwrite).unwrap_err();
            assert!(matches!(error, RunDirectoryError::NotADirectory { .. }));
        }
        assert_eq!(fs::read(&path).unwrap(), b"text");
    }

    /// Overwriting takes away what a run has written, and nothing else.
    #[test]
    fn overwriting_leaves_foreign_files_alone() {
        let folder = tempfile::tempdir().unwrap();
        let pictures = folder.path().join(PICTURES);
        fs::create_dir(&pictures).unwrap();
        for name in FILES {
            fs::write(folder.path().join(name), "old").unwrap();
        }
        fs::write(folder.path().join("states.npz.part"), "old").unwrap();
        fs::write(folder.path().join("notes.txt"), "mine").unwrap();
        for name in [
            "0000.vtp",
            "12345.vtp",
            "0001.vtp.part",
            "mine.vtp",
            "12.vtp",
        ] {
            fs::write(pictures.join(name), "old").unwrap();
        }
        RunDirectory::create(folder.path(), true).unwrap();
        assert_eq!(names(folder.path()), ["notes.txt", PICTURES]);
        assert_eq!(names(&pictures), ["12.vtp", "mine.vtp"]);
    }

    /// What was there before stays whole, and the unfinished file is gone.
    #[test]
    fn a_file_that_fails_half_way_is_not_seen() {
        let folder = tempfile::tempdir().unwrap();
        let directory = RunDirectory::create(folder.path(), false).unwrap();
        directory
            .write_file(ENERGIES, |out| out.write_all(b"whole"))
            .unwrap();
        let error = directory
            .write_file(ENERGIES, |out| {
                out.write_all(b"half")?;
                Err(io::Error::other("no space left"))
            })
            .unwrap_err();
        let path = folder.path().join(ENERGIES);
        assert_eq!(
            error.to_string(),
            format!("{}: no space left", path.display())
        );
        assert_eq!(fs::read(path).unwrap(), b"whole");
        assert_eq!(names(folder.path()), [ENERGIES]);
    }
}
