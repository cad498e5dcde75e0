//! Sequential reading of the arrays of `states.npz`.

use crate::RunDirectoryError;
use npyz::{NpyFile, Order};
use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom, Take};
use std::path::{Path, PathBuf};
use zip::{CompressionMethod, ZipArchive};

#[derive(Debug)]
pub(crate) struct Arrays {
    path: PathBuf,
    archive: std::cell::RefCell<ZipArchive<BufReader<File>>>,
}

impl Arrays {
    pub(crate) fn open(path: PathBuf) -> Result<Self, RunDirectoryError> {
        let file = File::open(&path).map_err(RunDirectoryError::io(&path))?;
        let archive = ZipArchive::new(BufReader::new(file))
            .map_err(|error| RunDirectoryError::damaged(&path, &error))?;
        let archive = std::cell::RefCell::new(archive);
        Ok(Self { path, archive })
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Opens an array with values of `shape` for each record. `records` is the expected number, if
    /// known.
    ///
    /// # Errors
    /// The array is missing or compressed, or has another type or shape.
    pub(crate) fn open_array(
        &self,
        name: &str,
        records: Option<usize>,
        shape: &[usize],
    ) -> Result<Array, RunDirectoryError> {
        let refused =
            |reason: String| RunDirectoryError::damaged(&self.path, &format!("{name}: {reason}"));
        let (start, size) = self.place(name)?;
        let open = || -> std::io::Result<_> {
            let mut file = File::open(&self.path)?;
            file.seek(SeekFrom::Start(start))?;
            NpyFile::new(BufReader::new(file).take(size))
        };
        let array = open().map_err(|error| refused(error.to_string()))?;
        let found = array.shape().to_vec();
        let of_record = shape.iter().map(|&n| n as u64);
        let records = records.map_or_else(|| found.first().copied().unwrap_or(0), |n| n as u64);
        let expected: Vec<u64> = std::iter::once(records).chain(of_record).collect();
        if found != expected || array.order() != Order::C {
            let reason =
                format!("{name} has the shape {found:?}, but the scene requires {expected:?}");
            return Err(RunDirectoryError::OtherBodies(self.path.clone(), reason));
        }
        let values = array
            .data::<f64>()
            .map_err(|error| refused(error.to_string()))?;
        Ok(Array {
            path: self.path.clone(),
            name: name.to_owned(),
            width: shape.iter().product(),
            values,
        })
    }

    fn place(&self, name: &str) -> Result<(u64, u64), RunDirectoryError> {
        let refused =
            |reason: String| RunDirectoryError::damaged(&self.path, &format!("{name}: {reason}"));
        let mut archive = self.archive.borrow_mut();
        let entry = archive.by_name(&format!("{name}.npy"));
        let entry = entry.map_err(|error| refused(error.to_string()))?;
        match (entry.compression(), entry.data_start()) {
            (CompressionMethod::Stored, Some(start)) => Ok((start, entry.size())),
            _ => Err(refused(
                "is compressed, but arrays of a run are not".to_owned(),
            )),
        }
    }
}

pub(crate) struct Array {
    path: PathBuf,
    name: String,
    /// Number of values in a record.
    width: usize,
    values: npyz::NpyReader<f64, Take<BufReader<File>>>,
}

impl Array {
    fn next(&mut self) -> Result<f64, RunDirectoryError> {
        match self.values.next() {
            Some(Ok(value)) if value.is_finite() => Ok(value),
            Some(Ok(value)) => Err(self.damaged(&format!("holds {value}"))),
            Some(Err(error)) => Err(self.damaged(&error.to_string())),
            None => Err(self.damaged("ends too early")),
        }
    }

    /// Reads the values of the next record after `skipped` records.
    pub(crate) fn record(&mut self, skipped: usize) -> Result<Vec<f64>, RunDirectoryError> {
        for _ in 0..skipped * self.width {
            self.next()?;
        }
        (0..self.width).map(|_| self.next()).collect()
    }

    pub(crate) fn damaged(&self, reason: &str) -> RunDirectoryError {
        RunDirectoryError::damaged(&self.path, &format!("{}: {reason}", self.name))
    }

    pub(crate) fn read_all(mut self) -> Result<Vec<f64>, RunDirectoryError> {
        (0..self.values.len()).map(|_| self.next()).collect()
    }
}

impl std::fmt::Debug for Array {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Array")
            .field("path", &self.path)
            .field("name", &self.name)
            .finish_non_exhaustive()
    }
}
