//! Data of the fits: Tables 3 and 5 of the paper, or a user's table in the format of `docs/how-to/rod-laws.md`.

use super::catalogue::{CATALOGUE, Group};
use super::column::Column;
use crate::published::{Table, entries};
use csv::StringRecord;
use std::path::Path;

/// Data of the fits; missing columns are empty.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct FitData {
    /// Path of the file, or description of the source.
    pub source: String,
    /// Secant twisting rigidity (pN nm^2) against twist (rad/nm).
    pub rigidity: Column,
    /// Relative change of length against twist (rad/nm).
    pub length: Column,
    /// Secant bending rigidity (pN nm^2) against curvature (rad/nm).
    pub bend: Column,
    /// Strain against axial force (pN).
    pub stretch: Column,
}

impl FitData {
    /// Tables 3 and 5 of the paper; without the rows that it calls unreliable unless `all_rows`.
    pub(crate) fn from_paper(all_rows: bool) -> Self {
        let column = |table| {
            let all = entries(table).into_iter();
            let chosen = all.filter(|entry| all_rows || entry.is_reliable());
            chosen.map(|e| (e.curvature, e.value)).collect()
        };
        let rows = if all_rows {
            "all rows"
        } else {
            "rows to 200 deg"
        };
        Self {
            source: format!("Tables 3 and 5 of the paper, {rows}"),
            rigidity: column(Table::Rigidity),
            length: column(Table::LengthChange),
            ..Self::default()
        }
    }

    /// Reads columns with a header, in any order. Empty cells have no value. Lines that begin with
    /// `#` and a byte-order mark are skipped.
    ///
    /// # Errors
    /// An unreadable file; an unknown, repeated or incomplete column; an invalid cell, with line,
    /// column, value and rule; a table without values.
    pub(super) fn from_csv(path: &Path) -> Result<Self, String> {
        let name = path.display();
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .trim(csv::Trim::All)
            .from_path(path)
            .map_err(|e| format!("{name}: {e}"))?;
        let header = reader.headers().map_err(|e| format!("{name}: {e}"))?;
        let header = header.clone();
        check_header(&header).map_err(|e| format!("{name}: {e}"))?;
        let mut columns: [Column; 4] = Default::default();
        for record in reader.records() {
            let record = record.map_err(|e| format!("{name}: {e}"))?;
            let row = Row {
                header: &header,
                record: &record,
            };
            for (group, column) in CATALOGUE.groups.iter().zip(&mut columns) {
                row.read(group, column).map_err(|e| format!("{name}:{e}"))?;
            }
        }
        if columns.iter().all(Column::is_empty) {
            return Err(format!("{name}: the table has no values"));
        }
        let [rigidity, length, bend, stretch] = columns;
        Ok(Self {
            source: name.to_string(),
            rigidity,
            length,
            bend,
            stretch,
        })
    }
}

/// Refuses unknown, repeated and incomplete columns.
fn check_header(header: &StringRecord) -> Result<(), String> {
    let groups = &CATALOGUE.groups;
    let columns = groups.iter().flat_map(|g| [&g.x, &g.value, &g.error]);
    let mut known: Vec<&str> = columns.map(String::as_str).collect();
    known.dedup();
    let has = |key: &str| header.iter().any(|found| found == key);
    for (at, key) in header.iter().enumerate() {
        if !known.contains(&key) {
            let known = known.join(", ");
            return Err(format!("column `{key}` is unknown; known columns: {known}"));
        }
        if header.iter().take(at).any(|before| before == key) {
            return Err(format!("column `{key}` occurs twice"));
        }
    }
    for group in groups {
        for (key, needed) in [(&group.error, &group.value), (&group.value, &group.x)] {
            if has(key) && !has(needed) {
                return Err(format!("column `{needed}` is missing: `{key}` needs it"));
            }
        }
    }
    if groups.iter().any(|group| has(&group.value)) {
        return Ok(());
    }
    let values = groups
        .each_ref()
        .map(|group| group.value.as_str())
        .join(", ");
    Err(format!("a column of values is missing, one of {values}"))
}

struct Row<'a> {
    header: &'a StringRecord,
    record: &'a StringRecord,
}

