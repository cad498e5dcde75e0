//! Load cases: clamps, loads, compared quantities and error bounds. Cases and bounds were fixed
//! before the first result.

use super::filament::RISE_NM;
use actin_sim::FreeTranslation;

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Case {
    pub group: Group,
    pub name: String,
    /// Length in rises. For a cantilever, the length to the point of the force, midway between the
    /// last two monomers.
    pub rises: f64,
    pub loading: Loading,
}

/// Ways of loading.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Loading {
    /// Clamped at the start, turned (deg per 73.94 nm) or pulled (pN), then loaded with each force
    /// (pN). The force is axial if the far end slides along the axis, else transverse.
    ///
    /// Compared: displacement of the far end (nm) of a cantilever, displacement over force (nm/pN)
    /// if the end slides freely, secant stretching rigidity (pN) if it slides along the axis.
    Forces {
        far_end: Option<FreeTranslation>,
        turn_deg: f64,
        tension_pn: f64,
        forces_pn: Vec<f64>,
    },
    /// Figure 5 or Figure 6. Compared: energy (pN nm) and centre line.
    Linked { figure: u32 },
    /// Each end turned by this angle (deg) and pushed in by 7.5 nm. Compared: height (nm), torque
    /// (pN nm), thrust (pN).
    Buckled { turn_deg: f64 },
    /// Turned by these angles (deg) per 73.94 nm with free length. Compared: secant twisting
    /// rigidity (pN nm^2) and change of length.
    Twisted { turns_deg: Vec<f64> },
}

/// Reference length of turns (nm): 27 rises, as in Tables 3 and 5.
pub(super) const TURNED_NM: f64 = 27.0 * RISE_NM;

/// Transverse forces and tensions of cantilevers of 160.2 nm (pN).
const ACROSS_PN: [f64; 5] = [0.05, 0.2, 1.0, 2.0, 5.0];
const SMALL_PN: [f64; 2] = [0.1, 0.5];
const PULL_PN: [f64; 4] = [1.0, 5.0, 10.0, 40.0];
/// Tensions of guided beams (pN), and spans with a bound (60, 90, 150 nm) and without (25, 30, 40
/// nm).
const GUIDED_PULL_PN: [f64; 3] = [0.0, 5.0, 10.0];
const SPANS: [(Group, [f64; 3]); 2] = [
    (Group::Guided, [22.0, 33.0, 55.0]),
    (Group::Beside, [9.0, 11.0, 15.0]),
];
const BUCKLED_DEG: [f64; 4] = [180.0, -180.0, 270.0, -270.0];
/// Turns (deg) of the rows of Tables 3 and 5.
const TURNS_DEG: [f64; 10] = [
    10.0, -10.0, 40.0, -40.0, 80.0, -80.0, 120.0, -120.0, 180.0, -180.0,
];
/// Axial forces (pN), and twists of stretched filaments (deg per 73.94 nm).
const ALONG_PN: [f64; 3] = [2.0, 10.0, 40.0];
const HELD_DEG: [f64; 3] = [0.0, 80.0, -80.0];

/// All cases, or a representative subset if `quick`.
pub(super) fn all(quick: bool) -> Vec<Case> {
    let cantilever = |group, pull: f64, forces: &[f64]| {
        let name = format!("160 nm, tension {pull} pN");
        Case::forces(group, name, 58.5, (None, pull, forces))
    };
    let mut all = vec![cantilever(Group::Cantilever, 0.0, &ACROSS_PN)];
    all.extend(PULL_PN.map(|pull| cantilever(Group::PulledCantilever, pull, &SMALL_PN)));
    for (group, spans) in SPANS {
        for rises in spans {
            all.extend(GUIDED_PULL_PN.map(|pull| Case::guided(group, rises, pull)));
        }
    }
    all.extend([5, 6].map(|figure| {
        let loading = Loading::Linked { figure };
        Case::new(Group::Linked, format!("Figure {figure}"), f64::NAN, loading)
    }));
    all.extend(BUCKLED_DEG.map(|turn_deg| {
        let name = format!("turned {turn_deg:+} deg");
        Case::buckled(Group::Buckled, name, turn_deg)
    }));
    let turns_deg = TURNS_DEG.to_vec();
    let twisted = Loading::Twisted { turns_deg };
    all.push(Case::new(Group::Twisted, "74 nm", 27.0, twisted));
    for turn_deg in HELD_DEG {
        for (what, sign) in [("pulled", 1.0), ("pushed", -1.0)] {
            let name = format!("74 nm, turned {turn_deg:+} deg, {what}");
            let forces = ALONG_PN.map(|force| sign * force);
            all.push(Case::stretched(
                Group::Stretched,
                name,
                27.0,
                (turn_deg, &forces),
            ));
        }
    }
    all.retain(|case| !quick || case.is_quick());
    all
}

