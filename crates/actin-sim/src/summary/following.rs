//! Summary of a motion with switches of cells.

use super::Summary;
use crate::follow::StretchStart;
use actin_assembly::{UnstableTwist, worst};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Effect of all switches of cells during a motion.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FollowingSummary {
    /// Number of switches; one switch may change several cells.
    pub switches: usize,
    /// Total energy added by switches (pN nm).
    pub switches_pn_nm: f64,
    /// Largest momentum change of a switch (ag nm/ns), due to round-off.
    pub largest_momentum_change: f64,
    /// Fraction of cells resolved by monomers, averaged over time.
    pub share_of_monomers: f64,
}

impl Summary {
    /// Creates the summary of a motion from the starts and summaries of its stretches; it ended at
    /// `end_ns` with the record that `last` describes.
    pub fn from_stretches(
        starts: &[StretchStart],
        stretches: Vec<Self>,
        last: &Self,
        end_ns: f64,
    ) -> Self {
        let mut all = Self {
            following: Some(FollowingSummary::new(starts, end_ns)),
            observables: BTreeMap::new(),
            thermal: None,
            ..last.clone()
        };
        for one in stretches {
            all.add_remarks(one);
        }
        all.beyond_use = worst(std::mem::take(&mut all.beyond_use));
        let excess = |found: &UnstableTwist| {
            let bound = found.bound_pn;
            bound.map_or(f64::INFINITY, |bound| found.compression_pn / bound)
        };
        all.unstable_twist
            .sort_by(|a, b| excess(b).total_cmp(&excess(a)));
        all.unstable_twist.truncate(1);
        if !last.observables.is_empty() || last.thermal.is_some() {
            let note =
                "means over records are available per stretch only, in stretches/*/summary.json";
            all.notes.push(note.to_owned());
        }
        all.with_derived_warnings()
    }

    /// Adds the notes and the worst values of a stretch.
    fn add_remarks(&mut self, one: Self) {
        let notes = one.coded_notes();
        self.beyond_use.extend(one.beyond_use);
        self.unstable_twist.extend(one.unstable_twist);
        for beyond in one.beyond_range {
            let mut known = self.beyond_range.iter_mut();
            match known.find(|known| known.quantity == beyond.quantity) {
                Some(known) if known.value.abs() >= beyond.value.abs() => {}
                Some(known) => *known = beyond,
                None => self.beyond_range.push(beyond),
            }
        }
        for note in notes {
            if !self.notes.iter().any(|text| is_alike(text, &note.message)) {
                self.add_note(note);
            }
        }
    }
}

impl FollowingSummary {
    fn new(starts: &[StretchStart], end_ns: f64) -> Self {
        let switches = || starts.iter().filter_map(|one| one.switch.as_ref());
        let from = std::iter::once(0.0).chain(switches().map(|switch| switch.time_ns));
        let to = from.clone().skip(1).chain([end_ns]);
        let weighted = starts.iter().zip(from.zip(to)).map(|(one, (from, to))| {
            let monomers = one.is_monomers.iter().filter(|resolved| **resolved).count();
            (to - from) * monomers as f64 / one.is_monomers.len() as f64
        });
        Self {
            switches: switches().count(),
            switches_pn_nm: starts.last().map_or(0.0, |one| one.switches_pn_nm),
            largest_momentum_change: switches().fold(0.0, |most, s| most.max(s.momentum_change)),
            share_of_monomers: if end_ns > 0.0 {
                weighted.sum::<f64>() / end_ns
            } else {
                0.0
            },
        }
    }
}

fn is_alike(one: &str, other: &str) -> bool {
    let words = |note: &str| -> String { note.chars().filter(|c| !c.is_ascii_digit()).collect() };
    words(one) == words(other)
}
