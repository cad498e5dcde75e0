//! Creation, overwriting and reopening of run directories.

use crate::RunDirectoryError;
use crate::atomic::UNFINISHED;
use crate::lock::{LOCK, RunLock, refuse_in_use};
use crate::manifest::Manifest;
use crate::names::{BEFORE_RESULTS, CHECKPOINT, MANIFEST, SUMMARY};
use std::fs;
use std::path::{Path, PathBuf};

/// A directory that holds the results of one run.
///
/// Results are written under temporary names. They are renamed after all of them are complete and
/// on the disk, so an interrupted run or a full disk leaves no partial results. `summary.json` is
/// renamed last: if it exists, all other results are complete.
///
/// The manifest `actin-run.json` lists the files of the run. Only listed files are replaced or
/// removed, and links are not followed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RunDirectory {
    pub(crate) path: PathBuf,
}

impl RunDirectory {
    /// Creates the directory and its parents if they do not exist.
    ///
    /// With `overwrite`, the files listed in the manifest of an earlier run are removed; all other
    /// files stay.
    ///
    /// # Errors
    /// - The path is not a directory, or another run is using it.
    /// - The directory is not empty and `overwrite` is false.
    /// - With `overwrite`: the directory has no manifest or is a link, an unlisted file has the name
    ///   of a result, or a text (`scene.ron`, a table) was changed after the run.
    /// - The file system refuses an operation.
    ///
    /// Files are removed after all checks.
    pub fn create(path: impl AsRef<Path>, overwrite: bool) -> Result<Self, RunDirectoryError> {
        Self::create_locked(path, overwrite).map(|(directory, _)| directory)
    }

    /// Creates the directory like [`create`](Self::create) and returns it with its lock.
    ///
    /// # Errors
    /// As [`create`](Self::create).
    pub fn create_locked(
        path: impl AsRef<Path>,
        overwrite: bool,
    ) -> Result<(Self, RunLock), RunDirectoryError> {
        let path = path.as_ref().to_owned();
        if fs::symlink_metadata(&path).is_ok() && !path.is_dir() {
            return Err(RunDirectoryError::NotADirectory(path));
        }
        fs::create_dir_all(&path).map_err(RunDirectoryError::io(&path))?;
        let directory = Self { path };
        // Checked before locking, which may require write permission.
        if !is_empty(&directory.path)? {
            refuse_in_use(&directory.path)?;
        }
        directory.earlier_run(overwrite)?;
        let lock = RunLock::acquire(&directory.path)?;
        // Checked again: another run may have written files before the lock was taken.
        if let Some(earlier) = directory.earlier_run(overwrite)? {
            earlier.remove_files(&directory.path)?;
        }
        let mut manifest = Manifest::new();
        manifest.add(BEFORE_RESULTS);
        manifest.write(&directory.path)?;
        Ok((directory, lock))
    }

    /// Path of the directory.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Returns true if a run ended here without results and without a checkpoint.
    pub fn is_unfinished(&self) -> bool {
        let is_there = |name| self.path.join(name).exists();
        is_there(MANIFEST) && !is_there(SUMMARY) && !is_there(CHECKPOINT)
    }

    /// Returns true if `file` lies in the directory, at any depth. Links are followed.
    pub fn holds(&self, file: impl AsRef<Path>) -> bool {
        let [file, folder] = [file.as_ref(), &self.path].map(fs::canonicalize);
        matches!((file, folder), (Ok(file), Ok(folder)) if file.starts_with(&folder))
    }

    /// Prepares the directory of an interrupted run for resuming, after its checkpoint was read.
    ///
    /// If the manifest is missing, a new one lists all files that have names of results.
    ///
    /// # Errors
    /// An unlisted file or link under the name of a result, a text that was changed after the run
    /// wrote it, or a refusal of the file system.
    pub(crate) fn reopen(&self) -> Result<(), RunDirectoryError> {
        let listed = Manifest::read(&self.path)?;
        let mut manifest = listed.map_or_else(|| Manifest::of_all_in(&self.path), Ok)?;
        manifest.add(BEFORE_RESULTS);
        manifest.ensure_own(&self.path)?;
        manifest.ensure_unchanged(&self.path)?;
        manifest.write(&self.path)
    }

    /// Manifest of an earlier run whose files may be removed; `None` if the directory is empty.
    fn earlier_run(&self, overwrite: bool) -> Result<Option<Manifest>, RunDirectoryError> {
        let path = &self.path;
        let manifest = Manifest::read(path);
        if is_empty(path)? {
            return manifest.map(|_| None);
        }
        if !overwrite {
            return Err(RunDirectoryError::NotEmpty(path.clone()));
        }
        refuse_link(path)?;
        let Some(manifest) = manifest? else {
            return Err(RunDirectoryError::NoManifest(path.clone()));
        };
        manifest.ensure_own(path)?;
        manifest.ensure_unchanged(path)?;
        Ok(Some(manifest))
    }
}

