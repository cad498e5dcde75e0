//! What was chosen, and what is said of it.

use super::{ErrorEstimate, RodStretch};
use crate::notes::{Note, codes};
use crate::scene::Quantity;
use serde::{Deserialize, Serialize};

/// What was chosen, and why.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Chosen {
    /// What was wanted.
    pub quantity: Quantity,
    /// Its largest relative error.
    pub wanted_error: f64,
    /// The most monomers that were allowed; none without a limit.
    pub most_monomers: Option<usize>,
    /// Whether the wanted error is met, also where each part of the estimate is a fifth off, and monomers have one state wherever there
    /// are rods. Always so without a limit.
    pub is_met: bool,
    /// Where rods are left whose monomers would have several states (nm of arc length).
    #[serde(default)]
    pub several_states_nm: Vec<[f64; 2]>,
    /// Estimated error over the corrected value; 0 where every monomer is resolved.
    pub relative_error: f64,
    /// Monomers that are resolved.
    pub monomers: usize,
    /// Where monomers are resolved (nm of arc length).
    pub monomers_nm: Vec<[f64; 2]>,
    /// Length of segments (nm), as nearly as whole ones allow; the longest, where they are graded.
    pub segment_nm: f64,
    /// The rods in order, where their segments differ in length; none where all are as long.
    #[serde(default)]
    pub graded: Vec<RodStretch>,
    /// The error that is left; none where every monomer is resolved.
    pub estimate: Option<ErrorEstimate>,
    /// Resolutions that were tried, and the estimated relative error of each.
    pub tried: Vec<Tried>,
    /// Time that the choice took (s).
    pub wall_s: f64,
}

impl Chosen {
    /// The choice in a sentence or two.
    pub(crate) fn note(&self) -> Note {
        let limit = self
            .most_monomers
            .map_or_else(String::new, |most| format!(" with at most {most} monomers"));
        let left = self.estimate.map_or_else(String::new, |estimate| {
            let percent = 100.0 * estimate.relative();
            let [value, corrected] =
                [estimate.value, estimate.corrected()].map(|value| self.quantity.show(value));
            format!(
                ". It is {value} in the equilibrium at rest, {corrected} with its estimated error of {percent:.2} %"
            )
        });
        let missed = if self.is_met {
            String::new()
        } else if !self.several_states_nm.is_empty() {
            format!(
                ". Its error is not known: where it is a rod from {}, monomers would have several states, and those are more than \
                 are allowed",
                places(&self.several_states_nm)
            )
        } else {
            format!(
                ". What is wanted is not met within so many monomers; of {} resolutions tried this one has the least \
                 estimated error",
                self.tried.len()
            )
        };
        let message = format!(
            "sections chosen for {} within {} %{limit}: {}{left}{missed}",
            self.quantity,
            100.0 * self.wanted_error,
            self.resolved()
        );
        if self.is_met {
            message.into()
        } else {
            Note::warning(codes::RESOLUTION, message)
        }
    }

    /// What is resolved how.
    fn resolved(&self) -> String {
        let monomers = places(&self.monomers_nm);
        match (monomers.is_empty(), self.estimate) {
            (true, _) => format!("a rod of segments of {}", self.segments()),
            (false, Some(_)) => {
                let segments = self.segments();
                format!("monomers from {monomers}, and a rod of segments of {segments}")
            }
            (false, None) => "every monomer".to_owned(),
        }
    }

    /// How long segments are.
    fn segments(&self) -> String {
        let rounded = |segment_nm: f64| (10.0 * segment_nm).round() / 10.0;
        if self.graded.is_empty() {
            return format!("{} nm", rounded(self.segment_nm));
        }
        let stretches = self.graded.iter().map(|rod| {
            let length = rounded(rod.segment_nm());
            format!("{length} nm from {:.0} to {:.0} nm", rod.from_nm, rod.to_nm)
        });
        stretches.collect::<Vec<_>>().join(", ")
    }
}

/// Stretches in words.
fn places(stretches: &[[f64; 2]]) -> String {
    let stretches = stretches.iter();
    let stretches = stretches.map(|[from, to]| format!("{from:.0} to {to:.0} nm"));
    stretches.collect::<Vec<_>>().join(", ")
}

/// A resolution that was tried.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tried {
    /// Where monomers were resolved (nm of arc length).
    pub monomers_nm: Vec<[f64; 2]>,
    /// Length of segments (nm); the longest, where they were graded.
    pub segment_nm: f64,
    /// Stretches with segments of one length each, where they were graded.
    #[serde(default)]
    pub graded: Vec<RodStretch>,
    /// Estimated error over the corrected value.
    pub relative_error: f64,
}
