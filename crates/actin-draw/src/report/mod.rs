//! Numbers beside what is expected of them: rows with verdicts, artefacts that hold them with their
//! pictures, and the files that they are kept in.
//!
//! ```
//! use actin_draw::report::Row;
//! let row = Row::measured("fig1", "height", "nm", 36.7, "mean of 8");
//! assert_eq!(row.pass, None);
//! // 36 is printed; two may be off by 1.
//! assert_eq!(row.against(36.0, 1.0).pass, Some(true));
//! ```

mod printed;

pub use printed::{DEVIATIONS, printed};

use serde::{Deserialize, Deserializer, Serialize};
use std::fs;
use std::path::Path;

/// A text that recipes write as a literal; read from a file it lives as long as the program, which
/// reads each artefact once.
pub type Literal = &'static str;

fn literal<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Literal, D::Error> {
    Ok(Box::leak(
        String::deserialize(deserializer)?.into_boxed_str(),
    ))
}

/// Where the number comes from that another is compared with.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Origin {
    /// The paper prints it, and a simulation gives ours.
    Paper,
    /// The paper prints it, and it follows from other printed numbers: no simulation has a part in it.
    Derived,
    /// The paper says it in words; the bound that decides is ours.
    Words,
    /// The code holds it as the paper gives it: it is shown, and no row is judged by it.
    Parameter,
    /// A theorem, or a symmetry.
    Theory,
    /// An earlier calculation that shares the modelling decisions of this code: a check of the arithmetic.
    CrossCheck,
    /// Asked for here.
    Bound,
}

impl Origin {
    /// In a table of rows.
    pub fn name(self) -> &'static str {
        match self {
            Self::Paper => "paper",
            Self::Derived => "paper, from its own numbers",
            Self::Words => "paper, in words",
            Self::Parameter => "paper, copied",
            Self::Theory => "theory",
            Self::CrossCheck => "cross-check",
            Self::Bound => "bound set here",
        }
    }
}

/// One number of an artefact.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Row {
    /// Which figure or table.
    #[serde(deserialize_with = "literal")]
    pub artefact: Literal,
    /// Path of the quantity.
    pub quantity: String,
    /// Unit; empty for a ratio.
    #[serde(deserialize_with = "literal")]
    pub unit: Literal,
    /// What the paper, or another origin, gives.
    pub paper: Option<f64>,
    /// What this run computed.
    pub ours: f64,
    /// Largest difference that passes.
    pub tolerance: Option<f64>,
    /// Verdict; none where nothing is given to compare with.
    pub pass: Option<bool>,
    /// How the number came about.
    pub note: String,
    /// Where `paper`, or the bound that decides, comes from.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub origin: Option<Origin>,
    /// Standard error of a fitted parameter, which bounds how well rounding determines it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub standard_error: Option<f64>,
}

impl Row {
    /// A number with nothing to compare it to.
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

    /// The same number, compared to `paper`, which the paper prints.
    #[must_use]
    pub fn against(self, paper: f64, tolerance: f64) -> Self {
        Self {
            origin: Some(Origin::Paper),
            paper: Some(paper),
            tolerance: Some(tolerance),
            pass: Some((self.ours - paper).abs() <= tolerance),
            ..self
        }
    }

    /// The same, with another origin of what it is compared with.
    #[must_use]
    pub fn of(self, origin: Origin) -> Self {
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
    /// What is seen.
    pub caption: String,
}

/// States to be turned in the page's viewer.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct View {
    /// A JSON file in the output folder.
    pub file: String,
    /// What is seen.
    pub caption: String,
}

/// A figure or table, computed.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Artefact {
    /// Which.
    #[serde(deserialize_with = "literal")]
    pub id: Literal,
    /// Its title, in our words.
    #[serde(deserialize_with = "literal")]
    pub title: Literal,
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

/// Writes `report.json`: all rows, sorted, one a line.
///
/// # Errors
/// Those of [`text`], a verdict that does not say who expects its number, and one on a parameter that
/// was copied, which cannot fail.
pub fn write(artefacts: &[Artefact], out: &Path) -> Result<(), String> {
    let rows: Vec<Row> = artefacts.iter().flat_map(|a| a.rows.clone()).collect();
    let is_unfounded =
        |row: &&Row| row.pass.is_some() && matches!(row.origin, None | Some(Origin::Parameter));
    if let Some(row) = rows.iter().find(is_unfounded) {
        let Row {
            artefact, quantity, ..
        } = row;
        return Err(format!(
            "{artefact} {quantity} has a verdict on a copied number, or without an origin"
        ));
    }
    write_atomically(&out.join("report.json"), &text(rows)?)
}

/// The text of a report.
///
/// # Errors
/// A row whose number is not finite, and two rows of one quantity.
pub fn text(mut rows: Vec<Row>) -> Result<String, String> {
    rows.sort_by(|a, b| (a.artefact, &a.quantity).cmp(&(b.artefact, &b.quantity)));
    if let Some(bad) = rows.iter().find(|row| !row.ours.is_finite()) {
        return Err(format!(
            "{} {} is {}: nothing non-finite is written",
            bad.artefact, bad.quantity, bad.ours
        ));
    }
    let is_twice = |w: &&[Row]| (w[0].artefact, &w[0].quantity) == (w[1].artefact, &w[1].quantity);
    if let Some([twice, ..]) = rows.windows(2).find(is_twice) {
        let Row {
            artefact, quantity, ..
        } = twice;
        return Err(format!("{artefact} {quantity} is written twice"));
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
/// A file that cannot be read or is no report.
pub fn read(path: &Path) -> Result<Vec<Row>, String> {
    let text = fs::read_to_string(path).map_err(|e| format!("{}: {e}", path.display()))?;
    serde_json::from_str(&text).map_err(|e| format!("{}: {e}", path.display()))
}

/// Writes a text under another name and renames it, so that the file is whole or not there.
///
/// # Errors
/// A file that cannot be written.
pub fn write_atomically(path: &Path, text: &str) -> Result<(), String> {
    let unfinished = path.with_extension("unfinished");
    fs::write(&unfinished, text).map_err(|e| format!("{}: {e}", unfinished.display()))?;
    fs::rename(&unfinished, path).map_err(|e| format!("{}: {e}", path.display()))
}

/// Writes a table of numbers under a header, as CSV.
///
/// # Errors
/// A file that cannot be written.
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
/// A file that cannot be written.
pub fn save(out: &Path, name: &str, text: &str) -> Result<(), String> {
    let path = out.join(name);
    fs::write(&path, text).map_err(|e| format!("{}: {e}", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A row without an origin is read and written as before there were any; a verdict without one is
    /// not reported.
    #[test]
    fn verdicts_need_an_origin() {
        let row = Row::measured("fig1", "q", "nm", 1.0, "");
        let json = serde_json::to_string(&row).unwrap();
        assert!(json.ends_with("\"note\":\"\"}"), "{json}");
        assert_eq!(serde_json::from_str::<Row>(&json).unwrap(), row);
        let theory = row.against(2.0, 0.5).of(Origin::Theory);
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
