//! Counts of verdicts.

use crate::report::Row;
use maud::{Markup, html};
use std::iter::Sum;
use std::ops::Add;

/// Counts of verdicts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Verdicts {
    /// Number of rows that agree.
    pub agree: usize,
    /// Number of rows that fail.
    pub missed: usize,
    /// Number of rows without a verdict.
    pub measured: usize,
}

impl Verdicts {
    /// Counts the verdicts of rows.
    pub fn from_rows(rows: &[Row]) -> Self {
        let count = |verdict| rows.iter().filter(|row| row.pass == verdict).count();
        Self {
            agree: count(Some(true)),
            missed: count(Some(false)),
            measured: count(None),
        }
    }

    /// Returns the number of rows with a verdict.
    pub fn compared(self) -> usize {
        self.agree + self.missed
    }

    /// Returns a short description.
    pub(crate) fn in_words(self) -> String {
        match (self.agree, self.missed) {
            (0, 0) => format!("{} measured", self.measured),
            (agree, 0) => format!("{agree} agree"),
            (agree, missed) => format!("{agree} agree, {missed} missed"),
        }
    }
}

impl Verdicts {
    /// Returns a bar with the fractions of agreement and failure; empty without verdicts.
    pub(super) fn bar(self) -> Markup {
        if self.compared() == 0 {
            return Markup::default();
        }
        let width = |count: usize| {
            let share = 100.0 * count as f64 / self.compared() as f64;
            format!("width:{share:.1}%")
        };
        let label = format!("{} of {} agree", self.agree, self.compared());
        html! {
            span class="bar" role="img" aria-label=(label) {
                span class="good" style=(width(self.agree)) {}
                span class="bad" style=(width(self.missed)) {}
            }
        }
    }
}

impl Add for Verdicts {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            agree: self.agree + other.agree,
            missed: self.missed + other.missed,
            measured: self.measured + other.measured,
        }
    }
}

impl Sum for Verdicts {
    fn sum<I: Iterator<Item = Self>>(all: I) -> Self {
        all.fold(Self::default(), Add::add)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn verdicts_are_counted() {
        let row = |ours| Row::measured("fig1", "q", "nm", ours, "");
        let rows = [
            row(1.0).with_paper_value(1.1, 0.2),
            row(1.0).with_paper_value(2.0, 0.2),
            row(1.0).with_paper_value(f64::NAN, 0.2),
            row(1.0),
        ];
        let counted = Verdicts::from_rows(&rows);
        let expected = Verdicts {
            agree: 1,
            missed: 2,
            measured: 1,
        };
        assert_eq!(counted, expected);
        assert_eq!(counted.compared(), 3);
        assert_eq!(counted.in_words(), "1 agree, 2 missed");
        let twice: Verdicts = [counted, counted].into_iter().sum();
        assert_eq!(twice.missed, 4);
    }
}
