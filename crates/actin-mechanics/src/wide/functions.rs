//! Polynomials for even functions of small angles, hyperbolic tangent and bounds.
//!
//! Each polynomial is a Chebyshev interpolation of `(f(u) - f(0)) / u` in 40-digit arithmetic. The
//! evaluation error is about half a unit in the last place of a number near 1.

use super::MOST_LANES;
use super::vectors::{read, write};
use pulp::Simd;

/// Upper limit of the squared half angle (rad^2) for the polynomials of [`cosine_and_sinc`]: angles
/// of a drift up to a quarter of a radian.
const LARGEST_SQUARED_HALF_ANGLE: f64 = 1.0 / 64.0;

/// `cos(sqrt(u))` for `u` up to 1/64; relative error of the fit 2e-18.
const COSINE: [f64; 5] = [
    1.0,
    -0.499_999_999_999_999_9,
    0.041_666_666_666_403_92,
    -0.001_388_888_804_808_541_2,
    2.479_297_704_082_534_3e-5,
];

/// `sin(sqrt(u)) / sqrt(u)` for `u` up to 1/64; relative error of the fit 2e-19.
const SINC: [f64; 5] = [
    1.0,
    -0.166_666_666_666_666_66,
    0.008_333_333_333_309_446,
    -0.000_198_412_690_768_779_9,
    2.754_949_151_820_351e-6,
];

/// `2 asin(sqrt(u)) / sqrt(u)` for `u` up to 0.25; relative error of the fit 6e-18.
pub(super) const TWICE_ARCSINE: [f64; 14] = [
    2.0,
    2.0 * 0.166_666_666_666_666_69,
    2.0 * 0.074_999_999_999_984_33,
    2.0 * 0.044_642_857_146_355_43,
    2.0 * 0.030_381_944_138_531_247,
    2.0 * 0.022_372_172_942_149_89,
    2.0 * 0.017_352_392_720_869_973,
    2.0 * 0.013_971_212_973_552_933,
    2.0 * 0.011_479_177_415_184_906,
    2.0 * 0.010_322_814_350_185_78,
    2.0 * 0.005_457_506_718_640_358,
    2.0 * 0.017_400_879_442_694_02,
    2.0 * -0.014_851_887_071_247_204,
    2.0 * 0.028_757_851_367_421_566,
];

/// `2 asin(sqrt(u)) / sqrt(u)` for `u` up to 1/64; relative error of the fit 2e-18.
pub(super) const TWICE_SMALL_ARCSINE: [f64; 7] = [
    2.0,
    0.333_333_333_333_333_15,
    0.150_000_000_000_950_65,
    0.089_285_713_576_553_3,
    0.060_764_082_164_930_08,
    0.044_720_549_934_173_64,
    0.036_047_105_507_435_42,
];

/// [`inverse_jacobian_coefficient`](crate::rotation::inverse_jacobian_coefficient) for squared
/// angles up to 0.063; relative error of the fit 5e-17.
pub(super) const SMALL_JACOBIAN: [f64; 5] = [
    1.0 / 12.0,
    0.001_388_888_888_888_822_4,
    3.306_878_310_239_559e-5,
    8.267_169_224_202_766e-7,
    2.094_380_257_639_943e-8,
];

/// [`inverse_jacobian_coefficient`](crate::rotation::inverse_jacobian_coefficient) for squared
/// angles up to 1.1; relative error of the fit 3e-17.
pub(super) const JACOBIAN: [f64; 8] = [
    1.0 / 12.0,
    0.001_388_888_888_888_891_1,
    3.306_878_306_858_232e-5,
    8.267_195_796_353_874e-7,
    2.087_674_112_956_713e-8,
    5.284_599_944_058_446e-10,
    1.332_839_826_839_602_9e-11,
    3.740_768_991_860_479_5e-13,
];

/// Value of `2 |x|` above which [`tanh`] equals 1 to round-off, and number of halvings.
const SATURATION: f64 = 40.0;
const HALVINGS: u32 = 5;

/// `(1 - exp(-v)) / v` for `v` up to `SATURATION / 2^HALVINGS` = 1.25; relative error of the fit
/// 9e-17, coefficients rounded.
const DECAY: [f64; 13] = [
    1.0,
    -0.5,
    0.166_666_666_666_663_85,
    -0.041_666_666_666_559_715,
    0.008_333_333_331_731_687,
    -0.001_388_888_876_479_964_4,
    0.000_198_412_641_586_642_67,
    -2.480_142_192_364_503_4e-5,
    2.755_413_945_051_169_3e-6,
    -2.751_629_907_035_304_6e-7,
    2.469_907_773_035_637_2e-8,
    -1.891_152_521_944_734_4e-9,
    9.465_923_857_189_377e-11,
];

