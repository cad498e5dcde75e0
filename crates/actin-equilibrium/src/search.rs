//! Random search for further stable equilibria of the same bodies.
//!
//! Two thirds of the initial guesses are sampled about known equilibria, one third about a
//! reference state. Displacements are sampled as thermal fluctuations with constant stiffness and
//! scaled to a given largest rotation. Each guess is then minimised. The search may miss
//! equilibria.

use crate::direction::Solver;
use crate::evaluation::{Evaluation, passes_through};
use crate::history::Iteration;
use crate::newton::Newton;
use crate::outcome::{Equilibrium, SolveError};
use actin_mechanics::{Interaction, State, Xorshift};
use std::ops::ControlFlow;

/// Largest rotations (rad) of the initial guesses.
const TURNS: [f64; 4] = [0.5, 1.0, 2.0, 3.0];
/// Energy difference (pN nm) below which two equilibria are identical: a thousandth of the thermal
/// energy, and above the error of soft modes at a loose tolerance.
const SAME: f64 = 4e-3;
const SADDLES: usize = 8;

/// Options of a search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Search {
    /// Number of initial guesses.
    pub starts: usize,
    /// Seed of the initial guesses. A guess does not depend on the number of guesses.
    pub seed: u64,
}

/// Starting point of a search.
#[derive(Clone, Copy, Debug)]
pub struct KnownEquilibrium<'a> {
    /// Known equilibrium.
    pub state: &'a State,
    /// Properties of the equilibrium.
    pub equilibrium: &'a Equilibrium,
    /// Reference state, in equilibrium or not, with the same held bodies and controls. Pass the
    /// equilibrium itself if there is no other.
    pub reference: &'a State,
}

/// Stable equilibrium found by a search.
#[derive(Clone, Debug, PartialEq)]
pub struct StableEquilibrium {
    /// State, with the velocities of the known equilibrium.
    pub state: State,
    /// Properties of the equilibrium.
    pub equilibrium: Equilibrium,
    /// Number of initial guesses that lead to this equilibrium; the known equilibrium counts as
    /// one.
    pub found: usize,
    /// Marks the known equilibrium.
    pub is_known: bool,
}

/// Result of a search.
#[derive(Clone, Debug, PartialEq)]
pub struct SearchResult {
    /// Stable equilibria, ordered by energy.
    pub states: Vec<StableEquilibrium>,
    /// Number of initial guesses that lead to no admissible equilibrium.
    pub lost: usize,
}

impl SearchResult {
    fn beginning(known: &KnownEquilibrium<'_>) -> Self {
        Self {
            states: vec![StableEquilibrium {
                state: known.state.clone(),
                equilibrium: known.equilibrium.clone(),
                found: 1,
                is_known: true,
            }],
            lost: 0,
        }
    }
}

/// Observer of a search.
pub trait SearchObserver {
    /// Called at each Newton step; may interrupt the search.
    fn iterate(&mut self, _step: &Iteration) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    /// Returns `false` to reject an equilibrium, such as one reached by a forbidden motion.
    fn counts(&mut self, _state: &State) -> bool {
        true
    }
}

impl SearchObserver for () {}

