//! Families of filaments: resolutions and models.

use crate::charts::line;
use crate::palette;
use crate::published::table;
use actin_draw::Series;
use actin_sim::{
    ForceLaw, Hold, JunctionWeight, Load, Material, Monomers, RodLaw, RodLaws, Scene, fitted_laws,
};
use serde::Deserialize;
use std::sync::LazyLock;

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

/// Properties and loads of filaments, independent of the resolution: a line of `data/models.csv`.
#[derive(Debug, Deserialize, PartialEq)]
pub(super) struct Model {
    pub figure: String,
    pub name: String,
    pub words: String,
    colour: String,
    pub is_mean: bool,
    junction: JunctionWeight,
    rods: RodLaw,
    /// The law of rods has a constant shearing rigidity.
    shear_is_constant: bool,
    pub balance: ForceLaw,
    pub segment_nm: f64,
    pub hold: Hold,
    /// Factor of the end force.
    force_factor: f64,
    pub is_stiff: bool,
}

static MODELS: LazyLock<Vec<Model>> =
    LazyLock::new(|| table(include_str!("../../data/models.csv")));

/// Models of a figure; with `quick` only those with a potential.
pub(super) fn models(figure: &str, quick: bool) -> Vec<&'static Model> {
    let own = MODELS.iter().filter(|model| model.figure == figure);
    own.filter(|model| !quick || model.has_potential())
        .collect()
}

impl Model {
    /// True for the model in the pictures of its figure.
    pub(super) fn is_shown(&self) -> bool {
        self.name.is_empty()
    }

    pub(super) fn has_potential(&self) -> bool {
        self.balance == ForceLaw::EnergyGradient
    }

    /// Name without slashes, or `shown` for the model in the pictures.
    pub(super) fn label(&self, shown: &str) -> String {
        match self.name.trim_matches('/') {
            "" => shown.into(),
            name => name.into(),
        }
    }

    /// Curve of the model in a chart.
    pub(super) fn curve(&self, points: Vec<(f64, f64)>) -> Series {
        let colour = match self.colour.as_str() {
            "data" => palette::DATA,
            "grey" => palette::GREY,
            "light-grey" => palette::LIGHT_GREY,
            number => palette::line(number.parse().expect("a colour of `data/models.csv`")),
        };
        line(self.words.clone(), colour, points)
    }

    /// True if the filament of a resolution is identical under another model of the figure.
    fn equals_at(&self, resolution: Resolution, other: &Self) -> bool {
        fn rods(m: &Model) -> (&RodLaw, bool, ForceLaw, f64) {
            (&m.rods, m.shear_is_constant, m.balance, m.segment_nm)
        }
        let ends = |m: &Self| (m.hold, m.force_factor, m.is_stiff);
        let (has_rod, has_monomers) = match resolution {
            Resolution::Rod => (true, false),
            Resolution::Mixed(_) => (true, true),
            Resolution::Ellipsoids => (false, true),
        };
        let has_junction = has_rod && has_monomers;
        self.figure == other.figure
            && ends(self) == ends(other)
            && (!has_rod || rods(self) == rods(other))
            && (!has_monomers || self.is_mean == other.is_mean)
            && (!has_junction || self.junction == other.junction)
    }

    /// First model of the figure with an identical filament at a resolution. It is solved once for all of them.
    pub(super) fn solved_at(&'static self, resolution: Resolution) -> &'static Self {
        let mut all = MODELS.iter();
        let first = all.find(|model| model.equals_at(resolution, self));
        first.unwrap_or(self)
    }

    /// Number of samplings of the bonds, at most `most`.
    pub(super) fn seeds(&self, most: u64) -> u64 {
        if self.is_mean { 1 } else { most }
    }

    /// Applies the model to a scene with sampled bonds.
    pub(super) fn apply(&self, scene: &mut Scene, seed: u64) {
        let filament = &mut scene.filament;
        if self.is_mean {
            filament.monomers = Monomers::default();
        }
        filament.monomers.seed = seed;
        filament.junction.weight = self.junction;
        filament.rod.law = self.rods.clone();
        if self.shear_is_constant {
            let laws = RodLaws {
                shear: None,
                ..fitted_laws()
            };
            filament.rod.law = RodLaw::Laws(Box::new(laws));
        }
        filament.rod.force_law = self.balance;
        if self.is_stiff {
            let times = stiffness_ratio();
            filament.monomers.lateral_rigidity_pn_per_nm *= times;
            filament.monomers.longitudinal_rigidity_pn_per_nm *= times;
            filament.rod.material = Material::PrecedingPaper;
        }
        for load in &mut scene.loads {
            if let Load::EndForce { force_pn, .. } = load {
                *force_pn = force_pn.map(|f| f * self.force_factor);
            }
        }
    }
}

fn stiffness_ratio() -> f64 {
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
        let all = models("fig4", false);
        let named = |name: &str| all.iter().find(|model| model.name == name).copied();
        let [full, mean] = ["full/", "mean-filament/"].map(|name| named(name).unwrap());
        let name = |model: &'static Model, resolution| model.solved_at(resolution).name.as_str();
        assert_eq!(name(full, Resolution::Mixed(40)), "full/");
        assert_eq!(name(full, Resolution::Rod), "");
        assert_eq!(name(full, Resolution::Ellipsoids), "");
        assert_eq!(name(mean, Resolution::Rod), "");
        assert_eq!(name(mean, Resolution::Ellipsoids), "mean-filament/");
    }
}
