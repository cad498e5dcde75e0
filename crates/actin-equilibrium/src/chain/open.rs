//! Whether what hangs together hangs on one place only, so that bodies can carry one another along freely.

use crate::layout::Layout;
use crate::ties::Ties;
use actin_mechanics::Coordinates::{self, Frame, Point};
use std::collections::{BTreeMap, BTreeSet};

/// Sets of bodies that hang together.
#[derive(Default)]
struct Clusters(BTreeMap<Coordinates, Coordinates>);

impl Clusters {
    /// The root of a set; links on the way are halved, so that `n` joins take `n log n` steps.
    fn root(&mut self, mut body: Coordinates) -> Coordinates {
        while let Some(&above) = self.0.get(&body) {
            let Some(&higher) = self.0.get(&above) else {
                return above;
            };
            self.0.insert(body, higher);
            body = higher;
        }
        body
    }

    fn join(&mut self, a: Coordinates, b: Coordinates) {
        let (a, b) = (self.root(a), self.root(b));
        if a != b {
            self.0.insert(a, b);
        }
    }
}

/// Whether no two held bodies that are not tied to each other hold the same bodies, and no bodies are coupled
/// but no neighbours: a filament held at one end is open, one held at both or linked to another is not.
pub(crate) fn is_open(layout: &Layout, ties: &Ties) -> bool {
    if layout.has_loose() {
        return false;
    }
    let is_held = |body| layout.node_of(body).is_none();
    let (mut all, mut held) = (Clusters::default(), Clusters::default());
    let mut places = BTreeSet::new();
    let mut join = |a: Coordinates, b: Coordinates| {
        all.join(a, b);
        if is_held(a) && is_held(b) {
            held.join(a, b);
        }
        places.extend([a, b].into_iter().filter(|&body| is_held(body)));
    };
    for (i, j, f) in ties.seen() {
        join(Point(i), Point(j));
        join(Point(i), Frame(f));
        join(Point(j), Frame(f));
    }
    ties.frames().for_each(|(a, b)| join(Frame(a), Frame(b)));
    ties.points().for_each(|(i, j)| join(Point(i), Point(j)));
    let clusters: BTreeSet<_> = places.iter().map(|&body| held.root(body)).collect();
    let held_up: BTreeSet<_> = clusters.iter().map(|&body| all.root(body)).collect();
    clusters.len() == held_up.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A long chain: with links that are not shortened a million lookups of a million links each.
    #[test]
    fn long_chains_are_joined_quickly() {
        let mut clusters = Clusters::default();
        let count = 300_000;
        for i in 1..count {
            clusters.join(Point(i - 1), Point(i));
            clusters.join(Point(0), Point(i));
        }
        let root = clusters.root(Point(0));
        assert!((1..count).all(|i| clusters.root(Point(i)) == root));
    }
}
