//! Manifest of a run directory: the files that a run may replace or remove.
//!
//! A name is listed before its file is written, and only listed files are removed. A run can
//! therefore be killed at any time.

use crate::RunDirectoryError;
use crate::atomic::{self, UNFINISHED};
use crate::json::write_json;
use crate::names::{FILES, MANIFEST, PICTURES, SCENE, SUMMARY, picture_index};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, FileType};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

const FORMAT: &str = "actin run directory";
/// Version of the format; increase it when a key changes.
const VERSION: u32 = 1;

#[derive(Debug, Deserialize)]
struct Head {
    format: String,
    version: u32,
}

#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Manifest {
    format: String,
    version: u32,
    /// CRC-32 (IEEE) of `scene.ron` as written by the run, which detects edits.
    scene_crc32: Option<u32>,
    /// CRC-32 of other texts by name: current contents and contents about to be published.
    #[serde(default)]
    crc32: BTreeMap<String, BTreeSet<u32>>,
    /// Names of written and planned files, relative to the directory.
    files: BTreeSet<String>,
}

impl Manifest {
    pub(crate) fn new() -> Self {
        Self {
            format: FORMAT.into(),
            version: VERSION,
            scene_crc32: None,
            crc32: BTreeMap::new(),
            files: BTreeSet::new(),
        }
    }

    /// Reads the manifest in `folder` or creates one, and refuses foreign files.
    pub(crate) fn own(folder: &Path) -> Result<Self, RunDirectoryError> {
        let manifest = Self::read(folder)?.unwrap_or_else(Self::new);
        manifest.ensure_own(folder)?;
        Ok(manifest)
    }

    /// Creates a manifest of all files in `folder` that have names of results.
    pub(crate) fn of_all_in(folder: &Path) -> Result<Self, RunDirectoryError> {
        let mut manifest = Self::new();
        manifest.add(found(folder)?.into_iter().map(|entry| entry.name));
        Ok(manifest)
    }

    /// Reads the manifest in `folder`, if it exists.
    ///
    /// # Errors
    /// The file is not a manifest, has another format or version, or lists a name that no run
    /// writes.
    pub(crate) fn read(folder: &Path) -> Result<Option<Self>, RunDirectoryError> {
        let path = folder.join(MANIFEST);
        let refused = |reason| RunDirectoryError::Manifest(path.clone(), reason);
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
                "its version is {version}, but this program reads version {VERSION}"
            ));
        }
        let manifest: Self = serde_json::from_slice(text).map_err(in_words)?;
        match manifest.files.iter().find(|name| !is_of_runs(name)) {
            None => Ok(manifest),
            Some(name) => Err(format!("it lists {name:?}, which no run writes")),
        }
    }

    pub(crate) fn write(&self, folder: &Path) -> Result<(), RunDirectoryError> {
        let path = folder.join(MANIFEST);
        let written = atomic::replace(&path, |out| write_json(self, out));
        written.map_err(RunDirectoryError::io(&path))
    }

    pub(crate) fn add<S: Into<String>>(&mut self, names: impl IntoIterator<Item = S>) {
        self.files.extend(names.into_iter().map(Into::into));
    }

    pub(crate) fn note_scene(&mut self, text: &str) {
        self.scene_crc32 = Some(crc32fast::hash(text.as_bytes()));
    }

    /// Stores the checksums of a text and of its unpublished replacement.
    pub(crate) fn note_text(&mut self, folder: &Path, name: &str) -> Result<(), RunDirectoryError> {
        let path = folder.join(name);
        let known = self.crc32.entry(name.to_owned()).or_default();
        let now = checksum(&path)?;
        known.retain(|sum| Some(*sum) == now);
        known.extend(checksum(&atomic::unfinished(&path))?);
        Ok(())
    }

    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.files.iter().map(String::as_str)
    }

    /// Refuses a folder with unlisted or irregular files under names of results.
    pub(crate) fn ensure_own(&self, folder: &Path) -> Result<(), RunDirectoryError> {
        let pictures = folder.join(PICTURES);
        if fs::symlink_metadata(&pictures).is_ok_and(|data| !data.is_dir()) {
            return Err(RunDirectoryError::NotOfARun(pictures));
        }
        let is_own = |entry: &ResultFile| entry.kind.is_file() && self.files.contains(&entry.name);
        match found(folder)?.into_iter().find(|entry| !is_own(entry)) {
            None => Ok(()),
            Some(ResultFile { path, .. }) => Err(RunDirectoryError::NotOfARun(path)),
        }
    }

    /// Refuses a folder with a text that was changed after the run wrote it.
    pub(crate) fn ensure_unchanged(&self, folder: &Path) -> Result<(), RunDirectoryError> {
        let scene = self.scene_crc32.map(|sum| (SCENE, BTreeSet::from([sum])));
        let others = self.crc32.iter();
        let others = others.map(|(name, known)| (name.as_str(), known.clone()));
        for (name, known) in scene.into_iter().chain(others) {
            let path = folder.join(name);
            if checksum(&path)?.is_some_and(|sum| !known.contains(&sum)) {
                return Err(RunDirectoryError::Changed(path));
            }
        }
        Ok(())
    }

    /// Removes all listed files, complete or not. The summary is removed first, because it marks
    /// the results as complete.
    pub(crate) fn remove_files(&self, folder: &Path) -> Result<(), RunDirectoryError> {
        for name in [SUMMARY].into_iter().chain(self.names()) {
            let path = folder.join(name);
            remove_if_there(&path)?;
            remove_if_there(&atomic::unfinished(&path))?;
        }
        Ok(())
    }
}

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

