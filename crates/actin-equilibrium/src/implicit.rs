//! The linear solve of a time step that is implicit in the stiffness: `(K + A) p = f`, with blocks `A`
//! of the caller, such as friction over a time step.
//!
//! What the step is for, and whether it is good, is the caller's business.

use crate::assemble::Assembly;
use crate::chain::is_open;
use crate::direction::Solver;
use crate::factor::Factor;
use crate::layout::{Layout, Node};
use crate::motion::StepSize;
use crate::outcome::SolveError;
use actin_mechanics::{Interaction, Loads, SecondOrder, State, UnitQuaternion, Vectors};

/// A layout with the memory that its solves need.
///
/// Nothing but memory is carried from one solve to the next, so that each depends on its arguments
/// alone. That includes the order of unknowns where the layout was given one; where it is still to be
/// found, the first factorisation settles it.
#[derive(Debug)]
pub struct ImplicitSolver {
    layout: Layout,
    assembly: Assembly,
    factor: Option<Factor>,
    metric: Vec<f64>,
    step: Vec<f64>,
    /// Whether bodies carry one another along, once that is known.
    carries: Option<bool>,
    /// Where a step starts from.
    from: Option<State>,
}

impl ImplicitSolver {
    /// A solver for what may move.
    pub fn new(layout: Layout) -> Self {
        Self {
            layout,
            assembly: Assembly::new(1.0),
            factor: None,
            metric: Vec::new(),
            step: Vec::new(),
            carries: None,
            from: None,
        }
    }

    /// What may move.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// Refuses interactions without a potential or without second derivatives.
    ///
    /// # Errors
    /// The first such interaction.
    pub fn check(interactions: &[Box<dyn Interaction>]) -> Result<(), SolveError> {
        Solver::check(interactions)
    }

    /// Factorises the stiffness of `interactions` at `state`, under `loads`, with the blocks of `added`; returns
    /// whether the sum is positive definite.
    ///
    /// It need not be. A pivot of zero is replaced by rounding.
    pub fn factorize(
        &mut self,
        (state, loads): (&State, &Loads),
        interactions: &[Box<dyn Interaction>],
        added: &dyn SecondOrder,
    ) -> bool {
        let at = (state, loads);
        let assembly = &mut self.assembly;
        if assembly.update_with(interactions, Some(added), at, &mut self.layout) {
            self.factor = None;
            self.metric = vec![0.0; self.layout.unknowns()];
        }
        let pattern = assembly.pattern();
        let factor = self.factor.get_or_insert_with(|| Factor::new(pattern));
        let upper = assembly.pattern().symbolic.as_ref();
        let pivots = factor.factorize(upper, &assembly.values, &self.metric, 0.0);
        pivots.is_positive()
    }

    /// Number of unknowns.
    pub fn unknowns(&self) -> usize {
        self.layout.unknowns()
    }

    /// The matrix last factorised times `v`.
    ///
    /// # Panics
    /// If nothing has been factorised, or `v` has not one number per unknown.
    pub fn times(&self, v: &[f64]) -> Vec<f64> {
        assert_eq!(v.len(), self.unknowns(), "one number per unknown");
        let mut product = vec![0.0; v.len()];
        self.assembly.multiply(v, &mut product);
        product
    }

    /// Solves with the matrix last factorised, in place.
    ///
    /// # Panics
    /// As [`times`](Self::times).
    pub fn solve(&mut self, b: &mut [f64]) {
        assert_eq!(b.len(), self.unknowns(), "one number per unknown");
        let factor = self.factor.as_mut().expect("factorised before");
        factor.solve(b);
    }

    /// The solution for `loads`, as velocities of points (lab frame) and angular velocities of frames (their own axes), zero of
    /// what is held.
    ///
    /// # Panics
    /// If nothing has been factorised.
    pub fn velocities(&mut self, state: &State, loads: &Loads) -> (Vectors, Vectors) {
        self.step.resize(self.layout.unknowns(), 0.0);
        self.layout.reduce(state, loads, &mut self.step);
        let factor = self.factor.as_mut().expect("factorised before");
        factor.solve(&mut self.step);
        let (moved, mut turned) = self.layout.velocities(state, &self.step);
        for i in 0..turned.len() {
            let q = state.frames.orientation.get(i);
            turned.set(i, q.inverse_transform_vector(&turned.get(i)));
        }
        (moved, turned)
    }

