//! Linear solve of an implicit time step.

use crate::assemble::{Assembly, MatrixParts, Sum};
use crate::chain::Clusters;
use crate::direction::Solver;
use crate::factor::Factor;
use crate::gradients::Gradients;
use crate::layout::{Layout, Node};
use crate::motion::{ComponentStep, StepSize};
use crate::outcome::SolveError;
use actin_mechanics::{
    Approach, Coordinates, Interaction, Loads, SecondOrder, State, UnitQuaternion, Vectors,
};
use std::ops::Range;

/// Solver for the linear equations of implicit time steps.
///
/// Solves are independent of earlier ones. If the layout has no prescribed order, the first
/// factorisation fixes the order of unknowns.
#[derive(Debug)]
pub struct ImplicitSolver {
    layout: Layout,
    assembly: Assembly,
    linear: Linear,
    metric: Vec<f64>,
    step: Vec<f64>,
    /// Generalised loads of the step.
    loads: Vec<f64>,
    clusters: Clusters,
    /// Frames that spin about their third axes.
    spins: Vec<Option<f64>>,
    from: Option<State>,
    /// Number of patterns so far.
    patterns: u64,
}

/// Components and parts of the matrix that take part in a solve.
#[derive(Clone, Copy, Debug)]
pub struct Selection<'a> {
    /// One flag per component; the bodies of others are held.
    pub components: &'a [bool],
    /// One flag per part of the matrix; set for all parts that couple selected components.
    pub parts: &'a [bool],
}

#[derive(Debug)]
enum Linear {
    Unknown,
    Direct(Box<Factor>),
    Gradients(Box<Gradients>),
}

/// Largest number of shortenings of a step. The last ones hold the bodies that still collide.
const SHORTENINGS: usize = 12;

/// Fraction of the motion up to the accepted distance. The next check then finds no approach.
const ACCEPTED: f64 = 0.95;

/// Relative tolerance; later iterations of the step correct the error.
const TOLERANCE: f64 = 0.03;

impl ImplicitSolver {
    /// Solver for the unknowns of `layout`.
    pub fn new(layout: Layout) -> Self {
        Self {
            layout,
            assembly: Assembly::new(1.0),
            linear: Linear::Unknown,
            metric: Vec::new(),
            step: Vec::new(),
            loads: Vec::new(),
            clusters: Clusters::default(),
            spins: Vec::new(),
            from: None,
            patterns: 0,
        }
    }

    /// Sets the frames whose rotations about their third axes are free spins:
    /// [`advance_along`](Self::advance_along) applies them last and without limit.
    pub fn set_spinning_frames(&mut self, frames: &[usize]) {
        let count = frames.iter().max().map_or(0, |most| most + 1);
        self.spins = vec![None; count];
        for &frame in frames {
            self.spins[frame] = Some(0.0);
        }
    }

    /// Rotation of a spinning frame about its third axis in the last step (rad), which may be more than a turn.
    pub fn spin(&self, frame: usize) -> f64 {
        self.spins.get(frame).copied().flatten().unwrap_or(0.0)
    }

    /// Layout of the unknowns.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// Checks for potentials and second derivatives.
    ///
    /// # Errors
    /// The first interaction without a potential or without second derivatives.
    pub fn check(interactions: &[Box<dyn Interaction>]) -> Result<(), SolveError> {
        Solver::check(interactions)
    }

    /// Factorises the stiffness of `interactions` at `state` plus the blocks of `added`. Returns `true` if the sum is positive definite. Zero pivots are replaced by
    /// rounding.
    pub fn factorize(
        &mut self,
        state: &State,
        interactions: &[Box<dyn Interaction>],
        added: &dyn SecondOrder,
    ) -> bool {
        let sum = Sum {
            interactions,
            other: Some(added),
        };
        self.factorize_parts(state, &sum, None)
    }

