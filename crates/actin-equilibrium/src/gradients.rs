//! Conjugate gradients for linked chains, preconditioned by the factors of the chains.
//!
//! The factorisation of a network fills with the links between its filaments; that of each filament alone keeps its band.
//! Links are soft compared with the stretch and shear of filaments, so that the number of iterations does not grow with the
//! number of filaments.
//!
//! # Source
//! M. R. Hestenes and E. Stiefel, J. Res. Natl. Bur. Stand. 49 (1952) 409; truncation at negative curvature: T. Steihaug, SIAM
//! J. Numer. Anal. 20 (1983) 626.

use crate::assemble::Assembly;
use crate::factor::Factor;
use crate::layout::Layout;
use faer::sparse::SymbolicSparseColMat;

/// Largest number of iterations.
const MOST_ITERATIONS: usize = 500;

/// Preconditioner and vectors of the iteration.
#[derive(Debug)]
pub(crate) struct Gradients {
    chains: SymbolicSparseColMat<usize>,
    /// Place of each entry of the chains among the values of the whole matrix.
    places: Vec<usize>,
    values: Vec<f64>,
    factor: Factor,
    residual: Vec<f64>,
    preconditioned: Vec<f64>,
    direction: Vec<f64>,
    product: Vec<f64>,
}

impl Gradients {
    /// Returns the solver of the matrix that was assembled last.
    pub(crate) fn new(assembly: &Assembly, layout: &Layout) -> Self {
        let (chains, places) = assembly.pattern().chains(layout);
        let zeros = vec![0.0; layout.unknowns()];
        Self {
            factor: Factor::new(&chains),
            chains,
            values: vec![0.0; places.len()],
            places,
            residual: zeros.clone(),
            preconditioned: zeros.clone(),
            direction: zeros.clone(),
            product: zeros,
        }
    }

    /// Factorises the chains; returns true if all of them are positive definite.
    pub(crate) fn factorize(&mut self, assembly: &Assembly, metric: &[f64]) -> bool {
        for (value, &place) in self.values.iter_mut().zip(&self.places) {
            *value = assembly.values[place];
        }
        let chains = self.chains.as_ref();
        let inertia = self.factor.factorize(chains, &self.values, metric, 0.0);
        inertia.is_positive()
    }

    /// Returns the unknowns with negative or doubtful pivots.
    pub(crate) fn indefinite_columns(&self) -> Vec<usize> {
        self.factor.indefinite_columns().collect()
    }

    /// Solves for the right-hand side `b`, in place, until the residual in the norm of the inverse preconditioner has fallen
    /// by `tolerance`. Returns false at a direction of negative curvature; `b` is then the solution up to it.
    pub(crate) fn solve(&mut self, assembly: &Assembly, b: &mut [f64], tolerance: f64) -> bool {
        self.residual.copy_from_slice(b);
        b.fill(0.0);
        self.precondition();
        self.direction.copy_from_slice(&self.preconditioned);
        let mut size = dot(&self.residual, &self.preconditioned);
        let enough = size * tolerance * tolerance;
        for iteration in 0..MOST_ITERATIONS {
            assembly.multiply(&self.direction, &mut self.product);
            let curvature = dot(&self.direction, &self.product);
            // Written so that a curvature that is not a number ends the iteration.
            if !(curvature > 0.0) {
                if iteration == 0 {
                    b.copy_from_slice(&self.direction);
                }
                return size == 0.0;
            }
            let length = size / curvature;
            add(b, length, &self.direction);
            add(&mut self.residual, -length, &self.product);
            self.precondition();
            let next = dot(&self.residual, &self.preconditioned);
            if next <= enough {
                break;
            }
            let ratio = next / size;
            for (direction, new) in self.direction.iter_mut().zip(&self.preconditioned) {
                *direction = new + ratio * *direction;
            }
            size = next;
        }
        true
    }

    fn precondition(&mut self) {
        self.preconditioned.copy_from_slice(&self.residual);
        self.factor.solve(&mut self.preconditioned);
    }
}

/// Four sums, so that additions do not wait for each other.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 4];
    let (a_chunks, a_rest) = a.as_chunks::<4>();
    let (b_chunks, b_rest) = b.as_chunks::<4>();
    for (a, b) in a_chunks.iter().zip(b_chunks) {
        for (sum, (a, b)) in sums.iter_mut().zip(a.iter().zip(b)) {
            *sum += a * b;
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum();
    sums.iter().sum::<f64>() + rest
}

fn add(to: &mut [f64], factor: f64, from: &[f64]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to += factor * from;
    }
}
