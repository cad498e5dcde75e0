//! Conjugate gradients for networks, preconditioned by the banded factors of the single filaments.
//!
//! Links are soft compared with the stretching and shear of filaments, so the number of iterations
//! does not grow with the number of filaments.
//!
//! # Source
//! M. R. Hestenes and E. Stiefel, J. Res. Natl. Bur. Stand. 49 (1952) 409; truncation at negative
//! curvature: T. Steihaug, SIAM J. Numer. Anal. 20 (1983) 626.

use crate::assemble::Assembly;
use crate::factor::Factor;
use crate::layout::Layout;
use faer::sparse::SymbolicSparseColMat;

const MOST_ITERATIONS: usize = 500;

#[derive(Debug)]
pub(crate) struct Gradients {
    chains: SymbolicSparseColMat<usize>,
    places: Vec<usize>,
    values: Vec<f64>,
    factor: Factor,
    residual: Vec<f64>,
    preconditioned: Vec<f64>,
    direction: Vec<f64>,
    product: Vec<f64>,
}

impl Gradients {
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

    pub(crate) fn factorize(&mut self, assembly: &Assembly, metric: &[f64]) -> bool {
        for (value, &place) in self.values.iter_mut().zip(&self.places) {
            *value = assembly.values[place];
        }
        let chains = self.chains.as_ref();
        let inertia = self.factor.factorize(chains, &self.values, metric, 0.0);
        inertia.is_positive()
    }

    pub(crate) fn indefinite_columns(&self) -> Vec<usize> {
        self.factor.indefinite_columns().collect()
    }

    /// Solves in place until the preconditioned residual norm has decreased by `tolerance`. Returns
    /// `false` at negative curvature.
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
            if curvature <= 0.0 || size <= 0.0 || curvature.is_nan() || size.is_nan() {
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
            if (0.0..=enough).contains(&next) {
                return true;
            }
            let ratio = next / size;
            for (direction, new) in self.direction.iter_mut().zip(&self.preconditioned) {
                *direction = new + ratio * *direction;
            }
            size = next;
        }
        false
    }

    fn precondition(&mut self) {
        self.preconditioned.copy_from_slice(&self.residual);
        self.factor.solve(&mut self.preconditioned);
    }
}

/// Four partial sums allow parallel additions.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::layout::BodyOrder;
    use actin_mechanics::{
        Coordinates, Loads, Matrix3, Point, SecondOrder, State, Stiffness, Vector3,
    };

    /// Two chains of ten points with soft springs across, and friction.
    struct Ladder;

    impl SecondOrder for Ladder {
        fn add_stiffness(&self, _: &State, stiffness: &mut Stiffness) {
            let mut spring = |i: usize, j: usize, k: f64| {
                let [a, b] = [i, j].map(Coordinates::Point);
                let block = Matrix3::from_diagonal(&Vector3::new(k, 2.0 * k, 3.0 * k));
                stiffness.push(a, a, block);
                stiffness.push(b, b, block);
                stiffness.push(a, b, -block);
            };
            for i in (0..9).chain(10..19) {
                spring(i, i + 1, 50.0);
            }
            (0..10).step_by(3).for_each(|i| spring(i, i + 10, 0.5));
            for i in (0..20).map(Coordinates::Point) {
                stiffness.push(i, i, Matrix3::identity() * 0.1);
            }
        }
    }

    #[test]
    fn conjugate_gradients_agree_with_a_factorisation() {
        let mut state = State::default();
        for _ in 0..20 {
            let position = Vector3::zeros();
            state.points.push(Point {
                position,
                mass: 1.0,
            });
        }
        let order = BodyOrder {
            points: (0..20).map(f64::from).collect(),
            frames: Vec::new(),
        };
        let layout = Layout::new(&state, Some(&order), Vec::new()).unwrap();
        let across = (0..10).map(|i| [i, i + 10].map(Coordinates::Point));
        let mut layout = layout.with_loose(across);
        let loads = Loads::zeros(&state);
        let mut assembly = Assembly::new(1.0);
        assembly.update_with(&[], Some(&Ladder), (&state, &loads), &mut layout);
        let metric = vec![0.0; layout.unknowns()];
        let mut gradients = Gradients::new(&assembly, &layout);
        assert!(gradients.factorize(&assembly, &metric));
        assert!(gradients.places.len() < assembly.values.len());
        let load: Vec<f64> = (0..layout.unknowns()).map(|i| (i as f64).sin()).collect();
        let mut found = load.clone();
        assert!(gradients.solve(&assembly, &mut found, 1e-12));
        let mut factor = Factor::new(&assembly.pattern().symbolic);
        let upper = assembly.pattern().symbolic.as_ref();
        factor.factorize(upper, &assembly.values, &metric, 0.0);
        let mut expected = load;
        factor.solve(&mut expected);
        let largest = expected.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
        for (a, b) in found.iter().zip(&expected) {
            assert!((a - b).abs() < 1e-9 * largest, "{a} {b}");
        }
    }
}