    /// As [`factorize`](Self::factorize) for a sum of parts. With a selection, all other bodies are
    /// held, which requires [`allows_selection`](Self::allows_selection).
    pub fn factorize_parts(
        &mut self,
        state: &State,
        parts: &dyn MatrixParts,
        selection: Option<Selection<'_>>,
    ) -> bool {
        let all = vec![true; parts.count()];
        let chosen = selection.map_or(&all[..], |selection| selection.parts);
        let nodes = self.selected_nodes(selection);
        let parts_of = (parts, chosen);
        let assembly = &mut self.assembly;
        assembly.choose(chosen);
        let is_same = assembly.update_nodes(parts_of, &nodes, state, &self.layout);
        let is_new = !is_same && assembly.update_with(parts, state, &mut self.layout);
        if is_new {
            self.begin_pattern();
        }
        let columns = match selection {
            Some(selection) if !is_new => self.clusters.columns(&self.layout, selection.components),
            _ => std::iter::once(0..self.layout.unknowns()).collect(),
        };
        let assembly = &self.assembly;
        match &mut self.linear {
            Linear::Unknown => unreachable!("the pattern is new at the first factorisation"),
            Linear::Gradients(gradients) => gradients.factorize(assembly, columns),
            Linear::Direct(factor) => is_positive(factor, assembly, &self.metric),
        }
    }

    /// Factorises again after changes of the chosen parts of the last matrix.
    ///
    /// # Panics
    /// If nothing has been factorised, or the changed parts do not couple the same bodies.
    pub fn refactorize_parts(
        &mut self,
        state: &State,
        parts: &dyn MatrixParts,
        changed: Selection<'_>,
    ) -> bool {
        let nodes = self.selected_nodes(Some(changed));
        let parts_of = (parts, changed.parts);
        let is_same = self
            .assembly
            .update_nodes(parts_of, &nodes, state, &self.layout);
        assert!(is_same, "changes of parts do not change the pattern");
        let columns = self.clusters.columns(&self.layout, changed.components);
        match &mut self.linear {
            Linear::Unknown => panic!("no matrix has been factorised"),
            Linear::Gradients(gradients) => gradients.refactorize(&self.assembly, &columns),
            Linear::Direct(factor) => is_positive(factor, &self.assembly, &self.metric),
        }
    }

    fn selected_nodes(&self, selection: Option<Selection<'_>>) -> Vec<bool> {
        let Some(selection) = selection else {
            return vec![true; self.layout.len()];
        };
        let of_nodes = self.clusters.of_nodes();
        of_nodes.iter().map(|&c| selection.components[c]).collect()
    }

    fn begin_pattern(&mut self) {
        self.patterns += 1;
        let (layout, assembly) = (&self.layout, &self.assembly);
        self.metric = vec![0.0; layout.unknowns()];
        self.clusters = Clusters::new(layout, assembly.ties(), assembly.chain());
        self.linear = if layout.has_gradients() {
            Linear::Gradients(Box::new(Gradients::new(assembly)))
        } else {
            Linear::Direct(Box::new(Factor::new(&assembly.pattern().symbolic)))
        };
    }

    /// Energy decrease of a step of each selected component for `loads` (pN nm), with the last factors
    /// of the components and without their links. Values of other components have no meaning.
    pub fn predicted_decreases(
        &mut self,
        loads: &Loads,
        is_selected: impl Fn(usize) -> bool,
    ) -> Vec<f64> {
        let unknowns = self.layout.unknowns();
        self.loads.resize(unknowns, 0.0);
        self.layout.reduce(loads, &mut self.loads);
        self.step.clone_from(&self.loads);
        let is_selected: Vec<bool> = (0..self.components()).map(is_selected).collect();
        let columns = self.clusters.columns(&self.layout, &is_selected);
        self.linear.precondition(&mut self.step, &columns);
        let products = self.loads.iter().zip(&self.step);
        let halves: Vec<f64> = products.map(|(f, p)| 0.5 * f * p).collect();
        self.clusters.sums(&self.layout, &halves)
    }

    /// Components with negative or doubtful pivots in the last factorisation (ascending).
    pub fn indefinite_components(&self) -> Vec<usize> {
        match &self.linear {
            Linear::Gradients(gradients) => {
                let columns = gradients.indefinite_columns();
                self.clusters.with_unknowns(&self.layout, &columns)
            }
            Linear::Direct(_) | Linear::Unknown => Vec::new(),
        }
    }

    /// Components that contribute negative curvature along the last search direction (ascending).
    pub fn components_of_negative_curvature(&self) -> Vec<usize> {
        match &self.linear {
            Linear::Gradients(gradients) => {
                let terms: Vec<f64> = gradients.curvatures().collect();
                let sums = self.clusters.sums(&self.layout, &terms);
                (0..sums.len()).filter(|&c| sums[c] < 0.0).collect()
            }
            Linear::Direct(_) | Linear::Unknown => Vec::new(),
        }
    }

    /// Returns `true` if components may be selected.
    pub fn allows_selection(&self) -> bool {
        matches!(self.linear, Linear::Gradients(_))
    }

