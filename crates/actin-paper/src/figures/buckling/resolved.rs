//! How much of a buckled filament is rod.

/// Length of the filament (nm).
pub(super) const LENGTH_NM: f64 = 300.0;

/// How much of the filament is rod.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Resolved {
    /// All.
    Rod,
    /// So many nm, half at each end.
    Mixed(u32),
    /// Nothing.
    Ellipsoids,
}

impl Resolved {
    /// Pure rod, mixed resolutions from much to little rod, pure monomers.
    pub(super) fn all(lengths: &[u32]) -> Vec<Self> {
        let mixed = lengths.iter().rev().map(|&rod| Self::Mixed(rod));
        let rod = std::iter::once(Self::Rod);
        rod.chain(mixed).chain([Self::Ellipsoids]).collect()
    }

    /// Name in tables, legends and quantities.
    pub(super) fn name(self) -> String {
        match self {
            Self::Rod => "rod".into(),
            Self::Mixed(rod) => format!("rod-{rod}"),
            Self::Ellipsoids => "ellipsoids".into(),
        }
    }

    /// Length that is rod (nm).
    pub(super) fn rod_nm(self) -> f64 {
        match self {
            Self::Rod => LENGTH_NM,
            Self::Mixed(rod) => f64::from(rod),
            Self::Ellipsoids => 0.0,
        }
    }

    /// Share of rod, for the colour.
    pub(super) fn rod_share(self) -> f64 {
        self.rod_nm() / LENGTH_NM
    }
}
