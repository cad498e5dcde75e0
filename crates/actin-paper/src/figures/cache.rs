//! Cache of finished artefacts in the output folder.
//!
//! An entry is valid until program, scenes or settings change. Each artefact is computed in a temporary folder. Its
//! files are then moved to the output folder, and a record with a hash of each file is written last. An interrupted
//! computation leaves no record and is repeated.

use crate::workspace_root;
use actin_draw::report::{Artefact, write_atomically};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};

const FOLDER: &str = ".artefacts";

#[derive(Debug, Deserialize, Serialize)]
pub(super) struct CachedArtefact {
    fingerprint: String,
    files: BTreeMap<String, String>,
    pub runs: u64,
    pub artefact: Artefact,
}

#[derive(Debug)]
pub(super) struct Cache<'a> {
    out: &'a Path,
    fingerprint: String,
}

impl<'a> Cache<'a> {
    /// Opens the cache in `out`. Entries with another fingerprint are outdated.
    pub(super) fn new(out: &'a Path, fingerprint: String) -> Result<Self, String> {
        let folder = out.join(FOLDER);
        fs::create_dir_all(&folder).map_err(|e| at(&folder, &e))?;
        Ok(Self { out, fingerprint })
    }

    /// Finds a valid artefact; the error is the reason to compute it.
    pub(super) fn find(&self, id: &str) -> Result<CachedArtefact, String> {
        let cached = self.read(id)?;
        if cached.fingerprint != self.fingerprint {
            return Err("program, scenes or settings have changed".into());
        }
        for (name, hash) in &cached.files {
            match fs::read(self.out.join(name)) {
                Err(_) => return Err(format!("{name} is missing")),
                Ok(bytes) if hash_of(&bytes) != *hash => {
                    return Err(format!("{name} has been changed"));
                }
                Ok(_) => {}
            }
        }
        Ok(cached)
    }

    /// Computes an artefact and replaces the cached one. `work` also returns the number of runs.
    pub(super) fn compute(
        &self,
        id: &str,
        work: impl FnOnce(&Path) -> Result<(Artefact, u64), String>,
    ) -> Result<CachedArtefact, String> {
        self.remove(id)?;
        let folder = self.unfinished(id);
        fs::create_dir_all(&folder).map_err(|e| at(&folder, &e))?;
        let (artefact, runs) = work(&folder)?;
        let cached = CachedArtefact {
            fingerprint: self.fingerprint.clone(),
            files: self.take_files(&folder)?,
            runs,
            artefact,
        };
        let json = serde_json::to_string_pretty(&cached).map_err(|e| e.to_string())?;
        write_atomically(&self.record(id), &json)?;
        Ok(cached)
    }

    fn record(&self, id: &str) -> PathBuf {
        self.out.join(FOLDER).join(format!("{id}.json"))
    }

    fn unfinished(&self, id: &str) -> PathBuf {
        self.out.join(FOLDER).join(format!("{id}.new"))
    }

    fn read(&self, id: &str) -> Result<CachedArtefact, String> {
        let path = self.record(id);
        if !path.exists() {
            return Err("not computed before".into());
        }
        let text = fs::read_to_string(&path).map_err(|e| e.to_string());
        let read = text.and_then(|text| serde_json::from_str(&text).map_err(|e| e.to_string()));
        read.map_err(|error| format!("its record cannot be read: {error}"))
    }

    /// Removes the record, its files and the temporary folder of an interrupted computation.
    fn remove(&self, id: &str) -> Result<(), String> {
        let unfinished = self.unfinished(id);
        if unfinished.exists() {
            fs::remove_dir_all(&unfinished).map_err(|e| at(&unfinished, &e))?;
        }
        let old = self.read(id).map(|cached| cached.files).unwrap_or_default();
        let files = old.keys().map(|name| self.out.join(name));
        for path in [self.record(id)].into_iter().chain(files) {
            if path.is_file() {
                fs::remove_file(&path).map_err(|e| at(&path, &e))?;
            }
        }
        Ok(())
    }

    /// Moves all files of `folder` to the output folder. Returns their hashes by name.
    fn take_files(&self, folder: &Path) -> Result<BTreeMap<String, String>, String> {
        let mut files = BTreeMap::new();
        for entry in fs::read_dir(folder).map_err(|e| at(folder, &e))? {
            let path = entry.map_err(|e| at(folder, &e))?.path();
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            let bytes = read(&path)?;
            fs::rename(&path, self.out.join(&*name)).map_err(|e| at(&path, &e))?;
            files.insert(name.into_owned(), hash_of(&bytes));
        }
        fs::remove_dir(folder).map_err(|e| at(folder, &e))?;
        Ok(files)
    }
}

pub(super) fn fingerprint(choices: &str) -> Result<String, String> {
    let mut hasher = DefaultHasher::new();
    env!("CARGO_PKG_VERSION").hash(&mut hasher);
    choices.hash(&mut hasher);
    let program = std::env::current_exe().map_err(|e| e.to_string())?;
    read(&program)?.hash(&mut hasher);
    for path in scenes()? {
        path.hash(&mut hasher);
        read(&path)?.hash(&mut hasher);
    }
    Ok(format!("{:016x}", hasher.finish()))
}

fn read(path: &Path) -> Result<Vec<u8>, String> {
    fs::read(path).map_err(|e| at(path, &e))
}

fn scenes() -> Result<Vec<PathBuf>, String> {
    let mut folders = vec![workspace_root().join("scenarios")];
    let mut all = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).map_err(|e| at(&folder, &e))? {
            let path = entry.map_err(|e| at(&folder, &e))?.path();
            let list = if path.is_dir() {
                &mut folders
            } else {
                &mut all
            };
            list.push(path);
        }
    }
    all.sort();
    Ok(all)
}

/// Hash that guards against accidental changes only. Other builds may give other values.
fn hash_of(bytes: &[u8]) -> String {
    let mut hasher = DefaultHasher::new();
    bytes.hash(&mut hasher);
    format!("{:016x}", hasher.finish())
}

fn at(path: &Path, error: &std::io::Error) -> String {
    format!("{}: {error}", path.display())
}
