//! Ties: relative motions of coupled bodies, and the stiffness that regularises them.
//!
//! The added stiffness is proportional to the relative motion of the tie, which bounds an energy
//! with bounded third derivatives from above. A multiple of the unit matrix would suppress the soft
//! modes of a long filament.
//!
//! # Source
//! Y. Nesterov and B. T. Polyak, Math. Program. 108 (2006) 177, applied to each tie.

use crate::layout::Layout;
use actin_mechanics::{Coordinates, Matrix3, State, Stiffness, Vector3, Vectors, rotation};
use std::collections::{BTreeMap, BTreeSet};

/// Distance of two points (nm) below which they coincide.
const COINCIDENT: f64 = 1e-9;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Tie {
    /// Two points: `dx_j - dx_i`.
    Points(usize, usize),
    /// Two points seen from a frame: `dx_j - dx_i - theta x (x_j - x_i)`.
    Seen(usize, usize, usize),
    /// Two frames: `theta_b - theta_a`, times the turn length.
    Frames(usize, usize),
}

#[derive(Debug, Default)]
pub(crate) struct Ties {
    ties: Vec<Tie>,
    turn_length: f64,
}

impl Ties {
    /// Ties of bodies that share a block.
    pub(crate) fn new(blocks: &[(Coordinates, Coordinates, Matrix3)], turn_length: f64) -> Self {
        use Coordinates::{Frame, Point};
        let mut points = BTreeSet::new();
        let mut frames = BTreeSet::new();
        let mut seen = BTreeSet::new();
        for &(a, b, _) in blocks {
            match (a, b) {
                (Point(i), Point(j)) if i != j => points.insert((i.min(j), i.max(j))),
                (Frame(i), Frame(j)) if i != j => frames.insert((i.min(j), i.max(j))),
                (Point(i), Frame(f)) | (Frame(f), Point(i)) => seen.insert((i, f)),
                _ => false,
            };
        }
        let mut ties: Vec<Tie> = frames.into_iter().map(|(a, b)| Tie::Frames(a, b)).collect();
        for (i, j) in points {
            let before = ties.len();
            let frames_of_i = seen.range((i, 0)..=(i, usize::MAX)).map(|&(_, f)| f);
            let common = frames_of_i.filter(|&f| seen.contains(&(j, f)));
            ties.extend(common.map(|f| Tie::Seen(i, j, f)));
            if ties.len() == before {
                ties.push(Tie::Points(i, j));
            }
        }
        Self { ties, turn_length }
    }

    /// In both orders.
    pub(crate) fn frames(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let of = |tie: &Tie| match *tie {
            Tie::Frames(a, b) => vec![(a, b), (b, a)],
            Tie::Points(..) | Tie::Seen(..) => vec![],
        };
        self.ties.iter().flat_map(of)
    }

    /// Without a common frame.
    pub(crate) fn points(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.ties.iter().filter_map(|tie| match *tie {
            Tie::Points(i, j) => Some((i, j)),
            Tie::Seen(..) | Tie::Frames(..) => None,
        })
    }

