//! Filaments of monomers, of a rod, or of both, and laws by their names in scenes.

use crate::run::{sections, segments};
use actin_sim::{Filament, Monomers, RodLaw, RodModel, Scene};

/// Rise per monomer (nm). Lengths are whole numbers of rises, so that they agree at all
/// resolutions.
pub(super) const RISE_NM: f64 = 71.2 / 26.0;
/// Number of sampled bonds of an interface.
const DRAWN: usize = 64;
/// Default segment length, and a segment length with negligible discretisation error (nm).
const SEGMENT_NM: f64 = 10.0;
const FINE_NM: f64 = 2.5;

#[derive(Clone, Debug, PartialEq)]
pub(super) struct FilamentModel {
    pub name: String,
    monomers: Monomers,
    /// Arc lengths (nm) of the rod sections; monomers fill the rest.
    rods: Vec<[f64; 2]>,
    rod: RodModel,
    segment_nm: f64,
}

impl FilamentModel {
    fn new(name: String, monomers: Monomers) -> Self {
        Self {
            name,
            monomers,
            rods: Vec::new(),
            rod: RodModel::default(),
            segment_nm: SEGMENT_NM,
        }
    }

    /// Mean filament: monomers with the default quadrature bonds and a lattice at this azimuth.
    pub(super) fn mean(azimuth_deg: f64) -> Self {
        let monomers = Monomers {
            azimuth_deg,
            ..Monomers::default()
        };
        Self::new(format!("mean-{azimuth_deg}"), monomers)
    }

    /// Monomers with sampled bonds.
    pub(super) fn with_sampled_bonds(seed: u64, azimuth_deg: f64) -> Self {
        let monomers = Monomers {
            azimuth_deg,
            ..Monomers::with_sampled_bonds(DRAWN, seed)
        };
        Self::new(format!("drawn-{seed}-{azimuth_deg}"), monomers)
    }

    /// Rod with segments of the default length.
    pub(super) fn coarse(law: &RodLaw) -> Self {
        let whole = vec![[0.0, f64::INFINITY]];
        Self {
            name: format!("rod of {SEGMENT_NM} nm segments"),
            ..Self::mean(0.0).with_rods(law, whole)
        }
    }

    /// Rod for comparison with sampled bonds.
    pub(super) fn rod_of_sampled_bonds(law: &RodLaw) -> Self {
        Self {
            monomers: Monomers::with_sampled_bonds(DRAWN, 0),
            ..Self::coarse(law)
        }
    }

    /// Rod with short segments.
    pub(super) fn fine(law: &RodLaw) -> Self {
        Self {
            name: format!("rod of {FINE_NM} nm segments"),
            ..Self::coarse(law).with_short_segments()
        }
    }

    pub(super) fn with_rods(self, law: &RodLaw, rods: Vec<[f64; 2]>) -> Self {
        Self {
            name: format!("rod at {rods:?}"),
            rods,
            rod: RodModel::with_law(law.clone()),
            ..self
        }
    }

    /// Uses segments of 2.5 nm.
    pub(super) fn with_short_segments(self) -> Self {
        Self {
            segment_nm: FINE_NM,
            ..self
        }
    }

    pub(super) fn is_rod(&self) -> bool {
        self.rods == [[0.0, f64::INFINITY]]
    }

    pub(super) fn is_drawn(&self) -> bool {
        self.monomers.lateral_bonds == DRAWN
    }

    /// A filament of this length (nm).
    pub(super) fn filament(&self, length_nm: f64) -> Filament {
        let segments = |rod_nm| Some(segments(rod_nm, self.segment_nm));
        let sections = sections(length_nm, self.rods.iter().copied(), segments);
        Filament {
            rod: self.rod.clone(),
            monomers: self.monomers.clone(),
            ..Filament::new(sections)
        }
    }
}

/// Returns the law with this name in scenes.
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
    use actin_sim::Section;

    #[test]
    fn laws_are_those_of_scenes() {
        assert_eq!(law("Fitted"), Ok(RodLaw::Fitted));
        assert!(law("Best").unwrap_err().contains("law `Best`"));
    }

    #[test]
    fn sections_match_the_composition() {
        let spans = |made: &FilamentModel| -> Vec<(f64, f64)> {
            let sections = made.filament(100.0).sections;
            sections.iter().map(Section::span_nm).collect()
        };
        let rods = vec![[0.0, 20.0], [80.0, 100.0]];
        let mixed = FilamentModel::mean(0.0).with_rods(&RodLaw::Constant, rods);
        assert_eq!(spans(&mixed), [(0.0, 20.0), (20.0, 80.0), (80.0, 100.0)]);
        assert_eq!(
            spans(&FilamentModel::coarse(&RodLaw::Constant)),
            [(0.0, 100.0)]
        );
        assert_eq!(
            spans(&FilamentModel::with_sampled_bonds(1, 0.0)),
            [(0.0, 100.0)]
        );
    }
}
