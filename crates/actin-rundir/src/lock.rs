//! Lock that admits one run at a time to a directory.

use crate::RunDirectoryError;
use std::fs::{self, File, TryLockError};
use std::io::{self, Read, Seek, Write};
use std::path::Path;

/// Name of the locked file, which user files are unlikely to have.
pub(crate) const LOCK: &str = ".actin-run.lock";

const MOST_DIGITS: u64 = 20;

/// `ENOLCK`: error of a network file system without a lock service.
const NO_LOCKS_AVAILABLE: Option<i32> = if cfg!(target_os = "linux") {
    Some(37)
} else {
    None
};

/// Exclusive access of a run to a directory, released on drop.
///
/// The operating system releases the lock on the open file whenever the process ends. The file
/// itself stays, so that all runs lock the same file. It is empty or holds the process number of a
/// running or killed run. Files with other contents and links are refused. File systems without
/// locks provide no protection.
#[derive(Debug)]
pub struct RunLock {
    file: File,
}

impl RunLock {
    /// Locks an existing directory.
    ///
    /// # Errors
    /// Another run holds the lock, the file in place of the lock was not written by a run, or the
    /// file system refuses an operation.
    pub fn acquire(directory: impl AsRef<Path>) -> Result<Self, RunDirectoryError> {
        let directory = directory.as_ref();
        let path = directory.join(LOCK);
        let foreign = || RunDirectoryError::ForeignLock(path.clone());
        if fs::symlink_metadata(&path).is_ok_and(|data| !data.is_file()) {
            return Err(foreign());
        }
        let file = File::options()
            .read(true)
            .write(true)
            .create(true)
            .truncate(false)
            .open(&path)
            .map_err(RunDirectoryError::io(&path))?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => return Err(in_use(directory, &path)),
            Err(TryLockError::Error(error)) if has_no_locks(&error) => {}
            Err(TryLockError::Error(error)) => return Err(RunDirectoryError::io(&path)(error)),
        }
        if !is_of_a_run(&file).map_err(RunDirectoryError::io(&path))? {
            return Err(foreign());
        }
        sign(&file);
        Ok(Self { file })
    }
}

impl Drop for RunLock {
    fn drop(&mut self) {
        // A remaining number is harmless, because the file is not locked.
        let _ = self.file.set_len(0);
    }
}

/// Refuses a directory in use by another run, without writing to it.
///
/// The check holds a shared lock for a moment, so a run that starts at the same time may be
/// refused.
pub(crate) fn refuse_in_use(directory: &Path) -> Result<(), RunDirectoryError> {
    let path = directory.join(LOCK);
    // Opening a pipe would block until a writer opens it.
    if !fs::symlink_metadata(&path).is_ok_and(|data| data.is_file()) {
        return Ok(());
    }
    let locked = File::open(&path).map(|file| file.try_lock_shared());
    match locked {
        Ok(Err(TryLockError::WouldBlock)) => Err(in_use(directory, &path)),
        _ => Ok(()),
    }
}

fn has_no_locks(error: &io::Error) -> bool {
    error.kind() == io::ErrorKind::Unsupported
        || NO_LOCKS_AVAILABLE.is_some_and(|code| error.raw_os_error() == Some(code))
}

/// Returns true if a file is empty or holds a process number.
fn is_of_a_run(mut file: &File) -> io::Result<bool> {
    let mut bytes = Vec::new();
    file.take(MOST_DIGITS + 1).read_to_end(&mut bytes)?;
    file.rewind()?;
    Ok(bytes.len() as u64 <= MOST_DIGITS && bytes.iter().all(u8::is_ascii_digit))
}

/// Writes the process number for error messages of other runs; failures are ignored.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_directory_has_one_run_at_a_time() {
        let folder = tempfile::tempdir().unwrap();
        let lock = RunLock::acquire(folder.path()).unwrap();
        let error = RunLock::acquire(folder.path()).unwrap_err();
        let message = error.to_string();
        let process = format!("process {}", std::process::id());
        assert!(matches!(error, RunDirectoryError::InUse { .. }), "{error}");
        assert!(
            message.contains(&process) && message.contains("is in use"),
            "{message}"
        );
        drop(lock);
        assert_eq!(fs::read(folder.path().join(LOCK)).unwrap(), b"");
        assert!(RunLock::acquire(folder.path()).is_ok());
    }

    #[test]
    fn lock_file_of_a_killed_run_is_reused() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join(LOCK), "4194304999").unwrap();
        let _lock = RunLock::acquire(folder.path()).unwrap();
        let signed = fs::read_to_string(folder.path().join(LOCK)).unwrap();
        assert_eq!(signed, std::process::id().to_string());
    }

    /// Numbers with too many digits for a process also count as user data.
    #[test]
    fn user_file_with_the_name_of_the_lock_is_kept() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(LOCK);
        for text in ["mine", "12 ", "-1", "123456789012345678901", "12\n"] {
            fs::write(&path, text).unwrap();
            let error = RunLock::acquire(folder.path()).unwrap_err();
            assert!(matches!(error, RunDirectoryError::ForeignLock(_)));
            assert!(error.to_string().contains(LOCK), "{error}");
            assert_eq!(fs::read_to_string(&path).unwrap(), text);
        }
        fs::write(&path, "").unwrap();
        assert!(RunLock::acquire(folder.path()).is_ok());
    }

    /// The target is neither written nor created, even if its contents look like a lock file.
    #[cfg(unix)]
    #[test]
    fn a_link_is_not_followed() {
        let folder = tempfile::tempdir().unwrap();
        let elsewhere = tempfile::tempdir().unwrap();
        let target = elsewhere.path().join("count");
        std::os::unix::fs::symlink(&target, folder.path().join(LOCK)).unwrap();
        for text in [None, Some(""), Some("12")] {
            if let Some(text) = text {
                fs::write(&target, text).unwrap();
            }
            let error = RunLock::acquire(folder.path()).unwrap_err();
            assert!(matches!(error, RunDirectoryError::ForeignLock(_)));
            assert_eq!(fs::read_to_string(&target).ok().as_deref(), text);
        }
    }

    #[test]
    fn refuse_in_use_changes_nothing() {
        let folder = tempfile::tempdir().unwrap();
        refuse_in_use(folder.path()).unwrap();
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
        let path = folder.path().join(LOCK);
        fs::write(&path, "4194304999").unwrap();
        refuse_in_use(folder.path()).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "4194304999");
        let _lock = RunLock::acquire(folder.path()).unwrap();
        let error = refuse_in_use(folder.path()).unwrap_err();
        assert!(matches!(
            error,
            RunDirectoryError::InUse {
                process: Some(_),
                ..
            }
        ));
    }

    #[test]
    fn missing_lock_support_is_recognised() {
        assert!(has_no_locks(&io::ErrorKind::Unsupported.into()));
        assert!(!has_no_locks(&io::ErrorKind::PermissionDenied.into()));
        #[cfg(target_os = "linux")]
        assert!(has_no_locks(&io::Error::from_raw_os_error(37)));
    }

    /// Threads compete for the lock. Removing the file on release would admit two: one that locks
    /// the removed file and one that creates a new one.
    #[test]
    fn competing_threads_hold_the_lock_one_at_a_time() {
        use std::sync::atomic::{AtomicUsize, Ordering};
        let folder = tempfile::tempdir().unwrap();
        let (inside, together) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let visit = || {
            for _ in 0..200 {
                let lock = loop {
                    match RunLock::acquire(folder.path()) {
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
