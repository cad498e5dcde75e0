//! Which capsules are near each other: found with an R*-tree, kept until one of them has moved.

use super::Capsule;
use super::distance;
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
        let boxes = self.ends.iter().enumerate();
        let boxes = boxes.filter(|(_, ends)| ends.iter().all(|x| x.amax() < FARTHEST));
        let boxes: Vec<_> = boxes.map(|(i, ends)| boxed(*ends, i)).collect();
        let tree = RTree::bulk_load(boxes);
        self.pairs.clear();
        for (i, ends) in self.ends.iter().enumerate() {
            if !ends.iter().all(|x| x.amax() < FARTHEST) {
                continue;
            }
            for other in tree.locate_in_envelope_intersecting(around(*ends, cutoff)) {
                let j = other.data;
                let may_touch = j > i && capsules[i].may_touch(&capsules[j], reach.apart);
                if may_touch && distance::between(*ends, self.ends[j]).squared < cutoff * cutoff {
                    self.pairs.push([i, j]);
                }
            }
        }
        self.pairs.sort_unstable();
        self.found_at.clone_from(&self.ends);
    }
}

/// The box about an axis, with the index of its capsule.
fn boxed([a, b]: [Vector3; 2], i: usize) -> GeomWithData<Rectangle<[f64; 3]>, usize> {
    GeomWithData::new(Rectangle::from_corners(a.into(), b.into()), i)
}

/// The box about an axis, wider by `margin` on all sides.
fn around([a, b]: [Vector3; 2], margin: f64) -> AABB<[f64; 3]> {
    let margin = Vector3::repeat(margin);
    AABB::from_corners((a.inf(&b) - margin).into(), (a.sup(&b) + margin).into())
}
