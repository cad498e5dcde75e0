//! One row of the table: what was taken to the extreme, and what became of it.

/// What became of an extreme.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Outcome {
    /// The result agrees with what is known of it.
    Correct {
        /// What was compared with what.
        what: &'static str,
        /// The largest relative error that was found, or absolute where `what` names a unit.
        error: f64,
        /// What it may be.
        bound: f64,
    },
    /// What has a bound and no right value stays below it.
    Bounded {
        /// What it is.
        what: &'static str,
        /// It over its bound.
        share: f64,
    },
    /// The scene was refused with this message before it ran.
    Refused(String),
    /// The run ended early with this message.
    Fails(String),
    /// Neither right nor refused: a defect.
    Wrong(String),
}

impl Outcome {
    /// A result with the error that was found.
    pub(super) fn correct(what: &'static str, error: f64, bound: f64) -> Self {
        Self::Correct { what, error, bound }
    }

    /// Whether it is right or says that it is not.
    pub(super) fn is_sound(&self) -> bool {
        match self {
            // Written so that an error that is not a number is no correct result.
            Self::Correct { error, bound, .. } => error <= bound,
            Self::Bounded { share, .. } => *share <= 1.0,
            Self::Refused(_) | Self::Fails(_) => true,
            Self::Wrong(_) => false,
        }
    }

    /// The outcome in words.
    pub(super) fn words(&self) -> String {
        match self {
            Self::Correct { what, error, bound } if error <= bound => {
                format!("correct to {error:.0e}: {what}")
            }
            Self::Correct { what, error, bound } => {
                format!("WRONG by {error:.1e}, more than {bound:.0e}: {what}")
            }
            Self::Bounded { what, share } if *share <= 1.0 => {
                format!("within {share:.1e} of its bound: {what}")
            }
            Self::Bounded { what, share } => {
                format!("WRONG: {share:.1e} times its bound: {what}")
            }
            Self::Refused(message) => format!("refused: {message}"),
            Self::Fails(message) => format!("fails with: {message}"),
            Self::Wrong(message) => format!("WRONG: {message}"),
        }
    }
}

/// A row of the table.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Row {
    /// Which number was taken to the extreme.
    pub(super) varied: &'static str,
    /// The model, and the value.
    pub(super) case: String,
    /// What became of it.
    pub(super) outcome: Outcome,
}

impl Row {
    /// A row.
    pub(super) fn new(varied: &'static str, case: impl Into<String>, outcome: Outcome) -> Self {
        Self {
            varied,
            case: case.into(),
            outcome,
        }
    }
}

/// The larger of two; what is not a number stays, which `f64::max` would drop.
pub(super) fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}
