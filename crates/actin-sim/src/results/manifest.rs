//! The manifest of a run directory: which of its files a run has written, and so may replace or remove.
//!
//! Nothing is written under a name before the manifest lists it, and nothing goes that it does not
//! list, so that a run may be killed at any moment. What the files hold is not known here.

use super::RunDirectoryError;
use super::atomic::{self, UNFINISHED};
use super::names::{FILES, MANIFEST, PICTURES, SCENE, SUMMARY, picture_index};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, FileType};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

/// What the file says it is.
const FORMAT: &str = "actin run directory";
/// Version of the format: to be raised when a key changes.
const VERSION: u32 = 1;

/// What a manifest of any version begins with.
#[derive(Debug, Deserialize)]
struct Head {
    format: String,
    version: u32,
}

/// The files of a run.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Manifest {
    format: String,
    version: u32,
    /// CRC-32 (IEEE) of `scene.ron` as the run has written it: people edit that file.
    scene_crc32: Option<u32>,
    /// The same of other texts, by name: as they are, and as they are about to be.
    #[serde(default)]
    crc32: BTreeMap<String, BTreeSet<u32>>,
    /// Names that the run has written or is about to write, relative to the directory.
    files: BTreeSet<String>,
}

impl Manifest {
    /// A manifest that lists nothing.
    pub(super) fn new() -> Self {
        Self {
            format: FORMAT.into(),
            version: VERSION,
            scene_crc32: None,
            crc32: BTreeMap::new(),
            files: BTreeSet::new(),
        }
    }

    /// A manifest that lists everything in `folder` that has a name which runs write.
    ///
    /// # Errors
    /// A refusal of the file system.
    pub(super) fn of_all_in(folder: &Path) -> Result<Self, RunDirectoryError> {
        let mut manifest = Self::new();
        manifest.add(found(folder)?.into_iter().map(|entry| entry.name));
        Ok(manifest)
    }

    /// The manifest in `folder`, if there is one.
    ///
    /// # Errors
    /// A file of that name that is not the manifest of a run: of another format or version, or with a
    /// name that no run writes.
    pub(super) fn read(folder: &Path) -> Result<Option<Self>, RunDirectoryError> {
        let path = folder.join(MANIFEST);
        let refused = |reason: String| RunDirectoryError::Manifest {
            path: path.clone(),
            reason,
        };
        match fs::symlink_metadata(&path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(RunDirectoryError::io(&path)(error)),
            Ok(data) if !data.is_file() => return Err(refused("is not a regular file".into())),
            Ok(_) => {}
        }
        let text = fs::read(&path).map_err(RunDirectoryError::io(&path))?;
        Self::parse(&text).map(Some).map_err(refused)
    }

    fn parse(text: &[u8]) -> Result<Self, String> {
        let in_words = |error: serde_json::Error| error.to_string();
        let head: Head = serde_json::from_slice(text).map_err(in_words)?;
        if head.format != FORMAT {
            return Err(format!("its format is {:?}, not {FORMAT:?}", head.format));
        }
        if head.version != VERSION {
            let version = head.version;
            return Err(format!(
                "its version is {version}, this program knows {VERSION}"
            ));
        }
        let manifest: Self = serde_json::from_slice(text).map_err(in_words)?;
        match manifest.files.iter().find(|name| !is_of_runs(name)) {
            None => Ok(manifest),
            Some(name) => Err(format!("it lists {name:?}, which no run writes")),
        }
    }

    /// Puts the manifest into `folder`.
    pub(super) fn write(&self, folder: &Path) -> Result<(), RunDirectoryError> {
        let path = folder.join(MANIFEST);
        let written = atomic::replace(&path, |out| {
            serde_json::to_writer_pretty(&mut *out, self)?;
            writeln!(out)
        });
        written.map_err(RunDirectoryError::io(&path))
    }

    /// Lists more names.
    pub(super) fn add<S: Into<String>>(&mut self, names: impl IntoIterator<Item = S>) {
        self.files.extend(names.into_iter().map(Into::into));
    }

    /// Notes what `scene.ron` will hold.
    pub(super) fn note_scene(&mut self, text: &str) {
        self.scene_crc32 = Some(crc32fast::hash(text.as_bytes()));
    }

