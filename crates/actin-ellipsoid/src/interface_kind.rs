//! Kinds of interfaces between monomers.

/// Kind of interface between two monomers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum InterfaceKind {
    /// Between monomers `i` and `i + 1`, of different strands.
    Lateral,
    /// Between monomers `i` and `i + 2`, of the same strand.
    Longitudinal,
}

impl InterfaceKind {
    /// Both kinds, in order of their index.
    pub const ALL: [Self; 2] = [Self::Lateral, Self::Longitudinal];

    /// Number of lattice steps from the lower to the upper monomer.
    pub fn steps(self) -> usize {
        match self {
            Self::Lateral => 1,
            Self::Longitudinal => 2,
        }
    }

    /// Name of a parameter of this kind in errors.
    pub(crate) fn key(self, parameter: &str) -> String {
        match self {
            Self::Lateral => format!("lateral.{parameter}"),
            Self::Longitudinal => format!("longitudinal.{parameter}"),
        }
    }

    pub(crate) fn number(self) -> u64 {
        match self {
            Self::Lateral => 0,
            Self::Longitudinal => 1,
        }
    }
}

impl std::fmt::Display for InterfaceKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Lateral => "lateral",
            Self::Longitudinal => "longitudinal",
        })
    }
}
