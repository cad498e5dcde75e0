//! Texts of the page, in `data/page.ron`: the rule of verdicts, findings, reasons of misses, meanings of names.

use actin_draw::report::Row;
use serde::Deserialize;
use std::sync::LazyLock;

/// All texts.
#[derive(Debug, Deserialize)]
pub(super) struct Texts {
    /// The rule for bounds: what is compared, and its bound.
    pub rule: Vec<(String, String)>,
    pub findings: Vec<Finding>,
    /// In the order in which they are reported: what concerns most of the paper first.
    pub reasons: Vec<Reason>,
    /// Parts of the names of quantities, and their meaning.
    pub names: Vec<(String, String)>,
    /// Choices that the paper leaves open and Tables 3 and 4 decided. Agreement with these tables is then no
    /// proof of the choices.
    pub choices: String,
}

/// A statement of the paper that some rows of one artefact decide.
#[derive(Debug, Deserialize)]
pub(super) struct Finding {
    pub artefact: String,
    /// It is confirmed if all of these agree, and not if one of them is missed.
    pub quantities: Vec<String>,
    /// A statement that can be read alone.
    pub confirmed: String,
    /// The same statement after `that`, if it differs.
    #[serde(default)]
    pub refuted: Option<String>,
}

/// Cause of a miss.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
pub(super) enum Cause {
    /// The paper contradicts itself.
    Paper,
    /// The bonds are random, and the paper shows one set of them.
    Bonds,
    /// The models contradict the paper.
    Models,
    /// The number that was missed is not the paper's.
    Elsewhere,
}

/// A reason that some misses share.
#[derive(Debug, Deserialize)]
pub(super) struct Reason {
    pub artefact: String,
    /// Names of rows, or what they begin with: the latter end in `/`.
    pub quantities: Vec<String>,
    pub cause: Cause,
    /// Finding, as a heading.
    pub title: String,
    pub text: String,
}

/// The texts of this version.
pub(super) static TEXTS: LazyLock<Texts> = LazyLock::new(|| {
    ron::from_str(include_str!("../../../data/page.ron")).expect("the texts are well formed")
});

impl Finding {
    /// The confirmed or the refuted statement.
    pub(super) fn in_words(&self, is_confirmed: bool) -> String {
        if is_confirmed {
            return self.confirmed.clone();
        }
        format!("that {}", self.refuted.as_ref().unwrap_or(&self.confirmed))
    }
}

impl Cause {
    pub(super) const ALL: [Self; 4] = [Self::Paper, Self::Bonds, Self::Models, Self::Elsewhere];

    /// Text for a number of misses of this cause.
    pub(super) fn in_words(self, count: usize) -> String {
        let s = if count == 1 { "s" } else { "" };
        match self {
            Self::Paper => format!("In {count} the paper contradicts itself"),
            Self::Bonds => format!(
                "{count} depend{s} on the random bonds, of which the paper shows a single set"
            ),
            Self::Models => {
                format!("{count} concern{s} statements that the models here do not bear out")
            }
            Self::Elsewhere => format!("{count} concern{s} bounds that were set for this page"),
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

    /// The reason for a row's miss.
    pub(super) fn of(row: &Row) -> Option<&'static Self> {
        TEXTS.reasons.iter().find(|reason| reason.covers(row))
    }
}
