//! Linkers in a state: sites, filaments, rates.

use crate::Assembly;
use crate::kinetics::{COARSEST, Switching};
use crate::scene::{Kinetics as Rates, SceneProblem};
use actin_coupling::Linker;
use actin_mechanics::{State, Vector3};
use std::borrow::Cow;

impl Assembly {
    /// Returns linker `i` with its sites in `state`, and whether it is bound.
    pub fn linker_in(&self, i: usize, state: &State) -> (Cow<'_, Linker>, bool) {
        match self.switching(i) {
            None => (Cow::Borrowed(&self.linkers[i]), true),
            Some(switching) => {
                let linker = switching.linker();
                (Cow::Owned(linker.linker(state)), linker.is_bound(state))
            }
        }
    }

    /// Centres (nm, lab frame) and radii (nm) of beads in `state`.
    pub fn beads_in(&self, state: &State) -> Vec<(Vector3, f64)> {
        let beads = self.beads.iter();
        beads
            .map(|(site, radius)| (site.position(state), *radius))
            .collect()
    }

    /// Returns `true` if linkers of the scene break, form or step.
    pub fn has_events(&self) -> bool {
        self.kinetics.is_some()
    }

    /// End positions of linker `i` in `state` (nm, lab frame), and whether it is bound.
    ///
    /// # Panics
    /// If the index is out of range.
    pub fn linker_ends(&self, i: usize, state: &State) -> ([Vector3; 2], bool) {
        let (linker, holds) = self.linker_in(i, state);
        let ends = [linker.site().position(state), linker.end_position(state)];
        (ends, holds)
    }

    /// Tension of linker `i` in `state` (pN): negative in compression, zero if unbound.
    ///
    /// # Panics
    /// If the index is out of range.
    pub fn linker_pull_pn(&self, i: usize, state: &State) -> f64 {
        let (linker, holds) = self.linker_in(i, state);
        let span = linker.end_position(state) - linker.site().position(state);
        match span.try_normalize(0.0) {
            Some(along) if holds => linker.force(state).dot(&along),
            _ => 0.0,
        }
    }

    fn switching(&self, i: usize) -> Option<&Switching> {
        self.kinetics.as_ref()?.linker(i)
    }

    /// Filaments that linker `i` joins in `state`; the second is `None` for an anchor.
    ///
    /// # Panics
    /// If the index is out of range.
    pub fn linked_filaments(&self, i: usize, state: &State) -> (usize, Option<usize>) {
        let written = &self.scene.linkers[i];
        match self.switching(i).filter(|one| one.rates.roams.is_some()) {
            None => (written.filament, written.to.map(|site| site.filament)),
            Some(roaming) => {
                let [first, second] = [0, 1].map(|hand| roaming.place(hand, state).0);
                (first, Some(second))
            }
        }
    }

    /// Returns whether linker `i` is bound in `state` and the arc length of its site (nm); `None`
    /// for permanent linkers.
    pub fn switched(&self, i: usize, state: &State) -> Option<(bool, f64)> {
        let switching = self.switching(i)?;
        let (_, at_nm) = switching.place(0, state);
        Some((switching.linker().is_bound(state), at_nm))
    }

    /// Refuses rates of linkers that are too fast for a time step (ns).
    ///
    /// # Errors
    /// Names the linker and the rate.
    pub fn check_rates(&self, step_ns: f64) -> Result<(), SceneProblem> {
        for (i, linker) in self.scene.linkers.iter().enumerate() {
            let rates = linker.kinetics.iter().flat_map(Rates::rates);
            for (name, rate) in rates {
                if rate * step_ns > COARSEST {
                    let rule = format!(
                        "is {:.2} per time step of {step_ns:.3e} ns, which delays events: must be at most \
                         {COARSEST}; shorten task.time_step_ns",
                        rate * step_ns
                    );
                    let key = format!("linkers[{i}].kinetics.{name}");
                    return Err(SceneProblem::new(key, format!("{rate:?}"), rule));
                }
            }
        }
        Ok(())
    }

    /// Warning about rates that became too fast for the time step under force.
    pub fn note_on_rates(&self, last: &State) -> Option<String> {
        let kinetics = self.kinetics.as_ref()?;
        let coarsest = last.controls[kinetics.coarsest];
        (coarsest > COARSEST).then(|| {
            format!(
                "linker rates reached {coarsest:.2} per time step: events are delayed by up to half a step, \
                 and each linker has at most one event per step; use a shorter time_step_ns"
            )
        })
    }
}
