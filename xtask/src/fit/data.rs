//! What is fitted: tables of B3 and of the change of length against twist, with their source.

use crate::figures::paper::{Table, entries};
use std::path::Path;

/// Values against twist (rad/nm, positive in over-twist).
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Column {
    pub twist: Vec<f64>,
    pub value: Vec<f64>,
}

/// A filament's twist in two columns.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TwistData {
    /// Where the numbers come from, in words.
    pub source: String,
    /// Secant twisting rigidity (pN nm^2).
    pub rigidity: Column,
    /// Relative change of length.
    pub length: Column,
}

/// Fewest values of a column: one more than the seven parameters of the largest forms.
const FEWEST: usize = 8;

impl Column {
    pub(super) fn push(&mut self, twist: f64, value: f64) {
        self.twist.push(twist);
        self.value.push(value);
    }

    /// Largest twist to either side.
    pub(crate) fn range(&self) -> f64 {
        self.twist.iter().fold(0.0, |most, k| k.abs().max(most))
    }
}

impl TwistData {
    /// Tables 3 and 5, without the rows that the paper calls unreliable unless `all_rows`.
    pub(crate) fn from_paper(all_rows: bool) -> Result<Self, String> {
        let column = |table| -> Result<Column, String> {
            let mut column = Column::default();
            for entry in entries(table)? {
                if all_rows || entry.is_reliable() {
                    column.push(entry.curvature, entry.value);
                }
            }
            Ok(column)
        };
        let rows = if all_rows {
            "all rows"
        } else {
            "rows to 200 deg"
        };
        Ok(Self {
            source: format!("Tables 3 and 5 of the paper, {rows}"),
            rigidity: column(Table::Rigidity)?,
            length: column(Table::LengthChange)?,
        })
    }

    /// A table of one's own: columns `kappa3_rad_per_nm`, `b3_pn_nm2` and `dl_over_l` under a
    /// header, in any order; an empty cell is no value. Lines that begin with `#` are skipped.
    ///
    /// # Errors
    /// A file that cannot be read, a column that is missing or unknown, and a cell that is no
    /// finite number, with line and column.
    pub(crate) fn from_csv(path: &Path) -> Result<Self, String> {
        let name = path.display();
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .trim(csv::Trim::All)
            .from_path(path)
            .map_err(|e| format!("{name}: {e}"))?;
        let header = reader
            .headers()
            .map_err(|e| format!("{name}: {e}"))?
            .clone();
        let known = ["kappa3_rad_per_nm", "b3_pn_nm2", "dl_over_l"];
        if let Some(unknown) = header.iter().find(|key| !known.contains(key)) {
            let known = known.join(", ");
            return Err(format!(
                "{name}: column `{unknown}` is unknown: there are {known}"
            ));
        }
        let place = |key: &str| header.iter().position(|found| found == key);
        let twist_at =
            place(known[0]).ok_or_else(|| format!("{name}: column `{}` is missing", known[0]))?;
        let mut data = Self {
            source: name.to_string(),
            rigidity: Column::default(),
            length: Column::default(),
        };
        for record in reader.records() {
            let record = record.map_err(|e| format!("{name}: {e}"))?;
            let line = record.position().map_or(0, csv::Position::line);
            let cell = |at: usize| number(&record[at], at, line).map_err(|e| format!("{name}:{e}"));
            let twist =
                cell(twist_at)?.ok_or_else(|| format!("{name}:{line}: a row without a twist"))?;
            for (key, column) in [(known[1], &mut data.rigidity), (known[2], &mut data.length)] {
                if let Some(value) = place(key).map(cell).transpose()?.flatten() {
                    column.push(twist, value);
                }
            }
        }
        data.ensure_enough(&name.to_string())?;
        Ok(data)
    }

    /// Refuses a column of fewer values than the largest form has parameters.
    fn ensure_enough(&self, name: &str) -> Result<(), String> {
        for (key, column) in [("b3_pn_nm2", &self.rigidity), ("dl_over_l", &self.length)] {
            let count = column.value.len();
            if count < FEWEST {
                return Err(format!(
                    "{name}: column `{key}` has {count} values, at least {FEWEST} are needed"
                ));
            }
        }
        Ok(())
    }
}