fn is_empty(directory: &Path) -> Result<bool, RunDirectoryError> {
    let io = || RunDirectoryError::io(directory);
    let unfinished = format!("{MANIFEST}{UNFINISHED}");
    for entry in fs::read_dir(directory).map_err(io())? {
        let name = entry.map_err(io())?.file_name();
        if name != LOCK && name != MANIFEST && name != unfinished.as_str() {
            return Ok(false);
        }
    }
    Ok(true)
}

fn refuse_link(path: &Path) -> Result<(), RunDirectoryError> {
    // Drops a trailing slash, which would make `read_link` follow the link.
    let path: PathBuf = path.components().collect();
    match fs::read_link(&path) {
        Ok(target) => Err(RunDirectoryError::Link { path, target }),
        Err(_) => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::{contents, names};
    use crate::manifest::remove_if_there;
    use crate::names::{
        CHECKPOINT, ENERGIES, FILES, PICTURES, PROFILE, RECORDS, SCENE, SUMMARY, picture_name,
    };

    #[test]
    fn new_or_empty_directory_is_accepted() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("runs/one");
        assert_eq!(RunDirectory::create(&path, false).unwrap().path(), path);
        assert!(RunDirectory::create(&path, false).is_ok());
    }

    /// A nonempty directory is refused before the lock is taken; locking is made impossible here.
    #[test]
    fn nonempty_directory_is_refused_before_locking() {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join(LOCK)).unwrap();
        let refusal = || RunDirectory::create(folder.path(), false).unwrap_err();
        assert!(matches!(refusal(), RunDirectoryError::ForeignLock(_)));
        fs::write(folder.path().join("notes.txt"), "mine").unwrap();
        assert!(matches!(refusal(), RunDirectoryError::NotEmpty(_)));
        fs::remove_dir(folder.path().join(LOCK)).unwrap();
        let lock = RunLock::acquire(folder.path()).unwrap();
        for overwrite in [false, true] {
            let error = RunDirectory::create(folder.path(), overwrite).unwrap_err();
            assert!(matches!(error, RunDirectoryError::InUse { .. }), "{error}");
        }
        drop(lock);
        assert!(matches!(refusal(), RunDirectoryError::NotEmpty(_)));
        assert_eq!(names(folder.path()), [LOCK, "notes.txt"]);
    }

    #[test]
    fn file_in_place_of_the_directory_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("file");
        fs::write(&path, "text").unwrap();
        for overwrite in [false, true] {
            let error = RunDirectory::create(&path, overwrite).unwrap_err();
            assert!(matches!(error, RunDirectoryError::NotADirectory(_)));
        }
        assert_eq!(fs::read(&path).unwrap(), b"text");
    }

    fn earlier_run(folder: &Path) {
        fs::create_dir(folder.join(PICTURES)).unwrap();
        let mut manifest = Manifest::new();
        manifest.add(FILES);
        manifest.add([0, 1, 12345].map(picture_name));
        manifest.note_scene("old");
        manifest.write(folder).unwrap();
        let written = [SCENE, SUMMARY, ENERGIES, RECORDS, "states.npz.part"];
        let pictures = ["vtk/0000.vtp", "vtk/12345.vtp", "vtk/0001.vtp.part"];
        for name in written.iter().chain(&pictures) {
            fs::write(folder.join(name), "old").unwrap();
        }
        for name in ["notes.txt", "vtk/mine.vtp", "vtk/12.vtp"] {
            fs::write(folder.join(name), "mine").unwrap();
        }
    }

    /// Error of overwriting an earlier run modified by `spoil`; checks that no file changes.
    fn refusal(spoil: impl FnOnce(&Path)) -> String {
        let folder = tempfile::tempdir().unwrap();
        earlier_run(folder.path());
        spoil(folder.path());
        let before = contents(folder.path());
        let error = RunDirectory::create(folder.path(), true).unwrap_err();
        assert_eq!(before, contents(folder.path()), "{error}");
        error.to_string()
    }

    #[test]
    fn overwriting_removes_listed_files_only() {
        let folder = tempfile::tempdir().unwrap();
        earlier_run(folder.path());
        let error = RunDirectory::create(folder.path(), false).unwrap_err();
        assert!(matches!(error, RunDirectoryError::NotEmpty(_)));
        assert!(error.to_string().contains("never overwritten"), "{error}");
        RunDirectory::create(folder.path(), true).unwrap();
        let left = [LOCK, MANIFEST, "notes.txt", PICTURES];
        assert_eq!(names(folder.path()), left);
        let pictures = names(&folder.path().join(PICTURES));
        assert_eq!(pictures, ["12.vtp", "mine.vtp"]);
        let manifest = Manifest::read(folder.path()).unwrap().unwrap();
        assert!(manifest.names().eq([CHECKPOINT, RECORDS, SCENE]));
    }

    /// Simulates a kill after each possible number of removals.
    #[test]
    fn interrupted_overwriting_can_be_repeated() {
        for removed in 0..=FILES.len() {
            let folder = tempfile::tempdir().unwrap();
            earlier_run(folder.path());
            for name in &FILES[..removed] {
                remove_if_there(&folder.path().join(name)).unwrap();
            }
            RunDirectory::create(folder.path(), true).unwrap();
            let left = [LOCK, MANIFEST, "notes.txt", PICTURES];
            assert_eq!(names(folder.path()), left);
        }
        // Killed before the manifest was complete.
        let folder = tempfile::tempdir().unwrap();
        for name in [LOCK, "actin-run.json.part"] {
            fs::write(folder.path().join(name), "").unwrap();
        }
        RunDirectory::create(folder.path(), false).unwrap();
        RunDirectory::create(folder.path(), false).unwrap();
    }

    #[test]
    fn unlisted_files_are_not_overwritten() {
        let without = refusal(|folder| fs::remove_file(folder.join(MANIFEST)).unwrap());
        assert!(without.contains(MANIFEST), "{without}");
        let foreign = refusal(|folder| fs::write(folder.join(MANIFEST), "{}").unwrap());
        assert!(
            foreign.contains("actin-run.json is not the list"),
            "{foreign}"
        );
        for name in ["vtk/0002.vtp", "vtk/0002.vtp.part", "Profile.csv"] {
            let unlisted = refusal(|folder| fs::write(folder.join(name), "").unwrap());
            let expected = format!("{name} was not written");
            assert!(unlisted.contains(&expected), "{unlisted}");
        }
        let folder = refusal(|folder| fs::create_dir(folder.join(PROFILE)).unwrap());
        assert!(folder.contains("profile.csv was not written"), "{folder}");
    }

    #[cfg(unix)]
    #[test]
    fn links_are_not_followed() {
        use std::os::unix::fs::symlink;
        let elsewhere = tempfile::tempdir().unwrap();
        earlier_run(elsewhere.path());
        let before = names(&elsewhere.path().join(PICTURES));
        let pictures = refusal(|folder| {
            fs::remove_dir_all(folder.join(PICTURES)).unwrap();
            symlink(elsewhere.path().join(PICTURES), folder.join(PICTURES)).unwrap();
        });
        assert!(pictures.contains("vtk was not written"), "{pictures}");
        let file = refusal(|folder| {
            fs::remove_file(folder.join(ENERGIES)).unwrap();
            symlink(elsewhere.path().join(ENERGIES), folder.join(ENERGIES)).unwrap();
        });
        assert!(file.contains("energies.csv was not written"), "{file}");
        let folder = tempfile::tempdir().unwrap();
        let link = folder.path().join("latest");
        symlink(elsewhere.path(), &link).unwrap();
        for path in [link.clone(), link.join(""), link.join(".")] {
            let error = RunDirectory::create(&path, true).unwrap_err();
            assert!(matches!(error, RunDirectoryError::Link { .. }), "{error}");
        }
        assert_eq!(names(&elsewhere.path().join(PICTURES)), before);
        fs::remove_file(&link).unwrap();
        symlink("nowhere", &link).unwrap();
        let error = RunDirectory::create(&link, true).unwrap_err();
        assert!(matches!(error, RunDirectoryError::NotADirectory(_)));
    }

    /// An old run without a manifest gets one.
    #[test]
    fn reopening_requires_files_of_the_run() {
        let folder = tempfile::tempdir().unwrap();
        earlier_run(folder.path());
        let directory = RunDirectory::existing(folder.path());
        directory.reopen().unwrap();
        fs::write(folder.path().join("vtk/0003.vtp"), "mine").unwrap();
        let message = directory.reopen().unwrap_err().to_string();
        assert!(message.contains("vtk/0003.vtp"), "{message}");
        fs::remove_file(folder.path().join(MANIFEST)).unwrap();
        directory.reopen().unwrap();
        let manifest = Manifest::read(folder.path()).unwrap().unwrap();
        assert!(manifest.names().any(|name| name == "vtk/0003.vtp"));
        assert!(manifest.names().all(|name| name != "notes.txt"));
    }

    #[test]
    fn holds_finds_files_at_any_depth() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        fs::create_dir_all(path.join("deep")).unwrap();
        for name in ["a/scene.ron", "a/deep/scene.ron", "ab.ron"] {
            fs::write(folder.path().join(name), "").unwrap();
        }
        let directory = RunDirectory::existing(&path);
        let holds = |name: &str| directory.holds(folder.path().join(name));
        assert!(holds("a/scene.ron") && holds("a/deep/../scene.ron") && holds("a/deep/scene.ron"));
        assert!(!holds("ab.ron") && !holds("a/absent.ron"));
        #[cfg(unix)]
        {
            let link = folder.path().join("link.ron");
            std::os::unix::fs::symlink(path.join("scene.ron"), link).unwrap();
            assert!(holds("link.ron"));
        }
    }
}
