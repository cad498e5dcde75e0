//! The law of the mean filament: its committed numbers, and how far their data reach.

use super::{Homogenised, HomogenisedForm};
use std::sync::LazyLock;

/// Coefficients of the mean filament without heat, as `cargo xtask homogenise law` writes them: stretch at rest, those
/// of the natural stretch, then those of each term, from the constant up.
const COLD: &str = include_str!("mean_filament.csv");

/// The same at 298 K, of `cargo xtask homogenise heat`.
const AT_298_K: &str = include_str!("mean_filament_298_k.csv");

/// The range of the fit, whose cells reach a little beyond; stretch is counted from that of cells as bent and sheared.
const RANGE: StrainRange = StrainRange {
    twist: 0.048,
    curvature: 0.01,
    shear: 0.015,
    stretch: [-2e-3, 6e-3],
};

/// Strains of the samples at 298 K.
const RANGE_AT_298_K: StrainRange = StrainRange {
    twist: 0.048,
    curvature: 0.01,
    shear: 0.05,
    stretch: [-8e-3, 8e-3],
};

/// How far the data behind a potential reach.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StrainRange {
    /// Twist to either side (rad/nm).
    pub twist: f64,
    /// Curvature (rad/nm).
    pub curvature: f64,
    /// Shear strain.
    pub shear: f64,
    /// Stretch beyond the natural length, in compression and in tension.
    pub stretch: [f64; 2],
}

impl StrainRange {
    /// No bound.
    pub const UNBOUNDED: Self = Self {
        twist: f64::INFINITY,
        curvature: f64::INFINITY,
        shear: f64::INFINITY,
        stretch: [f64::NEG_INFINITY, f64::INFINITY],
    };
}

impl Homogenised {
    /// The law of filaments of the default monomers with weighted bonds, of which
    /// [`RodMaterial::homogenised`](crate::RodMaterial::homogenised) makes a material.
    pub fn mean_filament() -> &'static Self {
        static LAW: LazyLock<Homogenised> = LazyLock::new(|| read(COLD).with_range(RANGE));
        &LAW
    }

    /// The free energy of the same filaments at [`HEATED_K`](Self::HEATED_K): what they store and bear on average while
    /// their monomers move.
    ///
    /// It is measured at cells of 36 nm. Shorter segments of a rod in a heat bath have motion of their own that the cells
    /// had already.
    pub fn mean_filament_at_298_k() -> &'static Self {
        static LAW: LazyLock<Homogenised> =
            LazyLock::new(|| read(AT_298_K).with_range(RANGE_AT_298_K));
        &LAW
    }

    /// Temperature (K) of [`mean_filament_at_298_k`](Self::mean_filament_at_298_k).
    pub const HEATED_K: f64 = 298.0;

    /// The same law whose data reach so far.
    #[must_use]
    pub fn with_range(self, range: StrainRange) -> Self {
        Self { range, ..self }
    }

    /// How far its data reach; unbounded where nothing is said.
    pub fn range(&self) -> &StrainRange {
        &self.range
    }
}

fn read(text: &str) -> Homogenised {
    let numbers = |name: &str| -> Vec<f64> {
        let mut lines = text.lines().filter_map(|line| line.split_once(','));
        let found = lines.find(|(other, _)| *other == name);
        let fields = found.map(|(_, numbers)| numbers.split(','));
        let number = |field: &str| field.parse().unwrap_or(f64::NAN);
        fields.into_iter().flatten().map(number).collect()
    };
    let form = HomogenisedForm::new(&numbers("natural"))
        .and_then(|form| form.with_rest(numbers("rest").into_iter().sum()));
    form.and_then(|form| Homogenised::new(form, |term| numbers(&format!("{term:?}"))))
        .expect("the committed numbers make a law: tests read them")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Term;

    /// A line that is missing, or of a term that does not exist, would make another law.
    #[test]
    fn the_numbers_stand_under_the_names_of_the_terms() {
        for text in [COLD, AT_298_K] {
            let mut names = text.lines().filter_map(|line| line.split_once(','));
            assert_eq!(names.next().unwrap().0, "rest");
            assert_eq!(names.next().unwrap().0, "natural");
            for term in Term::ALL {
                let (name, numbers) = names.next().unwrap();
                assert_eq!(name, format!("{term:?}"));
                assert_eq!(numbers.split(',').count(), term.degree() + 1);
            }
            assert_eq!(names.next(), None);
        }
    }
}
