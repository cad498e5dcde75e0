//! Components of tied bodies.

use crate::layout::Layout;
use crate::ties::Ties;
use actin_mechanics::Coordinates::{self, Frame, Point};
use std::collections::{BTreeMap, BTreeSet};

/// Disjoint sets of bodies (union-find).
#[derive(Default)]
struct DisjointSets(BTreeMap<Coordinates, Coordinates>);

impl DisjointSets {
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

/// Components of tied bodies with their held places.
#[derive(Default)]
pub(super) struct Components {
    all: DisjointSets,
    held: DisjointSets,
    places: BTreeSet<Coordinates>,
}

impl Components {
    pub(super) fn new(layout: &Layout, ties: &Ties) -> Self {
        let mut components = Self::default();
        for (i, j, f) in ties.seen() {
            components.join(layout, Point(i), Point(j));
            components.join(layout, Point(i), Frame(f));
            components.join(layout, Point(j), Frame(f));
        }
        for (a, b) in ties.frames() {
            components.join(layout, Frame(a), Frame(b));
        }
        for (i, j) in ties.points() {
            components.join(layout, Point(i), Point(j));
        }
        components
    }

    fn join(&mut self, layout: &Layout, a: Coordinates, b: Coordinates) {
        let is_held = |body| layout.node_of(body).is_none();
        self.all.join(a, b);
        if is_held(a) && is_held(b) {
            self.held.join(a, b);
        }
        self.places
            .extend([a, b].into_iter().filter(|&body| is_held(body)));
    }

    pub(super) fn root(&mut self, body: Coordinates) -> Coordinates {
        self.all.root(body)
    }

    /// Number of held places per component. Held bodies tied to each other count once.
    pub(super) fn holds(&mut self) -> BTreeMap<Coordinates, usize> {
        let clusters: BTreeSet<_> = self
            .places
            .iter()
            .map(|&body| self.held.root(body))
            .collect();
        let mut holds = BTreeMap::new();
        for body in clusters {
            *holds.entry(self.all.root(body)).or_default() += 1;
        }
        holds
    }
}

/// Returns `true` if each component is held at one place at most and no links are possible.
pub(crate) fn is_open(layout: &Layout, ties: &Ties) -> bool {
    let is_held_once =
        |components: &mut Components| components.holds().values().all(|&places| places == 1);
    !layout.has_links() && is_held_once(&mut Components::new(layout, ties))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Quadratic cost without path halving.
    #[test]
    fn long_chains_are_joined_quickly() {
        let mut clusters = DisjointSets::default();
        let count = 300_000;
        for i in 1..count {
            clusters.join(Point(i - 1), Point(i));
            clusters.join(Point(0), Point(i));
        }
        let root = clusters.root(Point(0));
        assert!((1..count).all(|i| clusters.root(Point(i)) == root));
    }
}