impl Case {
    pub(super) fn new(group: Group, name: impl Into<String>, rises: f64, loading: Loading) -> Self {
        Self {
            group,
            name: name.into(),
            rises,
            loading,
        }
    }

    /// Clamped at the start, pulled by a tension (pN), then loaded with each transverse force (pN).
    pub(super) fn forces(
        group: Group,
        name: String,
        rises: f64,
        (far_end, tension_pn, forces_pn): (Option<FreeTranslation>, f64, &[f64]),
    ) -> Self {
        let loading = Loading::Forces {
            far_end,
            turn_deg: 0.0,
            tension_pn,
            forces_pn: forces_pn.to_vec(),
        };
        Self::new(group, name, rises, loading)
    }

    /// Both ends held against rotation; the far end slides freely.
    pub(super) fn guided(group: Group, rises: f64, tension_pn: f64) -> Self {
        let name = format!("guided {:.0} nm, tension {tension_pn} pN", rises * RISE_NM);
        let loads = (Some(FreeTranslation::Freely), tension_pn, &SMALL_PN[..]);
        Self::forces(group, name, rises, loads)
    }

    /// Turned (deg per 73.94 nm), then pulled along the axis by each force (pN).
    pub(super) fn stretched(
        group: Group,
        name: String,
        rises: f64,
        (turned, forces_pn): (f64, &[f64]),
    ) -> Self {
        let loads = (Some(FreeTranslation::AlongAxis), 0.0, forces_pn);
        let mut case = Self::forces(group, name, rises, loads);
        if let Loading::Forces { turn_deg, .. } = &mut case.loading {
            *turn_deg = turned;
        }
        case
    }

    /// A filament of 301.2 nm, turned and pushed in at both ends.
    pub(super) fn buckled(group: Group, name: String, turn_deg: f64) -> Self {
        Self::new(group, name, 110.0, Loading::Buckled { turn_deg })
    }

    pub(super) fn length_nm(&self) -> f64 {
        self.rises * RISE_NM
    }

    fn is_quick(&self) -> bool {
        match &self.loading {
            Loading::Linked { figure } => *figure == 5,
            Loading::Buckled { turn_deg } => (90.0..=180.0).contains(turn_deg),
            Loading::Twisted { .. } => true,
            Loading::Forces {
                far_end,
                turn_deg,
                tension_pn,
                ..
            } => match far_end {
                None => *tension_pn < 10.0,
                Some(FreeTranslation::AlongAxis) => *turn_deg == 0.0,
                Some(_) => (32.5..33.5).contains(&self.rises),
            },
        }
    }

    /// Azimuths (deg) of the lattice for the mean filament and for one sampling. Axisymmetric cases
    /// have one azimuth.
    pub(super) fn azimuths_deg(&self, quick: bool) -> [Vec<f64>; 2] {
        let counts = match &self.loading {
            Loading::Twisted { .. } => [1, 1],
            Loading::Forces { far_end, .. } if *far_end == Some(FreeTranslation::AlongAxis) => {
                [1, 1]
            }
            Loading::Forces { .. } => [6, 4],
            Loading::Linked { .. } => [6, 2],
            Loading::Buckled { .. } => [3, 1],
        };
        let [mean, drawn] = counts;
        let counts = if quick {
            [u32::min(mean, 2), 1]
        } else {
            [mean, drawn]
        };
        counts.map(azimuths_deg)
    }

