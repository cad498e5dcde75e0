//! File names of a sweep directory, and atomic writing.

use crate::SweepError;
use actin_rundir::replace_file;
use std::fs;
use std::io::Write;
use std::path::Path;

pub(crate) const SWEEP: &str = "sweep.ron";
pub(crate) const SCENE: &str = "scene.ron";
pub(crate) const PARAMETERS: &str = "parameters.csv";
pub(crate) const MANIFEST: &str = "actin-sweep.json";
pub(crate) const RUNS: &str = "runs.csv";
pub(crate) const TABLE: &str = "table.csv";
pub(crate) const SNAKEFILE: &str = "Snakefile";
pub(crate) const PROFILE: &str = "profiles/default/config.yaml";

/// Replaces a file atomically. Several processes may write the same file.
pub(crate) fn replace(folder: &Path, name: &str, contents: &[u8]) -> Result<(), SweepError> {
    let path = folder.join(name);
    let part = format!(".{}.{}.part", name.replace('/', "-"), std::process::id());
    let part = folder.join(part);
    let above = path.parent().map_or(Ok(()), fs::create_dir_all);
    let written = above.and_then(|()| replace_file(&path, &part, |out| out.write_all(contents)));
    written.map_err(SweepError::io(&path))
}

pub(crate) fn csv<R, C>(rows: R) -> Vec<u8>
where
    R: IntoIterator<Item = C>,
    C: IntoIterator<Item = String>,
{
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        let row: Vec<String> = row.into_iter().collect();
        writer
            .write_record(&row)
            .expect("all rows have the same length");
    }
    writer.into_inner().expect("writing to memory cannot fail")
}
