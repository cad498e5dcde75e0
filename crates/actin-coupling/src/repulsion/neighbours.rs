//! Which capsules are near each other: found with an R*-tree, kept until one of them has moved.

use super::Capsule;
use super::distance;
use super::passing::comes_within;
use actin_mechanics::{State, Vector3};
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

/// Coordinates beyond this (nm) have no neighbours: a motion that has exploded.
const FARTHEST: f64 = 1e12;

/// How far around contact is looked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Reach {
    /// Distance of axes (nm) within which every pair is known at all times.
    pub(super) known: f64,
    /// What is looked beyond it (nm) so that a list lasts.
    pub(super) skin: f64,
    /// Length of filament (nm) from which on parts of one repel each other.
    pub(super) apart: f64,
}

/// Pairs of near capsules, and where all of them are.
///
/// A memory, not a state: it holds at least the pairs within reach, and who reads it selects again by
/// distance. What is computed with it therefore does not depend on when it was made.
#[derive(Debug, Default)]
pub(super) struct Neighbours {
    /// Pairs, the lesser index first, sorted.
    pub(super) pairs: Vec<[usize; 2]>,
    /// Ends of all axes in the present state (nm, lab frame).
    pub(super) ends: Vec<[Vector3; 2]>,
    /// The same when the pairs were found.
    found_at: Vec<[Vector3; 2]>,
}

impl Neighbours {
    /// Takes over the places of a state, and finds the pairs again if that is needed.
    pub(super) fn update(&mut self, capsules: &[Capsule], state: &State, reach: &Reach) {
        self.ends.clear();
        let ends = capsules.iter().map(|capsule| capsule.ends(state));
        self.ends.extend(ends);
        // Two that move towards each other do so by twice as much.
        let limit = 0.5 * reach.skin;
        let is_near = |([a, b], [c, d]): (&[Vector3; 2], &[Vector3; 2])| {
            let limit2 = limit * limit;
            (a - c).norm_squared() <= limit2 && (b - d).norm_squared() <= limit2
        };
        let lasts = self.found_at.len() == self.ends.len()
            && self.ends.iter().zip(&self.found_at).all(is_near);
        if !lasts {
            self.find(capsules, reach);
        }
    }

    fn find(&mut self, capsules: &[Capsule], reach: &Reach) {
        let cutoff = reach.known + reach.skin;
        let boxes: Vec<_> = self.ends.iter().map(Bounds::around).collect();
        self.pairs.clear();
        for [i, j] in meeting(&boxes, capsules, reach.apart, cutoff) {
            if distance::between(self.ends[i], self.ends[j]).squared < cutoff * cutoff {
                self.pairs.push([i, j]);
            }
        }
        self.found_at.clone_from(&self.ends);
    }

    /// The first two capsules that come within `least` (nm) of each other, or nearer than they are, on the
    /// straight way from the present places of all to `later` ones.
    pub(super) fn first_passing(
        &self,
        capsules: &[Capsule],
        later: &[[Vector3; 2]],
        (reach, least): (&Reach, f64),
    ) -> Option<[usize; 2]> {
        let ways = || self.ends.iter().zip(later);
        let farthest = ways()
            .flat_map(|([a, b], [c, d])| [(a - c).norm_squared(), (b - d).norm_squared()])
            .fold(0.0, f64::max)
            .sqrt();
        let passes = |&[i, j]: &[usize; 2]| {
            comes_within(
                least,
                [i, j].map(|k| self.ends[k]),
                [i, j].map(|k| later[k]),
            )
        };
        // Whatever can meet in a short step is near already.
        if 2.0 * farthest + least <= reach.known {
            return self.pairs.iter().copied().find(passes);
        }
        let boxes: Vec<_> = ways()
            .map(|way| Bounds::around(way.0).with(&Bounds::around(way.1)))
            .collect();
        let mut pairs = meeting(&boxes, capsules, reach.apart, least).into_iter();
        pairs.find(passes)
    }
}

/// A box with edges along the axes.
#[derive(Clone, Copy, Debug)]
struct Bounds {
    lower: Vector3,
    upper: Vector3,
}

impl Bounds {
    /// That about a stretch.
    fn around([a, b]: &[Vector3; 2]) -> Self {
        Self {
            lower: a.inf(b),
            upper: a.sup(b),
        }
    }

    /// That about both.
    fn with(&self, other: &Self) -> Self {
        Self {
            lower: self.lower.inf(&other.lower),
            upper: self.upper.sup(&other.upper),
        }
    }

    /// Whether it is where a motion that has not exploded can be.
    fn is_near(&self) -> bool {
        self.lower.amax() < FARTHEST && self.upper.amax() < FARTHEST
    }
}

/// Pairs of capsules that may touch and whose boxes come within a distance of each other, sorted.
fn meeting(boxes: &[Bounds], capsules: &[Capsule], apart: f64, within: f64) -> Vec<[usize; 2]> {
    let near = || boxes.iter().enumerate().filter(|(_, b)| b.is_near());
    let leaves = near().map(|(i, b)| {
        let corners: [[f64; 3]; 2] = [b.lower.into(), b.upper.into()];
        GeomWithData::new(Rectangle::from_corners(corners[0], corners[1]), i)
    });
    let tree = RTree::bulk_load(leaves.collect());
    let margin = Vector3::repeat(within);
    let mut pairs = Vec::new();
    for (i, b) in near() {
        let around = AABB::from_corners((b.lower - margin).into(), (b.upper + margin).into());
        let others = tree
            .locate_in_envelope_intersecting(around)
            .map(|leaf| leaf.data);
        let touching = others.filter(|&j| j > i && capsules[i].may_touch(&capsules[j], apart));
        pairs.extend(touching.map(|j| [i, j]));
    }
    pairs.sort_unstable();
    pairs
}