    /// Stem of file names.
    pub(super) fn file(&self) -> String {
        let name = format!("{:?}-{}", self.group, self.name);
        name.replace(
            |c: char| !c.is_ascii_alphanumeric() && !"+-.".contains(c),
            "_",
        )
    }
}

/// Equidistant azimuths (deg).
pub(super) fn azimuths_deg(count: u32) -> Vec<f64> {
    let step = 360.0 / f64::from(count);
    (0..count).map(|k| f64::from(k) * step).collect()
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Group {
    Cantilever,
    PulledCantilever,
    Guided,
    Linked,
    Buckled,
    Twisted,
    Stretched,
    /// Rods joined to monomers, at all resolutions.
    Mixed,
    /// Free filaments in a heat bath.
    Thermal,
    /// Reported without a bound.
    #[default]
    Beside,
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum Bound {
    /// Relative difference.
    Relative(f64),
    /// Largest distance of centre lines (nm), averaged over filaments.
    Distance(f64),
    /// One standard deviation of single filaments with sampled bonds.
    Scatter,
    /// Range over the mean.
    Spread(f64),
    /// No bound.
    #[default]
    Open,
}

/// Groups in the order of tables, with their names and bounds.
const GROUPS: [(Group, &str, Bound); 10] = [
    (Group::Cantilever, "cantilever", TWO),
    (Group::PulledCantilever, "cantilever under tension", THREE),
    (Group::Guided, "guided beam", FIVE),
    (Group::Linked, "linkers, Figures 5 and 6", FIVE),
    (Group::Buckled, "buckling, Figures 8 and 10", THREE),
    (Group::Twisted, "twist, Tables 3 and 5", Bound::Scatter),
    (Group::Stretched, "stretch and compression", FIVE),
    (Group::Mixed, "mixed filaments", Bound::Spread(0.02)),
    (Group::Thermal, "heat", FIVE),
    (Group::Beside, "beside the table", Bound::Open),
];
const TWO: Bound = Bound::Relative(0.02);
const THREE: Bound = Bound::Relative(0.03);
const FIVE: Bound = Bound::Relative(0.05);

impl Group {
    pub(super) fn name(self) -> &'static str {
        GROUPS[self as usize].1
    }

    pub(super) fn bound(self, quantity: &str) -> Bound {
        match (self, quantity) {
            (Self::Linked, "shape") => Bound::Distance(1.5),
            (Self::Thermal, "persistence length") => THREE,
            _ => GROUPS[self as usize].2,
        }
    }
}

impl Bound {
    /// Value of the bound; `scatter` is the relative deviation of single filaments.
    pub(super) fn size(self, scatter: Option<f64>) -> Option<f64> {
        match self {
            Self::Relative(bound) | Self::Distance(bound) | Self::Spread(bound) => Some(bound),
            Self::Scatter => scatter,
            Self::Open => None,
        }
    }

    /// Returns whether an error is within the bound; `None` without a bound.
    pub(super) fn is_met(self, error: f64, scatter: Option<f64>) -> Option<bool> {
        self.size(scatter).map(|bound| error.abs() <= bound)
    }

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
    use std::collections::BTreeSet;

    /// Every group with load cases has some, with unique names.
    #[test]
    fn every_group_has_cases_with_unique_names() {
        let cases = all(false);
        let groups: BTreeSet<Group> = cases.iter().map(|case| case.group).collect();
        let own = GROUPS.iter().map(|(group, ..)| *group);
        let own = own.filter(|group| ![Group::Mixed, Group::Thermal].contains(group));
        assert_eq!(groups, own.collect());
        let files: BTreeSet<String> = cases.iter().map(Case::file).collect();
        assert_eq!(files.len(), cases.len());
        let names: BTreeSet<String> = all(true).iter().map(Case::file).collect();
        assert!(names.is_subset(&files) && names.len() < files.len());
    }

    #[test]
    fn bounds_are_those_of_the_table() {
        let texts = GROUPS.map(|(group, ..)| group.bound("").text());
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
