//! New files of a run, renamed together after all of them are on the disk.

use crate::RunDirectoryError;
use crate::atomic::{self, sync, sync_all};
use crate::manifest::{Manifest, remove_if_there};
use crate::names::{PICTURES, SUMMARY, TABLES, picture_index, picture_name};
use std::fs::{self, File};
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};

/// Files that await their final names; dropping removes the unpublished ones.
///
/// Pictures are renamed first, then the other files in the order of writing.
pub(crate) struct Staged<'a> {
    pub(crate) folder: &'a Path,
    pictures: usize,
    files: Vec<PathBuf>,
    published: usize,
}

impl<'a> Staged<'a> {
    pub(crate) fn new(folder: &'a Path) -> Self {
        Self {
            folder,
            pictures: 0,
            files: Vec::new(),
            published: 0,
        }
    }

    pub(crate) fn file(
        &mut self,
        name: &str,
        fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
    ) -> Result<(), RunDirectoryError> {
        let path = self.folder.join(name);
        atomic::stage(&path, fill).map_err(RunDirectoryError::io(&path))?;
        self.files.push(path);
        Ok(())
    }

    pub(crate) fn picture(
        &mut self,
        fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
    ) -> Result<(), RunDirectoryError> {
        let path = self.folder.join(picture_name(self.pictures));
        atomic::stage(&path, fill).map_err(RunDirectoryError::io(&path))?;
        self.pictures += 1;
        Ok(())
    }

    fn count(&self) -> usize {
        self.pictures + self.files.len()
    }

    fn path(&self, i: usize) -> PathBuf {
        match i.checked_sub(self.pictures) {
            Some(file) => self.files[file].clone(),
            None => self.folder.join(picture_name(i)),
        }
    }

    /// Waits until all files are on the disk, renames them and removes surplus pictures of an
    /// earlier, longer run.
    pub(crate) fn publish(mut self) -> Result<(), RunDirectoryError> {
        let unfinished = |i| atomic::unfinished(&self.path(i));
        sync_all(self.count(), unfinished)
            .map_err(|(p, error)| RunDirectoryError::io(&p)(error))?;
        self.note_tables()?;
        remove_if_there(&self.folder.join(SUMMARY))?;
        self.remove_old_pictures()?;
        for i in 0..self.count() {
            let path = self.path(i);
            atomic::publish(&path).map_err(RunDirectoryError::io(&path))?;
            self.published += 1;
        }
        // Drops the checksums of replaced tables.
        self.note_tables()?;
        let pictures = (self.pictures > 0).then(|| self.folder.join(PICTURES));
        for folder in pictures.iter().map(PathBuf::as_path).chain([self.folder]) {
            sync(folder).map_err(RunDirectoryError::io(folder))?;
        }
        Ok(())
    }

    /// Stores the checksums of the new tables in the manifest, so that later edits are detected.
    fn note_tables(&self) -> Result<(), RunDirectoryError> {
        let Some(mut manifest) = Manifest::read(self.folder)? else {
            return Ok(());
        };
        let is_staged = |name: &&&str| self.files.contains(&self.folder.join(name));
        for name in TABLES.iter().filter(is_staged) {
            manifest.note_text(self.folder, name)?;
        }
        manifest.write(self.folder)
    }

    fn remove_old_pictures(&self) -> Result<(), RunDirectoryError> {
        let manifest = Manifest::read(self.folder)?;
        let listed = manifest.iter().flat_map(Manifest::names);
        listed
            .filter(|name| picture_index(name).is_some_and(|i| i >= self.pictures))
            .try_for_each(|name| remove_if_there(&self.folder.join(name)))
    }
}

impl Drop for Staged<'_> {
    fn drop(&mut self) {
        for i in self.published..self.count() {
            // The error has already been reported.
            let _ = fs::remove_file(atomic::unfinished(&self.path(i)));
        }
    }
}
