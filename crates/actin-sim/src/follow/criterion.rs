//! Where monomers are needed: what a cell does, and criteria that answer to it.

use crate::Assembly;
use crate::scene::Where;
use crate::shape::axis::Axis;
use actin_mechanics::{State, rotation};
use std::fmt::Debug;

/// A cell of a filament at one moment of a motion.
#[derive(Clone, Copy, Debug)]
pub struct Cell<'a> {
    /// The filament as it is resolved now.
    pub assembly: &'a Assembly,
    /// Its state.
    pub state: &'a State,
    /// Where the cell begins and ends at rest (nm of arc length).
    pub span_nm: [f64; 2],
    /// Whether it is resolved into monomers.
    pub is_monomers: bool,
    /// Angle between the tangents at its ends over its length (1/nm).
    pub curvature_per_nm: f64,
    /// Turn of its ends about the tangent against each other over its length, beyond that at rest (rad/nm).
    pub twist_per_nm: f64,
    /// Distance of its ends over that of an arc of its length and curvature, less 1.
    pub extension: f64,
}

/// What a criterion wants a cell to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wish {
    /// Monomers.
    Monomers,
    /// A rod, where no other criterion wants monomers and none wants it to stay.
    Rod,
    /// What it is.
    Stay,
}

/// Says where monomers are needed. It is asked at step numbers that do not depend on how often a run was interrupted,
/// and has no memory: answers to the same state are the same.
pub trait Criterion: Debug + Send + Sync {
    /// What a cell is to be.
    fn wish(&self, cell: &Cell<'_>) -> Wish;
}

impl Criterion for Where {
    fn wish(&self, cell: &Cell<'_>) -> Wish {
        let by = |value: f64, high: f64, low: f64| {
            if value > high {
                Wish::Monomers
            } else if value < low {
                Wish::Rod
            } else {
                Wish::Stay
            }
        };
        match *self {
            Self::Curvature {
                above_per_nm,
                below_per_nm,
            } => by(cell.curvature_per_nm, above_per_nm, below_per_nm),
            Self::Twist {
                above_per_nm,
                below_per_nm,
            } => by(cell.twist_per_nm.abs(), above_per_nm, below_per_nm),
            Self::Extension { above, below } => by(cell.extension.abs(), above, below),
            Self::Linker {
                linker,
                within_nm,
                beyond_nm,
            } => {
                let distance = distance_nm(cell, linker);
                by(-distance, -within_nm, -beyond_nm)
            }
        }
    }
}

/// How far the site of a linker is from a cell (nm of arc length); infinite where it does not hold.
fn distance_nm(cell: &Cell<'_>, linker: usize) -> f64 {
    let s_nm = match cell.assembly.switched(linker, cell.state) {
        Some((true, s_nm)) => s_nm,
        Some((false, _)) => return f64::INFINITY,
        None => cell.assembly.scene.linkers[linker].at_nm,
    };
    let [from, to] = cell.span_nm;
    (from - s_nm).max(s_nm - to).max(0.0)
}

/// What several criteria want of a cell: monomers if one does, a rod if all do.
pub(super) fn wish_of(criteria: &[Box<dyn Criterion>], cell: &Cell<'_>) -> Wish {
    let wishes = criteria.iter().map(|criterion| criterion.wish(cell));
    wishes.fold(Wish::Rod, |so_far, wish| match (so_far, wish) {
        (Wish::Monomers, _) | (_, Wish::Monomers) => Wish::Monomers,
        (Wish::Rod, wish) => wish,
        (Wish::Stay, _) => Wish::Stay,
    })
}

/// The cells of filament 0 in a state.
pub(super) fn cells<'a>(
    (assembly, state): (&'a Assembly, &'a State),
    spans_nm: impl Iterator<Item = [f64; 2]> + 'a,
    is_monomers: &'a [bool],
) -> impl Iterator<Item = Cell<'a>> + 'a {
    let axis = Axis::of(assembly, state);
    spans_nm
        .zip(is_monomers)
        .map(move |(span_nm, &is_monomers)| {
            let length = span_nm[1] - span_nm[0];
            let [a, b] = span_nm.map(|s_nm| axis.at(s_nm));
            let turn = rotation::log(a.1.inverse() * b.1) / length;
            let curvature = turn.x.hypot(turn.y);
            let half = 0.5 * curvature * length;
            let chord = if half > 0.0 { half.sin() / half } else { 1.0 };
            Cell {
                assembly,
                state,
                span_nm,
                is_monomers,
                curvature_per_nm: curvature,
                twist_per_nm: turn.z,
                extension: (b.0 - a.0).norm() / (length * chord) - 1.0,
            }
        })
}
