//! What a run says when it breaks.

use std::fmt;
use thiserror::Error;

/// A body, by its kind and its index among those of its kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Body {
    /// A point.
    Point(usize),
    /// A frame.
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

/// What is wrong with a state.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum FailureKind {
    /// A position, velocity, orientation or angular momentum is not a finite number.
    #[error("the state is no longer finite")]
    NotFinite,
    /// A frame turns by more than half a turn in one step, so that its motion has no meaning.
    #[error("a frame turns by {0:.3e} rad in one step")]
    TurnsTooFar(f64),
    /// The kinetic energy (pN nm) has grown too far since the last check, or above its limit.
    #[error("the kinetic energy has reached {0:.3e} pN nm")]
    TooFast(f64),
    /// There is more energy (pN nm), kinetic and of the loads, than there can be, or none that is a
    /// finite number.
    #[error("{}", too_much(*.0))]
    TooMuchEnergy(f64),
    /// A body has passed through another that an interaction keeps apart.
    #[error("bodies that are to stay apart pass through each other")]
    PassesThrough,
    /// The equations of an implicit step were not solved: by how much (nm) its last iteration still
    /// moved a body.
    #[error("a step has not converged: its last iteration moved a body by {0:.3e} nm")]
    NotConverged(f64),
}

fn too_much(energy: f64) -> String {
    if energy.is_finite() {
        format!("the energy has reached {energy:.3e} pN nm, more than there can be")
    } else {
        format!("the energy is no longer finite ({energy} pN nm)")
    }
}

/// What is said of the body and the term, before and behind the name of the term, and what may help.
fn words(problem: FailureKind) -> [&'static str; 3] {
    match problem {
        FailureKind::PassesThrough => ["against ", "", "a greater stiffness of it may help"],
        _ => [
            "on which ",
            " acts most strongly",
            "a smaller time step may help",
        ],
    }
}

/// A run that broke: where, when, and which term of the model is to be suspected.
///
/// The system has been put back to the last observed state that was good.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error(
    "{problem} at step {step} ({time} ns): {body}, {}{term:?}{}; the last \
     good state, of step {last_good_step}, was kept; {}", 
     words(*problem)[0], words(*problem)[1], words(*problem)[2]
)]
pub struct RunFailure {
    /// What went wrong.
    pub problem: FailureKind,
    /// The step after which it was found.
    pub step: u64,
    /// The time of that step (ns).
    pub time: f64,
    /// The body where it went wrong: the first with a number that is not finite, or else the
    /// fastest (largest kinetic energy). Where only the energy is not finite, that on which the term
    /// of that energy acts most strongly.
    pub body: Body,
    /// Name of the term with a load on that body that is not finite, or an energy, or else the
    /// largest load; "none" if no term acts on it.
    pub term: &'static str,
    /// Step of the state that the system was put back to.
    pub last_good_step: u64,
    /// Time of that state (ns).
    pub last_good_time: f64,
}
