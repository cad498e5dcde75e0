//! `report.json`: what the paper says, what we compute, and whether the two agree.

use serde::Serialize;
use std::fs;
use std::path::Path;

/// One number of an artefact.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Row {
    /// Which figure or table.
    pub artefact: &'static str,
    /// Path of the quantity.
    pub quantity: String,
    /// Unit; empty for a ratio.
    pub unit: &'static str,
    /// What the paper (or, where the note says so, a theory) gives.
    pub paper: Option<f64>,
    /// What this run computed.
    pub ours: f64,
    /// Largest difference that passes.
    pub tolerance: Option<f64>,
    /// Verdict; none where nothing is given to compare with.
    pub pass: Option<bool>,
    /// How the number came about.
    pub note: String,
}

impl Row {
    /// A number with nothing to compare it to.
    pub(super) fn measured(
        artefact: &'static str,
        quantity: impl Into<String>,
        unit: &'static str,
        ours: f64,
        note: impl Into<String>,
    ) -> Self {
        Self {
            artefact,
            quantity: quantity.into(),
            unit,
            paper: None,
            ours,
            tolerance: None,
            pass: None,
            note: note.into(),
        }
    }

    /// The same number, compared to `paper`.
    pub(super) fn against(self, paper: f64, tolerance: f64) -> Self {
        Self {
            paper: Some(paper),
            tolerance: Some(tolerance),
            pass: Some((self.ours - paper).abs() <= tolerance),
            ..self
        }
    }
}

/// A picture with its caption.
#[derive(Clone, Debug)]
pub(super) struct Picture {
    /// File name in the output folder.
    pub file: String,
    /// What is seen.
    pub caption: String,
}

/// States to be turned in the page's viewer.
#[derive(Clone, Debug)]
pub(super) struct View {
    /// A JSON file in the output folder.
    pub file: String,
    /// What is seen.
    pub caption: String,
}

/// A figure or table of the paper, computed.
#[derive(Clone, Debug)]
pub(super) struct Artefact {
    /// Which.
    pub id: &'static str,
    /// Its title, in our words.
    pub title: &'static str,
    /// How it was made: scenes, stop rule, seeds.
    pub settings: String,
    /// Numbers.
    pub rows: Vec<Row>,
    /// Pictures.
    pub pictures: Vec<Picture>,
    /// States for the viewer.
    pub views: Vec<View>,
    /// Time that it took (s).
    pub wall_s: f64,
}

/// Writes `report.json` and `report.csv`.
pub(super) fn write(artefacts: &[Artefact], out: &Path) -> Result<(), String> {
    let rows: Vec<&Row> = artefacts.iter().flat_map(|a| &a.rows).collect();
    if let Some(bad) = rows.iter().find(|row| !row.ours.is_finite()) {
        return Err(format!(
            "{} {} is {}: nothing non-finite is written",
            bad.artefact, bad.quantity, bad.ours
        ));
    }
    let json = serde_json::to_string_pretty(&rows).map_err(|e| e.to_string())?;
    save(out, "report.json", &json)
}

/// Writes a table of numbers under a header.
pub(crate) fn write_csv(
    out: &Path,
    name: &str,
    header: &[&str],
    rows: impl IntoIterator<Item = Vec<String>>,
) -> Result<(), String> {
    let path = out.join(name);
    let fail = |e: csv::Error| format!("{}: {e}", path.display());
    let mut writer = csv::Writer::from_path(&path).map_err(fail)?;
    writer.write_record(header).map_err(fail)?;
    for row in rows {
        writer.write_record(&row).map_err(fail)?;
    }
    writer
        .flush()
        .map_err(|e| format!("{}: {e}", path.display()))
}

/// Writes a text file.
pub(crate) fn save(out: &Path, name: &str, text: &str) -> Result<(), String> {
    let path = out.join(name);
    fs::write(&path, text).map_err(|e| format!("{}: {e}", path.display()))
}
