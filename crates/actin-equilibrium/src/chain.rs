//! Steps that carry neighbours along: the same to first order as moving every body on its own.
//!
//! A filament that bends far moves its end along an arc. Bodies that each go straight along their
//! own velocity leave it, which stretches ties by the square of the turn: for a long filament
//! that costs far more energy than the bending does. Here each body instead keeps its place
//! relative to the one before it, up to what the step does to that tie, so that a strain is linear
//! in the step however far the whole moves.
//!
//! This works along a tree of ties, which a filament held at one end is. Where ends meet again,
//! at a second held end, the step closes badly; the caller compares energies.
//!
//! # Source
//! The reason is that of D. Magisano, L. Leonetti and G. Garcea, Int. J. Numer. Methods Eng. 111
//! (2017) 1177: Newton's method is slow where displacements are extrapolated linearly and strains
//! thereby are not.

use crate::layout::{Layout, Node};
use crate::ties::Ties;
use actin_mechanics::{Coordinates, State, Vectors, rotation};
use std::collections::BTreeMap;

mod clusters;
mod open;
mod turning;

pub(crate) use clusters::Clusters;
pub(crate) use open::is_open;

/// A body that follows another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Link {
    /// A frame follows a frame.
    Frame { from: usize, to: usize },
    /// A point follows a point, seen from a frame.
    Point { from: usize, seen: usize, to: usize },
}

/// Free bodies in the order in which they follow one another.
#[derive(Debug, Default)]
pub(crate) struct Chain(Vec<Link>);

impl Chain {
    /// Lets each free body follow the latest one before it that it is tied to; bodies that are
    /// held or in groups come first, and what is tied to nothing before it follows nothing.
    pub(crate) fn new(layout: &Layout, ties: &Ties, points: usize, frames: usize) -> Self {
        let mut place = Places::new(layout, points, frames);
        let frame_ties = neighbours(ties.frames());
        let point_ties = neighbours(ties.seen().flat_map(|(i, j, f)| [(i, (j, f)), (j, (i, f))]));
        let mut links = Vec::new();
        for (rank, &k) in layout.sequence().iter().enumerate() {
            let latest = match layout.node(k) {
                Node::Group(_) => None,
                Node::Frame(to) => frame_ties
                    .get(&to)
                    .and_then(|others| {
                        let placed = others
                            .iter()
                            .filter_map(|&from| Some((place.frames[from]?, from)));
                        placed.max()
                    })
                    .map(|(_, from)| Link::Frame { from, to }),
                Node::Point(to) => point_ties
                    .get(&to)
                    .and_then(|others| {
                        let placed = others.iter().filter_map(|&(from, seen)| {
                            Some((place.points[from]?.min(place.frames[seen]?), from, seen))
                        });
                        placed.max()
                    })
                    .map(|(_, from, seen)| Link::Point { from, seen, to }),
            };
            links.extend(latest);
            match layout.node(k) {
                Node::Group(_) => {}
                Node::Point(i) => place.points[i] = Some(rank + 1),
                Node::Frame(i) => place.frames[i] = Some(rank + 1),
            }
        }
        Self(links)
    }

    /// Puts the bodies of `to`, which `scale` times a step has led straight from `from`, where
    /// the same step leads them one after another; `moved` and `turned` are the velocities of
    /// the step (lab frame).
    pub(crate) fn carry(
        &self,
        from: &State,
        (moved, turned): &(Vectors, Vectors),
        scale: f64,
        to: &mut State,
    ) {
        for link in &self.0 {
            link.carry(from, (moved, turned), scale, to);
        }
    }
}

impl Link {
    /// Returns the body that follows.
    fn follower(self) -> Coordinates {
        match self {
            Self::Frame { to, .. } => Coordinates::Frame(to),
            Self::Point { to, .. } => Coordinates::Point(to),
        }
    }

    /// Puts the following body of `to` where a step leads it relative to the body that it follows.
    fn carry(
        self,
        from: &State,
        (moved, turned): (&Vectors, &Vectors),
        scale: f64,
        to: &mut State,
    ) {
        match self {
            Self::Frame { from: a, to: b } => {
                let q = from.frames.orientation.get(a);
                let relative = q.inverse() * from.frames.orientation.get(b);
                let turn = q.inverse() * (turned.get(b) - turned.get(a)) * scale;
                let new = to.frames.orientation.get(a) * rotation::exp(turn) * relative;
                let new = actin_mechanics::UnitQuaternion::new_normalize(new.into_inner());
                to.frames.orientation.set(b, new);
            }
            Self::Point {
                from: i,
                seen,
                to: j,
            } => {
                let q = from.frames.orientation.get(seen);
                let d = from.points.position.get(j) - from.points.position.get(i);
                let slip = moved.get(j) - moved.get(i) - turned.get(seen).cross(&d);
                let new = to.frames.orientation.get(seen) * (q.inverse() * (d + slip * scale));
                let start = to.points.position.get(i);
                to.points.position.set(j, start + new);
            }
        }
    }
}

/// When each body is placed, counted along the sequence of the layout; held ones and groups at zero.
struct Places {
    points: Vec<Option<usize>>,
    frames: Vec<Option<usize>>,
}

impl Places {
    fn new(layout: &Layout, points: usize, frames: usize) -> Self {
        let mut places = Self {
            points: vec![Some(0); points],
            frames: vec![Some(0); frames],
        };
        for k in 0..layout.len() {
            match layout.node(k) {
                Node::Group(_) => {}
                Node::Point(i) => places.points[i] = None,
                Node::Frame(i) => places.frames[i] = None,
            }
        }
        places
    }
}

fn neighbours<T>(pairs: impl Iterator<Item = (usize, T)>) -> BTreeMap<usize, Vec<T>> {
    let mut map = BTreeMap::<usize, Vec<T>>::new();
    for (a, b) in pairs {
        map.entry(a).or_default().push(b);
    }
    map
}
