//! Families of filaments: how much of a filament is rod, and what its parts are made of.

use actin_sim::{
    ForceLaw, Hold, JunctionWeight, Load, Material, Monomers, RodLaw, RodLaws, Scene, Section,
    fitted_laws,
};

/// Share of rod in a filament.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Resolution {
    /// All.
    Rod,
    /// So many nm.
    Mixed(u32),
    /// Nothing.
    Ellipsoids,
}

impl Resolution {
    /// Name in tables, legends and quantities.
    pub(super) fn name(self) -> String {
        match self {
            Self::Rod => "rod".into(),
            Self::Mixed(rod) => format!("rod-{rod}"),
            Self::Ellipsoids => "ellipsoids".into(),
        }
    }

    pub(super) fn is_mixed(self) -> bool {
        matches!(self, Self::Mixed(_))
    }

    /// Length that is rod (nm) of a filament of `length` nm.
    pub(super) fn rod_nm(self, length: f64) -> f64 {
        match self {
            Self::Rod => length,
            Self::Mixed(rod) => f64::from(rod),
            Self::Ellipsoids => 0.0,
        }
    }
}

/// A section of monomers.
pub(super) fn monomers(from_nm: f64, to_nm: f64) -> Section {
    Section::Ellipsoids {
        from_nm,
        to_nm,
        altered: None,
    }
}

/// Law of the rods.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rods {
    /// Constant rigidities.
    Constant,
    /// The law fitted to filaments of monomers.
    Fitted,
    /// `Fitted` with the constant shearing rigidity.
    FittedWithoutShear,
    /// The published `B3(kappa)` and `xi(kappa)`.
    Extended,
    /// The energy `C3 sigma_3 kappa_3` of the paper's supplement in place of `xi(kappa)`.
    CouplingEnergy,
}

impl Rods {
    fn law(self) -> RodLaw {
        match self {
            Self::Constant => RodLaw::Constant,
            Self::Fitted => RodLaw::Fitted,
            Self::FittedWithoutShear => RodLaw::Laws(Box::new(RodLaws {
                shear: None,
                ..fitted_laws()
            })),
            Self::Extended => RodLaw::PublishedExtension,
            Self::CouplingEnergy => RodLaw::CouplingEnergy,
        }
    }
}

/// Composition and loads of filaments, independent of the resolution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Model {
    /// In quantities; empty for the model that a figure shows.
    pub name: &'static str,
    /// In legends.
    pub words: &'static str,
    /// Quadrature bonds, the default of scenes, instead of sampled bonds.
    pub is_mean: bool,
    /// Weight of each bond of a junction.
    pub junction: JunctionWeight,
    pub rods: Rods,
    pub balance: ForceLaw,
    /// Length of a rod's segments (nm).
    pub segment_nm: f64,
    /// Bodies of rods that clamps hold.
    pub hold: Hold,
    /// A quarter of the loads.
    pub is_weak: bool,
    /// Monomers and rod as stiff in bending as the preceding paper's rod.
    pub is_stiff: bool,
}

impl Model {
    /// Drawn bonds, constant rigidities, segments of 10 nm, junctions whose bonds share the rod's rigidity.
    pub(super) const STANDARD: Self = Self {
        name: "",
        words: "drawn bonds",
        is_mean: false,
        junction: JunctionWeight::Shared,
        rods: Rods::Constant,
        balance: ForceLaw::EnergyGradient,
        segment_nm: 10.0,
        hold: Hold::Wall,
        is_weak: false,
        is_stiff: false,
    };

    /// The model with what does not matter at a resolution set to one value.
    fn relevant_to(self, resolution: Resolution) -> Self {
        let standard = Self {
            hold: self.hold,
            is_weak: self.is_weak,
            is_stiff: self.is_stiff,
            ..Self::STANDARD
        };
        match resolution {
            Resolution::Mixed(_) => self,
            Resolution::Rod => Self {
                rods: self.rods,
                balance: self.balance,
                segment_nm: self.segment_nm,
                ..standard
            },
            Resolution::Ellipsoids => Self {
                is_mean: self.is_mean,
                ..standard
            },
        }
    }

    /// The first of `models` that has the same filament at a resolution, which is solved for all of them.
    pub(super) fn solved_as(self, models: &[Self], resolution: Resolution) -> Self {
        let own = self.relevant_to(resolution);
        let mut all = models.iter().copied();
        let first = all.find(|model| model.relevant_to(resolution) == own);
        first.unwrap_or(self)
    }

    /// Number of samplings of its bonds, at most so many.
    pub(super) fn seeds(self, most: u64) -> u64 {
        if self.is_mean { 1 } else { most }
    }

    /// Changes a scene of sampled bonds into the scene of the model.
    pub(super) fn apply(self, scene: &mut Scene, seed: u64) {
        let filament = &mut scene.filament;
        if self.is_mean {
            filament.monomers = Monomers::default();
        }
        filament.monomers.seed = seed;
        filament.junction.weight = self.junction;
        filament.rod.law = self.rods.law();
        filament.rod.force_law = self.balance;
        if self.is_stiff {
            let times = stiffness_ratio();
            filament.monomers.lateral_rigidity_pn_per_nm *= times;
            filament.monomers.longitudinal_rigidity_pn_per_nm *= times;
            filament.rod.material = Material::PrecedingPaper;
        }
        if self.is_weak {
            for load in &mut scene.loads {
                if let Load::EndForce { force_pn, .. } = load {
                    *force_pn = force_pn.map(|f| f * 0.25);
                }
            }
        }
    }
}

/// Bending rigidity of the preceding paper's rod over the one of Table 4, which is the monomers'.
pub(super) fn stiffness_ratio() -> f64 {
    let bend = |material: Material| material.rigidities().bend.x;
    bend(Material::PrecedingPaper) / bend(Material::Table4)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// E A^2/4 pi with 2000 pN/nm^2 and 38.5 nm^2, by hand 2.359e5 pN nm^2, over 3.9e4.
    #[test]
    fn the_preceding_paper_is_six_times_as_stiff() {
        assert!((stiffness_ratio() - 235_907.0 / 3.9e4).abs() < 1e-4);
    }

    /// A junction changes no filament of one model alone, bonds no rod and rods no monomers.
    #[test]
    fn filaments_alike_are_solved_once() {
        let full = Model {
            name: "full/",
            junction: JunctionWeight::Full,
            ..Model::STANDARD
        };
        let mean = Model {
            name: "mean/",
            is_mean: true,
            ..Model::STANDARD
        };
        let all = [Model::STANDARD, full, mean];
        let name = |model: Model, resolution| model.solved_as(&all, resolution).name;
        assert_eq!(name(full, Resolution::Mixed(40)), "full/");
        assert_eq!(name(full, Resolution::Rod), "");
        assert_eq!(name(full, Resolution::Ellipsoids), "");
        assert_eq!(name(mean, Resolution::Rod), "");
        assert_eq!(name(mean, Resolution::Ellipsoids), "mean/");
    }
}
