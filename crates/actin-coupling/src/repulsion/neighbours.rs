use super::Capsule;
use super::images::{Bounds, NeighbourPair, meeting};
use crate::PeriodicCell;
use crate::periodic::Lattice;
use actin_mechanics::{State, Vector3, segments};

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
    /// Periodic box; `None` in open space.
    pub(super) cell: Option<PeriodicCell>,
}

/// Neighbour list and current axes.
///
/// The list contains all pairs within `known`. It can contain more distant pairs. Callers check
/// distances, so that results do not depend on the time of the last update. The skin adapts to the
/// motion between uses.
#[derive(Debug, Default)]
pub(super) struct Neighbours {
    /// Sorted pairs.
    pub(super) pairs: Vec<NeighbourPair>,
    /// Current squared distance of each pair (nm^2).
    squares: Vec<f64>,
    /// Capsules that have moved since the last use.
    moved: Vec<bool>,
    /// Current ends of all axes (nm, lab frame).
    pub(super) ends: Vec<[Vector3; 2]>,
    /// Current lattice of images.
    pub(super) lattice: Option<Lattice>,
    found_at: Vec<[Vector3; 2]>,
    found_in: Option<Lattice>,
    skin: f64,
    /// Number of uses of the list.
    uses: u32,
}

impl Neighbours {
    /// Updates the axes and distances, and the list if capsules may have moved by more than the
    /// skin relative to each other.
    pub(super) fn update(&mut self, capsules: &[Capsule], state: &State, reach: &Reach) {
        let is_listed = self.ends.len() == capsules.len();
        let lattice = reach.cell.map(|cell| cell.lattice(state));
        let is_strained = self.lattice != lattice;
        self.lattice = lattice;
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
        if self.moved_since_found(reach) > self.skin {
            let factor = match self.uses {
                uses if uses < FEW_USES => CHANGE,
                uses if uses > MANY_USES => 1.0 / CHANGE,
                _ => 1.0,
            };
            return self.find(capsules, reach, factor * self.skin);
        }
        if is_strained || self.moved.iter().any(|moved| *moved) {
            self.uses = self.uses.saturating_add(1);
            for (pair, square) in self.pairs.iter().zip(&mut self.squares) {
                let [i, j] = pair.capsules;
                if is_strained || self.moved[i] || self.moved[j] {
                    let [a, b] = pair.ends(&self.ends, self.lattice);
                    *square = segments::nearest_points(a, b).squared;
                }
            }
        }
    }

    /// Upper bound of the relative displacement (nm) since the last search of two axes within the
    /// skin of `known`.
    fn moved_since_found(&self, reach: &Reach) -> f64 {
        let moves = (self.found_at.as_slice(), self.ends.as_slice());
        let longest = reach.known + self.skin;
        relative_displacement(moves, [self.found_in, self.lattice], longest)
    }

    /// Pairs within a distance (nm) of at most `known`, with the ends of both axes.
    pub(super) fn within(
        &self,
        distance: f64,
    ) -> impl Iterator<Item = (&NeighbourPair, [[Vector3; 2]; 2])> {
        let pairs = self.pairs.iter().zip(&self.squares);
        let near = pairs.filter(move |(_, square)| **square < distance * distance);
        near.map(|(pair, _)| (pair, pair.ends(&self.ends, self.lattice)))
    }

    fn find(&mut self, capsules: &[Capsule], reach: &Reach, skin: f64) {
        self.skin = skin.clamp(reach.skin, THICKEST * reach.skin);
        self.uses = 0;
        let cutoff = reach.known + self.skin;
        let boxes: Vec<_> = self.ends.iter().map(Bounds::new).collect();
        self.pairs.clear();
        self.squares.clear();
        let lattices = self.lattice.map(|lattice| [lattice; 2]);
        for pair in meeting(&[&boxes, &boxes], lattices, (capsules, reach.apart), cutoff) {
            let [a, b] = pair.ends(&self.ends, self.lattice);
            let nearest = segments::nearest_points(a, b);
            if nearest.squared < cutoff * cutoff {
                self.pairs.push(pair);
                self.squares.push(nearest.squared);
            }
        }
        self.found_at.clone_from(&self.ends);
        self.found_in = self.lattice;
    }

