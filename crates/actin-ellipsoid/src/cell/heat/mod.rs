//! The free energy of a cell at a temperature: mean loads, tangent and strains from its thermal motion.
//!
//! [`Cell::sample`] is what to call. The chain of states is in `chain.rs`, what it samples in `potential.rs`, means
//! and their errors in `means.rs`.

mod chain;
mod means;
mod normal;
mod potential;
mod slopes;

use super::{Cell, CellError, Control, Displacements, STRAINS, SixMatrix, SixVector};
use chain::Chain;
use means::{Moves, Sums, with_errors};
use nalgebra::{DMatrix, DVector};
use normal::Normal;
use potential::Potential;

/// Blocks of samples from whose scatter errors are taken.
const BLOCKS: usize = 40;
/// Samples from one Hessian to the next.
const APART: usize = 6;

/// How the motion of a cell is sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heat {
    /// Thermal energy (pN nm).
    pub kt: f64,
    /// Trajectories, about one independent state each; rounded up to a multiple of 40, 240 at least.
    pub samples: usize,
    /// Share of trajectories that are accepted: the more, the shorter the steps. No mean depends on it.
    pub acceptance: f64,
    /// Seed of the motion.
    pub seed: u64,
    /// Stream of the seed: streams are independent.
    pub stream: u64,
}

/// What a cell answers at a temperature; errors are standard errors from the scatter of 40 blocks.
#[derive(Clone, Debug)]
pub struct HeatResponse {
    /// Strains, means of those that are free.
    pub strain: SixVector,
    /// Errors of the means.
    pub strain_error: SixVector,
    /// Covariances of the free strains.
    pub covariance: SixMatrix,
    /// Their errors.
    pub covariance_error: SixMatrix,
    /// Mean couple (pN nm) and force (pN) in body axes: derivatives of the free energy per length. Those of free
    /// strains are the given ones.
    pub loads: SixVector,
    /// Their errors.
    pub loads_error: SixVector,
    /// The same means without control variates, with larger errors.
    pub plain: SixVector,
    /// Errors of the plain means.
    pub plain_error: SixVector,
    /// Second derivatives of the free energy per length by the strains that are held, units as in
    /// [`CellResponse`](super::CellResponse).
    pub tangent: SixMatrix,
    /// Their errors.
    pub tangent_error: SixMatrix,
    /// Mean energy per length of the built filament (pN), no free energy.
    pub energy: f64,
    /// `<x . dE/dx>` over kT and the number of coordinates, 1 for any potential, with its error.
    pub equipartition: [f64; 2],
    /// Mean square of the turns `w` (rad^2).
    pub mean_square_turn: f64,
    /// Share of trajectories that were accepted.
    pub acceptance: f64,
    /// Step, in units in which the frequency of every mode would be 1.
    pub step: f64,
    /// The last state.
    pub displacements: Displacements,
}

impl Cell {
    /// The response at a temperature where some strains are held and the loads of the others given.
    ///
    /// Means of `u` and `w` are held as for [`Cell::relax`]; all else moves: the density of the displacements
    /// and turns is that of Boltzmann times the uniform measure of rotations, exactly, whatever the step. The factor
    /// `det <J_l^-1(w)>` that the held mean turn adds to it is left out: it is that of a potential of 2/13 of
    /// the measure's, `kT |w|^2/12` per monomer.
    ///
    /// Loads are means of `D E = dE/dxi + A^T dE/dx`, where `A` is any shift of the free coordinates with the strain:
    /// the second term is zero on average, and takes away most of the scatter where `A` is that
    /// of the harmonic cell. The tangent is `<D^2 E> - cov(D E)/kT`, per length.
    ///
    /// The chain starts from `start`, by default from the built filament, relaxed.
    ///
    /// # Errors
    /// [`CellError::NoMinimum`] if there is no state to start from.
    ///
    /// # Panics
    /// If `start` is of another number of monomers.
    ///
    /// # Source
    /// S. Duane et al., Phys. Lett. B 195 (1987) 216; the vanishing means: R. Assaraf and M. Caffarel,
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
                block.add(&chain.place, &chain.gradient, &moves, potential);
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

    /// Means and errors; the rest as if nothing had moved from `origin`.
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
            mean_square_turn: mean.turn,
            acceptance: 0.0,
            step: 0.0,
            displacements: origin.rows(0, coordinates).into_owned(),
        }
    }

    /// How coordinates follow the strains, as in the harmonic cell of the mean Hessian.
    fn moves(&self, potential: &Potential<'_>, chain: &Chain<'_>, hessian: &DMatrix<f64>) -> Moves {
        let mixed = hessian.columns(self.coordinates(), STRAINS).into_owned();
        let mut along = -chain.mobility(&mixed);
        for k in 0..STRAINS {
            along[(self.coordinates() + k, k)] += 1.0;
        }
        for &k in &potential.free {
            along.column_mut(k).fill(0.0);
        }
        Moves {
            along,
            origin: chain.place.clone(),
        }
    }
}

#[cfg(test)]
mod tests;
