//! Conjugate gradients for networks, preconditioned by the banded factors of the single filaments.
//!
//! Links are soft compared with the stretching and shear of filaments, so the number of iterations
//! does not grow with the number of filaments.
//!
//! # Source
//! M. R. Hestenes and E. Stiefel, J. Res. Natl. Bur. Stand. 49 (1952) 409; truncation at negative
//! curvature: T. Steihaug, SIAM J. Numer. Anal. 20 (1983) 626.

use crate::assemble::Assembly;
use crate::band::dot;
use crate::factor::Factor;
use std::ops::Range;

const MOST_ITERATIONS: usize = 500;

#[derive(Debug)]
pub(crate) struct Gradients {
    factor: Factor,
    /// Unknowns of the solve; others are held.
    columns: Vec<Range<usize>>,
    residual: Vec<f64>,
    preconditioned: Vec<f64>,
    direction: Vec<f64>,
    /// Matrix of the chains times the direction.
    of_chains: Vec<f64>,
    /// Whole matrix times the direction.
    product: Vec<f64>,
}

impl Gradients {
    pub(crate) fn new(assembly: &Assembly) -> Self {
        let symbolic = &assembly.pattern().symbolic;
        let zeros = vec![0.0; symbolic.ncols()];
        Self {
            factor: Factor::new(symbolic),
            columns: Vec::new(),
            residual: zeros.clone(),
            preconditioned: zeros.clone(),
            direction: zeros.clone(),
            of_chains: zeros.clone(),
            product: zeros,
        }
    }

    /// Factorises the components with the unknowns `columns`; other unknowns are held.
    pub(crate) fn factorize(&mut self, assembly: &Assembly, columns: Vec<Range<usize>>) -> bool {
        self.columns = columns;
        let changed = self.columns.clone();
        self.refactorize(assembly, &changed)
    }

    /// Factorises again the components with the unknowns `changed`.
    pub(crate) fn refactorize(&mut self, assembly: &Assembly, changed: &[Range<usize>]) -> bool {
        let upper = assembly.pattern().symbolic.as_ref();
        let columns = (changed, self.columns.as_slice());
        let inertia = self
            .factor
            .factorize_columns(upper, &assembly.values, columns);
        inertia.is_positive()
    }

    /// Solves with the last factors of the chains of `columns`, without links.
    pub(crate) fn solve_chains(&mut self, b: &mut [f64], columns: &[Range<usize>]) {
        self.factor.solve_columns(b, columns);
    }

    pub(crate) fn indefinite_columns(&self) -> Vec<usize> {
        self.factor.indefinite_columns(&self.columns).collect()
    }

    /// Contributions of the unknowns to the curvature along the last search direction.
    pub(crate) fn curvatures(&self) -> impl Iterator<Item = f64> {
        let terms = self.direction.iter().zip(&self.product);
        terms.map(|(direction, product)| direction * product)
    }

    /// Solves in place until the preconditioned residual norm has decreased by `tolerance`. Returns
    /// `false` at negative curvature. Held unknowns become zero.
    ///
    /// With the matrix `M` of the chains, `M z = r` for the preconditioned residual `z`. The
    /// product of `M` and the direction follows the recurrence of the direction.
    pub(crate) fn solve(&mut self, assembly: &Assembly, b: &mut [f64], tolerance: f64) -> bool {
        let columns = std::mem::take(&mut self.columns);
        let is_solved = self.solve_columns(assembly, b, tolerance, &columns);
        self.columns = columns;
        is_solved
    }

    fn solve_columns(
        &mut self,
        assembly: &Assembly,
        b: &mut [f64],
        tolerance: f64,
        columns: &[Range<usize>],
    ) -> bool {
        self.begin(b, columns);
        let mut size = self.precondition(columns);
        let enough = size * tolerance * tolerance;
        let mut ratio = 0.0;
        for iteration in 0..MOST_ITERATIONS {
            for columns in columns.iter().cloned() {
                let new = &self.preconditioned[columns.clone()];
                scale_and_add(&mut self.direction[columns.clone()], ratio, new);
                let new = &self.residual[columns.clone()];
                scale_and_add(&mut self.of_chains[columns], ratio, new);
            }
            self.multiply(assembly, columns);
            let curvature = dot_in(columns, &self.direction, &self.product);
            if curvature <= 0.0 || size <= 0.0 || curvature.is_nan() || size.is_nan() {
                if iteration == 0 {
                    b.copy_from_slice(&self.direction);
                }
                return size == 0.0;
            }
            let length = size / curvature;
            for columns in columns.iter().cloned() {
                add(
                    &mut b[columns.clone()],
                    length,
                    &self.direction[columns.clone()],
                );
                let product = &self.product[columns.clone()];
                add(&mut self.residual[columns], -length, product);
            }
            let next = self.precondition(columns);
            if (0.0..=enough).contains(&next) {
                return true;
            }
            ratio = next / size;
            size = next;
        }
        false
    }

    /// Moves `b` to the residual.
    fn begin(&mut self, b: &mut [f64], columns: &[Range<usize>]) {
        for vector in [&mut self.residual, &mut self.direction, &mut self.product] {
            vector.fill(0.0);
        }
        for columns in columns.iter().cloned() {
            self.residual[columns.clone()].copy_from_slice(&b[columns]);
        }
        b.fill(0.0);
    }

