//! Atomic replacement of files: written under a temporary name, renamed when complete.

use std::fs::{self, File};
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Suffix of incomplete files.
pub(crate) const UNFINISHED: &str = ".part";

/// Number of concurrent `fsync` calls. A hundred small files then take as long as ten.
const SYNCED_AT_ONCE: usize = 8;

pub(crate) fn unfinished(path: &Path) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(UNFINISHED);
    name.into()
}

/// Writes a file under its temporary name and removes it on failure.
pub(crate) fn stage(
    path: &Path,
    fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> io::Result<()> {
    stage_as(&unfinished(path), fill)
}

fn stage_as(
    unfinished: &Path,
    fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> io::Result<()> {
    let written = create(unfinished).and_then(|file| {
        let mut out = BufWriter::new(file);
        fill(&mut out)?;
        out.into_inner().map(drop).map_err(io::Error::from)
    });
    if written.is_err() {
        // The first error is the relevant one.
        let _ = fs::remove_file(unfinished);
    }
    written
}

/// Renames a staged file to its final name. An existing link there is replaced, not followed.
pub(crate) fn publish(path: &Path) -> io::Result<()> {
    fs::rename(unfinished(path), path)
}

/// Replaces `path` by a complete file; on failure the old file stays.
pub(crate) fn replace(
    path: &Path,
    fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> io::Result<()> {
    stage(path, fill)?;
    publish_or_remove(&unfinished(path), path)
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
    stage_as(unfinished, |out| {
        fill(out)?;
        io::Write::flush(out)?;
        out.get_ref().sync_all()
    })?;
    publish_or_remove(unfinished, path)?;
    // The parent of a bare file name is empty and means the working directory.
    let folder = path
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty());
    sync(folder.unwrap_or(Path::new(".")))
}

fn publish_or_remove(unfinished: &Path, path: &Path) -> io::Result<()> {
    fs::rename(unfinished, path).inspect_err(|_| {
        let _ = fs::remove_file(unfinished);
    })
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

/// Waits until `count` files are on the disk. An error names the first file that fails.
pub(crate) fn sync_all(
    count: usize,
    path: impl Fn(usize) -> PathBuf + Sync,
) -> Result<(), (PathBuf, io::Error)> {
    let next = AtomicUsize::new(0);
    let work = || {
        loop {
            let i = next.fetch_add(1, Ordering::Relaxed);
            if i >= count {
                return Ok(());
            }
            let path = path(i);
            sync(&path).map_err(|error| (path, error))?;
        }
    };
    std::thread::scope(|scope| {
        let threads: Vec<_> = (0..SYNCED_AT_ONCE.min(count))
            .map(|_| scope.spawn(work))
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
        let sync_first = |count| sync_all(count, |i| paths[i].clone());
        assert!(sync_first(paths.len()).is_ok() && sync_first(0).is_ok());
        fs::remove_file(&paths[13]).unwrap();
        let (path, error) = sync_first(paths.len()).unwrap_err();
        assert_eq!((&path, error.kind()), (&paths[13], io::ErrorKind::NotFound));
    }
}