/// A cell as a finite number; `None` if it is empty.
fn number(text: &str, column: usize, line: u64) -> Result<Option<f64>, String> {
    if text.is_empty() {
        return Ok(None);
    }
    let place = format!("{line}:{}", column + 1);
    let value: f64 = text
        .parse()
        .map_err(|_| format!("{place}: `{text}` is no number"))?;
    if value.is_finite() {
        Ok(Some(value))
    } else {
        Err(format!("{place}: `{text}`: must be finite"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn read(text: &str) -> Result<TwistData, String> {
        let folder = std::env::temp_dir().join(format!("fit-data-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let path = folder.join(format!("{}.csv", text.len()));
        std::fs::write(&path, text).unwrap();
        let data = TwistData::from_csv(&path);
        std::fs::remove_file(path).unwrap();
        data
    }

    #[test]
    fn reliable_rows_are_22_of_26() {
        assert_eq!(
            TwistData::from_paper(false).unwrap().rigidity.twist.len(),
            22
        );
        let all = TwistData::from_paper(true).unwrap();
        assert_eq!(all.length.twist.len(), 26);
        assert!((all.length.range() - 0.0555).abs() < 1e-12);
    }

    #[test]
    fn empty_cells_are_no_values() {
        let header = "# mine\ndl_over_l, kappa3_rad_per_nm, b3_pn_nm2\n".to_owned();
        let rows = "-0.01, 0.02, 1.2e4\n".repeat(9);
        let data = read(&(header.clone() + &rows + ", -0.02, 6e3\n")).unwrap();
        assert_eq!(data.rigidity.value.len(), 10);
        assert_eq!(data.length.twist.len(), 9);
        let message = read(&(header + &rows.replace("-0.01", ""))).unwrap_err();
        assert!(
            message.contains("column `dl_over_l` has 0 values"),
            "{message}"
        );
    }

    #[test]
    fn bad_tables_are_refused_with_their_place() {
        for (text, expected) in [
            ("kappa,b3_pn_nm2\n1,2\n", "column `kappa` is unknown"),
            ("b3_pn_nm2\n2\n", "column `kappa3_rad_per_nm` is missing"),
            (
                "kappa3_rad_per_nm,b3_pn_nm2\n0.1,x\n",
                ":2:2: `x` is no number",
            ),
            ("kappa3_rad_per_nm,b3_pn_nm2\n0.1,inf\n", "must be finite"),
            (
                "kappa3_rad_per_nm,b3_pn_nm2\n,1.0\n",
                ":2: a row without a twist",
            ),
        ] {
            let message = read(text).unwrap_err();
            assert!(message.contains(expected), "{message}");
        }
    }

    proptest! {
        /// Tables of anything: numbers or a message, never a panic. Rows of other lengths, quotes
        /// that are not closed and bytes that are no text come as they come.
        #[test]
        fn spoilt_tables_are_read_or_refused(
            header in prop::sample::subsequence(vec!["kappa3_rad_per_nm", "b3_pn_nm2", "dl_over_l", "x"], 0..=4),
            rows in prop::collection::vec("[-+0-9.eEinfNa,\" #]{0,24}", 0..14),
            noise in prop::collection::vec(any::<u8>(), 0..6),
        ) {
            let mut table = format!("{}\n{}\n", header.join(","), rows.join("\n")).into_bytes();
            table.extend(noise);
            let name = format!("fit-data-spoilt-{}.csv", std::process::id());
            let file = std::env::temp_dir().join(name);
            std::fs::write(&file, table).unwrap();
            let data = TwistData::from_csv(&file);
            std::fs::remove_file(&file).unwrap();
            match data {
                Err(message) => prop_assert!(!message.is_empty()),
                Ok(data) => {
                    let all = data.rigidity.value.iter().chain(&data.length.value);
                    prop_assert!(all.chain(&data.rigidity.twist).all(|x| x.is_finite()));
                }
            }
        }
    }
}