    /// Number of patterns of the matrix so far. The components may change with the pattern.
    pub fn patterns(&self) -> u64 {
        self.patterns
    }

    /// Number of components: bodies that are coupled other than by links, such as filaments.
    pub fn components(&self) -> usize {
        self.clusters.len()
    }

    /// Pairs of components that are linked at present; with repetitions.
    pub fn linked_components(&self) -> Vec<[usize; 2]> {
        let of_nodes = self.clusters.of_nodes();
        let pairs = self.assembly.linked_nodes();
        pairs.map(|pair| pair.map(|k| of_nodes[k])).collect()
    }

    /// Components of bodies; `None` for held ones.
    pub fn components_of(&self, bodies: impl Iterator<Item = Coordinates>) -> Vec<Option<usize>> {
        let of_nodes = self.clusters.of_nodes();
        let component = |body| self.layout.node_of(body).map(|k| of_nodes[k]);
        bodies.map(component).collect()
    }

    /// Number of unknowns.
    pub fn unknowns(&self) -> usize {
        self.layout.unknowns()
    }

    /// Product of the last factorised matrix and `v`.
    ///
    /// # Panics
    /// If nothing has been factorised, or the length of `v` is wrong.
    pub fn times(&self, v: &[f64]) -> Vec<f64> {
        assert_eq!(v.len(), self.unknowns(), "one number per unknown");
        let mut product = vec![0.0; v.len()];
        self.assembly.multiply(v, &mut product);
        product
    }

    /// Solves with the last factorised matrix, in place.
    ///
    /// # Panics
    /// As [`times`](Self::times).
    pub fn solve(&mut self, b: &mut [f64]) {
        assert_eq!(b.len(), self.unknowns(), "one number per unknown");
        self.linear.solve(&self.assembly, b);
    }

    /// Solution for `loads` as velocities of points (lab frame) and angular velocities of frames
    /// (body axes). Zero for held bodies.
    ///
    /// # Panics
    /// If nothing has been factorised.
    pub fn velocities(&mut self, state: &State, loads: &Loads) -> (Vectors, Vectors) {
        self.step.resize(self.layout.unknowns(), 0.0);
        self.layout.reduce(loads, &mut self.step);
        self.linear.solve(&self.assembly, &mut self.step);
        let (moved, mut turned) = self.layout.velocities(state, &self.step);
        for i in 0..turned.len() {
            let q = state.frames.orientation.get(i);
            turned.set(i, q.inverse_transform_vector(&turned.get(i)));
        }
        (moved, turned)
    }

    /// Moves the bodies of `state` by the solution for `loads` and returns the extent of the
    /// solution. A step that rotates a body by more than `largest_turn` (rad) is shortened.
    ///
    /// # Panics
    /// If nothing has been factorised.
    pub fn advance(&mut self, state: &mut State, loads: &Loads, largest_turn: f64) -> StepSize {
        self.step.resize(self.layout.unknowns(), 0.0);
        self.layout.reduce(loads, &mut self.step);
        self.linear.solve(&self.assembly, &mut self.step);
        let extent = self.layout.step_extent(&self.step);
        let scale = (largest_turn / extent.rotation).min(1.0);
        self.layout.apply(state, &self.step, scale);
        extent
    }

    /// Solves for `loads` as step for
    /// [`advance_along`](Self::advance_along). Returns `false` if the matrix proves indefinite.
    ///
    /// # Panics
    /// If nothing has been factorised.
    pub fn find_step(&mut self, loads: &Loads) -> bool {
        self.step.resize(self.layout.unknowns(), 0.0);
        self.layout.reduce(loads, &mut self.step);
        self.loads.clone_from(&self.step);
        self.linear.solve(&self.assembly, &mut self.step)
    }

