//! Specimens of the measuring protocols.

use actin_sim::{
    Clamp, End, Equilibrium, Filament, FreeTranslation, Hold, Load, Monomers, RodModel, Scene,
    Section, Stage,
};

/// A filament with its clamps and the solver of its equilibria.
#[derive(Clone, Debug, PartialEq)]
pub struct Specimen {
    /// The filament, of any resolution.
    pub filament: Filament,
    /// Constraint of a rod end; at an end of monomers the last two monomers are held.
    pub hold: Hold,
    /// Tolerances of the equilibria, and the treatment of saddles and jumps. The first step of a
    /// path is a whole stage, independent of this setting.
    pub solver: Equilibrium,
}

impl Specimen {
    /// A specimen with clamped rod ends and default tolerances.
    ///
    /// The solver leaves saddles along their lowest mode and continues after jumps. The evidence of
    /// each point counts both.
    pub fn new(filament: Filament) -> Self {
        Self {
            filament,
            hold: Hold::Wall,
            solver: Equilibrium {
                largest_step: 1.0,
                accept_jumps: true,
                ..Equilibrium::default()
            },
        }
    }

    /// A filament of monomers; its length is rounded to whole monomers.
    pub fn ellipsoids(length_nm: f64, monomers: Monomers) -> Self {
        let section = Section::ellipsoids(0.0, length_nm);
        Self::from_section(section, monomers, RodModel::default())
    }

    /// A rod, by default with segments of about 10 nm.
    pub fn rod(length_nm: f64, segments: Option<usize>, rod: RodModel) -> Self {
        let section = Section::rod(0.0, length_nm, segments);
        Self::from_section(section, Monomers::default(), rod)
    }

    fn from_section(section: Section, monomers: Monomers, rod: RodModel) -> Self {
        Self::new(Filament {
            monomers,
            rod,
            ..Filament::new(vec![section])
        })
    }

    /// The scene with a held start and, unless `far_end` is `None`, a clamp at the far end.
    pub(super) fn scene(
        &self,
        far_end: Option<FreeTranslation>,
        loads: Vec<Load>,
        path: Vec<Stage>,
    ) -> Scene {
        let mut clamps = vec![self.clamp(End::Start, FreeTranslation::Nowhere)];
        clamps.extend(far_end.map(|slides| self.clamp(End::End, slides)));
        Scene {
            clamps,
            loads,
            path,
            ..Scene::new(self.filament.clone(), self.solver.clone())
        }
    }

    fn clamp(&self, end: End, slides: FreeTranslation) -> Clamp {
        let section = &self.filament.sections[self.filament.end_index(end)];
        let hold = if section.is_rod() {
            self.hold
        } else {
            Hold::Wall
        };
        Clamp {
            hold,
            slides,
            ..Clamp::new(end)
        }
    }
}
