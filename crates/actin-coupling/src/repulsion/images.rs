use super::Capsule;
use crate::periodic::Lattice;
use actin_mechanics::Vector3;
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};
use std::ops::RangeInclusive;

/// Largest coordinate (nm); a motion beyond it has diverged.
const FARTHEST: f64 = 1e12;
/// Largest number of images of the box in which an axis is searched; a longer motion has diverged.
const MOST_IMAGES: f64 = 1e4;

/// Pair of a capsule and a periodic image of a capsule.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct NeighbourPair {
    /// Ascending indices; equal for a capsule and its own image.
    pub(super) capsules: [usize; 2],
    /// Index of the image of the second capsule.
    pub(super) image: [i32; 3],
}

impl NeighbourPair {
    /// Displacement of the image (nm, lab frame).
    pub(super) fn shift(&self, lattice: Option<Lattice>) -> Vector3 {
        let image = Vector3::from(self.image.map(f64::from));
        lattice.map_or_else(Vector3::zeros, |lattice| lattice.shift(image))
    }

    /// Ends of both axes (nm, lab frame).
    pub(super) fn ends(&self, all: &[[Vector3; 2]], lattice: Option<Lattice>) -> [[Vector3; 2]; 2] {
        let [i, j] = self.capsules;
        let shift = self.shift(lattice);
        [all[i], all[j].map(|end| end + shift)]
    }
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    lower: Vector3,
    upper: Vector3,
}

/// Bounds of the path of a capsule, moved into the periodic box.
struct Wrapped {
    capsule: usize,
    /// Index of the image of the box in which the capsule is.
    image: [i32; 3],
    bounds: Bounds,
}

type Tree = RTree<GeomWithData<Rectangle<[f64; 3]>, usize>>;

impl Bounds {
    pub(super) fn new([a, b]: &[Vector3; 2]) -> Self {
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

    fn shifted(&self, shift: Vector3) -> Self {
        Self {
            lower: self.lower + shift,
            upper: self.upper + shift,
        }
    }

    fn grown(&self, margin: f64) -> Self {
        let margin = Vector3::repeat(margin);
        Self {
            lower: self.lower - margin,
            upper: self.upper + margin,
        }
    }

    fn corners(&self) -> [[f64; 3]; 2] {
        [self.lower.into(), self.upper.into()]
    }

    fn is_near(&self) -> bool {
        self.lower.amax() < FARTHEST && self.upper.amax() < FARTHEST
    }
}

/// Sorted pairs of capsules and images that may come within a distance (nm), from the bounds of the
/// capsules before and after a motion and the lattices of images. Parts of one filament closer than
/// `apart` (nm of contour) are omitted.
pub(super) fn meeting(
    ways: &[&[Bounds]; 2],
    lattices: Option<[Lattice; 2]>,
    (capsules, apart): (&[Capsule], f64),
    within: f64,
) -> Vec<NeighbourPair> {
    let paths = ways[0].iter().zip(ways[1]).enumerate();
    let wrapped = paths.map(|(i, (from, to))| Wrapped::new(i, [from, to], lattices));
    let all: Vec<_> = wrapped.filter(|one| one.bounds.is_near()).collect();
    let leaves = all.iter().enumerate().map(|(k, one)| {
        let [lower, upper] = one.bounds.corners();
        GeomWithData::new(Rectangle::from_corners(lower, upper), k)
    });
    let tree = Tree::bulk_load(leaves.collect());
    let mut pairs = Vec::new();
    for one in &all {
        let around = one.bounds.grown(within);
        for (image, [lower, upper]) in images(&tree, &around, lattices) {
            let others = tree.locate_in_envelope_intersecting(AABB::from_corners(lower, upper));
            let pair = |other: &Wrapped| NeighbourPair {
                capsules: [one.capsule, other.capsule],
                image: [0, 1, 2].map(|k| image[k] + one.image[k] - other.image[k]),
            };
            let pair = others.map(|leaf| pair(&all[leaf.data]));
            pairs.extend(pair.filter(|pair| may_touch(pair, capsules, apart)));
        }
    }
    pairs.sort_unstable();
    pairs
}

/// Returns whether a pair is the first of its two descriptions, and its parts may touch.
fn may_touch(pair: &NeighbourPair, capsules: &[Capsule], apart: f64) -> bool {
    let [i, j] = pair.capsules;
    let is_image = pair.image != [0; 3];
    let is_first = i < j || (i == j && pair.image > [0; 3]);
    is_first && (is_image || capsules[i].may_touch(&capsules[j], apart))
}

impl Wrapped {
    fn new(capsule: usize, [from, to]: [&Bounds; 2], lattices: Option<[Lattice; 2]>) -> Self {
        let Some([first, second]) = lattices else {
            let (image, bounds) = ([0; 3], from.with(to));
            return Self {
                capsule,
                image,
                bounds,
            };
        };
        let index = first.fractions(from.lower).map(f64::floor);
        // The limit exceeds all positions that have not diverged.
        let index = index.map(|n| n.clamp(-1e8, 1e8));
        let from = from.shifted(-first.shift(index));
        let to = to.shifted(-second.shift(index));
        Self {
            capsule,
            image: index.map(whole).into(),
            bounds: from.with(&to),
        }
    }
}

/// Indices of the images of the box in which bounds overlap the bounds of the tree, and the corners
/// of the bounds moved from there into the box.
fn images(
    tree: &Tree,
    around: &Bounds,
    lattices: Option<[Lattice; 2]>,
) -> Vec<([i32; 3], [[f64; 3]; 2])> {
    let Some(lattices) = lattices else {
        return vec![([0; 3], around.corners())];
    };
    let of_tree = tree.root().envelope();
    let (low, high) = (
        Vector3::from(of_tree.lower()),
        Vector3::from(of_tree.upper()),
    );
    let size = lattices[0].size;
    let overlapping = |k: usize, around: &Bounds| -> RangeInclusive<i32> {
        let first = ((around.lower[k] - high[k]) / size[k]).ceil();
        let last = ((around.upper[k] - low[k]) / size[k]).floor();
        whole(first)..=whole(last)
    };
    let extent = around.upper - around.lower + high - low;
    if extent.component_div(&size).map(|n| 1.0 + n).product() > MOST_IMAGES {
        return Vec::new();
    }
    let mut found = Vec::new();
    for z in overlapping(2, around) {
        let along_z = Vector3::new(0.0, 0.0, f64::from(z));
        let [first, second] = lattices.map(|lattice| around.shifted(-lattice.shift(along_z)));
        let sheared = first.with(&second);
        for y in overlapping(1, around) {
            for x in overlapping(0, &sheared) {
                let across = Vector3::new(f64::from(x) * size.x, f64::from(y) * size.y, 0.0);
                found.push(([x, y, z], sheared.shifted(-across).corners()));
            }
        }
    }
    found
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "whole numbers; the conversion saturates for motions that have diverged"
)]
fn whole(number: f64) -> i32 {
    number as i32
}
