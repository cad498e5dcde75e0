//! An endless filament of monomers under the loads that a filament carries: what a stretch of it would do.

use super::cells::Cells;
use super::section_loads::{linear, rotational};
use crate::assembly::ellipsoids;
use crate::scene::{Anchors, Monomers, SceneProblem};
use crate::shape::axis::CrossSection;
use actin_ellipsoid::{Cell, CellResponse, Control, Hold, SixMatrix, SixVector};
use actin_mechanics::{Vector3, rotation};
use std::rc::Rc;

/// Monomers of a cell: one period of the helix.
pub(crate) const PERIOD: usize = 13;
/// Share by which strains differ from those of a cell that they follow to first order: what that misses is of the order of its
/// square.
const FOLLOWS: f64 = 0.03;
/// Most that they follow.
const MOST: f64 = 0.3;
/// Longest step along an ideal stretch (nm).
const STEP_NM: f64 = 1.5;

/// The monomers of the mean filament: those of a scene, with weighted bonds for drawn ones.
pub(super) fn mean_monomers(monomers: &Monomers) -> Monomers {
    let mut mean = monomers.clone();
    if mean.anchors != Anchors::Cubature {
        mean.anchors = Anchors::Cubature;
        mean.lateral_bonds = Anchors::Cubature.usual_bonds();
        mean.longitudinal_bonds = Anchors::Cubature.usual_bonds();
    }
    mean
}

/// The monomers of filaments whose bonds are drawn: those of a scene, or with the usual number for weighted bonds.
pub(super) fn drawn_monomers(monomers: &Monomers) -> Monomers {
    let mut drawn = monomers.clone();
    if drawn.anchors == Anchors::Cubature {
        drawn.lateral_bonds = Anchors::Independent.usual_bonds();
        drawn.longitudinal_bonds = Anchors::Independent.usual_bonds();
        drawn.anchors = Anchors::Independent;
    }
    drawn
}

/// An endless filament in uniformly strained cells: the mean one of some monomers, with weighted bonds, or one whose bonds are
/// drawn and come again after a period.
#[derive(Debug)]
pub(crate) struct EndlessFilament {
    cell: Cell,
}

impl EndlessFilament {
    /// # Errors
    /// Monomers whose helix does not close after 13.
    pub(crate) fn of(monomers: &Monomers) -> Result<Self, SceneProblem> {
        Self::with_bonds(&mean_monomers(monomers), 0)
    }

    /// The same of monomers whose bonds are drawn, in one of many samplings.
    ///
    /// # Errors
    /// As [`of`](Self::of).
    pub(super) fn drawn(monomers: &Monomers, sampling: u32) -> Result<Self, SceneProblem> {
        Self::with_bonds(monomers, sampling as usize)
    }

    fn with_bonds(monomers: &Monomers, sampling: usize) -> Result<Self, SceneProblem> {
        let model = ellipsoids(monomers, sampling)?;
        let cell = Cell::new(&model, PERIOD, Hold::Means);
        let cell = cell.map_err(|error| {
            let rule =
                format!("errors are known for helices of 13 monomers a period only: {error}");
            SceneProblem::new("filament.monomers", "", rule)
        })?;
        Ok(Self { cell })
    }

    /// Curvature and shear strain under couple and force (body axes), found from a cell under similar ones.
    pub(crate) fn under(
        &self,
        load: &SixVector,
        near: Option<&CellResponse>,
    ) -> Option<CellResponse> {
        let controls = std::array::from_fn(|k| Control::Load(load[k]));
        self.cell.relax_under(&controls, near).ok()
    }

    /// The same, found from a cell that is held at a twist (rad/nm) at first.
    pub(crate) fn under_from_twist(
        &self,
        load: &SixVector,
        twist: f64,
        near: Option<&CellResponse>,
    ) -> Option<CellResponse> {
        let mut controls = std::array::from_fn(|k| Control::Load(load[k]));
        controls[2] = Control::Strain(twist);
        let held = self.cell.relax_under(&controls, near).ok()?;
        self.under(load, Some(&held))
    }
}

/// Strains of the mean filament along a stretch, between samples linear.
#[derive(Clone, Debug)]
pub(super) struct Ideal {
    /// Arc length (nm) and strain.
    samples: Vec<(f64, SixVector)>,
    /// Cells that were relaxed, and which of them each sample follows.
    cells: Vec<Rc<CellResponse>>,
    of: Vec<usize>,
    /// Share of the work of loads on strains that is not stored.
    complementary: f64,
}

