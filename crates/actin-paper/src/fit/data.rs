//! Data of the twist fits: tables of B3 and of the change of length.

use super::column::Column;
use crate::published::{Table, entries};

/// Twisting rigidity and length change against twist.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TwistData {
    /// Description of the source.
    pub source: String,
    /// Secant twisting rigidity (pN nm^2).
    pub rigidity: Column,
    /// Relative change of length.
    pub length: Column,
}

impl TwistData {
    pub(crate) fn new(
        source: String,
        rigidity: impl IntoIterator<Item = (f64, f64)>,
        length: impl IntoIterator<Item = (f64, f64)>,
    ) -> Self {
        Self {
            source,
            rigidity: rigidity.into_iter().collect(),
            length: length.into_iter().collect(),
        }
    }

    /// Tables 3 and 5; without the rows that the paper calls unreliable unless `all_rows`.
    pub(crate) fn from_paper(all_rows: bool) -> Result<Self, String> {
        let column = |table| -> Result<Vec<(f64, f64)>, String> {
            let wanted = entries(table).into_iter();
            let wanted = wanted.filter(|entry| all_rows || entry.is_reliable());
            Ok(wanted.map(|e| (e.curvature, e.value)).collect())
        };
        let rows = if all_rows {
            "all rows"
        } else {
            "rows to 200 deg"
        };
        Ok(Self::new(
            format!("Tables 3 and 5 of the paper, {rows}"),
            column(Table::Rigidity)?,
            column(Table::LengthChange)?,
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reliable_rows_are_22_of_26() {
        assert_eq!(TwistData::from_paper(false).unwrap().rigidity.len(), 22);
        let all = TwistData::from_paper(true).unwrap();
        assert_eq!(all.length.len(), 26);
        assert!((all.length.range() - 0.0555).abs() < 1e-12);
    }
}
