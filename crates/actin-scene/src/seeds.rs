//! Seeds of the random parts of a scene.

use super::{Anchors, Scene, Section, Task};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Random part of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename = "Drawn")]
pub enum RandomPart {
    /// Sampled bonds of monomers (`monomers.seed`).
    Bonds,
    /// Thermal noise (`task.thermal.seed`).
    Noise,
    /// Shapes of imperfections (`imperfection.seed`).
    Imperfections,
    /// Events of linkers (`linkers[].kinetics.seed`).
    Linkers,
}

impl RandomPart {
    /// All random parts.
    pub const ALL: [Self; 4] = [Self::Bonds, Self::Noise, Self::Imperfections, Self::Linkers];
}

impl Scene {
    /// Sets the seed of one random part wherever the scene uses it. Returns the number of seeds set. Unused
    /// seeds are not changed.
    pub fn reseed(&mut self, what: RandomPart, seed: u64) -> usize {
        match what {
            RandomPart::Bonds => {
                let drawing = self.filaments_mut().filter(|filament| {
                    let sections = &filament.sections;
                    filament.monomers.anchors != Anchors::Cubature
                        && (sections.is_automatic() || !sections.iter().all(Section::is_rod))
                });
                drawing.map(|f| f.monomers.seed = seed).count()
            }
            RandomPart::Noise => match &mut self.task {
                Task::Dynamics(dynamics) => {
                    let thermal = dynamics.thermal.iter_mut();
                    thermal.map(|thermal| thermal.seed = seed).count()
                }
                Task::Brownian(brownian) => {
                    brownian.seed = seed;
                    usize::from(brownian.thermal().is_some())
                }
                Task::Equilibrium(_) => 0,
            },
            RandomPart::Imperfections => {
                let imperfect = self.filaments_mut().filter_map(|f| f.imperfection.as_mut());
                imperfect
                    .map(|imperfection| imperfection.seed = seed)
                    .count()
            }
            RandomPart::Linkers => {
                let linkers = self.linkers.iter_mut().filter_map(|l| l.kinetics.as_mut());
                linkers.map(|kinetics| kinetics.seed = seed).count()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_random_parts_are_seeded() {
        let text = "Scene(
            filaments: [
                Filament(
                    sections: [Ellipsoids(from_nm: 0.0, to_nm: 30.0)],
                    monomers: Monomers(anchors: Independent),
                ),
                Filament(
                    sections: [Ellipsoids(from_nm: 0.0, to_nm: 30.0)],
                    imperfection: (amplitude_nm: 0.1, seed: 1),
                ),
                Filament(
                    sections: [Rod(from_nm: 0.0, to_nm: 30.0)],
                    monomers: Monomers(anchors: Independent),
                ),
            ],
            task: Dynamics(duration_ns: 1.0),
        )";
        let mut scene = Scene::from_ron(text).unwrap();
        assert_eq!(
            RandomPart::ALL.map(|what| scene.reseed(what, 7)),
            [1, 0, 1, 0]
        );
        assert_eq!(scene.filament.monomers.seed, 7);
        assert_eq!(scene.other_filaments[0].monomers.seed, 0);
        assert_eq!(scene.other_filaments[0].imperfection.unwrap().seed, 7);
        assert!(scene.validate().is_ok());
    }

    #[test]
    fn automatic_sections_are_seeded() {
        let text = "Scene(
            filament: Filament(
                sections: Adaptive(length_nm: 160.0, want: Tip(error: 0.02)),
                monomers: Monomers(anchors: Independent),
            ),
            clamps: [Clamp(end: Start)],
            task: Equilibrium(),
        )";
        let mut scene = Scene::from_ron(text).unwrap();
        assert_eq!(scene.reseed(RandomPart::Bonds, 7), 1);
        assert_eq!(scene.filament.monomers.seed, 7);
    }
}
