//! Coefficients and ranges of the laws of the mean filament and of filaments with sampled bonds.

use super::{Homogenised, HomogenisedForm};
use crate::Term;
use std::collections::BTreeMap;
use std::sync::{LazyLock, Mutex, PoisonError};

/// Coefficients of the mean filament at zero temperature, from `cargo xtask homogenise law`.
///
/// Rows: stretch at rest, natural stretch, then each term, lowest order first.
const COLD: &str = include_str!("mean_filament.csv");

/// Coefficients for [`SAMPLED_BONDS`](Homogenised::SAMPLED_BONDS) sampled bonds, from
/// `cargo xtask homogenise drawn`.
const DRAWN: &str = include_str!("drawn_filament.csv");

/// Coefficients of the mean filament at 298 K, from `cargo xtask homogenise heat`.
const AT_298_K: &str = include_str!("mean_filament_298_k.csv");

/// Range of the fit.
const RANGE: StrainRange = StrainRange {
    twist: 0.048,
    curvature: 0.01,
    shear: 0.02,
    stretch: [-2e-3, 6e-3],
    is_tension_free: true,
};

/// Range of the samples at 298 K.
const RANGE_AT_298_K: StrainRange = StrainRange {
    twist: 0.048,
    curvature: 0.01,
    shear: 0.05,
    stretch: [-8e-3, 8e-3],
    is_tension_free: false,
};

/// Range of the data of a potential.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StrainRange {
    /// Largest magnitude of the twist (rad/nm).
    pub twist: f64,
    /// Curvature (rad/nm).
    pub curvature: f64,
    /// Shear strain.
    pub shear: f64,
    /// Stretch relative to the natural length at the twist, in compression and in tension.
    pub stretch: [f64; 2],
    /// True if `stretch` refers to the length without tension at this curvature and shear.
    pub is_tension_free: bool,
}

impl StrainRange {
    /// Unlimited range.
    pub(crate) const UNBOUNDED: Self = Self {
        twist: f64::INFINITY,
        curvature: f64::INFINITY,
        shear: f64::INFINITY,
        stretch: [f64::NEG_INFINITY, f64::INFINITY],
        is_tension_free: false,
    };
}

impl Homogenised {
    /// Law of filaments of the default monomers with quadrature bonds, for
    /// [`RodMaterial::homogenised`](crate::RodMaterial::homogenised).
    pub fn mean_filament() -> &'static Self {
        static LAW: LazyLock<Homogenised> = LazyLock::new(|| read(COLD).with_range(RANGE));
        &LAW
    }

    /// Mean law of filaments with `bonds` sampled bonds per interface.
    ///
    /// They are softer than the mean filament, because compliances in series add up. The difference
    /// is inversely proportional to `bonds`, which is at least [`SAMPLED_BONDS`](Self::SAMPLED_BONDS).
    ///
    /// ```
    /// use actin_cosserat::Homogenised;
    /// use actin_mechanics::Vector3;
    /// let bend = Vector3::x() * 1e-3;
    /// let couple = |law: &Homogenised| law.joint_couple(bend).x;
    /// let of = |bonds| couple(Homogenised::sampled_filament(bonds)) / couple(Homogenised::mean_filament());
    /// assert!(of(64) < 0.98 && of(64) < of(640) && of(1_000_000_000) > 0.999_999);
    /// assert_eq!(of(10), of(64));
    /// ```
    pub fn sampled_filament(bonds: usize) -> &'static Self {
        // Leaked on purpose: programs use few laws, and materials refer to them permanently.
        static LAWS: Mutex<BTreeMap<usize, &'static Homogenised>> = Mutex::new(BTreeMap::new());
        static DRAWN_LAW: LazyLock<Homogenised> = LazyLock::new(|| read(DRAWN));
        let bonds = bonds.max(Self::SAMPLED_BONDS);
        let mut laws = LAWS.lock().unwrap_or_else(PoisonError::into_inner);
        laws.entry(bonds).or_insert_with(|| {
            let share = Self::SAMPLED_BONDS as f64 / bonds as f64;
            let law = Self::mean_filament().towards(&DRAWN_LAW, share);
            Box::leak(Box::new(law.with_range(RANGE)))
        })
    }

    /// Bonds per interface of the measured cells with sampled bonds, as in the paper.
    pub const SAMPLED_BONDS: usize = 64;

    /// Interpolates the coefficients between `self` (0) and `other` (1). Extrapolated coefficients
    /// could have an unbounded energy.
    fn towards(&self, other: &Self, share: f64) -> Self {
        let mixed = |own: &[f64], other: &[f64]| -> Vec<f64> {
            let both = own.iter().zip(other);
            both.map(|(a, b)| a + share * (b - a)).collect()
        };
        let (form, others) = (self.form(), other.form());
        let form = HomogenisedForm::new(&mixed(form.natural(), others.natural()));
        let numbers = |term: Term| mixed(self.coefficients(term), other.coefficients(term));
        let law = form.and_then(|form| Self::new(form, numbers));
        law.expect("interpolated coefficients are finite")
    }

    /// Free energy of mean filaments at [`HEATED_K`](Self::HEATED_K), averaged over the thermal
    /// motion of their monomers.
    ///
    /// Measured in cells of 35.6 nm with prescribed mean strain. Rods in a heat bath make the motion
    /// of shorter wavelength again; their law is [`heated_rod`](Self::heated_rod).
    pub fn mean_filament_at_298_k() -> &'static Self {
        static LAW: LazyLock<Homogenised> =
            LazyLock::new(|| read(AT_298_K).with_range(RANGE_AT_298_K));
        &LAW
    }

    /// Temperature (K) of [`mean_filament_at_298_k`](Self::mean_filament_at_298_k).
    pub const HEATED_K: f64 = 298.0;

    /// Sets the range of the data.
    #[must_use]
    pub(crate) fn with_range(self, range: StrainRange) -> Self {
        Self { range, ..self }
    }

    /// Range of the data; unlimited by default.
    pub fn range(&self) -> &StrainRange {
        &self.range
    }
}

/// Numbers of the line that starts with `name`.
pub(super) fn numbers(text: &str, name: &str) -> Vec<f64> {
    let mut lines = text.lines().filter_map(|line| line.split_once(','));
    let found = lines.find(|(other, _)| *other == name);
    let fields = found.map(|(_, numbers)| numbers.split(','));
    let number = |field: &str| field.parse().unwrap_or(f64::NAN);
    fields.into_iter().flatten().map(number).collect()
}

fn read(text: &str) -> Homogenised {
    let form = HomogenisedForm::new(&numbers(text, "natural"))
        .and_then(|form| form.with_rest(numbers(text, "rest").into_iter().sum()));
    form.and_then(|form| Homogenised::new(form, |term| numbers(text, &format!("{term:?}"))))
        .expect("the embedded coefficients are valid")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coefficients_are_listed_by_term() {
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