    /// Returns the squared norm of the preconditioned residual.
    fn precondition(&mut self, columns: &[Range<usize>]) -> f64 {
        for columns in columns.iter().cloned() {
            self.preconditioned[columns.clone()].copy_from_slice(&self.residual[columns]);
        }
        self.factor.solve_columns(&mut self.preconditioned, columns);
        dot_in(columns, &self.residual, &self.preconditioned)
    }

    fn multiply(&mut self, assembly: &Assembly, columns: &[Range<usize>]) {
        for columns in columns.iter().cloned() {
            self.product[columns.clone()].copy_from_slice(&self.of_chains[columns]);
        }
        assembly.add_product_of_links(&self.direction, &mut self.product);
    }
}

fn dot_in(columns: &[Range<usize>], a: &[f64], b: &[f64]) -> f64 {
    let columns = columns.iter().cloned();
    columns.map(|range| dot(&a[range.clone()], &b[range])).sum()
}

/// `to = factor to + new`.
fn scale_and_add(to: &mut [f64], factor: f64, new: &[f64]) {
    for (to, new) in to.iter_mut().zip(new) {
        *to = new + factor * *to;
    }
}

fn add(to: &mut [f64], factor: f64, from: &[f64]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to += factor * from;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assemble::Sum;
    use crate::layout::{BodyOrder, Layout};
    use actin_mechanics::{Coordinates, Matrix3, Point, SecondOrder, State, Stiffness, Vector3};
    use std::iter;

    /// Two chains of ten points with soft springs across, and friction.
    struct Ladder;

    impl SecondOrder for Ladder {
        fn add_stiffness(&self, _: &State, stiffness: &mut Stiffness) {
            type Push = fn(&mut Stiffness, Coordinates, Coordinates, Matrix3);
            let mut spring = |push: Push, i: usize, j: usize, k: f64| {
                let [a, b] = [i, j].map(Coordinates::Point);
                let block = Matrix3::from_diagonal(&Vector3::new(k, 2.0 * k, 3.0 * k));
                push(stiffness, a, a, block);
                push(stiffness, b, b, block);
                push(stiffness, a, b, -block);
            };
            for i in (0..9).chain(10..19) {
                spring(Stiffness::push, i, i + 1, 50.0);
            }
            let rungs = (0..10).step_by(3);
            rungs.for_each(|i| spring(Stiffness::push_link, i, i + 10, 0.5));
            for i in (0..20).map(Coordinates::Point) {
                stiffness.push(i, i, Matrix3::identity() * 0.1);
            }
        }
    }

    fn ladder(layout: &mut Layout, state: &State) -> Assembly {
        let mut assembly = Assembly::new(1.0);
        let sum = Sum {
            interactions: &[],
            other: Some(&Ladder),
        };
        assembly.update_with(&sum, state, layout);
        assembly
    }

    /// Numbers in the order of the points.
    fn by_points(layout: &Layout, unknowns: &[f64]) -> Vec<f64> {
        let points = (0..20).map(Coordinates::Point);
        let range = |body| layout.unknowns_of(body).expect("all points are free");
        points
            .flat_map(|body| unknowns[range(body)].to_vec())
            .collect()
    }

    #[test]
    fn conjugate_gradients_agree_with_a_factorisation() {
        let mut state = State::default();
        let point = Point {
            position: Vector3::zeros(),
            mass: 1.0,
        };
        (0..20).for_each(|_| {
            state.points.push(point);
        });
        let order = BodyOrder {
            points: (0..20).map(f64::from).collect(),
            frames: Vec::new(),
        };
        let layout = Layout::new(&state, Some(&order)).unwrap();
        let mut direct_layout = layout.clone().with_links();
        let mut layout = layout.with_links();
        layout.choose_gradients();
        let direct = ladder(&mut direct_layout, &state);
        let iterative = ladder(&mut layout, &state);
        assert!(iterative.values.len() < direct.values.len());
        let unknowns = layout.unknowns();
        let mut gradients = Gradients::new(&iterative);
        assert!(gradients.factorize(&iterative, iter::once(0..unknowns).collect()));
        let mut found: Vec<f64> = (0..unknowns).map(|i| (i as f64).sin()).collect();
        let load = by_points(&layout, &found);
        assert!(gradients.solve(&iterative, &mut found, 1e-12));
        let mut expected = vec![0.0; unknowns];
        for (i, load) in load.chunks(3).enumerate() {
            let own = direct_layout.unknowns_of(Coordinates::Point(i)).unwrap();
            expected[own].copy_from_slice(load);
        }
        let mut factor = Factor::new(&direct.pattern().symbolic);
        let upper = direct.pattern().symbolic.as_ref();
        factor.factorize(upper, &direct.values, &vec![0.0; unknowns], 0.0);
        factor.solve(&mut expected);
        let largest = expected.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
        let found = by_points(&layout, &found);
        for (a, b) in found.iter().zip(by_points(&direct_layout, &expected)) {
            assert!((a - b).abs() < 1e-9 * largest, "{a} {b}");
        }
    }
}
