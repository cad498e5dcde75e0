//! JSON files of a run directory.

use crate::RunDirectoryError;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fs;
use std::io::{self, Write};
use std::path::Path;

pub(crate) fn write_json(value: &impl Serialize, out: &mut impl Write) -> io::Result<()> {
    serde_json::to_writer_pretty(&mut *out, value)?;
    writeln!(out)
}

pub(crate) fn read_json<T: DeserializeOwned>(path: &Path) -> Result<T, RunDirectoryError> {
    let text = fs::read_to_string(path).map_err(RunDirectoryError::io(path))?;
    serde_json::from_str(&text).map_err(|error| RunDirectoryError::damaged(path, &error))
}
