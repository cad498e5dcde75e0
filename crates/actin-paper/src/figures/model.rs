//! Families of filaments: resolutions and models.

use actin_sim::{
    ForceLaw, Hold, JunctionWeight, Load, Material, Monomers, RodLaw, RodLaws, Scene, Section,
    fitted_laws,
};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Resolution {
    Rod,
    /// Length of rod (nm); the rest is monomers.
    Mixed(u32),
    Ellipsoids,
}

impl Resolution {
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

    /// Length of rod (nm) in a filament of `length` nm.
    pub(super) fn rod_nm(self, length: f64) -> f64 {
        match self {
            Self::Rod => length,
            Self::Mixed(rod) => f64::from(rod),
            Self::Ellipsoids => 0.0,
        }
    }
}

pub(super) fn monomers(from_nm: f64, to_nm: f64) -> Section {
    Section::Ellipsoids {
        from_nm,
        to_nm,
        altered: None,
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rods {
    Constant,
    Fitted,
    /// `Fitted` with constant shearing rigidity.
    FittedWithoutShear,
    /// Published `B3(kappa)` and `xi(kappa)`.
    Extended,
    /// Energy `C3 sigma_3 kappa_3` of the supplement instead of `xi(kappa)`.
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

/// Properties and loads of filaments, independent of the resolution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Model {
    /// Name in quantities; empty for the model of the figure.
    pub name: &'static str,
    /// Name in legends.
    pub words: &'static str,
    /// Uses quadrature bonds instead of sampled bonds.
    pub is_mean: bool,
    /// Weight of each bond of a junction.
    pub junction: JunctionWeight,
    pub rods: Rods,
    pub balance: ForceLaw,
    /// Length of rod segments (nm).
    pub segment_nm: f64,
    /// Type of the clamps of rods.
    pub hold: Hold,
    /// Divides end forces by four.
    pub is_weak: bool,
    /// Gives monomers and rod the bending rigidity of the preceding paper.
    pub is_stiff: bool,
}

impl Model {
    /// Sampled bonds, constant rigidities, segments of 10 nm, junction bonds of weight one half.
    pub(super) const STANDARD: Self = Self {
        name: "",
        words: "sampled bonds",
        is_mean: false,
        junction: JunctionWeight::Shared,
        rods: Rods::Constant,
        balance: ForceLaw::EnergyGradient,
        segment_nm: 10.0,
        hold: Hold::Wall,
        is_weak: false,
        is_stiff: false,
    };

    /// Resets properties without effect at a resolution to their standard values.
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

    /// First of `models` with an identical filament at a resolution. It is solved once for all of them.
    pub(super) fn solved_as(self, models: &[Self], resolution: Resolution) -> Self {
        let own = self.relevant_to(resolution);
        let mut all = models.iter().copied();
        let first = all.find(|model| model.relevant_to(resolution) == own);
        first.unwrap_or(self)
    }

    /// Number of samplings of the bonds, at most `most`.
    pub(super) fn seeds(self, most: u64) -> u64 {
        if self.is_mean { 1 } else { most }
    }

    /// Applies the model to a scene with sampled bonds.
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

pub(super) fn stiffness_ratio() -> f64 {
    let bend = |material: Material| material.rigidities().bend.x;
    bend(Material::PrecedingPaper) / bend(Material::Table4)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// E A^2/4 pi = 2.359e5 pN nm^2 with 2000 pN/nm^2 and 38.5 nm^2, divided by 3.9e4.
    #[test]
    fn preceding_paper_is_six_times_as_stiff() {
        assert!((stiffness_ratio() - 235_907.0 / 3.9e4).abs() < 1e-4);
    }

    /// Junctions affect mixed filaments only, bonds do not affect rods, and rod laws do not affect monomers.
    #[test]
    fn identical_filaments_are_solved_once() {
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