    /// With a common frame.
    pub(crate) fn seen(&self) -> impl Iterator<Item = (usize, usize, usize)> + '_ {
        self.ties.iter().filter_map(|tie| match *tie {
            Tie::Seen(i, j, f) => Some((i, j, f)),
            Tie::Points(..) | Tie::Frames(..) => None,
        })
    }

    /// Values of the points; for frames the largest value of points seen from them.
    pub(crate) fn spread(&self, of: impl Fn(usize, usize) -> f64) -> Vec<f64> {
        let mut seen_from = BTreeMap::<usize, f64>::new();
        for (i, j, f) in self.seen() {
            let largest = seen_from.entry(f).or_default();
            *largest = largest.max(of(i, j));
        }
        let from = |f| seen_from.get(&f).copied().unwrap_or(0.0);
        let of_tie = |tie: &Tie| match *tie {
            Tie::Points(i, j) | Tie::Seen(i, j, _) => of(i, j),
            Tie::Frames(a, b) => from(a).max(from(b)),
        };
        self.ties.iter().map(of_tie).collect()
    }

    /// Second derivatives of half the weighted sum of squared motions.
    pub(crate) fn add_blocks(&self, state: &State, weights: &[f64], blocks: &mut Stiffness) {
        use Coordinates::{Frame, Point};
        for (&tie, &weight) in self.ties.iter().zip(weights) {
            let unit = Matrix3::from_diagonal_element(weight);
            match tie {
                Tie::Points(i, j) => {
                    blocks.push(Point(i), Point(i), unit);
                    blocks.push(Point(j), Point(j), unit);
                    blocks.push(Point(i), Point(j), -unit);
                }
                Tie::Seen(i, j, f) => {
                    let turn = between(state, i, j).cross_matrix() * matrix(state, f);
                    blocks.push(Point(i), Point(i), unit);
                    blocks.push(Point(j), Point(j), unit);
                    blocks.push(Point(i), Point(j), -unit);
                    blocks.push(Point(j), Frame(f), turn * weight);
                    blocks.push(Point(i), Frame(f), turn * -weight);
                    blocks.push(Frame(f), Frame(f), turn.transpose() * turn * weight);
                }
                Tie::Frames(a, b) => {
                    let unit = unit * self.turn_length.powi(2);
                    let relative = matrix(state, a).transpose() * matrix(state, b);
                    blocks.push(Frame(a), Frame(a), unit);
                    blocks.push(Frame(b), Frame(b), unit);
                    blocks.push(Frame(a), Frame(b), -unit * relative);
                }
            }
        }
    }

    pub(crate) fn motions(&self, layout: &Layout, state: &State, step: &[f64]) -> Vec<f64> {
        let (moved, turned) = layout.velocities(state, step);
        let of = |tie: &Tie| match *tie {
            Tie::Points(i, j) => relative(&moved, i, j).norm(),
            Tie::Seen(i, j, f) => {
                let d = between(state, i, j);
                (relative(&moved, i, j) - turned.get(f).cross(&d)).norm()
            }
            Tie::Frames(a, b) => relative(&turned, a, b).norm() * self.turn_length,
        };
        self.ties.iter().map(of).collect()
    }

    /// Largest finite strain between two states.
    pub(crate) fn strain_between(&self, from: &State, to: &State) -> f64 {
        let turn =
            |f: usize| to.frames.orientation.get(f) * from.frames.orientation.get(f).inverse();
        let of = |tie: &Tie| match *tie {
            Tie::Points(i, j) => {
                let d = between(from, i, j);
                (between(to, i, j) - d).norm() / self.length(d)
            }
            Tie::Seen(i, j, f) => {
                let d = between(from, i, j);
                (between(to, i, j) - turn(f) * d).norm() / self.length(d)
            }
            Tie::Frames(a, b) => rotation::log(turn(b) * turn(a).inverse()).norm(),
        };
        self.ties.iter().map(of).fold(0.0, f64::max)
    }

    /// Motion (nm) equivalent to unit strain.
    pub(crate) fn lengths(&self, state: &State) -> Vec<f64> {
        let of = |tie: &Tie| match *tie {
            Tie::Points(i, j) | Tie::Seen(i, j, _) => self.length(between(state, i, j)),
            Tie::Frames(..) => self.turn_length,
        };
        self.ties.iter().map(of).collect()
    }

    /// Distance, or the turn length for coincident points.
    fn length(&self, d: Vector3) -> f64 {
        let length = d.norm();
        if length > COINCIDENT {
            length
        } else {
            self.turn_length
        }
    }
}

fn between(state: &State, i: usize, j: usize) -> Vector3 {
    relative(&state.points.position, i, j)
}

fn relative(vectors: &Vectors, i: usize, j: usize) -> Vector3 {
    vectors.get(j) - vectors.get(i)
}

fn matrix(state: &State, frame: usize) -> Matrix3 {
    let q = state.frames.orientation.get(frame);
    q.to_rotation_matrix().into_inner()
}
