//! Cells of the mean filament that are known already, from which others are found.

use super::ideal::EndlessFilament;
use crate::scene::{Monomers, SceneProblem};
use actin_ellipsoid::{CellResponse, SixVector};
use std::cell::RefCell;
use std::rc::Rc;

/// By what couples (pN nm) and forces (pN) count alike where the nearest of known loads is sought: those of a rigidity against
/// bending of 4e4 pN nm^2 and one against shear of 1e4 pN at one energy.
const ALIKE: [f64; 2] = [200.0, 100.0];

/// The mean filament in cells, of which those under loads asked for before are kept: for one estimate, or all of a
/// choice.
#[derive(Debug)]
pub(super) struct Cells {
    filament: EndlessFilament,
    known: RefCell<Vec<(SixVector, Rc<CellResponse>)>>,
}

impl Cells {
    /// # Errors
    /// As [`EndlessFilament::of`].
    pub(super) fn of(monomers: &Monomers) -> Result<Self, SceneProblem> {
        Ok(Self {
            filament: EndlessFilament::of(monomers)?,
            known: RefCell::default(),
        })
    }

    /// The cell under a load (body axes), found from that under the nearest known; none without a minimum.
    pub(super) fn under(&self, load: &SixVector) -> Option<Rc<CellResponse>> {
        let mut known = self.known.borrow_mut();
        let apart = |(other, _): &(SixVector, Rc<CellResponse>)| strain_scale(&(load - other));
        let nearest = known.iter().min_by(|a, b| apart(a).total_cmp(&apart(b)));
        if let Some((other, cell)) = nearest
            && other == load
        {
            return Some(Rc::clone(cell));
        }
        let start = nearest.map(|(_, cell)| &**cell);
        let cell = Rc::new(self.filament.under(load, start)?);
        known.push((*load, Rc::clone(&cell)));
        Some(cell)
    }
}

/// By how much a load strains a filament, about.
pub(super) fn strain_scale(load: &SixVector) -> f64 {
    let [couple, force] = ALIKE;
    (load.fixed_rows::<3>(0).norm() / couple).hypot(load.fixed_rows::<3>(3).norm() / force)
}
