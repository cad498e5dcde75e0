//! Other stable equilibria of the same bodies, from starts drawn at random about those that are known.
//!
//! Newton's method leads to the minimum in whose valley it starts. Bodies that are bent beyond a critical
//! load, or bonds that can be closed or open, have several: whether the one that was found is the lowest
//! shows only where the others are known. Starts are drawn as heat would spread bodies about a known
//! equilibrium if its stiffness were the same everywhere: soft modes go far, stiff ones hardly move, and
//! nothing is torn on the way. Each is scaled to a largest turn, of which there are several sizes in
//! turn, and minimised. A third of them are drawn about a state of reference instead, such as one that is
//! straight still: between two states that lean either way.
//!
//! What is not found may still be there: the search says what there is, not that there is nothing else.

use crate::direction::Solver;
use crate::evaluation::{Evaluation, passes_through};
use crate::history::Iteration;
use crate::newton::Newton;
use crate::outcome::{Equilibrium, SolveError};
use actin_mechanics::{Interaction, State, Xorshift};
use std::ops::ControlFlow;

/// Largest turns of a body (rad) to which starts are scaled, one after another.
const TURNS: [f64; 4] = [0.5, 1.0, 2.0, 3.0];
/// Energy (pN nm) below which the way from one equilibrium to another, at the stiffness of the first, is no
/// way: a thousandth of the energy of heat, and what a loose tolerance leaves of soft modes.
const SAME: f64 = 4e-3;
/// Saddles that are left from each start.
const SADDLES: usize = 8;

/// How other equilibria are looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Search {
    /// How many starts are drawn.
    pub starts: usize,
    /// Seed of the starts; each is the same whatever the number of them.
    pub seed: u64,
}

/// What a search begins with.
#[derive(Clone, Copy, Debug)]
pub struct Known<'a> {
    /// An equilibrium.
    pub state: &'a State,
    /// What is known of it.
    pub equilibrium: &'a Equilibrium,
    /// Another state, in equilibrium or not, about which starts are drawn, too: with held bodies and
    /// controls as in that equilibrium. The equilibrium itself, if there is none.
    pub reference: &'a State,
}

/// A stable equilibrium among several.
#[derive(Clone, Debug, PartialEq)]
pub struct Distinct {
    /// The state; velocities are those of the known equilibrium.
    pub state: State,
    /// What is known of it.
    pub equilibrium: Equilibrium,
    /// How many starts led to it; that of the known one counts.
    pub found: usize,
    /// Whether it is the known one.
    pub is_known: bool,
}

/// What a search has found.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// Stable equilibria, the one of least energy first.
    pub states: Vec<Distinct>,
    /// Starts from which none was reached, or none that counts.
    pub lost: usize,
}

impl Found {
    /// What is found before the first start.
    fn beginning(known: &Known<'_>) -> Self {
        Self {
            states: vec![Distinct {
                state: known.state.clone(),
                equilibrium: known.equilibrium.clone(),
                found: 1,
                is_known: true,
            }],
            lost: 0,
        }
    }
}

/// What a caller says of the search while it goes on.
pub trait SearchObserver {
    /// Sees each step of Newton's method; may end the search.
    fn iterate(&mut self, _step: &Iteration) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    /// Whether an equilibrium counts: one that was reached through something forbidden does not.
    fn counts(&mut self, _state: &State) -> bool {
        true
    }
}

impl SearchObserver for () {}

impl Newton {
    /// Looks for stable equilibria besides the `known` one of `state`.
    ///
    /// Held bodies and controls stay as they are. Two equilibria are the same if the way between them would
    /// cost less than 4e-3 pN nm at the stiffness of one of them, or if it is not known that all directions
    /// have stiffness and their energies are as near: what can be moved without effort is one state.
    ///
    /// # Errors
    /// [`Interrupted`](SolveError::Interrupted) if the observer ends it; an interaction without a potential
    /// or second derivatives.
    pub fn search(
        &mut self,
        known: &Known<'_>,
        interactions: &[Box<dyn Interaction>],
        search: &Search,
        observer: &mut dyn SearchObserver,
    ) -> Result<Found, SolveError> {
        Solver::check(interactions)?;
        let mut found = Found::beginning(known);
        for start in 0..search.starts {
            // Each draws from a source of its own, about those that are known by then in turn.
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
            // A reference need not have a finite energy.
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
        let energy = |a: &Distinct| a.equilibrium.energy;
        found.states.sort_by(|a, b| energy(a).total_cmp(&energy(b)));
        Ok(found)
    }

    /// A state drawn about another, in which a body turns by at most `turn` (rad) on top of being carried along.
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

    /// Adds an equilibrium to those that are found, or counts it if it is one of them.
    fn sort_in(
        &mut self,
        found: &mut Found,
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
        found.states.push(Distinct {
            state,
            equilibrium,
            found: 1,
            is_known: false,
        });
        Ok(())
    }
}
