//! Record as input of observables, with shared lazy values.

use crate::loads::loads_of;
use crate::shape::Ribbon;
use crate::{Assembly, At};
use actin_mechanics::{Loads, State};
use std::cell::OnceCell;

pub(crate) struct View<'a> {
    pub(crate) assembly: &'a Assembly,
    pub(crate) at: At,
    pub(crate) state: &'a State,
    pub(crate) energies_pn_nm: &'a [f64],
    pub(crate) kinetic_pn_nm: f64,
    ribbons: Vec<OnceCell<Ribbon>>,
    loads: OnceCell<Loads>,
}

impl<'a> View<'a> {
    pub(crate) fn new(
        assembly: &'a Assembly,
        (at, state): (At, &'a State),
        (energies_pn_nm, kinetic_pn_nm): (&'a [f64], f64),
    ) -> Self {
        Self {
            assembly,
            at,
            state,
            energies_pn_nm,
            kinetic_pn_nm,
            ribbons: assembly.filaments.iter().map(|_| OnceCell::new()).collect(),
            loads: OnceCell::new(),
        }
    }

    pub(crate) fn ribbon(&self, filament: usize) -> &Ribbon {
        let of = || Ribbon::from_state(self.assembly, filament, self.state);
        self.ribbons[filament].get_or_init(of)
    }

    /// All loads, at the cost of one additional evaluation.
    pub(crate) fn loads(&self) -> &Loads {
        let interactions = self.assembly.system.interactions();
        self.loads
            .get_or_init(|| loads_of(interactions, self.state))
    }
}
