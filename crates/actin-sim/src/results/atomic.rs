//! Files that are whole or not there: written under another name, and renamed when they are complete.
//! What a file holds, and whose it is, is not known here.

use std::fs::{self, File};
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Appended to the name of a file that is not complete yet.
pub(super) const UNFINISHED: &str = ".part";

/// Files that wait for the disk at the same time: a hundred small ones then take as long as ten.
const SYNCED_AT_ONCE: usize = 8;

/// The name under which a file is written until it is complete.
pub(super) fn unfinished(path: &Path) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(UNFINISHED);
    name.into()
}

/// Writes a file under its unfinished name; if that fails, nothing is left of it.
pub(super) fn stage(
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
        // The error that led here says more than one about the removal could.
        let _ = fs::remove_file(unfinished);
    }
    written
}

/// Gives a file that was staged its name. What had that name is gone; a link goes itself, and what
/// it points to stays.
pub(super) fn publish(path: &Path) -> io::Result<()> {
    fs::rename(unfinished(path), path)
}

/// Puts a whole file in the place of `path`, or leaves what was there.
pub(super) fn replace(
    path: &Path,
    fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> io::Result<()> {
    stage(path, fill)?;
    publish_or_remove(&unfinished(path), path)
}

/// The same so that it holds even if power is lost: the file and its new name are on the disk.
pub(super) fn replace_durably(
    path: &Path,
    fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> io::Result<()> {
    replace_file(path, &unfinished(path), fill)
}

/// Puts a whole file in the place of `path`, or leaves what was there, even if power is lost. It is written as
/// `unfinished`, in the same folder: where several processes may write the same file, a name of each its own.
///
/// # Errors
/// A refusal of the file system; nothing is left of the unfinished file.
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
    // That of a name without a folder is the empty path, which stands for the working directory.
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

/// A new file. One that a killed run has left goes; a link is never followed.
fn create(path: &Path) -> io::Result<File> {
    let create = || File::options().write(true).create_new(true).open(path);
    create().or_else(|error| match error.kind() {
        io::ErrorKind::AlreadyExists => fs::remove_file(path).and_then(|()| create()),
        _ => Err(error),
    })
}

/// Waits until a file or directory is on the disk.
pub(super) fn sync(path: &Path) -> io::Result<()> {
    // Some systems cannot open a directory; there a rename is as durable as it gets.
    match File::open(path) {
        Ok(file) => file.sync_all(),
        Err(error) if error.kind() == io::ErrorKind::PermissionDenied => Ok(()),
        Err(error) => Err(error),
    }
}

/// Waits until `count` files, each at a `path`, are on the disk; otherwise says which is not.
pub(super) fn sync_all(
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
    use crate::results::fixture::names;
    use std::io::Write;

    /// What was there before stays whole, and the unfinished file is gone; both ways of replacing.
    #[test]
    fn a_file_that_fails_half_way_is_not_seen() {
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

    /// A link in the place of a file, or of its unfinished name, is replaced; what it points to stays.
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

    /// More files than threads; one that is missing is named.
    #[test]
    fn all_files_reach_the_disk_or_one_is_named() {
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
