//! Cells of a filament, and the scene with some of them as monomers.

use crate::lattice::{Lattice, resolve};
use crate::scene::{AdaptiveResolution, ClampedEnds, End, Filament, Scene, SceneProblem, Section};
use crate::{HeatedSegments, TOO_SHORT, potential};
use actin_cosserat::Homogenised;

/// Tolerance (nm) for equal lengths of cells.
const SAME_LENGTH_NM: f64 = 1e-6;

/// Cells of a filament in order, each a rod or monomers.
#[derive(Clone, Debug)]
pub struct Cells {
    /// Boundaries (nm), one more than cells.
    boundaries_nm: Vec<f64>,
    /// Number of segments of a rod cell.
    segments: usize,
}

impl Cells {
    /// Divides a filament into cells.
    ///
    /// # Errors
    /// If no cell boundaries fit the lengths of `following`, or segments are too short for the rod law in a heat bath.
    pub fn new(scene: &Scene, following: &AdaptiveResolution) -> Result<Self, SceneProblem> {
        let cells = Self {
            boundaries_nm: cells_nm(scene, following.length_nm, following.cell_nm)?,
            segments: following.segments,
        };
        cells.check_bath(scene)?;
        Ok(cells)
    }

    /// Refuses segments that are too short for the rod law in a heat bath.
    fn check_bath(&self, scene: &Scene) -> Result<(), SceneProblem> {
        let Filament { rod, monomers, .. } = &scene.filament;
        let lengths = self.spans_nm().map(|[from, to]| to - from);
        let cell_nm = lengths.fold(f64::INFINITY, f64::min);
        let heated = scene.thermal().map(|thermal| HeatedSegments {
            segment_nm: cell_nm / self.segments as f64,
            temperature_k: thermal.temperature_k,
        });
        let is_law = rod.law.is_homogenised();
        if !is_law || potential(&rod.law, monomers, heated).is_ok() {
            return Ok(());
        }
        let most = (cell_nm / Homogenised::SHORTEST_HEATED_NM).floor();
        let rule = format!(
            "in cells of {cell_nm:.2} nm: {TOO_SHORT}; write segments: {most} or fewer, a larger cell_nm, or law: HomogenisedAthermal"
        );
        Err(SceneProblem::new(
            "filament.sections.segments",
            self.segments,
            rule,
        ))
    }

    /// Returns the number of cells.
    pub fn count(&self) -> usize {
        self.boundaries_nm.len() - 1
    }

    /// Returns the boundaries (nm), one more than cells.
    pub fn boundaries_nm(&self) -> &[f64] {
        &self.boundaries_nm
    }

    /// Iterates over the ends of the cells (nm).
    pub fn spans_nm(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        self.boundaries_nm.windows(2).map(|ends| [ends[0], ends[1]])
    }

    /// Returns the scene with explicit sections. Neighbouring cells of monomers form one section,
    /// as do neighbouring rods with segments of equal length. Segments therefore do not depend on
    /// the neighbours.
    pub fn scene(&self, scene: &Scene, is_monomers: &[bool]) -> Scene {
        let mut sections: Vec<(Section, f64)> = Vec::new();
        for ([from, to], &resolved) in self.spans_nm().zip(is_monomers) {
            let length = to - from;
            match sections.last_mut() {
                Some((Section::Ellipsoids { to_nm, .. }, _)) if resolved => *to_nm = to,
                Some((
                    Section::Rod {
                        to_nm,
                        segments: Some(segments),
                        ..
                    },
                    of_cell,
                )) if !resolved && (*of_cell - length).abs() < SAME_LENGTH_NM => {
                    *to_nm = to;
                    *segments += self.segments;
                }
                _ if resolved => sections.push((monomers(from, to), length)),
                _ => sections.push((Section::rod(from, to, Some(self.segments)), length)),
            }
        }
        let mut resolved = scene.clone();
        let sections: Vec<_> = sections.into_iter().map(|(section, _)| section).collect();
        resolved.filament.sections = sections.into();
        resolved
    }
}

/// Boundaries (nm) of cells of filament 0, whose length `length_nm` is rounded to whole monomers.
///
/// Each cell holds the number of whole monomers that brings it nearest to `cell_nm`. The last cell
/// takes the remainder.
fn cells_nm(scene: &Scene, length_nm: f64, cell_nm: f64) -> Result<Vec<f64>, SceneProblem> {
    let held = ClampedEnds::new(scene);
    let is_held = [End::Start, End::End].map(|end| held.clamp_at(0, end).is_some());
    let mut filament = scene.filament.clone();
    filament.sections = vec![monomers(0.0, length_nm)].into();
    let length_nm = resolve(&filament, is_held)?[0].to_nm;
    let lattice = Lattice::new(&scene.filament, is_held);
    let per_cell = (cell_nm / lattice.rise_nm).round();
    let cells = (length_nm / (per_cell * lattice.rise_nm)).round().max(1.0);
    let half = 0.5 * lattice.rise_nm;
    let places = (1..)
        .map(|k| f64::from(k) * per_cell)
        .take_while(|&j| j < (cells - 0.5) * per_cell)
        .map(|j| lattice.origin_nm + j * lattice.rise_nm + half);
    let mut boundaries = vec![0.0];
    boundaries.extend(places);
    boundaries.push(length_nm);
    Ok(boundaries)
}

/// Section of unaltered monomers.
fn monomers(from_nm: f64, to_nm: f64) -> Section {
    Section::Ellipsoids {
        from_nm,
        to_nm,
        altered: None,
    }
}
