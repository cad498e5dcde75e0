//! An endless filament of monomers under the loads that a filament carries: what a stretch of it would do.

use super::section_loads::{linear, rotational};
use crate::assembly::ellipsoids;
use crate::scene::{Anchors, Monomers, SceneProblem};
use crate::shape::axis::CrossSection;
use actin_ellipsoid::{Cell, CellResponse, Control, Hold, SixVector};
use actin_mechanics::{Vector3, rotation};

/// Monomers of a cell: one period of the helix.
pub(crate) const PERIOD: usize = 13;
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
    samples: Vec<(f64, SixVector)>,
    cells: Vec<CellResponse>,
}

impl Ideal {
    /// Of the stretch between two arc lengths (nm) under the loads of `load`, from evenly spaced samples; none where
    /// a cell finds no minimum. Each begins as that of `near` at its place, under similar loads, or as the one before.
    pub(super) fn along(
        filament: &EndlessFilament,
        load: impl Fn(f64) -> SixVector,
        ([from, to], samples): ([f64; 2], u32),
        near: Option<&Self>,
    ) -> Option<Self> {
        let (from, to) = (from.min(to), from.max(to));
        let spacing = (to - from) / f64::from(samples);
        let mut ideal = Self {
            samples: Vec::new(),
            cells: Vec::new(),
        };
        for k in 0..samples {
            let s_nm = from + (f64::from(k) + 0.5) * spacing;
            let start = near.map_or(ideal.cells.last(), |near| near.cells.get(k as usize));
            let cell = filament.under(&load(s_nm), start)?;
            ideal.samples.push((s_nm, cell.strain));
            ideal.cells.push(cell);
        }
        Some(ideal)
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
