//! The load cases: how a filament is held and loaded, and what is read. How that is computed is in `solve.rs`.

use super::bound::Group;
use super::filament::RISE_NM;

/// A load case.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Case {
    /// Which row of the table it belongs to.
    pub group: Group,
    /// Name in tables and files.
    pub name: String,
    /// How the filament is loaded.
    pub kind: Kind,
}

/// Ways of loading. Lengths are in rises.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Kind {
    /// Held at one end, pulled along the axis, then pushed across the tip with each force (pN). Read: how
    /// far the tip goes along the force (nm), from where the tension alone brought it.
    Cantilever {
        /// From the wall to where the force acts, less half a rise: on monomers midway between the last two.
        rises: u32,
        tension_pn: f64,
        forces_pn: Vec<f64>,
    },
    /// Both ends held against turning, the far one slides freely; pulled along, then pushed across. Read:
    /// displacement over force (nm/pN).
    Guided {
        rises: u32,
        tension_pn: f64,
        forces_pn: Vec<f64>,
    },
    /// Figure 5, or Figure 6. Read: energy (pN nm) and centre line.
    Linked { figure: u32 },
    /// 110 rises, each end turned so far (deg) and pushed in by 7.5 nm. Read: height (nm), couple (pN nm),
    /// thrust (pN).
    Buckled { turn_deg: f64 },
    /// Turned by so many deg per 73.94 nm, free to change its length. Read: secant twisting rigidity
    /// (pN nm^2) and change of length.
    Twisted { rises: u32, turns_deg: Vec<f64> },
    /// Turned by `turn_deg` per 73.94 nm, then pulled with each force (pN). Read: secant stretching rigidity
    /// (pN).
    Stretched {
        rises: u32,
        turn_deg: f64,
        forces_pn: Vec<f64>,
    },
}

/// The length to which turns refer (nm): that of Tables 3 and 5, 27 rises.
pub(super) const TURNED_NM: f64 = 27.0 * RISE_NM;

/// Forces across a cantilever that is not pulled (pN).
const ACROSS_PN: [f64; 5] = [0.05, 0.2, 1.0, 2.0, 5.0];
/// Forces across what is pulled (pN).
const SMALL_PN: [f64; 2] = [0.1, 0.5];
/// Tensions of cantilevers and of guided beams (pN).
const PULL_PN: [f64; 4] = [1.0, 5.0, 10.0, 40.0];
const GUIDED_PULL_PN: [f64; 3] = [0.0, 5.0, 10.0];
/// Spans of guided beams with and without a bound: 60, 90, 150 nm; 25, 30, 40 nm.
const GUIDED: [u32; 3] = [22, 33, 55];
const SHORT: [u32; 3] = [9, 11, 15];
/// From the wall to the load of a cantilever, less half a rise: 160.2 nm.
const CANTILEVER: u32 = 58;
/// Turns (deg) of which Tables 3 and 5 have rows.
const TURNS_DEG: [f64; 5] = [10.0, 40.0, 80.0, 120.0, 180.0];
/// Forces along a filament (pN).
const ALONG_PN: [f64; 3] = [2.0, 10.0, 40.0];
/// Twist under which filaments are stretched (deg per 73.94 nm).
const HELD_DEG: [f64; 3] = [0.0, 80.0, -80.0];

/// All cases; the first and last of each list if `quick`.
pub(super) fn all(quick: bool) -> Vec<Case> {
    let mut all = vec![cantilever(Group::Cantilever, 0.0, &ACROSS_PN)];
    all.extend(PULL_PN.map(|pull| cantilever(Group::PulledCantilever, pull, &SMALL_PN)));
    for (group, spans) in [(Group::Guided, GUIDED), (Group::Beside, SHORT)] {
        for rises in spans {
            all.extend(GUIDED_PULL_PN.map(|pull| guided(group, rises, pull)));
        }
    }
    all.extend([5, 6].map(linked));
    all.extend([180.0, -180.0, 270.0, -270.0].map(buckled));
    all.push(twisted());
    for turn_deg in HELD_DEG {
        all.extend([1.0, -1.0].map(|sign| stretched(turn_deg, sign)));
    }
    if quick {
        all.retain(is_quick);
    }
    all
}

