//! One run at a time in a directory.

use super::RunDirectoryError;
use std::fs::{self, File, TryLockError};
use std::io::{self, Read, Seek, Write};
use std::path::Path;

/// Name of the file that is locked, which no user file is likely to have.
pub(super) const LOCK: &str = ".actin-run.lock";

/// Most digits of a process number.
const MOST_DIGITS: u64 = 20;

/// `ENOLCK`: what a network file system without a service for locks says.
const NO_LOCKS_AVAILABLE: Option<i32> = if cfg!(target_os = "linux") {
    Some(37)
} else {
    None
};

/// Keeps other runs out of a directory until it is dropped.
///
/// What is locked is an open file: the operating system lets go of it when the process ends, however it
/// ends. The file stays, so that all runs lock the same one; it is empty, or holds the number of the
/// process that runs or was killed. A file of that name that holds anything else was not written by a run,
/// and a link is not followed: both are refused. On a file system without locks there is no lock.
#[derive(Debug)]
pub struct RunLock {
    /// Open as long as the lock is held.
    file: File,
}

impl RunLock {
    /// Locks `directory`, which exists.
    ///
    /// # Errors
    /// If another run has locked it, if something that no run has written stands in the place of the
    /// lock, or a refusal of the file system.
    pub fn take(directory: impl AsRef<Path>) -> Result<Self, RunDirectoryError> {
        let directory = directory.as_ref();
        let path = directory.join(LOCK);
        let foreign = || RunDirectoryError::ForeignLock { path: path.clone() };
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
        // A number that stays does no harm: no process holds the lock.
        let _ = self.file.set_len(0);
    }
}

/// Refuses a directory in which a run goes on, as far as can be seen without writing.
///
/// A run that takes the lock in the same instant may be refused for this look.
pub(super) fn refuse_in_use(directory: &Path) -> Result<(), RunDirectoryError> {
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

/// Whether the file system says that it knows no locks.
fn has_no_locks(error: &io::Error) -> bool {
    error.kind() == io::ErrorKind::Unsupported
        || NO_LOCKS_AVAILABLE.is_some_and(|code| error.raw_os_error() == Some(code))
}

/// Whether a file is what a run leaves: nothing, or a process number if it was killed.
fn is_of_a_run(mut file: &File) -> io::Result<bool> {
    let mut bytes = Vec::new();
    file.take(MOST_DIGITS + 1).read_to_end(&mut bytes)?;
    file.rewind()?;
    Ok(bytes.len() as u64 <= MOST_DIGITS && bytes.iter().all(u8::is_ascii_digit))
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

#[cfg(test)]
mod tests {
    use super::*;

    /// The second is refused, from any process, with the process that holds it; afterwards an empty file is
    /// left, which keeps no run out.
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
        assert_eq!(fs::read(folder.path().join(LOCK)).unwrap(), b"");
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

    /// A user file of that name is neither emptied nor removed; numbers that are too long for
    /// a process are theirs, too.
    #[test]
    fn what_no_run_has_left_stays() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(LOCK);
        for text in ["mine", "12 ", "-1", "123456789012345678901", "12\n"] {
            fs::write(&path, text).unwrap();
            let error = RunLock::take(folder.path()).unwrap_err();
            assert!(matches!(error, RunDirectoryError::ForeignLock { .. }));
            assert!(error.to_string().contains(LOCK), "{error}");
            assert_eq!(fs::read_to_string(&path).unwrap(), text);
        }
        fs::write(&path, "").unwrap();
        assert!(RunLock::take(folder.path()).is_ok());
    }

    /// A link to an empty file, or to a number, would pass for the lock: neither is written to, nor is a
    /// file made where a link points to nothing.
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
            let error = RunLock::take(folder.path()).unwrap_err();
            assert!(matches!(error, RunDirectoryError::ForeignLock { .. }));
            assert_eq!(fs::read_to_string(&target).ok().as_deref(), text);
        }
    }

    /// A look refuses while a run goes on, sees through what a killed one has left, and leaves all as
    /// it is.
    #[test]
    fn a_look_changes_nothing() {
        let folder = tempfile::tempdir().unwrap();
        refuse_in_use(folder.path()).unwrap();
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
        let path = folder.path().join(LOCK);
        fs::write(&path, "4194304999").unwrap();
        refuse_in_use(folder.path()).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "4194304999");
        let _lock = RunLock::take(folder.path()).unwrap();
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
    fn a_file_system_without_locks_is_told_from_a_refusal() {
        assert!(has_no_locks(&io::ErrorKind::Unsupported.into()));
        assert!(!has_no_locks(&io::ErrorKind::PermissionDenied.into()));
        #[cfg(target_os = "linux")]
        assert!(has_no_locks(&io::Error::from_raw_os_error(37)));
    }

    /// Many at once, for as long as it takes: never two inside, and all get in. A lock whose file were
    /// removed would let a second one in: it locks the removed file, a third makes a new one.
    #[test]
    fn never_are_two_inside() {
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