/// Polynomial with the given coefficients, constant first. Even and odd powers are summed
/// separately to shorten the chain of dependent products.
#[inline(always)]
pub(super) fn polynomial<S: Simd, const N: usize>(
    simd: S,
    coefficients: &[f64; N],
    u: S::f64s,
) -> S::f64s {
    let squared = simd.mul_f64s(u, u);
    let zero = simd.splat_f64s(0.0);
    let mut sums = [zero; 2];
    for k in (0..N).rev() {
        let c = simd.splat_f64s(coefficients[k]);
        let highest = k + 2 >= N;
        let sum = &mut sums[k % 2];
        *sum = if highest {
            c
        } else {
            simd.mul_add_e_f64s(*sum, squared, c)
        };
    }
    let [even, odd] = sums;
    simd.mul_add_e_f64s(odd, u, even)
}

/// Cosine and `sin(a)/a` of angles `a` (rad) with squares `u`, for two sets of angles.
///
/// Accurate to round-off. Angles above 1/8 are computed by the standard library, the reference. The
/// result of a lane depends on its angle alone.
#[inline(always)]
pub(crate) fn cosine_and_sinc<S: Simd>(simd: S, u: [S::f64s; 2]) -> [[S::f64s; 2]; 2] {
    let results = [small(simd, u[0]), small(simd, u[1])];
    let largest = simd.reduce_max_f64s(simd.max_f64s(u[0], u[1]));
    if largest <= LARGEST_SQUARED_HALF_ANGLE {
        results
    } else {
        [any(simd, u[0], results[0]), any(simd, u[1], results[1])]
    }
}

/// Hyperbolic tangent, to 1e-15 relative at every argument. NaN is preserved. The reference is
/// [`f64::tanh`].
///
/// ```text
/// tanh(x) = g(2x) / (2 - g(2x)),  g(v) = 1 - exp(-v),  x > 0
/// ```
///
/// `g` is a polynomial for small `v` and is extended by `g(2v) = g(v) (2 - g(v))`, without
/// cancellation.
#[inline(always)]
pub fn tanh<S: Simd>(simd: S, x: S::f64s) -> S::f64s {
    let two = simd.splat_f64s(2.0);
    let magnitude = simd.abs_f64s(x);
    let doubled = simd.add_f64s(magnitude, magnitude);
    let doubled = at_most(simd, doubled, simd.splat_f64s(SATURATION));
    let v = simd.mul_f64s(doubled, simd.splat_f64s(1.0 / f64::from(1_u32 << HALVINGS)));
    let mut g = simd.mul_f64s(v, polynomial(simd, &DECAY, v));
    for _ in 0..HALVINGS {
        g = simd.mul_f64s(g, simd.sub_f64s(two, g));
    }
    let positive = simd.div_f64s(g, simd.sub_f64s(two, g));
    let negative = simd.less_than_f64s(x, simd.splat_f64s(0.0));
    simd.select_f64s(negative, simd.neg_f64s(positive), positive)
}

/// `x` clamped to `[-bound, bound]`. NaN is preserved. The reference is [`f64::clamp`].
#[inline(always)]
pub fn clamp<S: Simd>(simd: S, x: S::f64s, bound: f64) -> S::f64s {
    let (lower, upper) = (simd.splat_f64s(-bound), simd.splat_f64s(bound));
    let below = simd.less_than_f64s(x, lower);
    simd.select_f64s(below, lower, at_most(simd, x, upper))
}

/// Minimum of `x` and `upper`. NaN is preserved, unlike the minimum instruction of some processors.
#[inline(always)]
fn at_most<S: Simd>(simd: S, x: S::f64s, upper: S::f64s) -> S::f64s {
    simd.select_f64s(simd.greater_than_f64s(x, upper), upper, x)
}

#[inline(always)]
fn small<S: Simd>(simd: S, u: S::f64s) -> [S::f64s; 2] {
    [polynomial(simd, &COSINE, u), polynomial(simd, &SINC, u)]
}

/// Results for any angles, given the results `of_small` for small ones.
#[inline(always)]
fn any<S: Simd>(simd: S, u: S::f64s, of_small: [S::f64s; 2]) -> [S::f64s; 2] {
    let mut lanes = [0.0; MOST_LANES];
    write(simd, &mut lanes, 0, u);
    let [cosines, sincs] = cosine_and_sinc_of_each(lanes);
    let is_small = simd.less_than_or_equal_f64s(u, simd.splat_f64s(LARGEST_SQUARED_HALF_ANGLE));
    [
        simd.select_f64s(is_small, of_small[0], read(simd, &cosines, 0)),
        simd.select_f64s(is_small, of_small[1], read(simd, &sincs, 0)),
    ]
}

#[cold]
#[inline(never)]
fn cosine_and_sinc_of_each(squared: [f64; MOST_LANES]) -> [[f64; MOST_LANES]; 2] {
    let angles = squared.map(f64::sqrt);
    [angles.map(f64::cos), angles.map(crate::rotation::sinc)]
}
