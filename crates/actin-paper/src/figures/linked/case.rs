//! One filament on linkers: how it is resolved, and the scene that follows. What comes out is in
//! `solve.rs`.

use crate::run::scenario;
use actin_sim::{JunctionWeight, Monomers, RodLaw, RodLaws, Scene, Section, fitted_laws};

/// A figure of a free filament on linkers.
#[derive(Debug)]
pub(super) struct Figure {
    pub id: &'static str,
    /// Its name above pictures.
    pub name: &'static str,
    pub title: &'static str,
    /// The scene file, in `scenarios`.
    pub file: &'static str,
    /// Length of the filament (nm).
    pub length: u32,
    /// Lengths of the rod in its middle (nm).
    pub rods: &'static [u32],
    /// The same for `--quick`.
    pub quick_rods: &'static [u32],
}

/// How a filament is resolved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Resolved {
    /// So many nm in the middle as a rod.
    Mixed(u32),
    /// All of it a rod.
    Rod,
    /// All monomers.
    Ellipsoids,
}

/// What the rod is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Law {
    /// Constant rigidities.
    Constant,
    /// The law fitted to filaments of monomers.
    Fitted,
    /// The same with the constant shearing rigidity.
    FittedWithoutShear,
}

/// What is varied besides the resolution.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Variant {
    pub law: Law,
    /// Segments to 10 nm of rod.
    refinement: usize,
    junction: JunctionWeight,
    /// Weighted bonds that stand for all, the default of scenes, in place of drawn ones.
    mean: bool,
}

/// Segments to 10 nm of a refined rod: 1.25 nm each.
const REFINEMENT: usize = 8;

/// The rod of the paper's figures: constant rigidities, segments of 10 nm.
pub(super) const STANDARD: Variant = Variant {
    law: Law::Constant,
    refinement: 1,
    junction: JunctionWeight::Shared,
    mean: false,
};

/// The junction as printed: every bond of it has the rod's full rigidity.
pub(super) const FULL: Variant = Variant {
    junction: JunctionWeight::Full,
    ..STANDARD
};

/// The mean filament.
pub(super) const MEAN: Variant = Variant {
    mean: true,
    ..STANDARD
};

/// All variants, the standard one first.
pub(super) const VARIANTS: [Variant; 7] = [
    STANDARD,
    fine(Law::Constant),
    Variant {
        law: Law::Fitted,
        ..STANDARD
    },
    fine(Law::Fitted),
    fine(Law::FittedWithoutShear),
    FULL,
    MEAN,
];

const fn fine(law: Law) -> Variant {
    Variant {
        law,
        refinement: REFINEMENT,
        ..STANDARD
    }
}

impl Variant {
    /// Name behind quantities; nothing for the standard one.
    pub(super) fn suffix(self) -> &'static str {
        match self {
            FULL => "/full",
            MEAN => "/mean-filament",
            _ => self.suffix_of_rod(),
        }
    }

    fn suffix_of_rod(self) -> &'static str {
        match (self.law, self.refinement > 1) {
            (Law::Constant, false) => "",
            (Law::Constant, true) => "/fine",
            (Law::Fitted, false) => "/fitted",
            (Law::Fitted, true) => "/fitted-fine",
            (Law::FittedWithoutShear, false) => "/fitted-without-shear",
            (Law::FittedWithoutShear, true) => "/fitted-without-shear-fine",
        }
    }

    /// In words.
    pub(super) fn words(self) -> String {
        match self {
            FULL => return "junction full".into(),
            MEAN => return "mean filament".into(),
            _ => {}
        }
        let law = match self.law {
            Law::Constant => "constant rigidities",
            Law::Fitted => "law Fitted",
            Law::FittedWithoutShear => "law Fitted but constant shear",
        };
        format!("{law}, segments of {} nm", 10.0 / self.refinement as f64)
    }

    /// Whether it has samplings of the bonds.
    pub(super) fn is_drawn_at_random(self) -> bool {
        !self.mean
    }

    /// Whether it is a model of the paper: the rod of its figures, joined to the monomers as the text
    /// means it or as the equations print it.
    pub(super) fn is_of_the_paper(self) -> bool {
        [STANDARD, FULL].contains(&self)
    }

    /// The variant that has the same filament of one model alone, as a rod or as monomers.
    pub(super) fn of_pure(self, resolved: Resolved) -> Self {
        match (self, resolved) {
            (MEAN, Resolved::Ellipsoids) => MEAN,
            (_, Resolved::Ellipsoids) | (FULL | MEAN, Resolved::Rod) => STANDARD,
            _ => self,
        }
    }

    fn rod_law(self) -> RodLaw {
        match self.law {
            Law::Constant => RodLaw::Constant,
            Law::Fitted => RodLaw::Fitted,
            Law::FittedWithoutShear => RodLaw::Laws(Box::new(RodLaws {
                shear: None,
                ..fitted_laws()
            })),
        }
    }
}

/// One filament.
#[derive(Clone, Copy, Debug)]
pub(super) struct Case {
    pub figure: &'static Figure,
    pub resolved: Resolved,
    pub variant: Variant,
    /// Seed of the bonds.
    pub seed: u64,
}

impl Case {
    pub(super) fn is_mixed(&self) -> bool {
        matches!(self.resolved, Resolved::Mixed(_))
    }

    /// Length of the rod (nm).
    fn rod(&self) -> u32 {
        match self.resolved {
            Resolved::Mixed(rod) => rod,
            Resolved::Rod => self.figure.length,
            Resolved::Ellipsoids => 0,
        }
    }

    /// Share of rod, for the colour.
    pub(super) fn rod_share(&self) -> f64 {
        f64::from(self.rod()) / f64::from(self.figure.length)
    }

    /// Name in tables, legends and quantities.
    pub(super) fn name(&self) -> String {
        match self.resolved {
            Resolved::Mixed(rod) => format!("rod-{rod}"),
            Resolved::Rod => "rod".into(),
            Resolved::Ellipsoids => "ellipsoids".into(),
        }
    }

    /// The scene of the figure, resolved as this case says.
    pub(super) fn scene(&self) -> Result<Scene, String> {
        let mut scene = scenario(self.figure.file)?;
        scene.filament.sections = self.sections().into();
        scene.filament.monomers.seed = self.seed;
        if self.variant.mean {
            scene.filament.monomers = Monomers::default();
        }
        scene.filament.junction.weight = self.variant.junction;
        scene.filament.rod.law = self.variant.rod_law();
        Ok(scene)
    }

    fn sections(&self) -> Vec<Section> {
        let (length, rod) = (f64::from(self.figure.length), f64::from(self.rod()));
        let (from, to) = (0.5 * (length - rod), 0.5 * (length + rod));
        let ellipsoids = |from_nm, to_nm| Section::Ellipsoids {
            from_nm,
            to_nm,
            altered: None,
        };
        let rod = Section::rod(
            from,
            to,
            Some(self.rod() as usize / 10 * self.variant.refinement),
        );
        match self.resolved {
            Resolved::Mixed(_) => vec![ellipsoids(0.0, from), rod, ellipsoids(to, length)],
            Resolved::Rod => vec![rod],
            Resolved::Ellipsoids => vec![ellipsoids(0.0, length)],
        }
    }
}