impl Newton {
    /// Searches for stable equilibria other than the `known` one.
    ///
    /// Held bodies and controls are unchanged. Two equilibria count as identical if the
    /// displacement between them costs less than 4e-3 pN nm with the stiffness of one of them. If
    /// one may have zero-stiffness modes, an energy difference below 4e-3 pN nm also suffices.
    ///
    /// # Errors
    /// [`Interrupted`](SolveError::Interrupted) if the observer interrupts; interactions without a
    /// potential or second derivatives.
    pub fn search(
        &mut self,
        known: &KnownEquilibrium<'_>,
        interactions: &[Box<dyn Interaction>],
        search: &Search,
        observer: &mut dyn SearchObserver,
    ) -> Result<SearchResult, SolveError> {
        Solver::check(interactions)?;
        let mut found = SearchResult::beginning(known);
        for start in 0..search.starts {
            // Separate random streams, about the known states in turn.
            let mut noise = Xorshift::new(
                search
                    .seed
                    .wrapping_add(1 << 32)
                    .wrapping_mul(start as u64 + 1),
            );
            let turn = TURNS[start / 3 % TURNS.len()];
            let about = match start % 3 {
                2 => known.reference,
                _ => &found.states[start % found.states.len()].state,
            };
            let drawn = self.drawn(about, interactions, (&mut noise, turn, start % 3 == 0));
            // A reference state may have an infinite energy.
            let Ok(mut trial) = drawn else {
                found.lost += 1;
                continue;
            };
            let solved = self.minimize_observed(&mut trial, interactions, SADDLES, &mut |step| {
                observer.iterate(step)
            });
            match solved {
                Ok(equilibrium) if !equilibrium.is_saddle() && observer.counts(&trial) => {
                    self.sort_in(&mut found, (trial, equilibrium), interactions)?;
                }
                Err(failure) if failure.cause == SolveError::Interrupted => {
                    return Err(SolveError::Interrupted);
                }
                _ => found.lost += 1,
            }
        }
        let energy = |a: &StableEquilibrium| a.equilibrium.energy;
        found.states.sort_by(|a, b| energy(a).total_cmp(&energy(b)));
        Ok(found)
    }

    /// Random state. Bodies rotate by at most `turn` (rad) in addition to being carried.
    fn drawn(
        &mut self,
        state: &State,
        interactions: &[Box<dyn Interaction>],
        (noise, turn, is_smooth): (&mut Xorshift, f64, bool),
    ) -> Result<State, SolveError> {
        self.solver.prepare(state, interactions)?;
        let inertia = self.solver.factorize(0.0);
        self.solver.make_positive(inertia)?;
        let mut step: Vec<f64> = (0..self.layout().unknowns())
            .map(|_| noise.sample())
            .collect();
        if is_smooth {
            self.solver.solve(&mut step);
        } else {
            self.solver.spread(&mut step);
        }
        let layout = &self.solver.layout;
        let extent = layout.step_extent(&step);
        let largest = extent.rotation.max(extent.strain);
        let mut scale = if largest > 0.0 { turn / largest } else { 0.0 };
        loop {
            let mut straight = state.clone();
            layout.apply(&mut straight, &step, scale);
            if !passes_through(interactions, state, &straight) {
                let mut carried = straight.clone();
                let velocities = layout.velocities(state, &step);
                let chain = self.solver.assembly.chain();
                chain.carry(state, &velocities, scale, &mut carried);
                let energy = |state| Evaluation::new(interactions, state).energy;
                let is_lower = energy(&carried) < energy(&straight)
                    && !passes_through(interactions, state, &carried);
                return Ok(if is_lower { carried } else { straight });
            }
            scale *= 0.5;
        }
    }

    fn sort_in(
        &mut self,
        found: &mut SearchResult,
        (state, equilibrium): (State, Equilibrium),
        interactions: &[Box<dyn Interaction>],
    ) -> Result<(), SolveError> {
        self.solver.prepare(&state, interactions)?;
        let layout = &self.solver.layout;
        let mut product = vec![0.0; layout.unknowns()];
        let is_free = |e: &Equilibrium| e.certificate.is_none_or(|c| c.unresolved > 0);
        for one in &mut found.states {
            let way = layout.difference(&state, &one.state);
            self.solver.assembly.multiply(&way, &mut product);
            let cost: f64 = 0.5 * way.iter().zip(&product).map(|(d, f)| d * f).sum::<f64>();
            let is_near = self.solver.layout.step_extent(&way).rotation < TURNS[0];
            let apart = (equilibrium.energy - one.equilibrium.energy).abs();
            let is_level = is_free(&equilibrium) || is_free(&one.equilibrium);
            if cost.abs() < SAME && is_near || is_level && apart < SAME {
                one.found += 1;
                if equilibrium.energy < one.equilibrium.energy && !one.is_known {
                    one.state = state;
                    one.equilibrium = equilibrium;
                }
                return Ok(());
            }
        }
        found.states.push(StableEquilibrium {
            state,
            equilibrium,
            found: 1,
            is_known: false,
        });
        Ok(())
    }
}
