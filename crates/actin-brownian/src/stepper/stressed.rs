//! Solution of steps with random stress.

use super::{Brownian, LARGEST_TURN};
use crate::components::{Components, Subset};
use crate::progress::Progress;
use crate::stress::StepMatrix;
use actin_equilibrium::{ComponentStep, StepSize};
use actin_integrate::StepFailure;
use actin_mechanics::System;

/// Initial iterations of all components.
const FULL_ITERATIONS: usize = 2;

/// If at most one component in `FEW` is unsolved, the neighbours of unsolved components are
/// iterated as well.
const FEW: usize = 16;

impl Brownian {
    pub(super) fn solve_stressed(
        &mut self,
        system: &mut System,
        h: f64,
    ) -> Result<(), StepFailure> {
        let strength = (2.0 * self.thermal_energy / h).sqrt();
        let noise = (&self.noise.points, &self.noise.frames);
        self.random.clear();
        self.friction
            .add_noise(&self.start, strength, noise, &mut self.random);
        self.components
            .begin_step(system.interactions(), system.state());
        self.progress = Progress::default();
        self.spins.fill(0.0);
        self.begin_iterations();
        let mut is_solved = false;
        for _ in 0..self.limits.iterations {
            self.iterations += 1;
            self.find_residual(system, h);
            let is_found = self.find_step(system, 1.0 / h);
            if self.renew_components(system) {
                continue;
            }
            let limits = self.progress.limits(LARGEST_TURN);
            let steps = self.advance(system, &limits);
            let components = &self.components;
            let is_selected = |c| components.has_component(c);
            let limits = &self.limits;
            let progress = &mut self.progress;
            is_solved = progress.record(&steps, is_selected, limits, self.thermal_energy);
            is_solved = is_solved && is_found && self.is_balanced(system, h);
            if is_solved {
                break;
            }
            self.select();
        }
        let moved = self.moved(system.state());
        let is_far = moved.into_iter().any(|moved| self.progress.is_far(moved));
        if is_solved && !is_far {
            return Ok(());
        }
        Err(self.failure(system, &self.progress.largest()))
    }

    /// Returns `true` if the loads confirm that all components are solved. If components have moved alone, only these and
    /// their neighbours are checked. Unsolved components are reopened. An iteration that turns a stiff spring changes its length by more than
    /// the iterations predict.
    fn is_balanced(&mut self, system: &mut System, h: f64) -> bool {
        if self.components.selection().is_some() {
            self.components
                .select_with_neighbours(self.progress.moved_alone());
        }
        self.find_residual(system, h);
        let components = &self.components;
        let is_selected = |c| components.has_component(c);
        let decreases = self.solver.predicted_decreases(&self.residual, is_selected);
        self.progress
            .reopen(&decreases, is_selected, self.thermal_energy)
    }

    /// Moves the bodies by the step of an iteration. Bodies that repel each other meet, but do not
    /// pass through each other.
    fn advance(&mut self, system: &mut System, limits: &StepSize) -> Vec<ComponentStep> {
        let (state, interactions) = system.state_mut_and_interactions();
        let steps = self.solver.advance_along(state, limits, |from, to| {
            let all = interactions.iter();
            all.flat_map(|interaction| interaction.approaches(from, to))
                .collect()
        });
        for i in (0..self.spins.len()).filter(|&i| self.is_axial[i]) {
            self.spins[i] += self.solver.spin(i);
        }
        steps
    }

    /// Updates the components if the pattern of the matrix has changed, and restarts the
    /// iterations. Returns `true` after an update.
    fn renew_components(&mut self, system: &System) -> bool {
        let has_changed = !self.components.fit(&self.solver);
        if has_changed {
            let (interactions, state) = (system.interactions(), system.state());
            self.components = Components::new(&self.solver, interactions, state, &self.friction);
            self.begin_iterations();
        }
        has_changed
    }

    fn begin_iterations(&mut self) {
        let count = self.components.count();
        self.progress.begin_iterations(count);
        self.components.select(vec![true; count]);
    }

    /// Selects the unsolved components if they are at most half of all components. If they are few,
    /// their neighbours are selected as well, because the motion of an unsolved component changes
    /// the loads on its neighbours.
    fn select(&mut self) {
        let progress = &self.progress;
        let count = self.components.count();
        let mut selected: Vec<bool> = (0..count).map(|c| !progress.is_solved(c)).collect();
        let open = selected.iter().filter(|open| **open).count();
        let is_part = progress.iterations() >= FULL_ITERATIONS
            && (1..=count / 2).contains(&open)
            && self.solver.allows_selection();
        if !is_part {
            selected.fill(true);
        } else if FEW * open <= count {
            let open = selected.clone();
            for [a, b] in self.solver.linked_components() {
                selected[a] |= open[b];
                selected[b] |= open[a];
            }
        }
        self.components.select(selected);
    }

    /// Finds the unbalanced loads of the selected components.
    fn find_residual(&mut self, system: &mut System, h: f64) {
        if self.components.selection().is_none() {
            self.loads.clone_from(system.loads());
        } else {
            self.loads.clear();
            for (k, interaction) in system.interactions().iter().enumerate() {
                if self.components.has_interaction(k) {
                    interaction.add_loads(system.state(), &mut self.loads);
                }
            }
        }
        let (state, interactions) = (system.state(), system.interactions());
        self.find_velocities_at_middle(state, h);
        let components = &self.components;
        self.stresses
            .turn_back(interactions, components, &self.spins);
        self.residual.clone_from(&self.loads);
        let residual = &mut self.residual;
        self.stresses
            .add_loads(interactions, components, (state, residual));
        residual.add(&self.random);
        let flow = self.flow.between(&self.start, state);
        let at = (&self.middle, &self.velocities, &flow);
        let has_frame = |i| components.has_frame(i);
        self.friction.add_loads(at, has_frame, residual);
    }

    /// Finds the step of an iteration, with the friction times `factor`. The geometric stiffness is
    /// omitted in the first iteration, and for components with an indefinite matrix. Returns
    /// `false` if the linear equations cannot be solved.
    fn find_step(&mut self, system: &System, factor: f64) -> bool {
        let (state, interactions) = (system.state(), system.interactions());
        let friction = self.friction.times(factor).in_axes_of(&self.middle);
        let components = &self.components;
        let iteration = self.progress.iterations();
        self.stresses.balance_early(interactions, iteration);
        let mut changed: Option<Subset> = None;
        loop {
            self.stresses.find_balance(interactions, components, state);
            let matrix = StepMatrix {
                interactions,
                stresses: &self.stresses,
                components,
                friction,
                progress: &self.progress,
            };
            let solver = &mut self.solver;
            let is_positive = match &changed {
                None => solver.factorize_parts(state, &matrix, components.selection()),
                Some(changed) => solver.refactorize_parts(state, &matrix, changed.selection()),
            };
            if is_positive && solver.find_step(&self.residual) {
                return true;
            }
            let worst = if is_positive {
                solver.components_of_negative_curvature()
            } else {
                solver.indefinite_components()
            };
            let balanced = self.stresses.balance_more(interactions, components, &worst);
            if balanced.is_empty() {
                return solver.find_step(&self.residual);
            }
            changed = Some(components.coupled_by(&balanced));
        }
    }
}
