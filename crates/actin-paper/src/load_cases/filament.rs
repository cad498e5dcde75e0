//! What carries a load: monomers, a rod under a law, or both joined; and laws by the names that scenes use.

use actin_sim::{Filament, Monomers, RodLaw, RodModel, Scene, Section};

/// Rise per monomer (nm): lengths are whole numbers of it, so that no resolution is compared at another.
pub(super) const RISE_NM: f64 = 71.2 / 26.0;
/// Drawn bonds of an interface.
pub(super) const DRAWN: usize = 64;

/// What a filament is made of.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Made {
    /// Monomers with the default weighted bonds: the mean filament.
    Mean {
        /// Azimuth of the lattice (deg).
        azimuth_deg: f64,
    },
    /// Monomers with drawn bonds.
    Drawn {
        /// Seed of the bonds.
        seed: u64,
        /// Azimuth of the lattice (deg).
        azimuth_deg: f64,
    },
    /// A rod.
    Rod(Rod),
    /// The mean filament, with a rod in a part of it.
    Mixed {
        /// The rod.
        rod: Rod,
        /// Arc lengths of its stretches (nm).
        stretches: Vec<[f64; 2]>,
        /// Azimuth of the lattice (deg).
        azimuth_deg: f64,
    },
}

/// A rod.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Rod {
    /// Its law.
    pub law: RodLaw,
    /// Length of segments that is aimed at (nm).
    pub segment_nm: f64,
    /// Length that is left out of a pure rod (nm): what an end correction would be.
    pub shorter_nm: f64,
    /// Whether it stands for monomers with drawn bonds.
    pub is_drawn: bool,
}

impl Rod {
    /// A rod of segments as long as scenes make them.
    pub(super) fn coarse(law: &RodLaw) -> Self {
        Self {
            law: law.clone(),
            segment_nm: 10.0,
            shorter_nm: 0.0,
            is_drawn: false,
        }
    }

    /// The same that stands for monomers with drawn bonds.
    pub(super) fn of_drawn(law: &RodLaw) -> Self {
        Self {
            is_drawn: true,
            ..Self::coarse(law)
        }
    }

    /// A rod of segments so short that they do not matter.
    pub(super) fn fine(law: &RodLaw) -> Self {
        Self {
            segment_nm: 2.5,
            ..Self::coarse(law)
        }
    }

    fn section(&self, [from_nm, to_nm]: [f64; 2]) -> Section {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a few hundred at most, and at least one"
        )]
        let segments = ((to_nm - from_nm) / self.segment_nm).round().max(1.0) as usize;
        Section::rod(from_nm, to_nm, Some(segments))
    }

    fn model(&self) -> RodModel {
        RodModel::of_law(self.law.clone())
    }
}

impl Made {
    /// A filament of this length (nm).
    pub(super) fn filament(&self, length_nm: f64) -> Filament {
        let all = || {
            vec![Section::Ellipsoids {
                from_nm: 0.0,
                to_nm: length_nm,
                altered: None,
            }]
        };
        match self {
            Self::Mean { azimuth_deg } => with_monomers(all(), &Monomers::default(), *azimuth_deg),
            Self::Drawn { seed, azimuth_deg } => {
                with_monomers(all(), &Monomers::drawn(DRAWN, *seed), *azimuth_deg)
            }
            Self::Rod(rod) => Filament {
                rod: rod.model(),
                monomers: if rod.is_drawn {
                    Monomers::drawn(DRAWN, 0)
                } else {
                    Monomers::default()
                },
                ..Filament::new(vec![rod.section([0.0, length_nm - rod.shorter_nm])])
            },
            Self::Mixed {
                rod,
                stretches,
                azimuth_deg,
            } => {
                let sections = mixed(rod, stretches, length_nm);
                Filament {
                    rod: rod.model(),
                    ..with_monomers(sections, &Monomers::default(), *azimuth_deg)
                }
            }
        }
    }

    /// Name in files and messages.
    pub(super) fn name(&self) -> String {
        match self {
            Self::Mean { azimuth_deg } => format!("mean-{azimuth_deg}"),
            Self::Drawn { seed, azimuth_deg } => format!("drawn-{seed}-{azimuth_deg}"),
            Self::Rod(rod) => format!("rod of {} nm segments", rod.segment_nm),
            Self::Mixed { stretches, .. } => format!("rod at {stretches:?}"),
        }
    }
}

fn with_monomers(sections: Vec<Section>, monomers: &Monomers, azimuth_deg: f64) -> Filament {
    Filament {
        monomers: Monomers {
            azimuth_deg,
            ..monomers.clone()
        },
        ..Filament::new(sections)
    }
}

/// Rods in these stretches, monomers elsewhere.
fn mixed(rod: &Rod, stretches: &[[f64; 2]], length_nm: f64) -> Vec<Section> {
    let mut sections = Vec::new();
    let mut at = 0.0;
    let monomers = |from_nm: f64, to_nm: f64| {
        (to_nm > from_nm).then_some(Section::Ellipsoids {
            from_nm,
            to_nm,
            altered: None,
        })
    };
    for &stretch in stretches {
        sections.extend(monomers(at, stretch[0]));
        sections.push(rod.section(stretch));
        at = stretch[1];
    }
    sections.extend(monomers(at, length_nm));
    sections
}

/// The law that scenes call so.
///
/// # Errors
/// A name that they do not know.
pub(super) fn law(name: &str) -> Result<RodLaw, String> {
    let text = format!(
        "Scene(filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 10.0)], rod: RodModel(law: {name})), \
         clamps: [Clamp(end: Start)], task: Equilibrium())"
    );
    let scene = Scene::from_ron(&text).map_err(|error| format!("law `{name}`: {error}"))?;
    Ok(scene.filament.rod.law)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Laws are those of scenes; others are refused by name.
    #[test]
    fn laws_are_those_of_scenes() {
        assert_eq!(law("Fitted"), Ok(RodLaw::Fitted));
        assert!(law("Best").unwrap_err().contains("law `Best`"));
    }

    /// Stretches of rod between monomers, and rods that are shortened.
    #[test]
    fn filaments_are_made_as_asked() {
        let rod = Rod::coarse(&RodLaw::Constant);
        let made = Made::Mixed {
            rod: rod.clone(),
            stretches: vec![[0.0, 20.0], [80.0, 100.0]],
            azimuth_deg: 0.0,
        };
        let spans = |made: &Made| -> Vec<(f64, f64)> {
            let sections = made.filament(100.0).sections;
            sections.iter().map(Section::span_nm).collect()
        };
        assert_eq!(spans(&made), [(0.0, 20.0), (20.0, 80.0), (80.0, 100.0)]);
        let shorter = Rod {
            shorter_nm: 6.0,
            ..rod
        };
        assert_eq!(spans(&Made::Rod(shorter)), [(0.0, 94.0)]);
    }
}
