use std::fmt;
use thiserror::Error;

/// Body, identified by its kind and index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Body {
    /// Point.
    Point(usize),
    /// Frame.
    Frame(usize),
}

impl fmt::Display for Body {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Point(i) => write!(f, "point {i}"),
            Self::Frame(i) => write!(f, "frame {i}"),
        }
    }
}

/// Kind of a failure.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum FailureKind {
    /// A position, velocity, orientation or angular momentum is not a finite number.
    #[error("the state is no longer finite")]
    NotFinite,
    /// A frame rotates by more than half a turn in one step.
    #[error("a frame turns by {0:.3e} rad in one step")]
    TurnsTooFar(f64),
    /// The kinetic energy (pN nm) has grown too much since the last check, or exceeds its limit.
    #[error("the kinetic energy has reached {0:.3e} pN nm")]
    TooFast(f64),
    /// The total energy (pN nm) exceeds its limit or is not finite.
    #[error("{}", too_much(*.0))]
    TooMuchEnergy(f64),
    /// A body has passed through another despite their repulsion.
    #[error("bodies pass through each other despite their repulsion")]
    PassesThrough,
    /// An implicit step has not converged: displacement (nm) of the last iteration.
    #[error("a step has not converged: its last iteration moved a body by {0:.3e} nm")]
    NotConverged(f64),
}

fn too_much(energy: f64) -> String {
    if energy.is_finite() {
        format!("the energy has reached {energy:.3e} pN nm, above its limit,")
    } else {
        format!("the energy is no longer finite ({energy} pN nm)")
    }
}

fn words(problem: FailureKind) -> [&'static str; 3] {
    match problem {
        FailureKind::PassesThrough => ["against ", "", "a larger stiffness of that term may help"],
        _ => [
            "on which ",
            " acts most strongly",
            "a smaller time step may help",
        ],
    }
}

/// Failure of a run, with its time, body and term.
///
/// The system has been restored to the last observed sound state.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error(
    "{problem} at step {step} ({time} ns): {body}, {}{term:?}{}; the last \
     good state, of step {last_good_step}, was kept; {}", 
     words(*problem)[0], words(*problem)[1], words(*problem)[2]
)]
pub struct RunFailure {
    /// Kind of the failure.
    pub problem: FailureKind,
    /// Step of the failure.
    pub step: u64,
    /// Time of the failure (ns).
    pub time: f64,
    /// Failing body: the first with a number that is not finite, else the one with the largest
    /// kinetic energy. If only the energy of a term is not finite, the body with the largest load
    /// of that term.
    pub body: Body,
    /// Term with a load or energy that is not finite, or else with the largest load on the body.
    /// `none` if no term acts on it.
    pub term: &'static str,
    /// Step of the restored state.
    pub last_good_step: u64,
}
