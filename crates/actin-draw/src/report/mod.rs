//! Numbers compared with reference values, and artefacts that contain them together with pictures.
//!
//! ```
//! use actin_draw::report::Row;
//! let row = Row::measured("fig1", "height", "nm", 36.7, "mean of 8");
//! assert_eq!(row.pass, None);
// The reference is 36, with a tolerance of 1.
//! assert_eq!(row.with_paper_value(36.0, 1.0).pass, Some(true));
//! ```

mod printed;

pub use printed::{DEVIATIONS, printed};

use serde::{Deserialize, Deserializer, Serialize};
use std::fs;
use std::path::Path;

/// A string literal. A string that is read from a file is leaked; each artefact is read once.
pub(crate) type Literal = &'static str;

fn literal<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Literal, D::Error> {
    Ok(Box::leak(
        String::deserialize(deserializer)?.into_boxed_str(),
    ))
}

/// Origin of the reference value.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Origin {
    /// Printed in the paper; ours is the result of a simulation.
    Paper,
    /// Printed in the paper; ours follows from other printed numbers without a simulation.
    Derived,
    /// Described in the text of the paper; the bound is ours.
    Words,
    /// Parameter copied from the paper; shown without a verdict.
    Parameter,
    /// A theorem or a symmetry.
    Theory,
    /// An earlier calculation with the same modelling decisions, which checks the arithmetic.
    CrossCheck,
    /// A requirement of this project.
    Bound,
}

impl Origin {
    /// Returns the description in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Paper => "paper",
            Self::Derived => "paper (derived)",
            Self::Words => "paper (text)",
            Self::Parameter => "paper (copied)",
            Self::Theory => "theory",
            Self::CrossCheck => "cross-check",
            Self::Bound => "bound of this report",
        }
    }
}

/// A number of an artefact.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Row {
    /// Figure or table.
    #[serde(deserialize_with = "literal")]
    pub artefact: Literal,
    /// Path of the quantity.
    pub quantity: String,
    /// Unit; empty for a ratio.
    #[serde(deserialize_with = "literal")]
    pub unit: Literal,
    /// Reference value, from the paper or another origin.
    pub paper: Option<f64>,
    /// Computed value.
    pub ours: f64,
    /// Largest accepted difference.
    pub tolerance: Option<f64>,
    /// Verdict; `None` without a reference value.
    pub pass: Option<bool>,
    /// Description of the computation.
    pub note: String,
    /// Origin of `paper` or of the bound.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub origin: Option<Origin>,
    /// Standard error of a fitted parameter, which limits the effect of round-off on it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub standard_error: Option<f64>,
}

impl Row {
    /// Creates a row without a reference value.
    pub fn measured(
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
            origin: None,
            standard_error: None,
        }
    }

    /// Adds a reference value that is printed in the paper.
    #[must_use]
    pub fn with_paper_value(self, paper: f64, tolerance: f64) -> Self {
        Self {
            origin: Some(Origin::Paper),
            paper: Some(paper),
            tolerance: Some(tolerance),
            pass: Some((self.ours - paper).abs() <= tolerance),
            ..self
        }
    }

    /// Sets the origin of the reference value.
    #[must_use]
    pub fn with_origin(self, origin: Origin) -> Self {
        Self {
            origin: Some(origin),
            ..self
        }
    }
}

/// A picture with its caption.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Picture {
    /// File name in the output folder.
    pub file: String,
    /// Caption.
    pub caption: String,
}

/// States for the interactive viewer.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct View {
    /// JSON file in the output folder.
    pub file: String,
    /// Caption.
    pub caption: String,
}

/// A computed figure or table.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Artefact {
    /// Identifier, such as `fig4`.
    #[serde(deserialize_with = "literal")]
    pub id: Literal,
    /// Title.
    #[serde(deserialize_with = "literal")]
    pub title: Literal,
    /// Settings of the computation: scenes, stop rule, seeds.
    pub settings: String,
    /// Numbers.
    pub rows: Vec<Row>,
    /// Pictures.
    pub pictures: Vec<Picture>,
    /// States for the viewer.
    pub views: Vec<View>,
    /// Run time (s).
    pub wall_s: f64,
}

