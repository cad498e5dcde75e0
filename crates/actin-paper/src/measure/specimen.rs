//! What is measured.

use crate::run::free;
use actin_sim::{
    Clamp, End, Equilibrium, Filament, Hold, Load, Monomers, RodModel, Scene, Section, Slides,
    Stage, Task,
};

/// A filament to be measured, how it is held and how far equilibria are solved.
#[derive(Clone, Debug, PartialEq)]
pub struct Specimen {
    /// The filament, of any resolution.
    pub filament: Filament,
    /// What holds an end that is a rod; of monomers the last two are held.
    pub hold: Hold,
    /// Tolerances of the equilibria, and how saddles and jumps are dealt with. The path makes its
    /// own first step: it tries to go from one value to the next at once.
    pub solver: Equilibrium,
}

impl Specimen {
    /// This filament, walls at the ends of rods, default tolerances.
    ///
    /// A saddle is left along its lowest mode, and the curve goes on from where a sudden jump
    /// leads: the evidence of each point says so.
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

    /// Monomers all along; the length moves to the nearest monomer.
    pub fn ellipsoids(length_nm: f64, monomers: Monomers) -> Self {
        let section = Section::Ellipsoids {
            from_nm: 0.0,
            to_nm: length_nm,
            altered: None,
        };
        Self::of_one_section(section, monomers, RodModel::default())
    }

    /// A rod all along, by default of segments as near to 10 nm as fits.
    pub fn rod(length_nm: f64, segments: Option<usize>, rod: RodModel) -> Self {
        let section = Section::rod(0.0, length_nm, segments);
        Self::of_one_section(section, Monomers::default(), rod)
    }

    fn of_one_section(section: Section, monomers: Monomers, rod: RodModel) -> Self {
        Self::new(Filament {
            monomers,
            rod,
            ..Filament::new(vec![section])
        })
    }

    /// The scene in which the start is held and the far end slides so, or is free.
    pub(super) fn scene(
        &self,
        title: &str,
        far_end: Option<Slides>,
        loads: Vec<Load>,
        path: Vec<Stage>,
    ) -> Scene {
        let mut clamps = vec![self.clamp(End::Start, Slides::Nowhere)];
        clamps.extend(far_end.map(|slides| self.clamp(End::End, slides)));
        Scene {
            clamps,
            loads,
            path,
            task: Task::Equilibrium(self.solver.clone()),
            ..free(title, self.filament.clone())
        }
    }

    fn clamp(&self, end: End, slides: Slides) -> Clamp {
        let sections = &self.filament.sections;
        let section = match end {
            End::Start => sections.first(),
            End::End => sections.last(),
        };
        let is_rod = matches!(section, Some(Section::Rod { .. }));
        let hold = if is_rod { self.hold } else { Hold::Wall };
        Clamp {
            filament: 0,
            end,
            hold,
            hinge: None,
            slides,
        }
    }
}
