//! Rows of the table: a case, its outcome, and the kind of outcome that is expected.

/// Outcome of an extreme.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Outcome {
    /// The largest relative error against a known result, or an absolute one where `what` names a unit.
    Correct { what: &'static str, error: f64 },
    /// A quantity over its bound.
    Bounded { what: &'static str, share: f64 },
    /// The scene was refused with this message before it ran.
    Refused(String),
    /// The run ended early with this message.
    Fails(String),
    /// Neither right nor refused: a defect.
    Wrong(String),
}

/// An outcome, whichever way a trial ended.
pub(super) type Tried = Result<Outcome, Outcome>;

/// A result with the error that was found; an error beyond its bound, or one that is not a number, is a defect.
pub(super) fn correct(what: &'static str, error: f64, bound: f64) -> Tried {
    if error <= bound {
        return Ok(Outcome::Correct { what, error });
    }
    Err(Outcome::Wrong(format!(
        "off by {error:.1e}, more than {bound:.0e}: {what}"
    )))
}

/// A quantity over its bound.
pub(super) fn bounded(what: &'static str, share: f64) -> Tried {
    if share <= 1.0 {
        return Ok(Outcome::Bounded { what, share });
    }
    Err(Outcome::Wrong(format!(
        "{share:.1e} times its bound: {what}"
    )))
}

impl Outcome {
    /// The outcome in words.
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

/// Kinds of sound outcomes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Expected {
    /// Right, or within its bound.
    Correct,
    Refused,
    /// Ended early with one of these words, if there are any.
    Fails(&'static [&'static str]),
    /// Refused or ended early.
    Stops,
    /// Right, or ended early with one of these words.
    CorrectOrFails(&'static [&'static str]),
    /// Any sound outcome.
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

/// A row of the table.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Row {
    /// Number that was taken to the extreme.
    pub(super) varied: &'static str,
    /// The model, and the value.
    pub(super) case: String,
    pub(super) outcome: Outcome,
    expected: Expected,
}

impl Row {
    /// A row that should be correct.
    pub(super) fn new(varied: &'static str, case: impl Into<String>, tried: Tried) -> Self {
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

    /// Whether the outcome is sound and of the expected kind.
    pub(super) fn is_sound(&self) -> bool {
        self.expected.is_met(&self.outcome)
    }

    /// The row in words.
    pub(super) fn words(&self) -> String {
        format!("{}, {}: {}", self.varied, self.case, self.outcome.words())
    }
}

/// The larger of two; what is not a number stays, which `f64::max` would drop.
pub(super) fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}
