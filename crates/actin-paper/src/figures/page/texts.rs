//! Texts of the page in `data/page.ron`: rule of verdicts, findings, reasons of misses, and names of quantities.

use actin_draw::report::Row;
use serde::Deserialize;
use std::sync::LazyLock;

#[derive(Debug, Deserialize)]
pub(super) struct Texts {
    /// Compared quantities and their bounds.
    pub rule: Vec<(String, String)>,
    pub findings: Vec<Finding>,
    /// Reasons in the order of the page, by descending relevance.
    pub reasons: Vec<Reason>,
    /// Parts of the names of quantities and their meanings.
    pub names: Vec<(String, String)>,
    /// Choices that the paper leaves open.
    pub choices: String,
}

/// Statement of the paper, decided by rows of one artefact.
#[derive(Debug, Deserialize)]
pub(super) struct Finding {
    pub artefact: String,
    /// Rows that must all agree.
    pub quantities: Vec<String>,
    /// Statement that is understandable on its own.
    pub confirmed: String,
    /// Statement after `that`, if it differs from `confirmed`.
    #[serde(default)]
    pub refuted: Option<String>,
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
pub(super) enum Cause {
    Paper,
    /// The paper shows one set of random bonds.
    Bonds,
    Models,
    /// The bound is not from the paper.
    Elsewhere,
}

#[derive(Debug, Deserialize)]
pub(super) struct Reason {
    pub artefact: String,
    /// Names of rows. A final slash covers all rows below.
    pub quantities: Vec<String>,
    pub cause: Cause,
    /// Heading.
    pub title: String,
    pub text: String,
}

pub(super) static TEXTS: LazyLock<Texts> = LazyLock::new(|| {
    actin_sim::read_ron(include_str!("../../../data/page.ron"), "Texts")
        .expect("`data/page.ron` is well formed")
});

impl Finding {
    pub(super) fn in_words(&self, is_confirmed: bool) -> String {
        if is_confirmed {
            return self.confirmed.clone();
        }
        format!("that {}", self.refuted.as_ref().unwrap_or(&self.confirmed))
    }
}

impl Cause {
    pub(super) const ALL: [Self; 4] = [Self::Paper, Self::Bonds, Self::Models, Self::Elsewhere];

    pub(super) fn in_words(self, count: usize) -> String {
        let s = if count == 1 { "s" } else { "" };
        match self {
            Self::Paper => format!("In {count} the paper contradicts itself"),
            Self::Bonds => {
                format!("{count} depend{s} on the random bonds, of which the paper shows one set")
            }
            Self::Models => {
                format!("{count} concern{s} statements that contradict the models")
            }
            Self::Elsewhere => format!("{count} concern{s} bounds that were set for this report"),
        }
    }
}

impl Reason {
    pub(super) fn covers(&self, row: &Row) -> bool {
        let names = |name: &String| {
            row.quantity == *name || name.ends_with('/') && row.quantity.starts_with(name)
        };
        row.artefact == self.artefact && self.quantities.iter().any(names)
    }

    pub(super) fn from_row(row: &Row) -> Option<&'static Self> {
        TEXTS.reasons.iter().find(|reason| reason.covers(row))
    }
}
