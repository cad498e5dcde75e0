//! The directory itself: what a run may take, replace and remove. It does not know what its files
//! hold.

use super::RunDirectoryError;
use super::atomic::UNFINISHED;
use super::lock::{LOCK, RunLock, refuse_in_use};
use super::manifest::Manifest;
use super::names::{BEFORE_RESULTS, CHECKPOINT, MANIFEST, SUMMARY};
use std::fs;
use std::path::{Path, PathBuf};

/// A directory that holds the results of one run.
///
/// Results are written under other names and renamed when all of them are complete and on the disk, so
/// that a run that is interrupted, or a disk that is full, leaves no half file under a final name, and
/// no new file beside an old one. `summary.json` comes last: where it is, the rest is complete.
///
/// `actin-run.json`, the manifest, lists what the run has written. Only files that it lists are ever
/// replaced or removed, and links are not followed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RunDirectory {
    pub(super) path: PathBuf,
}

impl RunDirectory {
    /// Creates the directory, and those above it, if need be.
    ///
    /// With `overwrite`, the files that an earlier run's manifest lists are removed at once, so that
    /// results of two runs never stand side by side; files of other names are left alone.
    ///
    /// # Errors
    /// A path that is no directory; a directory in which another run goes on or that is not empty
    /// (unless `overwrite`); with `overwrite`, one without a manifest, one that holds something that
    /// would have to go and that the manifest does not list, one in which a text (`scene.ron`, tables) was
    /// changed after the run, or a link to a directory; a refusal of the file system. Nothing has been removed then,
    /// unless the file system refuses half way.
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
        if fs::symlink_metadata(&path).is_ok() && !path.is_dir() {
            return Err(RunDirectoryError::NotADirectory { path });
        }
        fs::create_dir_all(&path).map_err(RunDirectoryError::io(&path))?;
        let directory = Self { path };
        // Without a lock, for which one may have to be allowed to write.
        if !is_empty(&directory.path)? {
            refuse_in_use(&directory.path)?;
        }
        directory.earlier_run(overwrite)?;
        let lock = RunLock::take(&directory.path)?;
        // Again: another run may have been there in between.
        if let Some(earlier) = directory.earlier_run(overwrite)? {
            earlier.remove_files(&directory.path)?;
        }
        let mut manifest = Manifest::new();
        manifest.add(BEFORE_RESULTS);
        manifest.write(&directory.path)?;
        Ok((directory, lock))
    }

    /// Where the directory is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Whether a run was here that has neither results nor a checkpoint: it was killed early.
    pub fn is_unfinished(&self) -> bool {
        let is_there = |name| self.path.join(name).exists();
        is_there(MANIFEST) && !is_there(SUMMARY) && !is_there(CHECKPOINT)
    }

    /// Whether `file` lies in the directory, at any depth; links are followed to find out.
    pub fn holds(&self, file: impl AsRef<Path>) -> bool {
        let [file, folder] = [file.as_ref(), &self.path].map(fs::canonicalize);
        matches!((file, folder), (Ok(file), Ok(folder)) if file.starts_with(&folder))
    }

    /// Refuses to go on in a directory that holds something else in the place of a run's file.
    ///
    /// To be called when its checkpoint has been read: where there is no manifest, the checkpoint tells
    /// that a run was here, and what it has written is listed now.
    ///
    /// # Errors
    /// The file or link, a text that was changed after the run wrote it, or a refusal of the file system.
    pub fn reopen(&self) -> Result<(), RunDirectoryError> {
        let listed = Manifest::read(&self.path)?;
        let mut manifest = listed.map_or_else(|| Manifest::of_all_in(&self.path), Ok)?;
        manifest.add(BEFORE_RESULTS);
        manifest.ensure_own(&self.path)?;
        manifest.ensure_unchanged(&self.path)?;
        manifest.write(&self.path)
    }

    /// What an earlier run has left, if the directory is not empty and it may go. Changes nothing.
    fn earlier_run(&self, overwrite: bool) -> Result<Option<Manifest>, RunDirectoryError> {
        let path = &self.path;
        let manifest = Manifest::read(path);
        if is_empty(path)? {
            return manifest.map(|_| None);
        }
        if !overwrite {
            return Err(RunDirectoryError::NotEmpty { path: path.clone() });
        }
        refuse_link(path)?;
        let Some(manifest) = manifest? else {
            return Err(RunDirectoryError::NoManifest { path: path.clone() });
        };
        manifest.ensure_own(path)?;
        manifest.ensure_unchanged(path)?;
        Ok(Some(manifest))
    }
}

/// Whether there is nothing in a directory but what keeps runs apart.
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

