//! One run at a time in a directory.

use super::RunDirectoryError;
use super::directory::remove_if_there;
use std::fs::{self, File, TryLockError};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Name of the file that is locked.
pub(super) const LOCK: &str = "lock";

/// Keeps other runs out of a directory until it is dropped.
///
/// What is locked is the open file, not its name: the operating system lets go of it when the
/// process ends, however it ends, and a file that a killed run has left keeps nobody out. Processes
/// are told apart as well as the file system tells them: on one without locks there is none.
#[derive(Debug)]
pub struct RunLock {
    path: PathBuf,
    /// Open as long as the lock is held.
    _file: File,
}

impl RunLock {
    /// Locks `directory`, which exists.
    ///
    /// # Errors
    /// If another run has locked it, or a refusal of the file system.
    pub fn take(directory: impl AsRef<Path>) -> Result<Self, RunDirectoryError> {
        let path = directory.as_ref().join(LOCK);
        loop {
            let file = File::options()
                .read(true)
                .write(true)
                .create(true)
                .truncate(false)
                .open(&path)
                .map_err(RunDirectoryError::io(&path))?;
            match file.try_lock() {
                Ok(()) => {}
                Err(TryLockError::WouldBlock) => return Err(in_use(directory.as_ref(), &path)),
                Err(TryLockError::Error(error)) if error.kind() == io::ErrorKind::Unsupported => {}
                Err(TryLockError::Error(error)) => return Err(RunDirectoryError::io(&path)(error)),
            }
            // Whoever held it before may have removed the name just now: then the lock is on a file
            // that nobody else will ever find.
            if is_at(&file, &path) {
                sign(&file);
                return Ok(Self { path, _file: file });
            }
        }
    }
}

impl Drop for RunLock {
    fn drop(&mut self) {
        // While it is still locked. A file that stays keeps nobody out.
        let _ = remove_if_there(&self.path);
    }
}

/// Writes into the file who holds it, for the message of others; a full disk only makes that shorter.
fn sign(file: &File) {
    let id = std::process::id().to_string();
    let mut file = file;
    let _ = file.set_len(0).and_then(|()| file.write_all(id.as_bytes()));
}

fn in_use(directory: &Path, lock: &Path) -> RunDirectoryError {
    let holder = fs::read_to_string(lock).ok();
    RunDirectoryError::InUse {
        path: directory.to_owned(),
        process: holder.and_then(|text| text.parse().ok()),
    }
}

/// Whether `file` is what stands at `path`.
#[cfg(unix)]
fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let identity = |data: fs::Metadata| (data.dev(), data.ino());
    let (here, there) = (file.metadata(), fs::metadata(path));
    here.is_ok_and(|here| there.is_ok_and(|there| identity(here) == identity(there)))
}

/// Whether `file` is what stands at `path`; here an open file keeps its name.
#[cfg(not(unix))]
fn is_at(_: &File, path: &Path) -> bool {
    path.exists()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The second is refused, whoever asks, with the process that holds it; afterwards nothing is
    /// left.
    #[test]
    fn a_directory_has_one_run_at_a_time() {
        let folder = tempfile::tempdir().unwrap();
        let lock = RunLock::take(folder.path()).unwrap();
        let error = RunLock::take(folder.path()).unwrap_err();
        let message = error.to_string();
        let process = format!("process {}", std::process::id());
        assert!(matches!(error, RunDirectoryError::InUse { .. }), "{error}");
        assert!(
            message.contains(&process) && message.contains("is in use"),
            "{message}"
        );
        drop(lock);
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
        assert!(RunLock::take(folder.path()).is_ok());
    }

    /// A file that a killed run has left, with its number, is only a file.
    #[test]
    fn what_a_killed_run_has_left_keeps_nobody_out() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join(LOCK), "4194304999").unwrap();
        let _lock = RunLock::take(folder.path()).unwrap();
        let signed = fs::read_to_string(folder.path().join(LOCK)).unwrap();
        assert_eq!(signed, std::process::id().to_string());
    }

    /// Many at once, for as long as it takes: never two inside, and all get in. Without the look at
    /// the name one locks a file that another has just removed, and a third a new one.
    #[test]
    fn removal_lets_no_second_one_in() {
        use std::sync::atomic::{AtomicUsize, Ordering};
        let folder = tempfile::tempdir().unwrap();
        let (inside, together) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let visit = || {
            for _ in 0..200 {
                let lock = loop {
                    match RunLock::take(folder.path()) {
                        Ok(lock) => break lock,
                        Err(RunDirectoryError::InUse { .. }) => std::thread::yield_now(),
                        Err(error) => panic!("{error}"),
                    }
                };
                let others = inside.fetch_add(1, Ordering::SeqCst);
                together.fetch_max(others, Ordering::SeqCst);
                inside.fetch_sub(1, Ordering::SeqCst);
                drop(lock);
            }
        };
        std::thread::scope(|scope| (0..4).for_each(|_| drop(scope.spawn(visit))));
        assert_eq!(together.into_inner(), 0);
    }
}
