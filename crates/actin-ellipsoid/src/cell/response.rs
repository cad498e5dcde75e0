//! Response of a relaxed cell.

use super::minimum::{CellState, Minimum, Problem};
use super::{Cell, CellError, Displacements, STRAINS, SixMatrix, SixVector};
use nalgebra::DVector;

/// Prescribed value of one of the six strains or of its conjugate load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Control {
    /// Strain.
    Strain(f64),
    /// Conjugate torque (pN nm) or force (pN).
    Load(f64),
}

/// Response of a relaxed cell.
#[derive(Clone, Debug)]
pub struct CellResponse {
    /// The strains.
    pub strain: SixVector,
    /// Energy per length of the built filament (pN).
    pub energy: f64,
    /// Torque (pN nm) and force (pN) in body axes: derivatives of the energy per length.
    pub loads: SixVector,
    /// Second derivatives of the energy per length: pN nm^2 for torques, pN for forces, pN nm
    /// mixed.
    pub tangent: SixMatrix,
    /// Displacements of the monomers.
    pub displacements: Displacements,
    /// Number of Newton steps.
    pub iterations: usize,
}

impl Cell {
    /// Response to the given strains.
    ///
    /// The minimum is the one reached from `start`, by default from the uniformly strained helix.
    /// The relative accuracy of the loads is 1e-9. Zero-stiffness modes, as at rest, do not
    /// contribute to the tangent.
    ///
    /// # Errors
    /// [`CellError::NoMinimum`] if the minimisation does not converge.
    ///
    /// # Panics
    /// If `start` has a different number of monomers.
    pub fn relax(
        &self,
        strain: &SixVector,
        start: Option<&Displacements>,
    ) -> Result<CellResponse, CellError> {
        let controls = std::array::from_fn(|k| Control::Strain(strain[k]));
        self.find(&controls, SixVector::zeros(), start)
    }

    /// Response to given strains or loads. Strains with given loads relax.
    ///
    /// The minimum is the one reached from `start`, by default from the built filament.
    ///
    /// ```
    /// use actin_ellipsoid::{Cell, Control::{Load, Strain}, EllipsoidModel, EllipsoidParameters, Hold};
    /// let model = EllipsoidModel::new(EllipsoidParameters::default()).unwrap();
    /// let cell = Cell::new(&model, 13, Hold::Means).unwrap();
    /// // Table 5 of the paper: over-twist by 0.0094 rad/nm at zero force shortens the filament by 0.0053.
    /// let free = Load(0.0);
    /// let twisted = [Strain(0.0), Strain(0.0), Strain(0.0094), free, free, free];
    /// let response = cell.relax_under(&twisted, None).unwrap();
    /// // The root mean square deviation from the table is 1.4e-3.
    /// let shortening = -response.strain[5];
    /// assert!((shortening - 0.0053).abs() < 2.0 * 1.4e-3, "{shortening}");
    /// ```
    ///
    /// # Errors
    /// [`CellError::NoMinimum`] if the minimisation does not converge.
    ///
    /// # Panics
    /// If `start` has a different number of monomers.
    pub fn relax_under(
        &self,
        controls: &[Control; 6],
        start: Option<&CellResponse>,
    ) -> Result<CellResponse, CellError> {
        let strain = start.map_or_else(SixVector::zeros, |start| start.strain);
        self.find(controls, strain, start.map(|start| &start.displacements))
    }

    fn find(
        &self,
        controls: &[Control; 6],
        mut strain: SixVector,
        start: Option<&Displacements>,
    ) -> Result<CellResponse, CellError> {
        let mut problem = Problem {
            cell: self,
            free: Vec::new(),
            loads: SixVector::zeros(),
        };
        for (k, control) in controls.iter().enumerate() {
            match *control {
                Control::Strain(value) => strain[k] = value,
                Control::Load(value) => {
                    problem.free.push(k);
                    problem.loads[k] = value;
                }
            }
        }
        let coordinates = match start {
            Some(start) => start.clone(),
            None => DVector::zeros(self.coordinates()),
        };
        assert_eq!(
            coordinates.len(),
            self.coordinates(),
            "coordinates of the cell"
        );
        let minimum = problem.minimise(CellState {
            coordinates,
            strain,
        })?;
        Ok(self.respond(minimum))
    }

    fn respond(&self, minimum: Minimum) -> CellResponse {
        let Minimum {
            state,
            derivatives,
            iterations,
        } = minimum;
        let per_length = self.length().recip();
        let tangent = self.condense(&derivatives) * per_length;
        let loads = derivatives.gradient.rows(self.coordinates(), STRAINS) * per_length;
        CellResponse {
            strain: state.strain,
            energy: derivatives.energy * per_length,
            loads: loads.fixed_rows::<6>(0).into(),
            tangent: SixMatrix::from_fn(|i, j| 0.5 * (tangent[(i, j)] + tangent[(j, i)])),
            displacements: state.coordinates,
            iterations,
        }
    }
}
