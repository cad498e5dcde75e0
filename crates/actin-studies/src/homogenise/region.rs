//! Strains that fill a region.

use actin_cosserat::HomogenisedForm;
use actin_paper::cells::{shortening, strain};
use actin_sim::ellipsoid::SixVector;

/// Returns point `k` of a low-discrepancy sequence in the unit cube.
///
/// # Source
/// M. Roberts, The unreasonable effectiveness of quasirandom sequences (2018): additive recurrence with powers of the
/// root of `x^(N+1) = x + 1`.
pub(super) fn evenly<const N: usize>(k: u64) -> [f64; N] {
    let mut root: f64 = 1.5;
    for _ in 0..60 {
        root = (1.0 + root).powf(1.0 / (N as f64 + 1.0));
    }
    let mut step = 1.0;
    std::array::from_fn(|_| {
        step /= root;
        (0.5 + k as f64 * step).fract()
    })
}

/// A region of strains, with a higher density at small strains.
#[derive(Clone, Copy, Debug)]
pub(super) struct Region {
    pub(super) curvature: f64,
    pub(super) twist: f64,
    pub(super) shear: f64,
    /// Extension relative to the natural length at the twist, or at the twist, bending and shear.
    pub(super) extension: [f64; 2],
    /// True if the natural length includes the shortening by bending and shear.
    is_shortened: bool,
}

impl Region {
    pub(super) const fn new([curvature, twist, shear]: [f64; 3], extension: [f64; 2]) -> Self {
        Self {
            curvature,
            twist,
            shear,
            extension,
            is_shortened: true,
        }
    }

    pub(super) const fn without_shortening(self) -> Self {
        Self {
            is_shortened: false,
            ..self
        }
    }

    pub(super) fn strains(self, form: &HomogenisedForm, skip: u64, count: u64) -> Vec<SixVector> {
        let draw = |k| {
            let [a, b, c, d, e] = evenly(k);
            let (side, pull): (f64, f64) = (2.0 * b - 1.0, 2.0 * e - 1.0);
            let twist = self.twist * side * side * side;
            let [least, most] = self.extension;
            let extension = pull * pull * if pull < 0.0 { least } else { most };
            let (curvature, shear) = (self.curvature * a * a, self.shear * c * c);
            let shorter = if self.is_shortened {
                shortening(curvature, shear)
            } else {
                0.0
            };
            let natural = form.natural_stretch(twist) - shorter;
            let angle = std::f64::consts::TAU * d;
            strain([curvature, twist, shear, natural + extension, angle])
        };
        (skip + 1..=skip + count).map(draw).collect()
    }
}

pub(super) fn strains(form: &HomogenisedForm, regions: &[(Region, u64)]) -> Vec<SixVector> {
    let of = |(region, count): &(Region, u64)| region.strains(form, 0, *count);
    regions.iter().flat_map(of).collect()
}
