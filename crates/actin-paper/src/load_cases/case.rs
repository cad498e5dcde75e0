//! Load cases: clamps, loads, compared quantities and error bounds. Cases and bounds were fixed
//! before the first result.

use super::filament::RISE_NM;
use actin_sim::{FreeTranslation, read_ron};
use serde::Deserialize;

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
#[derive(Clone, Debug, Deserialize, PartialEq)]
pub(super) enum Loading {
    /// Clamped at the start, turned (deg per 73.94 nm) or pulled (pN), then loaded with each force
    /// (pN). The force is axial if the far end slides along the axis, else transverse.
    ///
    /// Compared: displacement of the far end (nm) of a cantilever, displacement over force (nm/pN)
    /// if the end slides freely, secant stretching rigidity (pN) if it slides along the axis.
    Forces {
        #[serde(default)]
        far_end: Option<FreeTranslation>,
        #[serde(default)]
        turn_deg: f64,
        #[serde(default)]
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

/// Forces of guided beams (pN).
const SMALL_PN: [f64; 2] = [0.1, 0.5];

#[derive(Deserialize)]
struct LoadCases {
    cases: Vec<ListedCase>,
}

/// Case of `data/load_cases.ron`.
#[derive(Deserialize)]
struct ListedCase {
    group: Group,
    name: String,
    #[serde(default)]
    rises: Option<f64>,
    loading: Loading,
    #[serde(default)]
    quick: bool,
}

/// All cases, or a representative subset if `quick`.
pub(super) fn all(quick: bool) -> Vec<Case> {
    let listed: LoadCases = read_ron(include_str!("../../data/load_cases.ron"), "LoadCases")
        .expect("`data/load_cases.ron` is well formed");
    let chosen = listed.cases.into_iter().filter(|case| !quick || case.quick);
    chosen
        .map(|case| {
            let is_sized = matches!(case.loading, Loading::Linked { .. });
            let rises = case.rises.or(is_sized.then_some(f64::NAN));
            let rises = rises.unwrap_or_else(|| panic!("`{}` needs `rises`", case.name));
            Case::new(case.group, case.name, rises, case.loading)
        })
        .collect()
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

    /// Clamped at the start, pulled by a tension (pN), then loaded with each force (pN).
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

    pub(super) fn length_nm(&self) -> f64 {
        self.rises * RISE_NM
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

#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Group {
    Cantilever,
    PulledCantilever,
    Guided,
    Linked,
    Buckled,
    Twisted,
    Stretched,
    /// Pushed along the axis beyond buckling.
    Column,
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
const GROUPS: [(Group, &str, Bound); 11] = [
    (Group::Cantilever, "cantilever", TWO),
    (Group::PulledCantilever, "cantilever under tension", THREE),
    (Group::Guided, "guided beam", FIVE),
    (Group::Linked, "linkers, Figures 5 and 6", FIVE),
    (Group::Buckled, "buckling, Figures 8 and 10", THREE),
    (Group::Twisted, "twist, Tables 3 and 5", Bound::Scatter),
    (Group::Stretched, "stretch and compression", FIVE),
    (Group::Column, "buckled columns", FIVE),
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
            "2 %", "3 %", "5 %", "5 %", "3 %", "scatter", "5 %", "5 %", "2 %", "5 %", "",
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
