//! Ends of a rod.

use std::fmt;

/// An end of a rod.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RodEnd {
    /// End with node 0.
    Start,
    /// End with the last node.
    End,
}

impl fmt::Display for RodEnd {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Start => "start",
            Self::End => "end",
        })
    }
}
