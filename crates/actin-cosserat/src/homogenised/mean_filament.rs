//! The law of the mean filament: its committed numbers, and how far their data reach.

use super::{Homogenised, HomogenisedForm, Term};
use std::sync::LazyLock;

/// Coefficients of the mean filament, as `cargo xtask homogenise law` prints them: for each twist the
/// natural stretch and the coefficient of each term.
const NUMBERS: &str = include_str!("mean_filament.csv");

/// Strains of the cells behind these numbers.
const RANGE: StrainRange = StrainRange {
    twist: 0.048,
    curvature: 0.01,
    shear: 0.015,
    stretch: [-5e-4, 6e-3],
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
        static LAW: LazyLock<Homogenised> = LazyLock::new(read);
        &LAW
    }

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

fn read() -> Homogenised {
    let rows: Vec<Vec<f64>> = NUMBERS.lines().skip(1).map(numbers).collect();
    let column = |k: usize| -> Vec<f64> { rows.iter().map(|row| row[k]).collect() };
    let form = HomogenisedForm::new(&column(0), &column(1));
    let places = Term::ALL.into_iter().zip(2..);
    let coefficient = |term: Term, node: usize| {
        let mut places = places.clone();
        let place = places.find(|(other, _)| *other == term);
        place.map_or(f64::NAN, |(_, column)| rows[node][column])
    };
    form.and_then(|form| Homogenised::new(form, coefficient))
        .expect("the committed numbers make a law: tests read them")
        .with_range(RANGE)
}

fn numbers(line: &str) -> Vec<f64> {
    let number = |field: &str| field.parse().unwrap_or(f64::NAN);
    line.split(',').map(number).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A column that is moved, or a term that the numbers do not have, would make another law.
    #[test]
    fn the_numbers_stand_under_the_names_of_the_terms() {
        let header: Vec<&str> = NUMBERS.lines().next().unwrap().split(',').collect();
        let terms = Term::ALL.map(|term| format!("{term:?}"));
        assert_eq!(header[..2], ["twist_per_nm", "natural_stretch"]);
        assert_eq!(header[2..], terms);
        let law = Homogenised::mean_filament();
        // 1.736e4 at no twist: S3 = 3.47e4 pN.
        assert_eq!(law.coefficient(Term::Stretch, 10), 1.736_432_789_659_103_2e4);
    }
}