impl Ideal {
    /// Of the stretch between two arc lengths (nm) under the loads of `load`, from evenly spaced samples; none where
    /// a cell finds no minimum. Each follows to first order the cell of the one before where its strain differs by little.
    pub(super) fn along(
        filament: &Cells,
        load: impl Fn(f64) -> SixVector,
        ([from, to], samples): ([f64; 2], u32),
    ) -> Option<Self> {
        let spacing = (to - from) / f64::from(samples);
        let mut ideal = Self {
            samples: Vec::new(),
            cells: Vec::new(),
            of: Vec::new(),
            complementary: 0.5,
        };
        for k in 0..samples {
            let s_nm = from + (f64::from(k) + 0.5) * spacing;
            let load = load(s_nm);
            let last = ideal.cells.last();
            if !last.is_some_and(|last| is_near(last, &load)) {
                ideal.cells.push(filament.under(&load)?);
            }
            ideal.of.push(ideal.cells.len() - 1);
            ideal.samples.push((s_nm, SixVector::zeros()));
        }
        if from > to {
            ideal.samples.reverse();
            ideal.of.reverse();
        }
        Some(ideal.under(load))
    }

    /// The same under other loads that differ by little, to first order.
    pub(super) fn under(&self, load: impl Fn(f64) -> SixVector) -> Self {
        let mut other = self.clone();
        let (mut stored, mut work) = (0.0, 0.0);
        for ((s_nm, sample), cell) in other.samples.iter_mut().zip(&self.of) {
            let cell = &self.cells[*cell];
            let load = load(*s_nm);
            let more = load - cell.loads;
            let followed = follows(cell, &more);
            *sample = cell.strain + followed;
            stored += cell.energy + (cell.loads + more * 0.5).dot(&followed);
            work += load.dot(sample);
        }
        if work > 0.0 {
            other.complementary = (1.0 - stored / work).clamp(0.0, 1.0);
        }
        other
    }

    pub(super) fn strain(&self, s_nm: f64) -> SixVector {
        let samples = &self.samples;
        if samples.len() == 1 {
            return samples[0].1;
        }
        let after = samples.partition_point(|sample| sample.0 < s_nm);
        let after = after.clamp(1, samples.len() - 1);
        let (a, b) = (&samples[after - 1], &samples[after]);
        let t = (s_nm - a.0) / (b.0 - a.0);
        a.1 * (1.0 - t) + b.1 * t
    }

    /// What a stretch with a motion (body axes) beyond this one under a load stores beyond it at the same strains (pN nm): what
    /// it would if it were more of this filament. Half of the work of the load, taken from it, where strains are
    /// proportional to loads.
    pub(super) fn stored(&self, motion: &SixVector, load: &SixVector) -> f64 {
        -self.complementary * motion.dot(load)
    }

    /// Where the cross-section at `to` is if that at `from` is at `base`.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "at least 1, and the conversion saturates"
    )]
    pub(super) fn carry(&self, base: CrossSection, [from, to]: [f64; 2]) -> CrossSection {
        let steps = ((to - from).abs() / STEP_NM).ceil().max(1.0) as u32;
        let step = (to - from) / f64::from(steps);
        let (mut place, mut axes) = base;
        for k in 0..steps {
            let strain = self.strain(from + (f64::from(k) + 0.5) * step);
            let half = rotation::exp(rotational(&strain) * (0.5 * step));
            axes *= half;
            place += axes * (linear(&strain) + Vector3::z()) * step;
            axes *= half;
        }
        (place, axes)
    }
}

/// Derivative of the strains of a cell by its loads; none where it has no stiffness.
fn compliance(cell: &CellResponse) -> SixMatrix {
    cell.tangent.try_inverse().unwrap_or_else(SixMatrix::zeros)
}

/// By how much the strains of a cell follow more load: to first order, by no more than a share of themselves. Twist at rest
/// meets so little that it would follow without end.
fn follows(cell: &CellResponse, more: &SixVector) -> SixVector {
    let mut followed = compliance(cell) * more;
    // Bending, twist, shear and stretch.
    for (from, count) in [(0, 2), (2, 1), (3, 2), (5, 1)] {
        let most = MOST * cell.strain.rows(from, count).norm();
        let size = followed.rows(from, count).norm();
        if size > most {
            followed.rows_mut(from, count).scale_mut(most / size);
        }
    }
    followed
}

/// Whether strains under a load are those of a cell within [`FOLLOWS`], by what it takes to change them.
fn is_near(cell: &CellResponse, load: &SixVector) -> bool {
    let compliance = compliance(cell);
    let work = |load: &SixVector| load.dot(&(compliance * load));
    work(&(load - cell.loads)) <= FOLLOWS * FOLLOWS * work(load)
}
