//! Free energy of a cell: mean loads, tangent and strains from its thermal motion.
//!
//! [`Cell::sample`] is the entry point.

mod chain;
mod means;
mod normal;
mod potential;
mod slopes;

use super::{Cell, CellError, Control, Displacements, STRAINS, SixMatrix, SixVector};
use chain::Chain;
use means::{StrainDirections, Sums, with_errors};
use nalgebra::{DMatrix, DVector};
use normal::Normal;
use potential::Potential;

/// Number of blocks for the standard errors.
const BLOCKS: usize = 40;
/// Samples between two evaluations of the Hessian.
const APART: usize = 6;

/// Options of the sampling of a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heat {
    /// Thermal energy (pN nm).
    pub kt: f64,
    /// Number of trajectories, about one independent state each. Rounded up to a multiple of 40, at
    /// least 240.
    pub samples: usize,
    /// Target acceptance rate; higher rates give shorter time steps. Means do not depend on it.
    pub acceptance: f64,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Stream of the seed; streams are independent.
    pub stream: u64,
}

/// Mean response of a cell at finite temperature. Errors are standard errors from 40 blocks.
#[derive(Clone, Debug)]
pub struct HeatResponse {
    /// Given strains, and means of the free strains.
    pub strain: SixVector,
    /// Standard errors of the strains.
    pub strain_error: SixVector,
    /// Covariances of the free strains.
    pub covariance: SixMatrix,
    /// Standard errors of the covariances.
    pub covariance_error: SixMatrix,
    /// Mean torque (pN nm) and force (pN) in body axes: derivatives of the free energy per length.
    /// Loads of free strains are the given ones.
    pub loads: SixVector,
    /// Standard errors of the loads.
    pub loads_error: SixVector,
    /// Mean loads without control variates, with larger errors.
    pub plain: SixVector,
    /// Standard errors of the plain loads.
    pub plain_error: SixVector,
    /// Second derivatives of the free energy per length with respect to the given strains, in the
    /// units of [`CellResponse`](super::CellResponse).
    pub tangent: SixMatrix,
    /// Standard errors of the tangent.
    pub tangent_error: SixMatrix,
    /// Mean energy per length of the built filament (pN). This is not the free energy.
    pub energy: f64,
    /// `<x . dE/dx>` divided by kT and the number of coordinates, with its error. The exact value
    /// is 1.
    pub equipartition: [f64; 2],
    /// Acceptance rate.
    pub acceptance: f64,
    /// Time step, in units in which every mode has frequency 1.
    pub step: f64,
    /// Last state.
    pub displacements: Displacements,
}

impl Cell {
    /// Mean response at finite temperature to given strains or loads.
    ///
    /// The means of `u` and `w` are held as for [`Cell::relax`]. All other coordinates follow the
    /// Boltzmann distribution with the uniform measure of rotations, for any time step. The factor
    /// `det <J_l^-1(w)>` of the constraint on the mean rotation is omitted: 2/13 of the potential
    /// of the measure, `kT |w|^2/12` per monomer.
    ///
    /// ```text
    /// loads   <D E>,   D E = dE/dxi + A^T dE/dx
    /// tangent (<D^2 E> - cov(D E) / kT) / length
    ///
    /// A   displacement of the free coordinates with the strain, from the harmonic cell
    /// ```
    ///
    /// The second term of `D E` has zero mean and removes most of the variance. The chain starts
    /// from `start`, by default from the relaxed built filament.
    ///
    /// # Errors
    /// [`CellError::NoMinimum`] if the relaxation does not converge.
    ///
    /// # Panics
    /// If `start` has a different number of monomers.
    ///
    /// # Source
    /// S. Duane et al., Phys. Lett. B 195 (1987) 216. Control variates: R. Assaraf and M. Caffarel,
    /// Phys. Rev. Lett. 83 (1999) 4682.
    pub fn sample(
        &self,
        controls: &[Control; 6],
        heat: &Heat,
        start: Option<(&SixVector, &Displacements)>,
    ) -> Result<HeatResponse, CellError> {
        let (strain, displacements) = match start {
            Some((strain, displacements)) => (*strain, displacements.clone()),
            None => self
                .relax_under(controls, None)
                .map(|found| (found.strain, found.displacements))?,
        };
        let mut potential = Potential {
            cell: self,
            kt: heat.kt,
            free: Vec::new(),
            loads: SixVector::zeros(),
        };
        let mut place = DVector::zeros(potential.size());
        place
            .rows_mut(0, self.coordinates())
            .copy_from(&displacements);
        for (k, control) in controls.iter().enumerate() {
            match *control {
                Control::Strain(value) => place[self.coordinates() + k] = value,
                Control::Load(value) => {
                    place[self.coordinates() + k] = strain[k];
                    potential.free.push(k);
                    potential.loads[k] = value;
                }
            }
        }
        let chain = Chain::new(&potential, place, Normal::new(heat.seed, heat.stream));
        Ok(self.measure(&potential, chain, heat))
    }

