//! What is compared across resolutions: one model of rods, junctions and bonds, one clamp.

use super::resolved::Resolved;
use crate::palette;
use actin_draw::Colour;
use actin_sim::{ForceLaw, Hold, JunctionWeight, Monomers, RodLaw, Scene};

/// Which figure, and with it the clamp of the numbers to compare with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Figure {
    /// Rods of constant rigidities.
    Eight,
    /// Rods with the published `B3(kappa)` and `xi(kappa)`.
    Ten,
}

impl Figure {
    /// Identifier of the artefact.
    pub(super) fn id(self) -> &'static str {
        match self {
            Self::Eight => "fig8",
            Self::Ten => "fig10",
        }
    }
}

/// How rods answer to twist.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rods {
    /// Constant rigidities.
    Constant,
    /// The published `B3(kappa)` and `xi(kappa)`, as the gradient of an energy.
    Extended,
    /// The same in the balance of forces and torques as printed, which has no energy.
    PaperBalance,
    /// The energy `C3 sigma_3 kappa_3` of the paper's discussion in place of `xi(kappa)`.
    CouplingEnergy,
}

/// One model of rods, junctions and bonds, one clamp.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Group {
    /// Whose scene.
    pub figure: Figure,
    pub rods: Rods,
    /// What clamps hold of rods.
    pub hold: Hold,
    /// Weight of each bond of a junction.
    pub weight: JunctionWeight,
    /// Weighted bonds that stand for all, the default of scenes, in place of 64 drawn ones.
    pub mean: bool,
}

impl Rods {
    /// Name in tables.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Constant => "constant",
            Self::Extended => "extended",
            Self::PaperBalance => "paper-balance",
            Self::CouplingEnergy => "coupling-energy",
        }
    }
}

impl Group {
    /// The one that is compared: drawn bonds, junctions of weight `Shared`.
    pub(super) fn main(figure: Figure) -> Self {
        let (rods, hold) = match figure {
            Figure::Eight => (Rods::Constant, Hold::TwoNodesAndFrame),
            Figure::Ten => (Rods::Extended, Hold::NodeAndFrame),
        };
        Self {
            figure,
            rods,
            hold,
            weight: JunctionWeight::Shared,
            mean: false,
        }
    }

    /// The same group with what means nothing for `resolved` set to one value, so that a filament
    /// is computed once only.
    pub(super) fn relevant_to(self, resolved: Resolved) -> Self {
        let weight = JunctionWeight::Shared;
        match resolved {
            Resolved::Rod => Self {
                mean: false,
                weight,
                ..self
            },
            Resolved::Mixed(_) => self,
            Resolved::Ellipsoids => Self {
                rods: Rods::Constant,
                weight,
                ..self
            },
        }
    }

    /// The sampling with this seed: the mean filament has one.
    pub(super) fn seed(self, seed: u64) -> u64 {
        if self.mean { 0 } else { seed }
    }

    /// Changes the scene of the figure into that of this group.
    pub(super) fn apply(self, scene: &mut Scene, seed: u64) {
        let filament = &mut scene.filament;
        if self.mean {
            filament.monomers = Monomers::default();
        }
        filament.monomers.seed = seed;
        filament.junction.weight = self.weight;
        (filament.rod.law, filament.rod.force_law) = match self.rods {
            Rods::Constant => (RodLaw::Constant, ForceLaw::EnergyGradient),
            Rods::Extended => (RodLaw::PublishedExtension, ForceLaw::EnergyGradient),
            Rods::PaperBalance => (RodLaw::PublishedExtension, ForceLaw::PaperBalance),
            Rods::CouplingEnergy => (RodLaw::CouplingEnergy, ForceLaw::EnergyGradient),
        };
    }

    /// In legends, what tells it from the first group of its figure.
    pub(super) fn words(self) -> &'static str {
        let main = Self::main(self.figure);
        match self.rods {
            Rods::PaperBalance => return "balance as printed",
            _ if self.mean => return "mean filament",
            _ => {}
        }
        if self.weight != main.weight {
            return "junction as printed";
        }
        if self.hold != main.hold {
            return "clamp Wall";
        }
        match (self.figure, self.rods) {
            (Figure::Ten, Rods::Constant) => "constant rigidities",
            (Figure::Ten, Rods::CouplingEnergy) => "C3 energy",
            _ => "drawn bonds",
        }
    }

    /// In charts against the length of rod.
    pub(super) fn colour(self) -> Colour {
        let main = Self::main(self.figure);
        match self {
            group if group == main => palette::line(3),
            group if group.rods == Rods::PaperBalance => palette::line(0),
            group if group.mean => palette::DATA,
            group if group.hold != main.hold => palette::LIGHT_GREY,
            group if group.weight != main.weight => palette::line(0),
            group => match group.rods {
                Rods::Constant => palette::line(1),
                Rods::CouplingEnergy => palette::line(2),
                _ => palette::GREY,
            },
        }
    }
}
