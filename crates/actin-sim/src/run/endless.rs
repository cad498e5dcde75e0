//! An endless filament of monomers under the loads that a filament carries: what a stretch of it would do.

use crate::assembly::ellipsoids;
use crate::scene::{Monomers, SceneProblem};
use crate::trade::weighted;
use actin_ellipsoid::{Cell, CellResponse, Control, Hold, SixVector};

/// Monomers of a cell: one period of the helix.
pub(super) const PERIOD: usize = 13;

/// An endless filament of the mean of some monomers, with weighted bonds, in uniformly strained cells.
#[derive(Debug)]
pub(super) struct EndlessFilament {
    cell: Cell,
}

impl EndlessFilament {
    /// # Errors
    /// Monomers whose helix does not close after 13.
    pub(super) fn of(monomers: &Monomers) -> Result<Self, SceneProblem> {
        let model = ellipsoids(&weighted(monomers), 0)?;
        let cell = Cell::new(&model, PERIOD, Hold::Means);
        let cell = cell.map_err(|error| {
            let rule =
                format!("errors are known for helices of 13 monomers a period only: {error}");
            SceneProblem::new("filament.monomers", "", rule)
        })?;
        Ok(Self { cell })
    }

    /// Curvature and shear strain under couple and force (body axes), found from a cell under similar ones.
    pub(super) fn under(
        &self,
        load: &SixVector,
        near: Option<&CellResponse>,
    ) -> Option<CellResponse> {
        let controls = std::array::from_fn(|k| Control::Load(load[k]));
        self.cell.relax_under(&controls, near).ok()
    }

    /// The same, found from a cell that is held at a twist (rad/nm) at first.
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