/// What takes little time and covers most of the table.
fn is_quick(case: &Case) -> bool {
    match &case.kind {
        Kind::Cantilever { tension_pn, .. } => *tension_pn < 10.0,
        Kind::Guided { rises, .. } => *rises == GUIDED[1],
        Kind::Linked { figure } => *figure == 5,
        Kind::Buckled { turn_deg } => (90.0..=180.0).contains(turn_deg),
        Kind::Twisted { .. } => true,
        Kind::Stretched { turn_deg, .. } => *turn_deg == 0.0,
    }
}

fn cantilever(group: Group, tension_pn: f64, forces_pn: &[f64]) -> Case {
    Case {
        group,
        name: format!("160 nm, tension {tension_pn} pN"),
        kind: Kind::Cantilever {
            rises: CANTILEVER,
            tension_pn,
            forces_pn: forces_pn.to_vec(),
        },
    }
}

/// A guided beam.
pub(super) fn guided(group: Group, rises: u32, tension_pn: f64) -> Case {
    let nm = f64::from(rises) * RISE_NM;
    Case {
        group,
        name: format!("guided {nm:.0} nm, tension {tension_pn} pN"),
        kind: Kind::Guided {
            rises,
            tension_pn,
            forces_pn: SMALL_PN.to_vec(),
        },
    }
}

fn linked(figure: u32) -> Case {
    Case {
        group: Group::Linked,
        name: format!("Figure {figure}"),
        kind: Kind::Linked { figure },
    }
}

fn buckled(turn_deg: f64) -> Case {
    Case {
        group: Group::Buckled,
        name: format!("turned {turn_deg:+} deg"),
        kind: Kind::Buckled { turn_deg },
    }
}

fn twisted() -> Case {
    Case {
        group: Group::Twisted,
        name: "74 nm".to_owned(),
        kind: Kind::Twisted {
            rises: 27,
            turns_deg: TURNS_DEG
                .into_iter()
                .flat_map(|turn| [turn, -turn])
                .collect(),
        },
    }
}

fn stretched(turn_deg: f64, sign: f64) -> Case {
    let what = if sign > 0.0 { "pulled" } else { "pushed" };
    Case {
        group: Group::Stretched,
        name: format!("74 nm, turned {turn_deg:+} deg, {what}"),
        kind: Kind::Stretched {
            rises: 27,
            turn_deg,
            forces_pn: ALONG_PN.map(|force| sign * force).to_vec(),
        },
    }
}

impl Case {
    /// Azimuths of the lattice at which the mean filament and one sampling are loaded (deg). Without a
    /// direction across the axis there is one.
    pub(super) fn azimuths_deg(&self, quick: bool) -> [Vec<f64>; 2] {
        let round = |count: u32| -> Vec<f64> {
            let step = 360.0 / f64::from(count);
            (0..count).map(|k| f64::from(k) * step).collect()
        };
        let (mean, drawn) = match self.kind {
            Kind::Cantilever { .. } | Kind::Guided { .. } => (6, 4),
            Kind::Linked { .. } => (6, 2),
            Kind::Buckled { .. } => (3, 1),
            Kind::Twisted { .. } | Kind::Stretched { .. } => (1, 1),
        };
        if quick {
            return [round(u32::min(mean, 2)), round(1)];
        }
        [round(mean), round(drawn)]
    }

    /// Its name as part of a file's.
    pub(super) fn file(&self) -> String {
        let name = format!("{:?}-{}", self.group, self.name);
        let plain = |c: char| {
            if c.is_ascii_alphanumeric() || "+-.".contains(c) {
                c
            } else {
                '_'
            }
        };
        name.chars().map(plain).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// Every row of the table that has load cases of its own has some, no two of one name.
    #[test]
    fn the_table_is_covered() {
        let cases = all(false);
        let groups: BTreeSet<Group> = cases.iter().map(|case| case.group).collect();
        let own = Group::ALL.into_iter();
        let own = own.filter(|group| ![Group::Mixed, Group::Thermal].contains(group));
        assert_eq!(groups, own.collect());
        let files: BTreeSet<String> = cases.iter().map(Case::file).collect();
        assert_eq!(files.len(), cases.len());
        assert!(all(true).iter().all(|case| cases.contains(case)));
    }
}
