//! Contacts of an assembly in a state: gaps, refusal of deep overlaps, stiffness.

use crate::repulsion::SurfaceGap;
use crate::scene::SceneProblem;
use crate::{Assembly, At, Part};
use actin_mechanics::State;

impl Assembly {
    /// Smallest gap between surfaces of filaments, of parts of one filament, and of walls in
    /// `state` (nm).
    ///
    /// A negative gap is a penetration. `None` if no gap is below a quarter of a radius, or without
    /// repulsion.
    pub fn smallest_gap_nm(&self, state: &State) -> Option<f64> {
        let touching = self.repelled.as_ref()?.touching(state);
        touching.iter().map(|t| t.gap.gap).min_by(f64::total_cmp)
    }

    /// Upper bound of the largest frequency (rad/ns) including contact. The largest eigenvalue of a
    /// sum of stiffnesses is at most the sum of the largest eigenvalues.
    ///
    /// # Errors
    /// If the stiffness of contacts has no largest frequency.
    pub fn with_contact(&self, frequency: f64) -> Result<f64, SceneProblem> {
        let Some(repelled) = &self.repelled else {
            return Ok(frequency);
        };
        let of_contact = repelled.largest_frequency(&self.rest).map_err(|error| {
            SceneProblem::new("repulsion", "", format!("has no stable time step: {error}"))
        })?;
        Ok(frequency.hypot(of_contact))
    }

    /// Contacts as built, with the images of a periodic box at the start.
    fn initial_contacts(&self) -> Vec<SurfaceGap> {
        let Some(repelled) = &self.repelled else {
            return Vec::new();
        };
        let mut state = self.rest.clone();
        self.place_controls(&mut state, At::Time(0.0));
        repelled.touching(&state)
    }

    /// # Errors
    /// If filaments as built penetrate each other or a wall beyond the range of the repulsion.
    pub(super) fn check_repulsion(&self) -> Result<(), SceneProblem> {
        let touching = self.initial_contacts();
        let Some(beyond) = touching.iter().find(|touching| touching.is_beyond()) else {
            return Ok(());
        };
        let radius = self.repelled.as_ref().map(|repelled| repelled.radius_nm);
        let (key, value) = match (beyond.part, radius) {
            (Part::Contacts, Some(radius)) => {
                ("repulsion.radius_nm".to_owned(), format!("{radius:?}"))
            }
            (Part::Wall(name), _) => (name.key(), String::new()),
            _ => return Ok(()),
        };
        let rule = format!(
            "in the initial state {}, more than repulsion can separate: increase the distance",
            beyond.in_words(self.filaments.len())
        );
        Err(SceneProblem::new(key, value, rule))
    }

    pub(crate) fn notes_on_repulsion(&self) -> Vec<String> {
        let touching = self.initial_contacts().into_iter();
        let pressed = touching.filter(|touching| touching.depth > 0.0);
        pressed
            .map(|touching| {
                let what = touching.in_words(self.filaments.len());
                format!("repulsion: in the initial state {what}, so it is not an equilibrium")
            })
            .collect()
    }
}
