//! Energy per length, loads and tangent of a relaxed cell.

use super::minimum::{CellState, Minimum, Problem};
use super::{Cell, CellError, Displacements, STRAINS, SixMatrix, SixVector};
use nalgebra::DVector;

/// What is given of one of the six strains.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Control {
    /// The strain itself.
    Strain(f64),
    /// The couple (pN nm) or force (pN) that belongs to it.
    Load(f64),
}

/// What a cell answers when all that is free in it has relaxed.
#[derive(Clone, Debug)]
pub struct CellResponse {
    /// The strains.
    pub strain: SixVector,
    /// Energy per length of the built filament (pN).
    pub energy: f64,
    /// Couple (pN nm) and force (pN) in body axes: the derivatives of the energy per length.
    pub loads: SixVector,
    /// Its second derivatives: of couples pN nm^2, of forces pN, mixed pN nm; symmetric.
    pub tangent: SixMatrix,
    /// Where the monomers are.
    pub displacements: Displacements,
    /// Newton steps.
    pub iterations: usize,
}

impl Cell {
    /// The response to the given strains.
    ///
    /// The minimum is that which is reached from `start`, by default from the uniformly strained helix. A saddle
    /// is left along its most unstable mode. Couple and force are accurate to 1e-9 of their scale;
    /// the tangent follows by the implicit function theorem. Where modes have no stiffness, as at rest, what
    /// they would add to the tangent is left out.
    ///
    /// # Errors
    /// [`CellError::NoMinimum`] if none is found.
    ///
    /// # Panics
    /// If `start` is of another number of monomers.
    pub fn relax(
        &self,
        strain: &SixVector,
        start: Option<&Displacements>,
    ) -> Result<CellResponse, CellError> {
        let controls = std::array::from_fn(|k| Control::Strain(strain[k]));
        self.find(&controls, SixVector::zeros(), start)
    }

    /// The response where some strains are given and the loads of the others: those relax too.
    ///
    /// The search starts from `start`, by default from the built filament.
    ///
    /// ```
    /// use actin_ellipsoid::{Cell, Control::{Load, Strain}, EllipsoidModel, EllipsoidParameters, Hold};
    /// let model = EllipsoidModel::new(EllipsoidParameters::default()).unwrap();
    /// let cell = Cell::new(&model, 13, Hold::Means).unwrap();
    /// // Over-twist without force shortens the filament, by 0.0053 at 0.0094 rad/nm in the paper's Table 5.
    /// let free = Load(0.0);
    /// let twisted = [Strain(0.0), Strain(0.0), Strain(0.0094), free, free, free];
    /// let response = cell.relax_under(&twisted, None).unwrap();
    /// // The mean filament is off by 1.4e-3 (root mean square over the table).
    /// let shortening = -response.strain[5];
    /// assert!((shortening - 0.0053).abs() < 2.0 * 1.4e-3, "{shortening}");
    /// ```
    ///
    /// # Errors
    /// [`CellError::NoMinimum`] if none is found.
    ///
    /// # Panics
    /// If `start` is of another number of monomers.
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
