//! Infinite filament of monomers under constant loads, for the local strains of a finite filament.

use crate::scene::{Monomers, SceneProblem};
use actin_assembly::ellipsoids;
use actin_ellipsoid::{Cell, CellResponse, Control, Hold, SixVector};

/// Number of monomers in a periodic cell: one period of the helix.
pub(super) const PERIOD: usize = 13;

/// Infinite filament with quadrature bonds, as a periodic cell under uniform strain.
#[derive(Debug)]
pub(super) struct PeriodicFilament {
    cell: Cell,
}

impl PeriodicFilament {
    /// Creates the filament from the parameters of its monomers.
    ///
    /// # Errors
    /// A helix without a period of 13 monomers.
    pub(super) fn new(monomers: &Monomers) -> Result<Self, SceneProblem> {
        let model = ellipsoids(&monomers.with_quadrature_bonds(), 0)?;
        let cell = Cell::new(&model, PERIOD, Hold::Means);
        let cell = cell.map_err(|error| {
            let rule = format!("the helix must have a period of 13 monomers: {error}");
            SceneProblem::new("filament.monomers", "", rule)
        })?;
        Ok(Self { cell })
    }

    /// Returns curvature and shear strain under couple and force (body axes). `near` is the initial guess: the response to a
    /// similar load.
    pub(super) fn under(
        &self,
        load: &SixVector,
        near: Option<&CellResponse>,
    ) -> Option<CellResponse> {
        let controls = std::array::from_fn(|k| Control::Load(load[k]));
        self.cell.relax_under(&controls, near).ok()
    }

    /// Returns the response under `load`, with the equilibrium at a fixed twist (rad/nm) as the initial guess.
    pub(super) fn under_from_twist(
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
