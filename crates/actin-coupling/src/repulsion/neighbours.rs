use super::Capsule;
use actin_mechanics::{State, Vector3, segments};
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

/// Largest coordinate (nm); a motion beyond it has diverged.
const FARTHEST: f64 = 1e12;

/// A list that is used less often than this before it must be renewed is made longer.
const FEW_USES: u32 = 16;
/// A list that is used more often than this is made shorter.
const MANY_USES: u32 = 256;
/// Factor of these changes.
const CHANGE: f64 = 1.5;
/// Largest skin in units of the smallest one. Longer motions are searched directly.
const THICKEST: f64 = 32.0;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Reach {
    /// Distance of axes (nm) within which the list is complete.
    pub(super) known: f64,
    /// Smallest additional distance (nm) of listed pairs, so that the list stays valid while bodies
    /// move.
    pub(super) skin: f64,
    /// Smallest contour distance (nm) of interacting parts of one filament.
    pub(super) apart: f64,
}

/// Neighbour list and current axes.
///
/// The list contains all pairs within `known`. It can contain more distant pairs. Callers check
/// distances, so that results do not depend on the time of the last update. The skin adapts to the
/// motion between uses.
#[derive(Debug, Default)]
pub(super) struct Neighbours {
    /// Pairs with ascending indices, sorted.
    pub(super) pairs: Vec<[usize; 2]>,
    /// Current squared distance of each pair (nm^2).
    squares: Vec<f64>,
    /// Capsules that have moved since the last use.
    moved: Vec<bool>,
    /// Current ends of all axes (nm, lab frame).
    pub(super) ends: Vec<[Vector3; 2]>,
    found_at: Vec<[Vector3; 2]>,
    skin: f64,
    /// Number of uses of the list.
    uses: u32,
}

impl Neighbours {
    /// Updates the axes and distances, and the list if a capsule has moved by more than half the
    /// skin.
    pub(super) fn update(&mut self, capsules: &[Capsule], state: &State, reach: &Reach) {
        let is_listed = self.ends.len() == capsules.len();
        if !is_listed {
            self.ends = capsules.iter().map(|capsule| capsule.ends(state)).collect();
            return self.find(capsules, reach, 0.0);
        }
        self.moved.clear();
        for (capsule, ends) in capsules.iter().zip(&mut self.ends) {
            let now = capsule.ends(state);
            self.moved.push(*ends != now);
            *ends = now;
        }
        // Two capsules can approach each other at twice this distance.
        if 2.0 * farthest(&self.found_at, &self.ends) > self.skin {
            let factor = match self.uses {
                uses if uses < FEW_USES => CHANGE,
                uses if uses > MANY_USES => 1.0 / CHANGE,
                _ => 1.0,
            };
            return self.find(capsules, reach, factor * self.skin);
        }
        if self.moved.iter().any(|moved| *moved) {
            self.uses = self.uses.saturating_add(1);
            for (&[i, j], square) in self.pairs.iter().zip(&mut self.squares) {
                if self.moved[i] || self.moved[j] {
                    *square = segments::nearest_points(self.ends[i], self.ends[j]).squared;
                }
            }
        }
    }

    /// Pairs within a distance (nm) of at most `known`.
    pub(super) fn within(&self, distance: f64) -> impl Iterator<Item = [usize; 2]> {
        let pairs = self.pairs.iter().zip(&self.squares);
        let near = pairs.filter(move |(_, square)| **square < distance * distance);
        near.map(|(pair, _)| *pair)
    }

    fn find(&mut self, capsules: &[Capsule], reach: &Reach, skin: f64) {
        self.skin = skin.clamp(reach.skin, THICKEST * reach.skin);
        self.uses = 0;
        let cutoff = reach.known + self.skin;
        let boxes: Vec<_> = self.ends.iter().map(Bounds::new).collect();
        self.pairs.clear();
        self.squares.clear();
        for [i, j] in meeting(&boxes, capsules, reach.apart, cutoff) {
            let nearest = segments::nearest_points(self.ends[i], self.ends[j]);
            if nearest.squared < cutoff * cutoff {
                self.pairs.push([i, j]);
                self.squares.push(nearest.squared);
            }
        }
        self.found_at.clone_from(&self.ends);
    }

    /// Pairs that may come within `least` (nm) on straight paths to `later`.
    pub(super) fn meeting_on_the_way(
        &mut self,
        capsules: &[Capsule],
        later: &[[Vector3; 2]],
        (reach, least): (&Reach, f64),
    ) -> Vec<[usize; 2]> {
        let needed = 2.0 * farthest(&self.ends, later) + least - reach.known;
        if needed > THICKEST * reach.skin {
            let ways = self.ends.iter().zip(later);
            let boxes: Vec<_> = ways
                .map(|way| Bounds::new(way.0).with(&Bounds::new(way.1)))
                .collect();
            return meeting(&boxes, capsules, reach.apart, least);
        }
        if needed > self.skin - 2.0 * farthest(&self.found_at, &self.ends) {
            self.find(capsules, reach, CHANGE * needed);
        }
        let ways = self.ends.iter().zip(later);
        let lengths: Vec<f64> = ways
            .map(|([a, b], [c, d])| (a - c).norm().max((b - d).norm()))
            .collect();
        let pairs = self.pairs.iter().zip(&self.squares);
        let may_meet = |pair: [usize; 2], square: f64| {
            let path: f64 = pair.iter().map(|i| lengths[*i]).sum();
            path > 0.0 && square < (path + least).powi(2)
        };
        let meeting = pairs.filter(|(pair, square)| may_meet(**pair, **square));
        meeting.map(|(pair, _)| *pair).collect()
    }
}

/// Largest displacement of an end (nm); infinite if not finite.
fn farthest(from: &[[Vector3; 2]], to: &[[Vector3; 2]]) -> f64 {
    let moved = |([a, b], [c, d]): (&[Vector3; 2], &[Vector3; 2])| {
        let squares = [(a - c).norm_squared(), (b - d).norm_squared()];
        squares.map(|square| {
            if square.is_finite() {
                square
            } else {
                f64::INFINITY
            }
        })
    };
    let squares = from.iter().zip(to).flat_map(moved);
    squares.fold(0.0, f64::max).sqrt()
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
