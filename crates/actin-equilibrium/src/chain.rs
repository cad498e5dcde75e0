//! Carried steps: to first order equal to moving every body independently.
//!
//! Straight motion of the bodies of a bending filament stretches ties by the square of the
//! rotation. In a carried step each body keeps its pose relative to its predecessor, up to the step
//! of the tie between them, so strains are linear in the step. If a filament is held at a second
//! place, the step does not close.
//!
//! # Source
//! Cause of slow convergence with linear extrapolation of displacements: D. Magisano, L. Leonetti
//! and G. Garcea, Int. J. Numer. Methods Eng. 111 (2017) 1177.

use crate::layout::{Layout, Node};
use crate::ties::Ties;
use actin_mechanics::{Coordinates, State, Vectors, rotation};
use std::collections::BTreeMap;

mod clusters;
mod open;
mod turning;

pub(crate) use clusters::Clusters;
pub(crate) use open::is_open;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Link {
    /// A frame follows a frame.
    Frame { from: usize, to: usize },
    /// A point follows a point in the axes of a frame.
    Point { from: usize, seen: usize, to: usize },
}

/// Free bodies, each after its predecessor.
#[derive(Debug, Default)]
pub(crate) struct Chain(Vec<Link>);

impl Chain {
    /// Links each free body to the latest preceding body that it is tied to.
    pub(crate) fn new(layout: &Layout, ties: &Ties, points: usize, frames: usize) -> Self {
        let mut place = Places::new(layout, points, frames);
        let frame_ties = neighbours(ties.frames());
        let point_ties = neighbours(ties.seen().flat_map(|(i, j, f)| [(i, (j, f)), (j, (i, f))]));
        let mut links = Vec::new();
        for (rank, &k) in layout.sequence().iter().enumerate() {
            let latest = match layout.node(k) {
                Node::Slider(_) => None,
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
                Node::Slider(_) => {}
                Node::Point(i) => place.points[i] = Some(rank + 1),
                Node::Frame(i) => place.frames[i] = Some(rank + 1),
            }
        }
        Self(links)
    }

    /// Replaces a straight motion by `scale` times a step by the carried motion; velocities in the
    /// lab frame.
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
    fn follower(self) -> Coordinates {
        match self {
            Self::Frame { to, .. } => Coordinates::Frame(to),
            Self::Point { to, .. } => Coordinates::Point(to),
        }
    }

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

/// Position in the sequence of the layout; zero for held bodies and sliders.
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
                Node::Slider(_) => {}
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
