//! What a rod may be off by: the table of what a law must meet, set before any result was seen.

/// Kinds of load cases.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Group {
    /// A cantilever bent by a force across its tip.
    Cantilever,
    /// The same, pulled along its axis.
    PulledCantilever,
    /// Both ends held against turning, one slides: pushed across, pulled along.
    Guided,
    /// Free filaments on linkers, Figures 5 and 6.
    Linked,
    /// Ends turned against each other and pushed together, Figures 8 and 10.
    Buckled,
    /// Twist at no force: Tables 3 and 5.
    Twisted,
    /// Stretch and compression, turn blocked.
    Stretched,
    /// Rods joined to monomers, over all resolutions.
    Mixed,
    /// Free filaments in a heat bath.
    Thermal,
    /// Shown, without a bound.
    Beside,
}

/// A bound of an error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Bound {
    /// Relative difference.
    Relative(f64),
    /// Largest distance of centre lines (nm), averaged over filaments.
    Distance(f64),
    /// One standard deviation of single filaments of drawn bonds.
    Scatter,
    /// Largest minus smallest over the mean.
    Spread(f64),
    /// None.
    Open,
}

impl Group {
    /// All, in the order of tables.
    pub(super) const ALL: [Self; 10] = [
        Self::Cantilever,
        Self::PulledCantilever,
        Self::Guided,
        Self::Linked,
        Self::Buckled,
        Self::Twisted,
        Self::Stretched,
        Self::Mixed,
        Self::Thermal,
        Self::Beside,
    ];

    /// Name in tables.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Cantilever => "cantilever",
            Self::PulledCantilever => "cantilever under tension",
            Self::Guided => "guided beam",
            Self::Linked => "linkers, Figures 5 and 6",
            Self::Buckled => "buckling, Figures 8 and 10",
            Self::Twisted => "twist, Tables 3 and 5",
            Self::Stretched => "stretch and compression",
            Self::Mixed => "mixed filaments",
            Self::Thermal => "heat",
            Self::Beside => "beside the table",
        }
    }

    /// The bound of a quantity.
    pub(super) fn bound(self, quantity: &str) -> Bound {
        match (self, quantity) {
            (Self::Cantilever, _) => Bound::Relative(0.02),
            (Self::Linked, "shape") => Bound::Distance(1.5),
            (Self::PulledCantilever | Self::Buckled, _) | (Self::Thermal, "persistence length") => {
                Bound::Relative(0.03)
            }
            (Self::Guided | Self::Linked | Self::Stretched | Self::Thermal, _) => {
                Bound::Relative(0.05)
            }
            (Self::Twisted, _) => Bound::Scatter,
            (Self::Mixed, _) => Bound::Spread(0.02),
            (Self::Beside, _) => Bound::Open,
        }
    }
}

impl Bound {
    /// Whether an error is within it; `scatter` is the relative deviation of single filaments. None where
    /// there is nothing to decide.
    pub(super) fn is_met(self, error: f64, scatter: Option<f64>) -> Option<bool> {
        let within = |bound: f64| error.abs() <= bound;
        match self {
            Self::Relative(bound) | Self::Distance(bound) | Self::Spread(bound) => {
                Some(within(bound))
            }
            Self::Scatter => scatter.map(within),
            Self::Open => None,
        }
    }

    /// In tables.
    pub(super) fn text(self) -> String {
        match self {
            Self::Relative(bound) | Self::Spread(bound) => format!("{:.0} %", 100.0 * bound),
            Self::Distance(bound) => format!("{bound} nm"),
            Self::Scatter => "scatter".to_owned(),
            Self::Open => String::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The table, as it was asked for.
    #[test]
    fn bounds_are_those_of_the_table() {
        let texts = Group::ALL.map(|group| group.bound("").text());
        let expected = [
            "2 %", "3 %", "5 %", "5 %", "3 %", "scatter", "5 %", "2 %", "5 %", "",
        ];
        assert_eq!(texts, expected);
        assert_eq!(Group::Linked.bound("shape"), Bound::Distance(1.5));
        let length = Group::Thermal.bound("persistence length");
        assert_eq!(length, Bound::Relative(0.03));
    }

    #[test]
    fn errors_of_either_sign_count() {
        assert_eq!(Bound::Relative(0.02).is_met(-0.021, None), Some(false));
        assert_eq!(Bound::Scatter.is_met(-0.02, Some(0.03)), Some(true));
        assert_eq!(Bound::Scatter.is_met(0.02, None), None);
        assert_eq!(Bound::Open.is_met(9.0, None), None);
    }
}
