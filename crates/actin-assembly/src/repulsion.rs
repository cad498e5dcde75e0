//! Repulsion of filaments and walls: gaps between surfaces, and contact stiffness.

use super::Part;
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
