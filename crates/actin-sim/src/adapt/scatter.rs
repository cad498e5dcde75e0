//! By how much filaments differ whose bonds are drawn: the error that no resolution takes away.

use super::adjoint::Adjoint;
use super::check;
use super::ideal::{EndlessFilament, PERIOD, drawn_monomers};
use super::section_loads::SectionLoads;
use super::wall::no_cell;
use crate::Assembly;
use crate::scene::{Quantity, SceneProblem};
use actin_mechanics::State;
use serde::{Deserialize, Serialize};

/// Samplings of bonds.
const SAMPLINGS: u32 = 8;
/// Places along a filament under whose loads periods are relaxed.
const PLACES: u32 = 6;

/// What drawing the bonds of each interface at random makes of a number, against the mean filament, whose weighted bonds
/// stand for all that could be drawn.
///
/// To first order, from periods of 13 monomers under the loads of the filament: periods that follow each other are
/// taken as independent, and what walls and junctions do is left out. Of 8 samplings at 6 places; the deviation is
/// known to about a sixth of itself.
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
    check(&assembly.scene, quantity)?;
    let written = assembly.monomers_of(0);
    let adjoint = Adjoint::of(quantity, assembly, state)?;
    let loads = SectionLoads::of(assembly, state);
    let mean = EndlessFilament::of(written)?;
    let monomers = drawn_monomers(written);
    let (mut shift, mut variance) = (0.0, 0.0);
    for place in 0..PLACES {
        let s_nm = assembly.length_nm() * (f64::from(place) + 0.5) / f64::from(PLACES);
        let load = loads.at(s_nm);
        let usual = mean.under(&load, None).ok_or_else(no_cell)?;
        // Others at each place: their number counts.
        let change = |k: u32| {
            let drawn = EndlessFilament::drawn(&monomers, place * SAMPLINGS + k)?;
            let response = drawn.under(&load, Some(&usual)).ok_or_else(no_cell)?;
            let defect = response.strain - usual.strain;
            let stored = response.energy - usual.energy - load.dot(&defect);
            Ok(adjoint.change(s_nm, &defect, stored))
        };
        let changes = (0..SAMPLINGS).map(change);
        let changes = changes.collect::<Result<Vec<f64>, SceneProblem>>()?;
        let n = f64::from(SAMPLINGS);
        let of_place = changes.iter().sum::<f64>() / n;
        shift += of_place;
        variance += changes.iter().map(|c| (c - of_place).powi(2)).sum::<f64>() / (n - 1.0);
    }
    let length = assembly.length_nm() / f64::from(PLACES);
    let period = PERIOD as f64 * written.rise_nm;
    Ok(Scatter {
        bonds: [monomers.lateral_bonds, monomers.longitudinal_bonds],
        shift: shift * length,
        deviation: (variance * length * period).sqrt(),
    })
}