    fn measure(
        &self,
        potential: &Potential<'_>,
        mut chain: Chain<'_>,
        heat: &Heat,
    ) -> HeatResponse {
        let hessian = chain.warm_up(heat.acceptance);
        let moves = self.moves(potential, &chain, &hessian);
        let per_block = heat.samples.div_ceil(BLOCKS).max(APART);
        let mut accepted = 0.0;
        let mut blocks = vec![Sums::default(); BLOCKS];
        for block in &mut blocks {
            for k in 0..per_block {
                accepted += chain.advance();
                block.add(&chain.place, &chain.gradient, &moves, self.coordinates());
                if k % APART == 0 {
                    block.add_derivatives(&potential.derivatives(&chain.place), &moves);
                }
            }
        }
        let place = &moves.origin;
        HeatResponse {
            acceptance: accepted / (BLOCKS * per_block) as f64,
            step: chain.step,
            displacements: chain.place.rows(0, self.coordinates()).into_owned(),
            ..self.respond_to(potential, &blocks, place)
        }
    }

    fn respond_to(
        &self,
        potential: &Potential<'_>,
        blocks: &[Sums],
        origin: &DVector<f64>,
    ) -> HeatResponse {
        let (mean, error) = with_errors(blocks, potential.kt);
        let coordinates = self.coordinates();
        let per_length = self.length().recip();
        let strain: SixVector = origin.fixed_rows::<STRAINS>(coordinates).into();
        let mut loads = mean.slope * per_length;
        for &k in &potential.free {
            loads[k] = potential.loads[k];
        }
        let unknowns = potential.kt * potential.directions().ncols() as f64;
        HeatResponse {
            strain: strain + mean.strain,
            strain_error: error.strain,
            covariance: mean.covariance,
            covariance_error: error.covariance,
            loads,
            loads_error: error.slope * per_length,
            plain: mean.plain * per_length,
            plain_error: error.plain * per_length,
            tangent: mean.curvature * per_length,
            tangent_error: error.curvature * per_length,
            energy: mean.energy * per_length,
            equipartition: [mean.virial / unknowns, error.virial / unknowns],
            acceptance: 0.0,
            step: 0.0,
            displacements: origin.rows(0, coordinates).into_owned(),
        }
    }

    fn moves(
        &self,
        potential: &Potential<'_>,
        chain: &Chain<'_>,
        hessian: &DMatrix<f64>,
    ) -> StrainDirections {
        let mixed = hessian.columns(self.coordinates(), STRAINS).into_owned();
        let mut along = -chain.mobility(&mixed);
        for k in 0..STRAINS {
            along[(self.coordinates() + k, k)] += 1.0;
        }
        for &k in &potential.free {
            along.column_mut(k).fill(0.0);
        }
        StrainDirections {
            along,
            origin: chain.place.clone(),
        }
    }
}

#[cfg(test)]
mod tests;
