//! Position of a state in its run.

use serde::{Deserialize, Serialize};

/// Time or path parameter of a record.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum At {
    /// Time (ns).
    Time(f64),
    /// Path parameter, which counts stages.
    Path(f64),
}

impl At {
    /// Value of either kind.
    pub fn value(self) -> f64 {
        match self {
            Self::Time(value) | Self::Path(value) => value,
        }
    }

    /// Time (ns); `None` for an equilibrium.
    pub fn time_ns(self) -> Option<f64> {
        match self {
            Self::Time(time_ns) => Some(time_ns),
            Self::Path(_) => None,
        }
    }

    /// Path parameter; `None` for a motion in time.
    pub fn path(self) -> Option<f64> {
        match self {
            Self::Time(_) => None,
            Self::Path(parameter) => Some(parameter),
        }
    }
}