/// A file, link or folder with the name of a result.
struct ResultFile {
    /// Name in a manifest, without the suffix of incomplete files.
    name: String,
    path: PathBuf,
    kind: FileType,
}

fn found(folder: &Path) -> Result<Vec<ResultFile>, RunDirectoryError> {
    let pictures = folder.join(PICTURES);
    let has_pictures = fs::symlink_metadata(&pictures).is_ok_and(|data| data.is_dir());
    let folders = [(folder, String::new()), (&pictures, format!("{PICTURES}/"))];
    let mut all = Vec::new();
    for (folder, prefix) in folders.iter().take(1 + usize::from(has_pictures)) {
        let io = || RunDirectoryError::io(folder);
        for entry in fs::read_dir(folder).map_err(io())? {
            let entry = entry.map_err(io())?;
            let name = entry.file_name();
            let Some(name) = name.to_str() else { continue };
            let name = name.strip_suffix(UNFINISHED).unwrap_or(name);
            let name = format!("{prefix}{name}");
            // Some file systems ignore case.
            if is_of_runs(&name.to_ascii_lowercase()) {
                let (path, kind) = (entry.path(), entry.file_type().map_err(io())?);
                all.push(ResultFile { name, path, kind });
            }
        }
    }
    Ok(all)
}

fn is_of_runs(name: &str) -> bool {
    FILES.contains(&name) || picture_index(name).is_some()
}

pub(crate) fn remove_if_there(path: &Path) -> Result<(), RunDirectoryError> {
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

    #[test]
    fn manifest_survives_the_round_trip() {
        let folder = tempfile::tempdir().unwrap();
        assert!(Manifest::read(folder.path()).unwrap().is_none());
        let mut written = manifest(&[SCENE, "vtk/0000.vtp", "vtk/12345.vtp"]);
        written.note_scene("Scene()");
        written.write(folder.path()).unwrap();
        let read = Manifest::read(folder.path()).unwrap().unwrap();
        assert_eq!(read.files, written.files);
        assert_eq!(read.scene_crc32, written.scene_crc32);
    }

    #[test]
    fn invalid_manifests_are_refused() {
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
}
