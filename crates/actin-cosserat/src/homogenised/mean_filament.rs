//! The laws of the mean filament and of drawn ones: their committed numbers, and how far their data reach.

use super::{Homogenised, HomogenisedForm};
use crate::Term;
use std::collections::BTreeMap;
use std::sync::{LazyLock, Mutex, PoisonError};

/// Coefficients of the mean filament without heat, as `cargo xtask homogenise law` writes them: stretch at rest, those
/// of the natural stretch, then those of each term, from the constant up.
const COLD: &str = include_str!("mean_filament.csv");

/// The same of filaments of [`DRAWN_BONDS`](Homogenised::DRAWN_BONDS) drawn bonds, of `cargo xtask homogenise drawn`.
const DRAWN: &str = include_str!("drawn_filament.csv");

/// The same of the mean filament at 298 K, of `cargo xtask homogenise heat`.
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

    /// The law of filaments whose interfaces have so many bonds each, drawn for each: what they store and bear on average.
    /// They are softer than the mean filament, as compliances in a row are more than that of the mean stiffness.
    ///
    /// Cells were measured with [`DRAWN_BONDS`](Self::DRAWN_BONDS). What sets these apart from the mean filament is taken in
    /// inverse proportion to the bonds; with fewer bonds the law is theirs.
    ///
    /// ```
    /// use actin_cosserat::Homogenised;
    /// use actin_mechanics::Vector3;
    /// let bend = Vector3::x() * 1e-3;
    /// let couple = |law: &Homogenised| law.joint_couple(bend).x;
    /// let of = |bonds| couple(Homogenised::drawn_filament(bonds)) / couple(Homogenised::mean_filament());
    /// assert!(of(64) < 0.98 && of(64) < of(640) && of(1_000_000_000) > 0.999_999);
    /// assert_eq!(of(10), of(64));
    /// ```
    pub fn drawn_filament(bonds: usize) -> &'static Self {
        // Programs have few of them, which materials keep for good.
        static LAWS: Mutex<BTreeMap<usize, &'static Homogenised>> = Mutex::new(BTreeMap::new());
        static DRAWN_LAW: LazyLock<Homogenised> = LazyLock::new(|| read(DRAWN));
        let bonds = bonds.max(Self::DRAWN_BONDS);
        let mut laws = LAWS.lock().unwrap_or_else(PoisonError::into_inner);
        laws.entry(bonds).or_insert_with(|| {
            let share = Self::DRAWN_BONDS as f64 / bonds as f64;
            let law = Self::mean_filament().towards(&DRAWN_LAW, share);
            Box::leak(Box::new(law.with_range(RANGE)))
        })
    }

    /// Bonds of an interface with which cells of drawn bonds were measured: those of the paper.
    pub const DRAWN_BONDS: usize = 64;

    /// The law with this share of another one's numbers, up to all, and the rest of its own: beyond that its energy would not
    /// be bounded as theirs are.
    fn towards(&self, other: &Self, share: f64) -> Self {
        let mixed = |own: &[f64], other: &[f64]| -> Vec<f64> {
            let both = own.iter().zip(other);
            both.map(|(a, b)| a + share * (b - a)).collect()
        };
        let (form, others) = (self.form(), other.form());
        let form = HomogenisedForm::new(&mixed(form.natural(), others.natural()));
        let numbers = |term: Term| mixed(self.coefficients(term), other.coefficients(term));
        let law = form.and_then(|form| Self::new(form, numbers));
        law.expect("mixed numbers of two laws make a law")
    }

    /// The free energy of mean filaments at [`HEATED_K`](Self::HEATED_K): what they store and bear on average while
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

    /// A line that is missing, or of a term that does not exist, would make another law.
    #[test]
    fn the_numbers_stand_under_the_names_of_the_terms() {
        for text in [COLD, DRAWN, AT_298_K] {
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