    /// Moves the bodies of `state` by the solution for `loads`, the generalised loads of which are taken
    /// at `state`; one that turns a body by more than `largest_turn` (rad) is shortened to that. Returns
    /// how far the solution goes.
    ///
    /// # Panics
    /// If nothing has been factorised.
    pub fn advance(&mut self, state: &mut State, loads: &Loads, largest_turn: f64) -> StepSize {
        self.step.resize(self.layout.unknowns(), 0.0);
        self.layout.reduce(state, loads, &mut self.step);
        let factor = self.factor.as_mut().expect("factorised before");
        factor.solve(&mut self.step);
        let extent = self.layout.step_extent(&self.step);
        let scale = (largest_turn / extent.rotation).min(1.0);
        self.layout.apply(state, &self.step, scale);
        extent
    }

    /// The same, but where all hangs together at one place or at none, bodies carry one another along: the step changes strains
    /// by as much as its velocities say, however far it turns what is carried.
    ///
    /// # Panics
    /// If nothing has been factorised.
    pub fn advance_together(
        &mut self,
        state: &mut State,
        loads: &Loads,
        largest_turn: f64,
    ) -> StepSize {
        let (layout, assembly) = (&self.layout, &self.assembly);
        let carries = *self
            .carries
            .get_or_insert_with(|| layout.groups().is_empty() && is_open(layout, assembly.ties()));
        if !carries {
            return self.advance(state, loads, largest_turn);
        }
        let mut from = self.from.take().unwrap_or_else(|| state.clone());
        from.copy_motion_from(state);
        let extent = self.advance(state, loads, largest_turn);
        let scale = (largest_turn / extent.rotation).min(1.0);
        let velocities = self.layout.velocities(&from, &self.step);
        let chain = self.assembly.chain();
        chain.carry(&from, &velocities, scale, state);
        self.from = Some(from);
        extent
    }

    /// Moves the free bodies of `middle` as far again as they have come from `start`: points straight, frames by
    /// the same turn.
    pub fn go_on(&self, start: &State, middle: &mut State) {
        for (node, _) in self.layout.nodes() {
            match node {
                Node::Point(i) => go_on(start, middle, i),
                Node::Frame(i) => {
                    let q = middle.frames.orientation.get(i);
                    let half = start.frames.orientation.get(i).inverse() * q;
                    let turned = UnitQuaternion::new_normalize((q * half).into_inner());
                    middle.frames.orientation.set(i, turned);
                }
                Node::Group(g) => {
                    let group = &self.layout.groups()[g];
                    group.points.iter().for_each(|&i| go_on(start, middle, i));
                }
            }
        }
    }
}

/// Moves point `i` of `middle` as far again as it has come from `start`.
fn go_on(start: &State, middle: &mut State, i: usize) {
    let half = middle.points.position.get(i) - start.points.position.get(i);
    middle.points.position.add(i, half);
}

#[cfg(test)]
mod tests {
    use super::*;
    use actin_mechanics::testing::push_point;
    use actin_mechanics::{Coordinates, Matrix3, Stiffness, Vector3};

    /// Adds 4 to the diagonal of each point.
    struct Four;

    impl SecondOrder for Four {
        fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
            for i in (0..state.points.len()).map(Coordinates::Point) {
                stiffness.push(i, i, Matrix3::identity() * 4.0);
            }
        }
    }

    /// A load of 2 on a body with 4 on its diagonal moves it by a half; a held one stays.
    #[test]
    fn a_solve_moves_what_is_free() {
        let mut state = State::default();
        for _ in 0..2 {
            let position = Vector3::zeros();
            push_point(&mut state, position, 1.0);
        }
        state.points.hold(1);
        let mut loads = Loads::zeros(&state);
        loads.force.set(0, Vector3::x() * 2.0);
        loads.force.set(1, Vector3::x() * 2.0);
        let mut solver = ImplicitSolver::new(Layout::free(&state));
        solver.factorize((&state, &loads), &[], &Four);
        let extent = solver.advance(&mut state, &loads, 1.0);
        assert_eq!(state.points.position.get(0), Vector3::x() * 0.5);
        assert_eq!(state.points.position.get(1), Vector3::zeros());
        assert!((extent.displacement - 0.5).abs() < 1e-15);
    }
}
