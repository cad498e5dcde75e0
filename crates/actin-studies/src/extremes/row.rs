//! Rows of the table: a case, its outcome, and the expected kind of outcome.

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Outcome {
    /// Largest error against a known result: relative, or absolute if `what` names a unit.
    Correct {
        what: &'static str,
        error: f64,
    },
    Bounded {
        what: &'static str,
        share: f64,
    },
    /// The scene was refused before it ran.
    Refused(String),
    Fails(String),
    Wrong(String),
}

pub(super) type CaseResult = Result<Outcome, Outcome>;

/// Returns `Correct`, or a defect if the error exceeds its bound or is not a number.
pub(super) fn correct(what: &'static str, error: f64, bound: f64) -> CaseResult {
    if error <= bound {
        return Ok(Outcome::Correct { what, error });
    }
    Err(Outcome::Wrong(format!(
        "off by {error:.1e}, more than {bound:.0e}: {what}"
    )))
}

/// Returns `Bounded`, or a defect if the ratio exceeds 1.
pub(super) fn bounded(what: &'static str, share: f64) -> CaseResult {
    if share <= 1.0 {
        return Ok(Outcome::Bounded { what, share });
    }
    Err(Outcome::Wrong(format!(
        "{share:.1e} times its bound: {what}"
    )))
}

impl Outcome {
    pub(super) fn words(&self) -> String {
        match self {
            Self::Correct { what, error } => format!("correct to {error:.0e}: {what}"),
            Self::Bounded { what, share } => format!("within {share:.1e} of its bound: {what}"),
            Self::Refused(message) => format!("refused: {message}"),
            Self::Fails(message) => format!("fails with: {message}"),
            Self::Wrong(message) => format!("WRONG: {message}"),
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Expected {
    Correct,
    Refused,
    /// Ended early with a message that contains one of these texts, if there are any.
    Fails(&'static [&'static str]),
    Stops,
    CorrectOrFails(&'static [&'static str]),
    Sound,
}

impl Expected {
    fn is_met(self, outcome: &Outcome) -> bool {
        let is_said = |message: &String, words: &[&str]| {
            words.is_empty() || words.iter().any(|words| message.contains(words))
        };
        match outcome {
            Outcome::Correct { .. } | Outcome::Bounded { .. } => {
                matches!(self, Self::Correct | Self::CorrectOrFails(_) | Self::Sound)
            }
            Outcome::Refused(_) => matches!(self, Self::Refused | Self::Stops | Self::Sound),
            Outcome::Fails(message) => match self {
                Self::Fails(words) | Self::CorrectOrFails(words) => is_said(message, words),
                _ => matches!(self, Self::Stops | Self::Sound),
            },
            Outcome::Wrong(_) => false,
        }
    }
}

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Row {
    pub(super) varied: &'static str,
    pub(super) case: String,
    pub(super) outcome: Outcome,
    expected: Expected,
}

impl Row {
    pub(super) fn new(varied: &'static str, case: impl Into<String>, tried: CaseResult) -> Self {
        Self {
            varied,
            case: case.into(),
            outcome: tried.unwrap_or_else(|outcome| outcome),
            expected: Expected::Correct,
        }
    }

    pub(super) fn expecting(self, expected: Expected) -> Self {
        Self { expected, ..self }
    }

    pub(super) fn is_sound(&self) -> bool {
        self.expected.is_met(&self.outcome)
    }

    pub(super) fn words(&self) -> String {
        format!("{}, {}: {}", self.varied, self.case, self.outcome.words())
    }
}

/// Returns the larger number, or NaN if one is NaN, unlike `f64::max`.
pub(super) fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}
