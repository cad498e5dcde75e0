use super::Capsule;
use super::distance;
use super::passing::comes_within;
use actin_mechanics::{State, Vector3};
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

/// Largest coordinate (nm); a motion beyond it has diverged.
const FARTHEST: f64 = 1e12;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Reach {
    /// Distance of axes (nm) within which the list is complete.
    pub(super) known: f64,
    /// Additional distance (nm) of listed pairs, so that the list stays valid while bodies move.
    pub(super) skin: f64,
    /// Smallest contour distance (nm) of interacting parts of one filament.
    pub(super) apart: f64,
}

/// Neighbour list and current axes.
///
/// The list contains all pairs within `known`. It can contain more distant pairs. Callers check
/// distances, so that results do not depend on the time of the last update.
#[derive(Debug, Default)]
pub(super) struct Neighbours {
    /// Pairs with ascending indices, sorted.
    pub(super) pairs: Vec<[usize; 2]>,
    /// Current ends of all axes (nm, lab frame).
    pub(super) ends: Vec<[Vector3; 2]>,
    found_at: Vec<[Vector3; 2]>,
}

impl Neighbours {
    /// Updates the axes, and the list if a capsule has moved by more than half the skin.
    pub(super) fn update(&mut self, capsules: &[Capsule], state: &State, reach: &Reach) {
        self.ends.clear();
        let ends = capsules.iter().map(|capsule| capsule.ends(state));
        self.ends.extend(ends);
        // Two capsules can approach each other at twice this distance.
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
        let boxes: Vec<_> = self.ends.iter().map(Bounds::new).collect();
        self.pairs.clear();
        for [i, j] in meeting(&boxes, capsules, reach.apart, cutoff) {
            if distance::between(self.ends[i], self.ends[j]).squared < cutoff * cutoff {
                self.pairs.push([i, j]);
            }
        }
        self.found_at.clone_from(&self.ends);
    }

    /// First pair whose distance falls below `least` (nm) on straight paths to `later`. If the
    /// distance is below `least` already, any further approach counts.
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
        // All possible pairs are in the list.
        if 2.0 * farthest + least <= reach.known {
            return self.pairs.iter().copied().find(passes);
        }
        let boxes: Vec<_> = ways()
            .map(|way| Bounds::new(way.0).with(&Bounds::new(way.1)))
            .collect();
        let mut pairs = meeting(&boxes, capsules, reach.apart, least).into_iter();
        pairs.find(passes)
    }
}

#[derive(Clone, Copy, Debug)]
struct Bounds {
    lower: Vector3,
    upper: Vector3,
}

impl Bounds {
    fn new([a, b]: &[Vector3; 2]) -> Self {
        Self {
            lower: a.inf(b),
            upper: a.sup(b),
        }
    }

    fn with(&self, other: &Self) -> Self {
        Self {
            lower: self.lower.inf(&other.lower),
            upper: self.upper.sup(&other.upper),
        }
    }

    fn is_near(&self) -> bool {
        self.lower.amax() < FARTHEST && self.upper.amax() < FARTHEST
    }
}

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
