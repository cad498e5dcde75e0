//! Tables 3 and 5 of the paper.

use serde::de::DeserializeOwned;

const TABLE_3: &str = include_str!("../data/table3_twisting_rigidity.csv");
const TABLE_5: &str = include_str!("../data/table5_twist_stretch.csv");

/// Angle (deg) above which the paper calls its numbers unreliable.
const RELIABLE_DEG: f64 = 200.0;

/// Rounding of a printed curvature, half a unit of the last digit (rad/nm).
pub(super) const CURVATURE_ROUNDING: f64 = 5e-5;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Table {
    Rigidity,
    LengthChange,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Entry {
    /// Angle (deg), printed without a sign.
    pub phi_deg: f64,
    /// Curvature (rad/nm), positive in over-twist.
    pub curvature: f64,
    /// Rigidity (pN nm^2) or relative change of length.
    pub value: f64,
    /// Half a unit of the last digit of the value.
    pub rounding: f64,
}

impl Entry {
    pub(super) fn direction(&self) -> &'static str {
        if self.curvature > 0.0 {
            "over"
        } else {
            "under"
        }
    }

    /// True if the paper calls the entry reliable.
    pub(crate) fn is_reliable(&self) -> bool {
        self.phi_deg <= RELIABLE_DEG
    }
}

/// Parses a table of this crate. Lines that begin with `#` are comments.
pub(crate) fn table<T: DeserializeOwned>(text: &str) -> Vec<T> {
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_reader(text.as_bytes());
    let lines: Result<_, csv::Error> = reader.deserialize().collect();
    lines.expect("tables of this crate are well formed")
}

/// Entries of a table in ascending order of curvature.
pub(crate) fn entries(table: Table) -> Vec<Entry> {
    let text = match table {
        Table::Rigidity => TABLE_3,
        Table::LengthChange => TABLE_5,
    };
    let mut all = Vec::new();
    for [phi_deg, curvature, under, over] in self::table::<[f64; 4]>(text) {
        let entry = |curvature, value: f64| Entry {
            phi_deg,
            curvature,
            value,
            rounding: rounding(table, value),
        };
        all.push(entry(-curvature, under));
        all.push(entry(curvature, over));
    }
    all.sort_by(|a, b| a.curvature.total_cmp(&b.curvature));
    all
}

/// Half a unit of the last digit. Rigidities have two digits, changes of length four decimals.
fn rounding(table: Table, value: f64) -> f64 {
    match table {
        Table::Rigidity => 0.5 * 10f64.powf(value.log10().floor() - 1.0),
        Table::LengthChange => 5e-5,
    }
}

#[cfg(test)]
mod tests {
    use super::{Table, entries};

    #[test]
    fn entries_have_signs_and_rounding() {
        for table in [Table::Rigidity, Table::LengthChange] {
            assert_eq!(entries(table).len(), 26);
        }
        let find = |table, phi: f64, direction| {
            let all = entries(table).into_iter();
            all.filter(|e| e.phi_deg.total_cmp(&phi).is_eq())
                .find(|e| e.direction() == direction)
                .unwrap()
        };
        let entry = find(Table::Rigidity, 180.0, "over");
        assert_eq!((entry.value, entry.rounding), (1.6e4, 500.0));
        for (phi, rounding) in [(40.0, 50.0), (10.0, 5.0)] {
            let entry = find(Table::Rigidity, phi, "under");
            assert!((entry.rounding - rounding).abs() < 1e-12 * rounding);
        }
        let entry = find(Table::LengthChange, 40.0, "under");
        assert_eq!((entry.curvature, entry.value), (-0.0092, 0.0003));
        assert!(find(Table::Rigidity, 200.0, "over").is_reliable());
        assert!(!find(Table::Rigidity, 220.0, "over").is_reliable());
    }
}