impl Row<'_> {
    /// Appends the value of the row, if any, to the column of a group.
    fn read(&self, group: &Group, column: &mut Column) -> Result<(), String> {
        let x = self.cell(&group.x, false)?;
        let value = self.cell(&group.value, group.is_rigidity)?;
        let error = self.cell(&group.error, true)?;
        let lacks =
            |key: &str, of: &str| Err(format!("{}: a `{of}` without its `{key}`", self.line()));
        match (x, value, error) {
            (None, Some(_), _) => lacks(&group.x, &group.value),
            (_, None, Some(_)) => lacks(&group.value, &group.error),
            (_, Some(_), None) if self.place(&group.error).is_some() => {
                lacks(&group.error, &group.value)
            }
            (Some(x), Some(value), error) => {
                column.push(x, value);
                column.error.extend(error);
                Ok(())
            }
            (_, None, None) => Ok(()),
        }
    }

    fn line(&self) -> u64 {
        self.record.position().map_or(0, csv::Position::line)
    }

    fn place(&self, key: &str) -> Option<usize> {
        self.header.iter().position(|found| found == key)
    }

    /// Returns a cell as a number; `None` if the cell is empty or the column is missing.
    fn cell(&self, key: &str, is_positive: bool) -> Result<Option<f64>, String> {
        let Some(at) = self.place(key) else {
            return Ok(None);
        };
        let text = &self.record[at];
        if text.is_empty() {
            return Ok(None);
        }
        let refused = |rule: &str| {
            let (line, column) = (self.line(), at + 1);
            Err(format!(
                "{line}:{column}: `{key}` is `{text}`: must be {rule}"
            ))
        };
        match text.parse::<f64>() {
            Err(_) => refused("a number"),
            Ok(value) if !value.is_finite() => refused("finite"),
            Ok(value) if is_positive && value <= 0.0 => refused("positive"),
            Ok(value) => Ok(Some(value)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn read(text: impl AsRef<[u8]>) -> Result<FitData, String> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("table.csv");
        std::fs::write(&path, text).unwrap();
        FitData::from_csv(&path)
    }

    #[test]
    fn reliable_rows_are_22_of_26() {
        assert_eq!(FitData::from_paper(false).rigidity.len(), 22);
        let all = FitData::from_paper(true);
        assert_eq!(all.length.len(), 26);
        assert!((all.length.range() - 0.0555).abs() < 1e-12);
    }

    #[test]
    fn empty_cells_are_no_values() {
        let header = "\u{feff}# mine\ndl_over_l, kappa3_rad_per_nm, b3_pn_nm2\n".to_owned();
        let rows = "-0.01, 0.02, 1.2e4\n".repeat(9);
        let data = read(header + &rows + ", -0.02, 6e3\n").unwrap();
        assert_eq!((data.rigidity.len(), data.length.len()), (10, 9));
        assert!(data.bend.is_empty() && data.stretch.is_empty() && !data.length.is_known());
    }

    #[test]
    fn groups_share_a_file() {
        let data = read(
            "kappa3_rad_per_nm,b3_pn_nm2,b3_error_pn_nm2,curvature_rad_per_nm,b_pn_nm2,force_pn,strain\n\
             0.01,5e3,50,0.001,3.2e4,,\n\
             ,,,,,-10,-6e-4\n",
        )
        .unwrap();
        assert_eq!(data.rigidity.error, [50.0]);
        assert_eq!((data.bend.x[0], data.bend.value[0]), (1e-3, 3.2e4));
        assert_eq!((data.stretch.x[0], data.stretch.value[0]), (-10.0, -6e-4));
    }

    #[test]
    fn bad_headers_are_refused() {
        #[rustfmt::skip]
        let cases = [
            ("kappa,b3_pn_nm2", "column `kappa` is unknown; known columns: kappa3_rad_per_nm, b3_pn_nm2,"),
            ("b3_pn_nm2", "column `kappa3_rad_per_nm` is missing: `b3_pn_nm2` needs it"),
            ("force_pn,strain_error", "column `strain` is missing: `strain_error` needs it"),
            ("kappa3_rad_per_nm", "a column of values is missing, one of b3_pn_nm2, dl_over_l,"),
            ("force_pn,strain,strain", "column `strain` occurs twice"),
        ];
        for (header, expected) in cases {
            let message = read(format!("{header}\n1,2\n")).unwrap_err();
            assert!(message.contains(expected), "{message}");
        }
        let message = read("force_pn,strain\n1,\n").unwrap_err();
        assert!(message.contains("the table has no values"), "{message}");
    }

    #[test]
    fn bad_cells_are_refused_with_their_place() {
        let header = "kappa3_rad_per_nm,b3_pn_nm2,b3_error_pn_nm2\n0.01,100,1\n";
        #[rustfmt::skip]
        let cases = [
            ("0.1,x,1", ":3:2: `b3_pn_nm2` is `x`: must be a number"),
            ("inf,1,1", ":3:1: `kappa3_rad_per_nm` is `inf`: must be finite"),
            ("0.1,-5,1", ":3:2: `b3_pn_nm2` is `-5`: must be positive"),
            ("0.1,5,0", ":3:3: `b3_error_pn_nm2` is `0`: must be positive"),
            (",1.0,1", ":3: a `b3_pn_nm2` without its `kappa3_rad_per_nm`"),
            ("0.1,1.0,", ":3: a `b3_pn_nm2` without its `b3_error_pn_nm2`"),
            ("0.1,,1", ":3: a `b3_error_pn_nm2` without its `b3_pn_nm2`"),
        ];
        for (row, expected) in cases {
            let message = read(format!("{header}{row}\n")).unwrap_err();
            assert!(message.contains(expected), "{message}");
        }
        let message = read(b"force_pn,strain\n1,2\n1,\xff\n").unwrap_err();
        assert!(message.contains("line 3, field: 1"), "{message}");
        let message = read("force_pn,strain\n1,2\n1\n").unwrap_err();
        assert!(message.contains("line: 3"), "{message}");
    }

    proptest! {
        /// Random tables give numbers or a message, never a panic. They include rows of unequal
        /// length, unclosed quotes and invalid UTF-8.
        #[test]
        fn spoilt_tables_are_read_or_refused(
            header in prop::sample::subsequence(
                vec!["kappa3_rad_per_nm", "b3_pn_nm2", "dl_over_l", "force_pn", "strain", "strain_error", "x"],
                0..=5,
            ),
            rows in prop::collection::vec("[-+0-9.eEinfNa,\" #]{0,24}", 0..14),
            noise in prop::collection::vec(any::<u8>(), 0..6),
        ) {
            let mut table = format!("{}\n{}\n", header.join(","), rows.join("\n")).into_bytes();
            table.extend(noise);
            match read(table) {
                Err(message) => prop_assert!(!message.is_empty()),
                Ok(data) => for column in [&data.rigidity, &data.length, &data.bend, &data.stretch] {
                    let all = column.value.iter().chain(&column.error).chain(&column.x);
                    prop_assert!(all.copied().all(f64::is_finite));
                    prop_assert_eq!(column.x.len(), column.len());
                    prop_assert!(!column.is_known() || column.error.len() == column.len());
                },
            }
        }
    }
}
