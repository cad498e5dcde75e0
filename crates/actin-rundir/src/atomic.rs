//! Atomic replacement of files: written under a temporary name, renamed when complete.

use crate::RunDirectoryError;
use std::fs::{self, File};
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};

/// Suffix of incomplete files.
pub(crate) const UNFINISHED: &str = ".part";

/// Number of concurrent `fsync` calls. A hundred small files then take as long as ten.
const SYNCED_AT_ONCE: usize = 8;

pub(crate) fn unfinished(path: &Path) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(UNFINISHED);
    name.into()
}

/// Writes a new file and removes it on failure.
pub(crate) fn write_new(
    path: &Path,
    fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> io::Result<()> {
    let written = create(path).and_then(|file| {
        let mut out = BufWriter::new(file);
        fill(&mut out)?;
        out.into_inner().map(drop).map_err(io::Error::from)
    });
    if written.is_err() {
        // The first error is the relevant one.
        let _ = fs::remove_file(path);
    }
    written
}

/// Renames a file, also in place of a link, and removes it on failure.
fn rename(unfinished: &Path, path: &Path) -> io::Result<()> {
    fs::rename(unfinished, path).inspect_err(|_| {
        let _ = fs::remove_file(unfinished);
    })
}

/// Replaces `path` by a complete file; on failure the old file stays.
pub(crate) fn replace(
    path: &Path,
    fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> io::Result<()> {
    write_new(&unfinished(path), fill)?;
    rename(&unfinished(path), path)
}

/// Replaces `path` like [`replace`], durably: the file and its name are on the disk at return.
pub(crate) fn replace_durably(
    path: &Path,
    fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> io::Result<()> {
    replace_file(path, &unfinished(path), fill)
}

/// Replaces `path` durably by a complete file; on failure the old file stays.
///
/// `unfinished` is the temporary path in the same folder. It must differ between processes that may
/// write the same file.
///
/// # Errors
/// A refusal of the file system; the temporary file is removed.
pub fn replace_file(
    path: &Path,
    unfinished: &Path,
    fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> io::Result<()> {
    write_new(unfinished, |out| {
        fill(out)?;
        io::Write::flush(out)?;
        out.get_ref().sync_all()
    })?;
    rename(unfinished, path)?;
    // The parent of a bare file name is empty and means the working directory.
    let folder = path
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty());
    sync(folder.unwrap_or(Path::new(".")))
}

/// Creates a new file in place of one left by a killed run, without following links.
fn create(path: &Path) -> io::Result<File> {
    let create = || File::options().write(true).create_new(true).open(path);
    create().or_else(|error| match error.kind() {
        io::ErrorKind::AlreadyExists => fs::remove_file(path).and_then(|()| create()),
        _ => Err(error),
    })
}

pub(crate) fn sync(path: &Path) -> io::Result<()> {
    // Some systems cannot open directories; the rename alone has to suffice there.
    match File::open(path) {
        Ok(file) => file.sync_all(),
        Err(error) if error.kind() == io::ErrorKind::PermissionDenied => Ok(()),
        Err(error) => Err(error),
    }
}

/// Waits until all files are on the disk. An error names a file that fails.
pub(crate) fn sync_all(paths: &[PathBuf]) -> Result<(), RunDirectoryError> {
    let sync_each = |paths: &[PathBuf]| {
        let mut paths = paths.iter();
        paths.try_for_each(|path| sync(path).map_err(RunDirectoryError::io(path)))
    };
    let share = paths.len().div_ceil(SYNCED_AT_ONCE).max(1);
    std::thread::scope(|scope| {
        let shares = paths.chunks(share);
        let threads: Vec<_> = shares
            .map(|paths| scope.spawn(move || sync_each(paths)))
            .collect();
        let mut done = threads.into_iter().map(std::thread::ScopedJoinHandle::join);
        done.try_for_each(|outcome| outcome.expect("waiting for the disk does not panic"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::names;
    use std::io::Write;

    #[test]
    fn failed_writing_keeps_the_old_file() {
        type Replace = fn(&Path, fn(&mut BufWriter<File>) -> io::Result<()>) -> io::Result<()>;
        let ways: [Replace; 2] = [
            |path, fill| replace(path, fill),
            |path, fill| replace_durably(path, fill),
        ];
        for replace in ways {
            let folder = tempfile::tempdir().unwrap();
            let path = folder.path().join("table.csv");
            replace(&path, |out| out.write_all(b"whole")).unwrap();
            let error = replace(&path, |out| {
                out.write_all(b"half")?;
                Err(io::Error::other("no space left"))
            });
            assert_eq!(error.unwrap_err().to_string(), "no space left");
            assert_eq!(fs::read(&path).unwrap(), b"whole");
            assert_eq!(names(folder.path()), ["table.csv"]);
        }
    }

    #[cfg(unix)]
    #[test]
    fn links_are_not_followed() {
        use std::os::unix::fs::symlink;
        let folder = tempfile::tempdir().unwrap();
        let [mine, path] = ["mine", "table.csv"].map(|name| folder.path().join(name));
        fs::write(&mine, "mine").unwrap();
        symlink(&mine, &path).unwrap();
        symlink(&mine, unfinished(&path)).unwrap();
        replace(&path, |out| out.write_all(b"table")).unwrap();
        assert_eq!(fs::read(&mine).unwrap(), b"mine");
        assert_eq!(fs::read(&path).unwrap(), b"table");
        assert!(fs::symlink_metadata(&path).unwrap().is_file());
        assert_eq!(names(folder.path()), ["mine", "table.csv"]);
    }

    #[test]
    fn sync_all_names_the_missing_file() {
        let folder = tempfile::tempdir().unwrap();
        let paths: Vec<_> = (0..3 * SYNCED_AT_ONCE)
            .map(|i| folder.path().join(i.to_string()))
            .collect();
        for path in &paths {
            fs::write(path, "x").unwrap();
        }
        assert!(sync_all(&paths).is_ok() && sync_all(&[]).is_ok());
        fs::remove_file(&paths[13]).unwrap();
        let error = sync_all(&paths).unwrap_err().to_string();
        let missing = paths[13].display().to_string();
        assert!(error.starts_with(&missing), "{error}");
    }
}
