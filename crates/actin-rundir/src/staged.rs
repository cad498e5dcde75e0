//! New files of a run, renamed together after all of them are on the disk.

use crate::RunDirectoryError;
use crate::atomic::{self, sync, unfinished};
use crate::manifest::{Manifest, remove_if_there};
use crate::names::{PICTURES, SUMMARY, TABLES, picture_index};
use std::fs::{self, File};
use std::io::{self, BufWriter};
use std::path::Path;

/// Files that await their final names; dropping removes the unpublished ones.
pub(crate) struct Staged<'a> {
    folder: &'a Path,
    names: Vec<String>,
    published: usize,
}

impl<'a> Staged<'a> {
    pub(crate) fn new(folder: &'a Path) -> Self {
        Self {
            folder,
            names: Vec::new(),
            published: 0,
        }
    }

    pub(crate) fn file(
        &mut self,
        name: impl Into<String>,
        fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
    ) -> Result<(), RunDirectoryError> {
        let name = name.into();
        let path = self.folder.join(&name);
        atomic::write_new(&unfinished(&path), fill).map_err(RunDirectoryError::io(&path))?;
        self.names.push(name);
        Ok(())
    }

    /// Waits until all files are on the disk, renames them in the order of writing and removes
    /// pictures of an earlier, longer run.
    pub(crate) fn publish(mut self, mut manifest: Manifest) -> Result<(), RunDirectoryError> {
        let paths = self.names.iter().map(|name| self.folder.join(name));
        let paths: Vec<_> = paths.collect();
        let staged: Vec<_> = paths.iter().map(|path| unfinished(path)).collect();
        atomic::sync_all(&staged)?;
        self.note_tables(&mut manifest)?;
        remove_if_there(&self.folder.join(SUMMARY))?;
        let pictures = self.names.iter().filter_map(|name| picture_index(name));
        let pictures = pictures.count();
        let is_old = |name: &&str| picture_index(name).is_some_and(|i| i >= pictures);
        for name in manifest.names().filter(is_old) {
            remove_if_there(&self.folder.join(name))?;
        }
        for (staged, path) in staged.iter().zip(&paths) {
            fs::rename(staged, path).map_err(RunDirectoryError::io(path))?;
            self.published += 1;
        }
        // Drops the checksums of replaced tables.
        self.note_tables(&mut manifest)?;
        let pictures = self.folder.join(PICTURES);
        for folder in [pictures.as_path(), self.folder]
            .iter()
            .filter(|f| f.exists())
        {
            sync(folder).map_err(RunDirectoryError::io(folder))?;
        }
        Ok(())
    }

    /// Stores the checksums of the new tables in the manifest, so that later edits are detected.
    fn note_tables(&self, manifest: &mut Manifest) -> Result<(), RunDirectoryError> {
        let tables = self.names.iter().map(String::as_str);
        for name in tables.filter(|name| TABLES.contains(name)) {
            manifest.note_text(self.folder, name)?;
        }
        manifest.write(self.folder)
    }
}

impl Drop for Staged<'_> {
    fn drop(&mut self) {
        for name in &self.names[self.published..] {
            // The error has already been reported.
            let _ = fs::remove_file(unfinished(&self.folder.join(name)));
        }
    }
}