    /// Pairs that may come within `least` (nm) on straight paths to `later` in a lattice.
    pub(super) fn meeting_on_the_way(
        &mut self,
        capsules: &[Capsule],
        (later, lattice): (&[[Vector3; 2]], Option<Lattice>),
        (reach, least): (&Reach, f64),
    ) -> Vec<NeighbourPair> {
        let path = relative_displacement((&self.ends, later), [self.lattice, lattice], least);
        let needed = path + least - reach.known;
        if needed > THICKEST * reach.skin {
            let boxes = [self.ends.as_slice(), later]
                .map(|ends| -> Vec<_> { ends.iter().map(Bounds::new).collect() });
            let lattices = self.lattice.zip(lattice).map(<[Lattice; 2]>::from);
            let ways = [boxes[0].as_slice(), &boxes[1]];
            return meeting(&ways, lattices, (capsules, reach.apart), least);
        }
        if needed > self.skin - self.moved_since_found(reach) {
            self.find(capsules, reach, CHANGE * needed);
        }
        let ways = self.ends.iter().zip(later);
        let lengths: Vec<f64> = ways
            .map(|([a, b], [c, d])| (a - c).norm().max((b - d).norm()))
            .collect();
        let pairs = self.pairs.iter().zip(&self.squares);
        let may_meet = |pair: &NeighbourPair, square: f64| {
            let strained = (pair.shift(lattice) - pair.shift(self.lattice)).norm();
            let path = pair.capsules.iter().map(|i| lengths[*i]).sum::<f64>() + strained;
            path > 0.0 && square < (path + least).powi(2)
        };
        let meeting = pairs.filter(|(pair, square)| may_meet(pair, **square));
        meeting.map(|(pair, _)| *pair).collect()
    }
}

/// Upper bound of the relative displacement (nm) of two axes, or of an axis and an image. They are
/// within a distance `d` (nm) in the second state or on the straight path to it.
///
/// ```text
/// 2 (1 + |g|) (max |u| + |g' - g| max |x' - x|) + |g' - g| d
/// ```
///
/// `x` and `x'` are positions, `g` and `g'` the strains, and `u` the displacement without strain,
/// which is the same for all images.
fn relative_displacement(
    (from, to): (&[[Vector3; 2]], &[[Vector3; 2]]),
    lattices: [Option<Lattice>; 2],
    distance: f64,
) -> f64 {
    let [Some(first), Some(second)] = lattices else {
        return 2.0 * farthest((from, to), |x| x, |x| x);
    };
    let unstrained = farthest(
        (from, to),
        |x| first.unstrained(x),
        |x| second.unstrained(x),
    );
    let change = (second.strain - first.strain).abs();
    // Without a change of strain, the product with an infinite displacement would not be a number.
    let strained = if change > 0.0 {
        change * farthest((from, to), |x| x, |x| x)
    } else {
        0.0
    };
    2.0 * (1.0 + first.strain.abs()) * (unstrained + strained) + change * distance
}

/// Largest displacement of an end between two states with a map of the positions of each (nm);
/// infinite if not finite.
fn farthest(
    (from, to): (&[[Vector3; 2]], &[[Vector3; 2]]),
    first: impl Fn(Vector3) -> Vector3,
    second: impl Fn(Vector3) -> Vector3,
) -> f64 {
    let moved = |(from, to): (&[Vector3; 2], &[Vector3; 2])| {
        let squares = [0, 1].map(|end| (first(from[end]) - second(to[end])).norm_squared());
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

#[cfg(test)]
mod tests {
    use super::*;
    use actin_mechanics::Xorshift;

    /// Listed pairs stay complete only if no pair approaches further than this bound.
    #[test]
    fn no_image_moves_further_than_the_bound() {
        let mut noise = Xorshift::new(5);
        let mut vector = |size: f64| Vector3::from_fn(|_, _| size * noise.sample());
        let size = Vector3::new(80.0, 90.0, 100.0);
        for strains in [None, Some([0.0, 0.0]), Some([0.3, 0.3]), Some([0.2, -0.1])] {
            let lattices = [0, 1].map(|k| strains.map(|s| Lattice { size, strain: s[k] }));
            let mut largest = 0.0_f64;
            for _ in 0..200 {
                let from = [[vector(50.0), vector(50.0)]];
                let to = [from[0].map(|x| x + vector(3.0))];
                let index = vector(1.5).map(f64::round);
                let between = |[[a, b]]: [[Vector3; 2]; 1], lattice: Option<Lattice>| {
                    a + lattice.map_or(Vector3::zeros(), |one| one.shift(index)) - b
                };
                let before = between(from, lattices[0]);
                let moved = (between(to, lattices[1]) - before).norm();
                let bound = relative_displacement((&from, &to), lattices, before.norm());
                assert!(moved <= bound * (1.0 + 1e-12), "{moved} > {bound}");
                largest = largest.max(moved / bound);
            }
            let is_same = strains.is_none_or(|[first, second]| (first - second).abs() < 1e-9);
            assert!(!is_same || largest > 0.5, "{largest}");
        }
    }
}