/// Writes `report.json`, with one sorted row per line.
///
/// # Errors
/// Errors of [`text`], a verdict without an origin, or a verdict on a copied parameter, which cannot fail.
pub fn write(artefacts: &[Artefact], out: &Path) -> Result<(), String> {
    let rows: Vec<Row> = artefacts.iter().flat_map(|a| a.rows.clone()).collect();
    let is_unfounded =
        |row: &&Row| row.pass.is_some() && matches!(row.origin, None | Some(Origin::Parameter));
    if let Some(row) = rows.iter().find(is_unfounded) {
        let Row {
            artefact, quantity, ..
        } = row;
        return Err(format!(
            "{artefact} {quantity}: a verdict requires an origin other than a copied parameter"
        ));
    }
    write_atomically(&out.join("report.json"), &text(rows)?)
}

/// Returns the text of a report.
///
/// # Errors
/// If a number is not finite, or a quantity occurs twice.
pub fn text(mut rows: Vec<Row>) -> Result<String, String> {
    rows.sort_by(|a, b| (a.artefact, &a.quantity).cmp(&(b.artefact, &b.quantity)));
    if let Some(bad) = rows.iter().find(|row| !row.ours.is_finite()) {
        return Err(format!(
            "{} {} is {}: numbers in a report must be finite",
            bad.artefact, bad.quantity, bad.ours
        ));
    }
    let is_twice = |w: &&[Row]| (w[0].artefact, &w[0].quantity) == (w[1].artefact, &w[1].quantity);
    if let Some([twice, ..]) = rows.windows(2).find(is_twice) {
        let Row {
            artefact, quantity, ..
        } = twice;
        return Err(format!(
            "{artefact} {quantity} occurs twice: names of rows must be unique"
        ));
    }
    let lines: Vec<String> = rows
        .iter()
        .map(|row| serde_json::to_string(row).map_err(|e| e.to_string()))
        .collect::<Result<_, _>>()?;
    Ok(format!("[\n{}\n]\n", lines.join(",\n")))
}

/// Reads a report.
///
/// # Errors
/// If the file cannot be read or is not a report.
pub fn read(path: &Path) -> Result<Vec<Row>, String> {
    let text = fs::read_to_string(path).map_err(|e| format!("{}: {e}", path.display()))?;
    serde_json::from_str(&text).map_err(|e| format!("{}: {e}", path.display()))
}

/// Writes a file under another name and renames it, so that it is never incomplete.
///
/// # Errors
/// If the file cannot be written.
pub fn write_atomically(path: &Path, text: &str) -> Result<(), String> {
    let unfinished = path.with_extension("unfinished");
    fs::write(&unfinished, text).map_err(|e| format!("{}: {e}", unfinished.display()))?;
    fs::rename(&unfinished, path).map_err(|e| format!("{}: {e}", path.display()))
}

/// Writes a table with a header as CSV.
///
/// # Errors
/// If the file cannot be written.
pub fn write_csv(
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
///
/// # Errors
/// If the file cannot be written.
pub fn save(out: &Path, name: &str, text: &str) -> Result<(), String> {
    let path = out.join(name);
    fs::write(&path, text).map_err(|e| format!("{}: {e}", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows without an origin can be read and written, but a verdict without an origin is an error.
    #[test]
    fn verdicts_need_an_origin() {
        let row = Row::measured("fig1", "q", "nm", 1.0, "");
        let json = serde_json::to_string(&row).unwrap();
        assert!(json.ends_with("\"note\":\"\"}"), "{json}");
        assert_eq!(serde_json::from_str::<Row>(&json).unwrap(), row);
        let theory = row.with_paper_value(2.0, 0.5).with_origin(Origin::Theory);
        let json = serde_json::to_string(&theory).unwrap();
        assert!(json.ends_with(",\"origin\":\"theory\"}"), "{json}");
        let folder = tempfile::tempdir().unwrap();
        let written = |origin| {
            let row = Row {
                origin,
                ..theory.clone()
            };
            let artefact = Artefact {
                id: "fig1",
                title: "",
                settings: String::new(),
                rows: vec![row],
                pictures: Vec::new(),
                views: Vec::new(),
                wall_s: 0.0,
            };
            write(&[artefact], folder.path())
        };
        assert!(written(None).unwrap_err().contains("fig1 q"));
        assert!(written(Some(Origin::Parameter)).is_err());
        assert_eq!(written(Some(Origin::Theory)), Ok(()));
    }
}
