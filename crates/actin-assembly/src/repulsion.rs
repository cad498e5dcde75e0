//! Repulsion of filaments and walls: gaps between surfaces, and contact stiffness.

use crate::scene::SceneProblem;
use crate::{Assembly, At, Part};
use actin_coupling::repulsion::{Capsule, Contacts, Gap, Tethers, WallContact};
use actin_integrate::FrequencyError;
use actin_mechanics::{Interaction, State, System};

/// Repulsion between filaments and from walls.
#[derive(Clone, Debug)]
pub struct RepulsionModel {
    pub(super) capsules: Vec<Capsule>,
    /// Repulsion between filaments; `None` for a single filament or walls alone.
    pub contacts: Option<Contacts>,
    pub(super) walls: Vec<(Part, WallContact)>,
    /// Radius of the filaments (nm).
    pub radius_nm: f64,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct SurfaceGap {
    pub(crate) part: Part,
    pub(crate) gap: Gap,
    /// Indices of both filaments; equal for a wall.
    pub(crate) filaments: [usize; 2],
    /// Penetration depth over the contact distance; for a wall, over the radius.
    pub(crate) depth: f64,
    pub(crate) limit: f64,
}

impl RepulsionModel {
    /// Returns the number of pairs of segments within range.
    pub fn pairs(&self, state: &State) -> usize {
        let contacts = self.contacts.as_ref();
        contacts.map_or(0, |contacts| contacts.pairs(state))
    }

    /// Nearest pair of filament surfaces, and nearest surface to each wall, if within range.
    pub(crate) fn touching(&self, state: &State) -> Vec<SurfaceGap> {
        let between = self.contacts.iter().filter_map(|contacts| {
            let gap = contacts.closest(state)?;
            let depth = -gap.gap / (2.0 * self.radius_nm);
            let limit = Contacts::yield_depth();
            Some(self.at(Part::Contacts, gap, (depth, limit)))
        });
        let walls = self.walls.iter().filter_map(|(part, wall)| {
            let gap = wall.closest(state)?;
            let depth = -gap.gap / self.radius_nm;
            Some(self.at(*part, gap, (depth, WallContact::yield_depth())))
        });
        between.chain(walls).collect()
    }

    fn at(&self, part: Part, gap: Gap, (depth, limit): (f64, f64)) -> SurfaceGap {
        SurfaceGap {
            part,
            gap,
            filaments: gap.capsules.map(|i| self.capsules[i].filament()),
            depth,
            limit,
        }
    }

    /// Largest frequency (rad/ns) of the filaments under the stiffest contact alone.
    pub(crate) fn largest_frequency(&self, state: &State) -> Result<f64, FrequencyError> {
        let between = self.contacts.iter().map(Contacts::greatest_stiffness);
        let walls = self.walls.iter().map(|(_, wall)| wall.greatest_stiffness());
        let stiffness = between.chain(walls).sum();
        let tethers = Tethers::new(state, &self.capsules, self.radius_nm, stiffness);
        let tethers: Box<dyn Interaction> = Box::new(tethers);
        actin_integrate::largest_frequency(&System::new(state.clone(), vec![tethers]))
    }
}

impl SurfaceGap {
    pub(crate) fn is_beyond(&self) -> bool {
        self.depth > self.limit
    }

    pub(crate) fn in_words(&self, filaments: usize) -> String {
        let [a, b] = self.filaments;
        let [s, t] = self.gap.places;
        let depth = -self.gap.gap;
        let name = |filament: usize| match filaments {
            1 => "the filament".to_owned(),
            _ => format!("filament {filament}"),
        };
        if matches!(self.part, Part::Wall(_)) {
            return format!(
                "{} penetrates this wall by {depth:.2} nm at s = {s:.2} nm",
                name(a)
            );
        }
        let other = match self.gap.image {
            [0, 0, 0] if a == b => "itself".to_owned(),
            [0, 0, 0] => name(b),
            image => format!("image {image:?} of {}", name(b)),
        };
        format!(
            "{} overlaps {other} by {depth:.2} nm at s = {s:.2} and {t:.2} nm",
            name(a)
        )
    }
}

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