    /// Notes what a text will hold, once the unfinished file beside it has its name; until then it may be as it was.
    ///
    /// # Errors
    /// A refusal of the file system.
    pub(super) fn note_text(&mut self, folder: &Path, name: &str) -> Result<(), RunDirectoryError> {
        let path = folder.join(name);
        let known = self.crc32.entry(name.to_owned()).or_default();
        let now = checksum(&path)?;
        known.retain(|sum| Some(*sum) == now);
        known.extend(checksum(&atomic::unfinished(&path))?);
        Ok(())
    }

    /// The names that are listed.
    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
        self.files.iter().map(String::as_str)
    }

    /// Refuses a folder in which something has a name that runs write, and is not listed or not a
    /// regular file; other files and folders are ignored.
    ///
    /// # Errors
    /// The first such file or link.
    pub(super) fn ensure_own(&self, folder: &Path) -> Result<(), RunDirectoryError> {
        let pictures = folder.join(PICTURES);
        match fs::symlink_metadata(&pictures) {
            Ok(data) if !data.is_dir() => {
                return Err(RunDirectoryError::NotOfARun { path: pictures });
            }
            _ => {}
        }
        let is_own = |entry: &Found| entry.kind.is_file() && self.files.contains(&entry.name);
        match found(folder)?.into_iter().find(|entry| !is_own(entry)) {
            None => Ok(()),
            Some(Found { path, .. }) => Err(RunDirectoryError::NotOfARun { path }),
        }
    }

    /// Refuses a folder in which a text is no longer what the run has written.
    ///
    /// # Errors
    /// That file, or a refusal of the file system.
    pub(super) fn ensure_unchanged(&self, folder: &Path) -> Result<(), RunDirectoryError> {
        let scene = self.scene_crc32.map(|sum| (SCENE, BTreeSet::from([sum])));
        let others = self.crc32.iter();
        let others = others.map(|(name, known)| (name.as_str(), known.clone()));
        for (name, known) in scene.into_iter().chain(others) {
            let path = folder.join(name);
            if checksum(&path)?.is_some_and(|sum| !known.contains(&sum)) {
                return Err(RunDirectoryError::Changed { path });
            }
        }
        Ok(())
    }

    /// Removes what is listed, complete or not; the summary first, which says that the rest is there.
    pub(super) fn remove_files(&self, folder: &Path) -> Result<(), RunDirectoryError> {
        for name in [SUMMARY].into_iter().chain(self.names()) {
            let path = folder.join(name);
            remove_if_there(&path)?;
            remove_if_there(&atomic::unfinished(&path))?;
        }
        Ok(())
    }
}

/// CRC-32 of a file; `None` if there is none.
fn checksum(path: &Path) -> Result<Option<u32>, RunDirectoryError> {
    let sum = || {
        let mut file = fs::File::open(path)?;
        let (mut hasher, mut chunk) = (crc32fast::Hasher::new(), vec![0; 1 << 16]);
        loop {
            match file.read(&mut chunk)? {
                0 => return Ok::<u32, io::Error>(hasher.finalize()),
                read => hasher.update(&chunk[..read]),
            }
        }
    };
    match sum() {
        Ok(sum) => Ok(Some(sum)),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(RunDirectoryError::io(path)(error)),
    }
}

/// A file, link or folder that has a name which runs write.
struct Found {
    /// The name in a manifest, without what marks it as unfinished.
    name: String,
    path: PathBuf,
    /// Its own kind: of a link, not of what it points to.
    kind: FileType,
}

/// Everything in `folder` that has a name which runs write, complete or not.
fn found(folder: &Path) -> Result<Vec<Found>, RunDirectoryError> {
    let mut all = found_in(folder, "")?;
    let pictures = folder.join(PICTURES);
    if fs::symlink_metadata(&pictures).is_ok_and(|data| data.is_dir()) {
        all.extend(found_in(&pictures, PICTURES)?);
    }
    Ok(all)
}

fn found_in(folder: &Path, prefix: &str) -> Result<Vec<Found>, RunDirectoryError> {
    let io = || RunDirectoryError::io(folder);
    let mut all = Vec::new();
    for entry in fs::read_dir(folder).map_err(io())? {
        let entry = entry.map_err(io())?;
        let name = entry.file_name();
        let Some(name) = name.to_str() else { continue };
        let name = name.strip_suffix(UNFINISHED).unwrap_or(name);
        let name = match prefix {
            "" => name.to_owned(),
            prefix => format!("{prefix}/{name}"),
        };
        // Some file systems take no notice of case.
        if is_of_runs(&name.to_ascii_lowercase()) {
            let kind = entry.file_type().map_err(io())?;
            all.push(Found {
                name,
                path: entry.path(),
                kind,
            });
        }
    }
    Ok(all)
}