    /// Moves the bodies of `state` by the last step found and returns the steps of the components
    /// before shortening.
    ///
    /// In filaments that are free or held at one place, each body follows the motion of its
    /// predecessor, so strains are linear in the step. The step of a component is shortened to the
    /// limits of displacement and rotation. It is shortened further until `approaches` returns no
    /// pairs for the motion between two states.
    pub fn advance_along(
        &mut self,
        state: &mut State,
        limits: &StepSize,
        approaches: impl Fn(&State, &State) -> Vec<Approach>,
    ) -> Vec<ComponentStep> {
        let mut from = self.from.take().unwrap_or_else(|| state.clone());
        from.copy_motion_from(state);
        let mut shares = vec![1.0; self.clusters.len()];
        let (layout, step) = (&self.layout, &self.step);
        let mut sizes = Vec::new();
        for round in 0..=SHORTENINGS {
            let limits = (&mut self.spins[..], limits, &shares[..]);
            sizes = self.clusters.advance(layout, (&from, state), step, limits);
            let approaches = approaches(&from, state);
            if approaches.is_empty() {
                break;
            }
            let is_last = round + 1 >= SHORTENINGS;
            self.shorten(&approaches, is_last, &mut shares);
            state.copy_motion_from(&from);
        }
        self.from = Some(from);
        let work: Vec<f64> = self.loads.iter().zip(step).map(|(f, p)| f * p).collect();
        let work = self.clusters.sums(layout, &work);
        let steps = sizes.into_iter().zip(work);
        steps
            .map(|(size, work)| ComponentStep {
                size,
                decrease: 0.5 * work,
            })
            .collect()
    }

    /// Shortens the steps of components on collision course to the accepted fraction, or to zero.
    fn shorten(&self, approaches: &[Approach], is_last: bool, shares: &mut [f64]) {
        let of_nodes = self.clusters.of_nodes();
        let mut factors = vec![1.0_f64; shares.len()];
        for approach in approaches {
            for body in approach.bodies {
                if let Some(node) = self.layout.node_of(body) {
                    let factor = &mut factors[of_nodes[node]];
                    let share = if is_last { 0.0 } else { ACCEPTED };
                    *factor = factor.min(share * approach.fraction);
                }
            }
        }
        for (share, factor) in shares.iter_mut().zip(factors) {
            *share *= factor;
        }
    }

    /// Repeats the motion of free bodies from `start` to `middle`: straight for points, same
    /// rotation for frames.
    pub fn repeat_motion(&self, start: &State, middle: &mut State) {
        for (node, _) in self.layout.nodes() {
            match node {
                Node::Point(i) => go_on(start, middle, i),
                Node::Frame(i) => {
                    let q = middle.frames.orientation.get(i);
                    let half = start.frames.orientation.get(i).inverse() * q;
                    let turned = UnitQuaternion::new_normalize((q * half).into_inner());
                    middle.frames.orientation.set(i, turned);
                }
                Node::Slider(s) => {
                    let points = self.layout.sliders()[s].points.iter();
                    points.for_each(|&i| go_on(start, middle, i));
                }
            }
        }
    }
}

impl Linear {
    fn precondition(&mut self, b: &mut [f64], columns: &[Range<usize>]) {
        match self {
            Self::Unknown => panic!("no matrix has been factorised"),
            Self::Gradients(gradients) => gradients.solve_chains(b, columns),
            Self::Direct(factor) => factor.solve(b),
        }
    }

    fn solve(&mut self, assembly: &Assembly, b: &mut [f64]) -> bool {
        match self {
            Self::Unknown => panic!("no matrix has been factorised"),
            Self::Gradients(gradients) => gradients.solve(assembly, b, TOLERANCE),
            Self::Direct(factor) => {
                factor.solve(b);
                true
            }
        }
    }
}

/// Factorises the assembled matrix; returns `true` if it is positive definite.
fn is_positive(factor: &mut Factor, assembly: &Assembly, metric: &[f64]) -> bool {
    let upper = assembly.pattern().symbolic.as_ref();
    let pivots = factor.factorize(upper, &assembly.values, metric, 0.0);
    pivots.is_positive()
}

fn go_on(start: &State, middle: &mut State, i: usize) {
    let half = middle.points.position.get(i) - start.points.position.get(i);
    middle.points.position.add(i, half);
}

#[cfg(test)]
mod tests {
    use super::*;
    use actin_mechanics::testing::push_point;
    use actin_mechanics::{Coordinates, Matrix3, Stiffness, Vector3};

    struct Four;

    impl SecondOrder for Four {
        fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
            for i in (0..state.points.len()).map(Coordinates::Point) {
                stiffness.push(i, i, Matrix3::identity() * 4.0);
            }
        }
    }

    #[test]
    fn a_solve_moves_free_bodies_only() {
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
        solver.factorize(&state, &[], &Four);
        let extent = solver.advance(&mut state, &loads, 1.0);
        assert_eq!(state.points.position.get(0), Vector3::x() * 0.5);
        assert_eq!(state.points.position.get(1), Vector3::zeros());
        assert!((extent.displacement - 0.5).abs() < 1e-15);
    }
}
