//! By how much filaments differ whose bonds are drawn: the error that no resolution takes away.

use super::adjoint::Adjoint;
use super::cells::Cells;
use super::defects::{Contribution, Look};
use super::ensure_known;
use super::ideal::{EndlessFilament, PERIOD, drawn_monomers};
use super::runs::Run;
use super::section_loads::SectionLoads;
use super::wall::no_cell;
use crate::Assembly;
use crate::scene::{Anchors, Quantity, SceneProblem};
use actin_mechanics::State;
use serde::{Deserialize, Serialize};

/// Samplings of bonds.
const SAMPLINGS: u32 = 8;
/// Places along a filament under whose loads periods are relaxed.
const PLACES: u32 = 6;

/// What drawing the bonds of interfaces at random makes of a number, against the mean filament, whose weighted bonds
/// stand for all that could be drawn.
///
/// To first order, from periods of 13 monomers under the loads of the filament: periods that follow each other are
/// taken as independent, or as the same where all interfaces share one pattern (`Identical`), and what walls and junctions
/// do is left out. Of 8 samplings at 6 places; the deviation is known to about a sixth of itself, to a quarter of
/// patterns that are shared.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scatter {
    /// Bonds of an interface: lateral, longitudinal.
    pub bonds: [usize; 2],
    /// Mean of filaments with drawn bonds less the value of the mean filament, in the number's unit.
    pub shift: f64,
    /// Standard deviation of filaments about their mean, in the same unit.
    pub deviation: f64,
}

/// How filaments with drawn bonds scatter in a number of the equilibrium `state`: with as many bonds as the scene draws,
/// or 64 an interface where its own are weighted.
///
/// # Errors
/// As [`estimate`](super::estimate).
pub fn scatter(
    assembly: &Assembly,
    state: &State,
    quantity: Quantity,
) -> Result<Scatter, SceneProblem> {
    ensure_known(assembly, quantity)?;
    let written = assembly.monomers_of(0);
    let monomers = drawn_monomers(written);
    let is_shared = monomers.anchors == Anchors::Identical;
    let length = assembly.length_nm() / f64::from(PLACES);
    let adjoint = Adjoint::of(quantity, assembly, state)?;
    let loads = SectionLoads::of(assembly, state);
    let mean = Cells::of(written)?;
    let changes = (0..PLACES).map(|place| changes_at(place, assembly, (&loads, &adjoint, &mean)));
    let changes: Vec<Vec<f64>> = changes.collect::<Result<_, _>>()?;
    let variance = if is_shared {
        let of_filament = |k: usize| changes.iter().map(|of_place| of_place[k]).sum();
        let filaments: Vec<f64> = (0..SAMPLINGS as usize).map(of_filament).collect();
        moments(&filaments).1
    } else {
        // Of as many periods as there are about each place.
        let period = PERIOD as f64 * written.rise_nm;
        let of_places = changes.iter().map(|of_place| moments(of_place).1);
        of_places.sum::<f64>() * period / length
    };
    Ok(Scatter {
        bonds: [monomers.lateral_bonds, monomers.longitudinal_bonds],
        shift: changes.iter().map(|of_place| moments(of_place).0).sum(),
        deviation: variance.sqrt(),
    })
}

/// What each sampling does to a number by the stretch about one of the places, in its unit.
fn changes_at(
    place: u32,
    assembly: &Assembly,
    (loads, adjoint, mean): (&SectionLoads, &Adjoint, &Cells),
) -> Result<Vec<f64>, SceneProblem> {
    let monomers = drawn_monomers(assembly.monomers_of(0));
    let length = assembly.length_nm() / f64::from(PLACES);
    let s_nm = length * (f64::from(place) + 0.5);
    let load = loads.at(s_nm);
    let usual = mean.under(&load).ok_or_else(no_cell)?;
    let change = |k: u32| {
        // Others at each place, where they are independent: their number counts.
        let is_shared = monomers.anchors == Anchors::Identical;
        let sampling = if is_shared { k } else { place * SAMPLINGS + k };
        let drawn = EndlessFilament::drawn(&monomers, sampling)?;
        let response = drawn.under(&load, Some(&usual)).ok_or_else(no_cell)?;
        let defect = response.strain - usual.strain;
        let stored = response.energy - usual.energy - load.dot(&defect);
        Ok(length * adjoint.change(s_nm, &defect, stored))
    };
    (0..SAMPLINGS).map(change).collect()
}

impl Look<'_> {
    /// What rods stand for beyond the mean filament, where a scene draws bonds for each interface: the mean over drawings.
    pub(super) fn drawn(&self, runs: &[Run]) -> Result<Vec<Contribution>, SceneProblem> {
        if self.assembly.monomers_of(0).anchors != Anchors::Independent {
            return Ok(Vec::new());
        }
        let length = self.assembly.length_nm() / f64::from(PLACES);
        let rods: Vec<&Run> = runs.iter().filter(|run| run.rod.is_some()).collect();
        let at = |place: u32| {
            let span_nm = [0.0, 1.0].map(|k| (f64::from(place) + k) * length);
            let of_rods: f64 = rods
                .iter()
                .map(|run| overlap([run.span.from_nm, run.span.to_nm], span_nm))
                .sum();
            if of_rods <= 0.0 {
                return Ok(None);
            }
            let changes = changes_at(place, self.assembly, (self.loads, self.adjoint, self.cells))?;
            let error = moments(&changes).0 * of_rods / length;
            Ok(Some(Contribution { span_nm, error }))
        };
        (0..PLACES)
            .filter_map(|place| at(place).transpose())
            .collect()
    }
}

/// Length that two stretches share (nm).
fn overlap([a, b]: [f64; 2], [c, d]: [f64; 2]) -> f64 {
    (b.min(d) - a.max(c)).max(0.0)
}

/// Mean and variance of a sample.
fn moments(sample: &[f64]) -> (f64, f64) {
    let n = sample.len() as f64;
    let mean = sample.iter().sum::<f64>() / n;
    let squares = sample.iter().map(|value| (value - mean).powi(2));
    (mean, squares.sum::<f64>() / (n - 1.0))
}