/// Whether runs write files of this name.
fn is_of_runs(name: &str) -> bool {
    FILES.contains(&name) || picture_index(name).is_some()
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

#[cfg(test)]
mod tests {
    use super::*;

    fn manifest(files: &[&str]) -> Manifest {
        let mut manifest = Manifest::new();
        manifest.add(files.iter().copied());
        manifest
    }

    /// What is written is read, and what is not there is no error.
    #[test]
    fn a_manifest_comes_back() {
        let folder = tempfile::tempdir().unwrap();
        assert!(Manifest::read(folder.path()).unwrap().is_none());
        let mut written = manifest(&[SCENE, "vtk/0000.vtp", "vtk/12345.vtp"]);
        written.note_scene("Scene()");
        written.write(folder.path()).unwrap();
        let read = Manifest::read(folder.path()).unwrap().unwrap();
        assert_eq!(read.files, written.files);
        assert_eq!(read.scene_crc32, written.scene_crc32);
    }

    /// A file of another program, a later version, names that lead elsewhere or that no run writes,
    /// a link: refused by name and reason. A manifest is a list of what may be removed.
    #[test]
    fn what_is_no_manifest_is_refused() {
        let head = |rest: &str| format!("{{\"format\":\"{FORMAT}\",\"version\":{rest}");
        let lists = |name: &str| head(&format!("1,\"scene_crc32\":null,\"files\":[\"{name}\"]}}"));
        let bad = [
            (String::new(), "EOF"),
            ("{\"name\":\"an app\",\"version\":2}".into(), "format"),
            (
                "{\"format\":\"tar\",\"version\":1}".into(),
                "its format is \"tar\"",
            ),
            (head("2,\"folders\":[]}"), "its version is 2"),
            (
                head("1,\"scene_crc32\":null,\"files\":[],\"x\":1}"),
                "unknown field",
            ),
            (lists("notes.txt"), "lists \"notes.txt\""),
            (lists("../scene.ron"), "lists"),
            (lists("/etc/passwd"), "lists"),
            (lists("vtk/../scene.ron"), "lists"),
            (lists("vtk/1.vtp"), "lists"),
            (lists("vtk/+0001.vtp"), "lists"),
            (lists(MANIFEST), "lists"),
        ];
        for (text, reason) in bad {
            let folder = tempfile::tempdir().unwrap();
            fs::write(folder.path().join(MANIFEST), &text).unwrap();
            let message = Manifest::read(folder.path()).unwrap_err().to_string();
            assert!(message.contains(MANIFEST), "{message}");
            assert!(message.contains(reason), "{text}: {message}");
        }
        let good = lists(SCENE);
        assert!(Manifest::parse(good.as_bytes()).is_ok(), "{good}");
    }

    /// Files that runs write are to be listed, and files; whatever else is there does not matter.
    #[test]
    fn only_listed_files_are_own() {
        let listed = manifest(&[SCENE, "vtk/0000.vtp"]);
        let refused = |spoil: &dyn Fn(&Path)| {
            let folder = tempfile::tempdir().unwrap();
            fs::create_dir(folder.path().join(PICTURES)).unwrap();
            for name in [
                SCENE,
                "scene.ron.part",
                "notes.txt",
                "vtk/0000.vtp",
                "vtk/mine.vtp",
            ] {
                fs::write(folder.path().join(name), "").unwrap();
            }
            spoil(folder.path());
            let outcome = listed.ensure_own(folder.path());
            outcome.err().map(|error| error.to_string())
        };
        assert_eq!(refused(&|_| ()), None);
        for name in [SUMMARY, "Summary.json", "vtk/0001.vtp", "records.bin.part"] {
            let message = refused(&|folder| fs::write(folder.join(name), "").unwrap());
            assert!(message.is_some_and(|m| m.contains(name)), "{name}");
        }
        let folder_for_file = refused(&|folder| {
            fs::remove_file(folder.join(SCENE)).unwrap();
            fs::create_dir(folder.join(SCENE)).unwrap();
        });
        assert!(folder_for_file.is_some_and(|m| m.contains(SCENE)));
    }
}
