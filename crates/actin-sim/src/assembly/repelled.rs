//! Filaments that repel each other and walls: how near surfaces are, and how stiff contact can be.

use super::{Assembly, Part};
use crate::scene::SceneProblem;
use actin_coupling::repulsion::{Capsule, Contacts, Gap, Tethers, WallContact};
use actin_integrate::FrequencyError;
use actin_mechanics::{Interaction, State, System};

/// What the repulsion of a scene has become.
#[derive(Clone, Debug)]
pub(crate) struct Repelled {
    /// All filaments.
    pub(super) capsules: Vec<Capsule>,
    pub(super) contacts: Option<Contacts>,
    pub(super) walls: Vec<(Part, WallContact)>,
    pub(crate) radius_nm: f64,
}

/// Where two surfaces are near each other.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Touching {
    /// What repels: contacts, a plane or a sphere.
    pub(crate) part: Part,
    /// How far they are apart.
    pub(crate) gap: Gap,
    /// Their filaments; of a wall twice the same.
    pub(crate) filaments: [usize; 2],
    /// Depth over the distance of contact, or over the radius in a wall.
    pub(crate) depth: f64,
    /// What that may be.
    pub(crate) limit: f64,
}

impl Repelled {
    /// Number of pairs of capsules that are near each other.
    pub(crate) fn pairs(&self, state: &State) -> usize {
        let contacts = self.contacts.as_ref();
        contacts.map_or(0, |contacts| contacts.pairs(state))
    }

    /// Where surfaces are nearest to each other, and to each wall, as far as they are near.
    pub(crate) fn touching(&self, state: &State) -> Vec<Touching> {
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

    fn at(&self, part: Part, gap: Gap, (depth, limit): (f64, f64)) -> Touching {
        Touching {
            part,
            gap,
            filaments: gap.capsules.map(|i| self.capsules[i].filament()),
            depth,
            limit,
        }
    }

    /// The largest frequency (rad/ns) that filaments would have under the stiffest contact alone.
    fn largest_frequency(&self, state: &State) -> Result<f64, FrequencyError> {
        let between = self.contacts.iter().map(Contacts::greatest_stiffness);
        let walls = self.walls.iter().map(|(_, wall)| wall.greatest_stiffness());
        let stiffness = between.chain(walls).sum();
        let tethers = Tethers::new(state, &self.capsules, self.radius_nm, stiffness);
        let tethers: Box<dyn Interaction> = Box::new(tethers);
        actin_integrate::largest_frequency(&System::new(state.clone(), vec![tethers]))
    }
}

impl Touching {
    /// Whether filaments are farther in each other or in a wall than they can be pushed back.
    pub(crate) fn is_beyond(&self) -> bool {
        self.depth > self.limit
    }

    /// Where and how far, in a scene of so many filaments.
    pub(crate) fn in_words(&self, filaments: usize) -> String {
        let [a, b] = self.filaments;
        let [s, t] = self.gap.places;
        let depth = -self.gap.gap;
        let name = |filament: usize| match filaments {
            1 => "the filament".to_owned(),
            _ => format!("filament {filament}"),
        };
        match self.part {
            Part::Plane(_) | Part::Sphere(_) => {
                format!(
                    "{} is {depth:.2} nm deep in this wall at s = {s:.2} nm",
                    name(a)
                )
            }
            _ if a == b => format!(
                "{} is {depth:.2} nm deep in itself at s = {s:.2} and {t:.2} nm",
                name(a)
            ),
            _ => format!(
                "{} is {depth:.2} nm deep in {} at s = {s:.2} and {t:.2} nm",
                name(a),
                name(b)
            ),
        }
    }
}

impl Assembly {
    /// Distance of the two surfaces that are nearest to each other in `state` (nm), of filaments, parts of
    /// one, or walls; negative where one is in the other. None if none are within a quarter of a radius, or
    /// if nothing repels.
    pub fn smallest_gap_nm(&self, state: &State) -> Option<f64> {
        let touching = self.repelled.as_ref()?.touching(state);
        touching.iter().map(|t| t.gap.gap).min_by(f64::total_cmp)
    }

    /// A largest frequency (rad/ns) with what contact can add to it: no eigenvalue of a sum of two
    /// stiffnesses is above the sum of their largest.
    pub(crate) fn with_contact(&self, frequency: f64) -> Result<f64, SceneProblem> {
        let Some(repelled) = &self.repelled else {
            return Ok(frequency);
        };
        let of_contact = repelled.largest_frequency(&self.rest).map_err(|error| {
            SceneProblem::new("repulsion", "", format!("has no stable time step: {error}"))
        })?;
        Ok(frequency.hypot(of_contact))
    }

    /// Notes on filaments that are pressed into each other or into walls as built.
    pub(crate) fn notes_on_repulsion(&self) -> Vec<String> {
        let Some(repelled) = &self.repelled else {
            return Vec::new();
        };
        let touching = repelled.touching(&self.rest).into_iter();
        let pressed = touching.filter(|touching| touching.depth > 0.0);
        pressed
            .map(|touching| {
                let what = touching.in_words(self.filaments.len());
                format!("repulsion: as built {what}, so that it is not at rest")
            })
            .collect()
    }
}
