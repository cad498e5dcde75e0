//! The linear solve of a time step that is implicit in the stiffness: `(K + A) p = f`, with blocks `A`
//! of the caller, such as friction over a time step.
//!
//! What the step is for, and whether it is good, is the caller's business.

use crate::assemble::Assembly;
use crate::chain::Clusters;
use crate::direction::Solver;
use crate::factor::Factor;
use crate::gradients::Gradients;
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
    linear: Linear,
    metric: Vec<f64>,
    step: Vec<f64>,
    clusters: Clusters,
    /// True for each frame that spins about its third axis.
    spins: Vec<bool>,
    /// Values that couple such turns to other unknowns.
    uncoupled: Vec<usize>,
    /// Start of a step.
    from: Option<State>,
}

/// Solver of the linear equations of a step.
#[derive(Debug)]
enum Linear {
    /// Before the first factorisation.
    Unknown,
    Direct(Box<Factor>),
    Gradients(Box<Gradients>),
}

/// Residual of conjugate gradients relative to that at the start: steps are iterated, and the next iteration corrects the
/// rest.
const TOLERANCE: f64 = 1e-2;

impl ImplicitSolver {
    /// A solver for what may move.
    pub fn new(layout: Layout) -> Self {
        Self {
            layout,
            assembly: Assembly::new(1.0),
            linear: Linear::Unknown,
            metric: Vec::new(),
            step: Vec::new(),
            clusters: Clusters::default(),
            spins: Vec::new(),
            uncoupled: Vec::new(),
            from: None,
        }
    }

    /// Lets these frames turn about their third axes without effect on other unknowns than such turns of other frames: the matrix
    /// has no other couplings, and steps along filaments turn them after all else.
    ///
    /// # Panics
    /// If nothing has been factorised.
    pub fn let_spin(&mut self, frames: &[usize]) {
        let count = frames.iter().max().map_or(0, |most| most + 1);
        self.spins = vec![false; count];
        for &frame in frames {
            self.spins[frame] = true;
        }
        self.find_uncoupled();
    }

    /// Finds the entries of the pattern that couple turns about third axes to other unknowns.
    fn find_uncoupled(&mut self) {
        let mut is_spin = vec![false; self.layout.unknowns()];
        for (node, range) in self.layout.nodes() {
            if let Node::Frame(i) = node {
                is_spin[range.start + 2] = self.spins.get(i).copied().unwrap_or(false);
            }
        }
        let symbolic = &self.assembly.pattern().symbolic;
        self.uncoupled.clear();
        for column in 0..is_spin.len() {
            for at in symbolic.col_ptr()[column]..symbolic.col_ptr()[column + 1] {
                if is_spin[column] != is_spin[symbolic.row_idx()[at]] {
                    self.uncoupled.push(at);
                }
            }
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
            self.find_uncoupled();
            let (layout, assembly) = (&self.layout, &self.assembly);
            self.metric = vec![0.0; layout.unknowns()];
            self.clusters = Clusters::new(layout, assembly.ties(), assembly.chain());
            self.linear = if layout.has_gradients() {
                Linear::Gradients(Box::new(Gradients::new(assembly, layout)))
            } else {
                Linear::Direct(Box::new(Factor::new(&assembly.pattern().symbolic)))
            };
        }
        for &at in &self.uncoupled {
            self.assembly.values[at] = 0.0;
        }
        let assembly = &self.assembly;
        match &mut self.linear {
            Linear::Unknown => unreachable!("the pattern is new at the first factorisation"),
            Linear::Gradients(gradients) => gradients.factorize(assembly, &self.metric),
            Linear::Direct(factor) => {
                let upper = assembly.pattern().symbolic.as_ref();
                let pivots = factor.factorize(upper, &assembly.values, &self.metric, 0.0);
                pivots.is_positive()
            }
        }
    }

    /// Returns the frames of filaments with negative or doubtful pivots in the last factorisation.
    pub fn indefinite_frames(&self) -> Vec<usize> {
        match &self.linear {
            Linear::Gradients(gradients) => {
                let columns = gradients.indefinite_columns();
                self.clusters.frames_with(&self.layout, &columns)
            }
            Linear::Direct(_) | Linear::Unknown => Vec::new(),
        }
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
        self.linear.solve(&self.assembly, b);
    }

    /// The solution for `loads`, as velocities of points (lab frame) and angular velocities of frames (their own axes), zero of
    /// what is held.
    ///
    /// # Panics
    /// If nothing has been factorised.
    pub fn velocities(&mut self, state: &State, loads: &Loads) -> (Vectors, Vectors) {
        self.step.resize(self.layout.unknowns(), 0.0);
        self.layout.reduce(state, loads, &mut self.step);
        self.linear.solve(&self.assembly, &mut self.step);
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
        self.linear.solve(&self.assembly, &mut self.step);
        let extent = self.layout.step_extent(&self.step);
        let scale = (largest_turn / extent.rotation).min(1.0);
        self.layout.apply(state, &self.step, scale);
        extent
    }

    /// Solves for `loads`, the generalised loads of which are taken at `state`; [`advance_along`](Self::advance_along) makes the
    /// step. Returns false if the matrix has shown to be indefinite.
    ///
    /// # Panics
    /// If nothing has been factorised.
    pub fn find_step(&mut self, state: &State, loads: &Loads) -> bool {
        self.step.resize(self.layout.unknowns(), 0.0);
        self.layout.reduce(state, loads, &mut self.step);
        self.linear.solve(&self.assembly, &mut self.step)
    }

    /// Moves the bodies of `state` by the step found last. Bodies of filaments that are free or held at one place carry one
    /// another along: the step changes strains by as much as its velocities, however far it turns what is carried. The step
    /// of each filament that turns a body by more than `largest_turn` (rad) is shortened to that. Returns the extent of the whole step before it is shortened.
    pub fn advance_along(&mut self, state: &mut State, largest_turn: f64) -> StepSize {
        let mut from = self.from.take().unwrap_or_else(|| state.clone());
        from.copy_motion_from(state);
        let states = (&from, state);
        let extent = self.clusters.advance(
            &self.layout,
            states,
            &self.step,
            (&self.spins, largest_turn),
        );
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

impl Linear {
    /// Solves in place; returns false if the matrix has shown to be indefinite.
    fn solve(&mut self, assembly: &Assembly, b: &mut [f64]) -> bool {
        match self {
            Self::Unknown => panic!("a matrix is factorised before"),
            Self::Gradients(gradients) => gradients.solve(assembly, b, TOLERANCE),
            Self::Direct(factor) => {
                factor.solve(b);
                true
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