/// Refuses a path that is itself a link: what it points to may be meant or not.
fn refuse_link(path: &Path) -> Result<(), RunDirectoryError> {
    // A slash behind a link stands for what it points to; here it is the link that counts.
    let path: PathBuf = path.components().collect();
    match fs::read_link(&path) {
        Ok(target) => Err(RunDirectoryError::Link { path, target }),
        Err(_) => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::results::fixture::names;
    use crate::results::manifest::remove_if_there;
    use crate::results::names::{
        CHECKPOINT, ENERGIES, FILES, PICTURES, PROFILE, RECORDS, SCENE, SUMMARY, picture_name,
    };

    #[test]
    fn a_new_or_empty_directory_is_taken() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("runs/one");
        assert_eq!(RunDirectory::create(&path, false).unwrap().path(), path);
        assert!(RunDirectory::create(&path, false).is_ok());
    }

    /// That it is not empty is said before anything is locked, for which one may have to be allowed to
    /// write: here a lock can never be had. One in which a run goes on is in use, with whatever in it.
    #[test]
    fn what_is_not_empty_needs_no_lock() {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join(LOCK)).unwrap();
        let refusal = || RunDirectory::create(folder.path(), false).unwrap_err();
        assert!(matches!(refusal(), RunDirectoryError::ForeignLock { .. }));
        fs::write(folder.path().join("notes.txt"), "mine").unwrap();
        assert!(matches!(refusal(), RunDirectoryError::NotEmpty { .. }));
        fs::remove_dir(folder.path().join(LOCK)).unwrap();
        let lock = RunLock::take(folder.path()).unwrap();
        for overwrite in [false, true] {
            let error = RunDirectory::create(folder.path(), overwrite).unwrap_err();
            assert!(matches!(error, RunDirectoryError::InUse { .. }), "{error}");
        }
        drop(lock);
        assert!(matches!(refusal(), RunDirectoryError::NotEmpty { .. }));
        assert_eq!(names(folder.path()), [LOCK, "notes.txt"]);
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

    /// A run directory with files of all kinds that its manifest lists, some unfinished, some of others.
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

    /// Refuses to overwrite what `spoil` makes of an earlier run, and changes nothing; returns why.
    fn refusal(spoil: impl FnOnce(&Path)) -> String {
        let folder = tempfile::tempdir().unwrap();
        earlier_run(folder.path());
        spoil(folder.path());
        let before = names(folder.path());
        let error = RunDirectory::create(folder.path(), true).unwrap_err();
        assert_eq!(before, names(folder.path()), "{error}");
        error.to_string()
    }

    /// Overwriting takes away what the manifest lists, and nothing else.
    #[test]
    fn overwriting_removes_what_the_run_has_written() {
        let folder = tempfile::tempdir().unwrap();
        earlier_run(folder.path());
        let error = RunDirectory::create(folder.path(), false).unwrap_err();
        assert!(matches!(error, RunDirectoryError::NotEmpty { .. }));
        assert!(error.to_string().contains("never overwritten"), "{error}");
        RunDirectory::create(folder.path(), true).unwrap();
        let left = [LOCK, MANIFEST, "notes.txt", PICTURES];
        assert_eq!(names(folder.path()), left);
        let pictures = names(&folder.path().join(PICTURES));
        assert_eq!(pictures, ["12.vtp", "mine.vtp"]);
        // The new run has a manifest of its own, and nothing of the old one.
        let manifest = Manifest::read(folder.path()).unwrap().unwrap();
        assert!(manifest.names().eq([CHECKPOINT, RECORDS, SCENE]));
    }

    /// Killed anywhere between the first removal and the first file of the new run: what is left can be
    /// overwritten again, and is removed then.
    #[test]
    fn overwriting_that_was_killed_can_be_done_again() {
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
        // Even before its first own file, the directory is still one that a run may take.
        let folder = tempfile::tempdir().unwrap();
        for name in [LOCK, "actin-run.json.part"] {
            fs::write(folder.path().join(name), "").unwrap();
        }
        RunDirectory::create(folder.path(), false).unwrap();
        RunDirectory::create(folder.path(), false).unwrap();
    }

    /// Without a manifest, with one that no run has written, with a file in the way that it does not
    /// list: refused by name, and everything stays.
    #[test]
    fn what_no_manifest_lists_is_not_overwritten() {
        let without = refusal(|folder| fs::remove_file(folder.join(MANIFEST)).unwrap());
        assert!(without.contains(MANIFEST), "{without}");
        let foreign = refusal(|folder| fs::write(folder.join(MANIFEST), "{}").unwrap());
        assert!(
            foreign.contains("actin-run.json is not the list"),
            "{foreign}"
        );
        let unlisted = refusal(|folder| fs::write(folder.join("vtk/0002.vtp"), "").unwrap());
        assert!(
            unlisted.contains("vtk/0002.vtp was not written"),
            "{unlisted}"
        );
        let folder = refusal(|folder| fs::create_dir(folder.join(PROFILE)).unwrap());
        assert!(folder.contains("profile.csv was not written"), "{folder}");
    }

    /// Nothing goes through a link: of a file, of the pictures, of the directory, with a slash or not.
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
        assert!(matches!(error, RunDirectoryError::NotADirectory { .. }));
    }

    /// A run that goes on finds its files; something else in their place is refused. An older run
    /// without a manifest gets one.
    #[test]
    fn a_directory_is_reopened_with_its_own_files() {
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
    fn what_lies_in_the_directory_is_known() {
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
