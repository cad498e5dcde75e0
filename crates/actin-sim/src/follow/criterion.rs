//! Criteria for the resolution of cells.

use crate::Assembly;
use crate::scene::RefinementCriterion;
use crate::shape::axis::Axis;
use crate::shape::{SectionLoad, SectionLoads, energy_per_length};
use actin_mechanics::{State, rotation};
use std::cell::OnceCell;
use std::fmt::Debug;

/// Smallest largest energy of a cell (pN nm); below, energies are round-off of an unstrained
/// filament.
const NO_ENERGY: f64 = 1e-6;

/// Number of cross-sections of a cell over which its internal loads are averaged.
const CROSS_SECTIONS: u32 = 8;

/// Filament at one moment of a motion, with quantities that its cells share. Loads and energies are
/// computed on demand.
#[derive(Debug)]
pub struct FilamentState<'a> {
    /// Filament in its present resolution.
    pub assembly: &'a Assembly,
    /// State of the filament.
    pub state: &'a State,
    boundaries_nm: &'a [f64],
    loads: OnceCell<SectionLoads>,
    energies_per_length_pn: OnceCell<Vec<f64>>,
}

impl<'a> FilamentState<'a> {
    /// Creates the state of filament 0 with these boundaries of cells.
    pub fn new((assembly, state): (&'a Assembly, &'a State), boundaries_nm: &'a [f64]) -> Self {
        Self {
            assembly,
            state,
            boundaries_nm,
            loads: OnceCell::new(),
            energies_per_length_pn: OnceCell::new(),
        }
    }

    /// Returns the internal loads of the filament.
    pub(crate) fn loads(&self) -> &SectionLoads {
        let loads = || SectionLoads::new(self.assembly, 0, self.state);
        self.loads.get_or_init(loads)
    }

    /// Returns the elastic energy per length of each cell (pN).
    pub(crate) fn energies_per_length_pn(&self) -> &[f64] {
        let energies = || energy_per_length(self.assembly, 0, self.state, self.boundaries_nm);
        self.energies_per_length_pn.get_or_init(energies)
    }

    /// Returns the cells in order; `is_monomers` is true for each resolved cell.
    pub fn cells(&self, is_monomers: &'a [bool]) -> impl Iterator<Item = Cell<'_>> {
        let axis = Axis::new(self.assembly, self.state);
        let spans = self.boundaries_nm.windows(2).enumerate();
        spans
            .zip(is_monomers)
            .map(move |((index, ends), &is_monomers)| {
                let length = ends[1] - ends[0];
                let [a, b] = [ends[0], ends[1]].map(|s_nm| axis.at(s_nm));
                let turn = rotation::log(a.1.inverse() * b.1) / length;
                let curvature = turn.x.hypot(turn.y);
                let half = 0.5 * curvature * length;
                let chord = if half > 0.0 { half.sin() / half } else { 1.0 };
                Cell {
                    filament: self,
                    index,
                    span_nm: [ends[0], ends[1]],
                    is_monomers,
                    curvature_per_nm: curvature,
                    twist_per_nm: turn.z,
                    extension: (b.0 - a.0).norm() / (length * chord) - 1.0,
                }
            })
    }
}

/// Cell of a filament at one moment of a motion.
#[derive(Clone, Copy, Debug)]
pub struct Cell<'a> {
    /// The filament at this moment.
    pub filament: &'a FilamentState<'a>,
    /// Index of the cell.
    pub index: usize,
    /// Arc lengths of its ends at rest (nm).
    pub span_nm: [f64; 2],
    /// `true` if resolved into monomers.
    pub is_monomers: bool,
    /// Angle between the tangents at its ends over its length (1/nm).
    pub curvature_per_nm: f64,
    /// Relative rotation of its ends about the tangent over its length, beyond the rotation at rest
    /// (rad/nm).
    pub twist_per_nm: f64,
    /// Distance of its ends over the chord of an arc with its length and curvature, minus 1.
    pub extension: f64,
}

