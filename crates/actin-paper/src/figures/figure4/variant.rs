//! What is varied in Figure 4 besides the resolution: what it is called, and what it changes in a scene.

use actin_sim::{ForceLaw, JunctionWeight, Load, Material, Monomers, RodLaw, Scene};

/// A load, a model and a set of parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Variant {
    /// A quarter of the force, 0.5 pN.
    weak: bool,
    junction: JunctionWeight,
    pub balance: ForceLaw,
    /// Weighted bonds that stand for all, the default of scenes, in place of drawn ones.
    mean: bool,
    /// Monomers and rod as stiff in bending as the preceding paper's rod.
    stiff: bool,
}

impl Variant {
    /// 2 pN, drawn bonds; the bonds of a junction share the rod's rigidity.
    pub(super) const SHARED: Self = Self {
        weak: false,
        junction: JunctionWeight::Shared,
        balance: ForceLaw::EnergyGradient,
        mean: false,
        stiff: false,
    };
    /// The junction as printed: every bond of it has the rod's full rigidity.
    pub(super) const FULL: Self = Self {
        junction: JunctionWeight::Full,
        ..Self::SHARED
    };
    /// The junction and the rod's balance of loads as printed.
    pub(super) const AS_PRINTED: Self = Self {
        balance: ForceLaw::PaperBalance,
        ..Self::FULL
    };
    /// 0.5 pN.
    pub(super) const WEAK: Self = Self {
        weak: true,
        ..Self::SHARED
    };
    /// The mean filament.
    pub(super) const MEAN: Self = Self {
        mean: true,
        ..Self::SHARED
    };
    /// The mean filament under 0.5 pN.
    pub(super) const WEAK_MEAN: Self = Self {
        mean: true,
        ..Self::WEAK
    };
    /// The preceding paper's rigidity.
    pub(super) const STIFF: Self = Self {
        stiff: true,
        ..Self::SHARED
    };
    /// The preceding paper's rigidity with the junction as printed.
    pub(super) const STIFF_FULL: Self = Self {
        stiff: true,
        ..Self::FULL
    };

    /// The preceding paper's rigidity of the mean filament.
    pub(super) const STIFF_MEAN: Self = Self {
        stiff: true,
        ..Self::MEAN
    };

    /// In words.
    pub(super) fn words(self) -> String {
        let force = if self.weak { "0.5 pN" } else { "2 pN" };
        let model = match (self.balance, self.junction) {
            (ForceLaw::PaperBalance, _) => "junction and balance as printed",
            (_, JunctionWeight::Full) => "junction full",
            (_, JunctionWeight::Shared) => "junction shared",
        };
        let mut words = format!("{force}, {model}");
        if self.stiff {
            words += ", the preceding paper's rigidity";
        }
        if self.mean {
            words += ", mean filament";
        }
        words
    }

    /// Folders of its rows; none for the first one.
    pub(super) fn path(self) -> String {
        let model = match (self.balance, self.junction) {
            (ForceLaw::PaperBalance, _) => "paper-balance/",
            (_, JunctionWeight::Full) => "full/",
            (_, JunctionWeight::Shared) => "",
        };
        let named = [
            (self.weak, "0.5-pN/"),
            (self.stiff, "preceding-paper/"),
            (true, model),
            (self.mean, "mean-filament/"),
        ];
        let folders = named.into_iter().filter(|(is_so, _)| *is_so);
        folders.map(|(_, name)| name).collect()
    }

    /// Whether monomers and rod have the preceding paper's rigidity.
    pub(super) fn is_stiff(self) -> bool {
        self.stiff
    }

    /// Whether it is followed in time; the preceding paper's rigidity is shown by equilibria alone.
    pub(super) fn moves(self) -> bool {
        !self.stiff
    }

    /// Whether the first flexural motion of its filaments is compared over resolutions: of our model,
    /// of the mean filament and of the paper's own model.
    pub(super) fn swings(self) -> bool {
        [Self::SHARED, Self::MEAN, Self::AS_PRINTED].contains(&self)
    }

    /// Changes the scene of [`Self::SHARED`] into its own.
    pub(super) fn apply(self, scene: &mut Scene) {
        let filament = &mut scene.filament;
        filament.junction.weight = self.junction;
        filament.rod.force_law = self.balance;
        if self.mean {
            filament.monomers = Monomers::default();
        }
        if self.stiff {
            let times = stiffness_ratio();
            filament.monomers.lateral_rigidity_pn_per_nm *= times;
            filament.monomers.longitudinal_rigidity_pn_per_nm *= times;
            filament.rod.law = RodLaw::Constant;
            filament.rod.material = Material::PrecedingPaper;
        }
        if self.weak {
            for load in &mut scene.loads {
                if let Load::EndForce { force_pn, .. } = load {
                    *force_pn = force_pn.map(|f| f * 0.25);
                }
            }
        }
    }
}

/// Bending rigidity of the preceding paper's rod over that of Table 4, which is the monomers'.
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

    /// Rows of two variants never share a name.
    #[test]
    fn variants_have_folders_of_their_own() {
        let all = [
            Variant::SHARED,
            Variant::FULL,
            Variant::AS_PRINTED,
            Variant::WEAK,
            Variant::MEAN,
            Variant::WEAK_MEAN,
            Variant::STIFF,
            Variant::STIFF_FULL,
            Variant::STIFF_MEAN,
        ];
        let mut paths = all.map(Variant::path);
        paths.sort();
        assert!(paths.windows(2).all(|pair| pair[0] != pair[1]), "{paths:?}");
        assert_eq!(Variant::SHARED.path(), "");
        assert_eq!(Variant::STIFF_FULL.path(), "preceding-paper/full/");
    }
}