impl Cell<'_> {
    /// Returns the internal force (pN) and moment (pN nm) in the axes of the cross-sections,
    /// averaged over the cell.
    pub fn mean_load(&self) -> SectionLoad {
        let [from_nm, to_nm] = self.span_nm;
        let count = f64::from(CROSS_SECTIONS);
        let mut mean = SectionLoad::default();
        for k in 0..CROSS_SECTIONS {
            let share = (f64::from(k) + 0.5) / count;
            let load = self
                .filament
                .loads()
                .at(from_nm + share * (to_nm - from_nm));
            mean.force_pn += load.force_pn / count;
            mean.couple_pn_nm += load.couple_pn_nm / count;
        }
        mean
    }

    /// Returns the elastic energy over the length (pN).
    pub fn energy_per_length_pn(&self) -> f64 {
        self.filament.energies_per_length_pn()[self.index]
    }

    /// Returns the energy per length in units of the largest of all cells; 0 without energy.
    pub(crate) fn energy_over_largest(&self) -> f64 {
        let energies = self.filament.energies_per_length_pn().iter().copied();
        let largest = energies.fold(0.0, f64::max);
        let length = self.span_nm[1] - self.span_nm[0];
        if largest * length > NO_ENERGY {
            self.energy_per_length_pn() / largest
        } else {
            0.0
        }
    }
}

/// Resolution that a criterion requests for a cell. Of several requests the largest prevails.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ResolutionRequest {
    /// Rod, unless another criterion requests monomers or the present resolution.
    Rod,
    /// Present resolution.
    Stay,
    /// Monomers.
    Monomers,
}

/// Criterion for the resolution of cells.
///
/// It is evaluated at steps that do not depend on interruptions. It must be a pure function of the
/// state.
pub trait Criterion: Debug + Send + Sync {
    /// Returns the requested resolution of a cell.
    fn request(&self, cell: &Cell<'_>) -> ResolutionRequest;
}

impl Criterion for RefinementCriterion {
    fn request(&self, cell: &Cell<'_>) -> ResolutionRequest {
        let (_, [low, high]) = self.thresholds();
        let value = value(self, cell);
        let [is_needed, is_superfluous] = match self {
            Self::Linker { .. } => [value < low, value > high],
            _ => [value > high, value < low],
        };
        match (is_needed, is_superfluous) {
            (true, _) => ResolutionRequest::Monomers,
            (false, true) => ResolutionRequest::Rod,
            (false, false) => ResolutionRequest::Stay,
        }
    }
}

/// The quantity that the thresholds of a criterion apply to.
fn value(criterion: &RefinementCriterion, cell: &Cell<'_>) -> f64 {
    match *criterion {
        RefinementCriterion::Curvature { .. } => cell.curvature_per_nm,
        RefinementCriterion::Twist { .. } => cell.twist_per_nm.abs(),
        RefinementCriterion::Extension { .. } => cell.extension.abs(),
        RefinementCriterion::Force { .. } => cell.mean_load().force_pn.norm(),
        RefinementCriterion::Couple { .. } => cell.mean_load().couple_pn_nm.norm(),
        RefinementCriterion::Energy { .. } => cell.energy_per_length_pn(),
        RefinementCriterion::LargestEnergy { .. } => cell.energy_over_largest(),
        RefinementCriterion::Linker { linker, .. } => distance_nm(cell, linker),
    }
}

/// Distance from the site of a linker to a cell (nm of arc length); infinite for an unbound linker.
fn distance_nm(cell: &Cell<'_>, linker: usize) -> f64 {
    let FilamentState {
        assembly, state, ..
    } = cell.filament;
    let s_nm = match assembly.switched(linker, state) {
        Some((true, s_nm)) => s_nm,
        Some((false, _)) => return f64::INFINITY,
        None => assembly.scene.linkers[linker].at_nm,
    };
    let [from, to] = cell.span_nm;
    (from - s_nm).max(s_nm - to).max(0.0)
}

/// Combines several criteria: monomers if any requests them, a rod if all request it.
pub(super) fn wish_of(criteria: &[Box<dyn Criterion>], cell: &Cell<'_>) -> ResolutionRequest {
    let wishes = criteria.iter().map(|criterion| criterion.request(cell));
    wishes.max().unwrap_or(ResolutionRequest::Rod)
}
