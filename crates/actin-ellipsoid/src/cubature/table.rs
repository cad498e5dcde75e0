//! Quadrature points of the default parameters, computed by [`Cubature::find`].
//!
//! `cargo run -p actin-ellipsoid --example weighted_bonds` prints this table.

use super::moments::Site;
use super::{Cubature, CubaturePoint, MomentCheck, numbers};
use crate::{EllipsoidParameters, InterfaceKind};

/// Relative tolerance: conversion to degrees and back changes the last digits.
const SAME: f64 = 1e-12;

struct StoredPoints {
    certificate: MomentCheck,
    /// Position (nm), height (nm), length (nm), weight.
    points: &'static [[f64; 5]],
}

impl StoredPoints {
    fn for_kind(kind: InterfaceKind) -> &'static Self {
        match kind {
            InterfaceKind::Lateral => &LATERAL,
            InterfaceKind::Longitudinal => &LONGITUDINAL,
        }
    }

    fn points(&self) -> impl Iterator<Item = CubaturePoint> + '_ {
        let total: f64 = self.points.iter().map(|point| point[4]).sum();
        let points = self.points.iter();
        points.map(move |&[x, y, height, length, weight]| CubaturePoint {
            place: [x, y],
            height,
            length,
            weight: weight / total,
        })
    }
}

/// Built-in quadrature if the parameters agree with the default.
pub(super) fn built_in(parameters: &EllipsoidParameters, kind: InterfaceKind) -> Option<Cubature> {
    let known = StoredPoints::for_kind(kind);
    let standard = EllipsoidParameters::default();
    let pairs = numbers(parameters, kind)
        .into_iter()
        .zip(numbers(&standard, kind));
    let mut is_same = pairs.map(|(a, b)| (a - b).abs() <= SAME * b.abs());
    let count = parameters.interface(kind).bonds;
    (known.points.len() == count && is_same.all(|same| same)).then(|| Cubature {
        points: known.points().collect(),
        certificate: known.certificate,
    })
}

/// Points in dimensionless units, as initial guess for other geometries.
pub(super) fn sites(kind: InterfaceKind) -> Vec<(Site, f64)> {
    let known = StoredPoints::for_kind(kind);
    let mean = |square: fn(&CubaturePoint) -> f64| -> f64 {
        known.points().map(|p| p.weight * square(&p)).sum()
    };
    let distance = mean(|p| p.place[0] * p.place[0] + p.place[1] * p.place[1]).sqrt();
    let inverse = mean(|p| p.length.powi(-2)).sqrt();
    let site = |p: CubaturePoint| {
        let site = Site {
            place: p.place.map(|x| x / distance),
            inverse: 1.0 / (p.length * inverse),
        };
        (site, p.weight)
    };
    known.points().map(site).collect()
}

static LATERAL: StoredPoints = StoredPoints {
    certificate: MomentCheck {
        residual: 4.205e-5,
        weights: [0.037_123_242_537, 0.140_436_821_151],
        lengths: [0.265_813_910_773, 1.455_406_139_990],
        drawn_lengths: [0.264_514_662_450, 1.599_998_814_081],
        outside: 0,
    },
    points: &[
        [
            -0.693_135_878_251,
            -0.079_939_874_508,
            -0.024_498_703_210,
            0.504_054_856_698,
            0.075_139_817_502,
        ],
        [
            0.846_191_319_584,
            0.515_803_928_970,
            0.146_987_772_552,
            0.492_223_151_819,
            0.067_154_418_475,
        ],
        [
            0.002_789_005_661,
            -0.741_015_286_645,
            -0.220_061_591_178,
            0.475_327_680_052,
            0.072_432_121_954,
        ],
        [
            -0.392_129_434_266,
            1.285_100_189_488,
            0.389_617_723_094,
            1.059_160_605_503,
            0.076_989_752_585,
        ],
        [
            -0.506_549_090_853,
            1.658_363_303_203,
            0.508_176_722_093,
            1.455_406_139_990,
            0.037_123_242_537,
        ],
        [
            1.505_061_721_477,
            0.923_808_147_715,
            0.249_525_907_223,
            1.210_563_418_852,
            0.110_460_509_523,
        ],
        [
            0.177_723_599_539,
            0.026_420_353_432,
            0.007_785_180_360,
            0.265_813_910_773,
            0.038_830_298_978,
        ],
        [
            -0.309_801_869_807,
            -1.458_241_561_015,
            -0.440_618_036_624,
            1.191_057_786_322,
            0.140_436_821_151,
        ],
        [
            1.506_691_212_790,
            -0.879_616_187_074,
            -0.237_837_470_457,
            1.176_342_689_924,
            0.129_880_217_502,
        ],
        [
            -0.164_290_301_482,
            0.740_428_862_382,
            0.221_600_824_149,
            0.498_331_331_140,
            0.062_066_668_189,
        ],
        [
            -1.539_576_859_256,
            -0.094_843_815_351,
            -0.030_518_160_735,
            1.224_214_038_426,
            0.122_667_275_700,
        ],
        [
            0.890_929_343_987,
            -0.387_420_149_985,
            -0.110_180_762_105,
            0.465_923_766_723,
            0.066_818_855_906,
        ],
    ],
};

static LONGITUDINAL: StoredPoints = StoredPoints {
    certificate: MomentCheck {
        residual: 1.030e-5,
        weights: [0.020_517_527_464, 0.152_829_792_989],
        lengths: [0.233_979_152_871, 2.096_072_452_395],
        drawn_lengths: [0.200_000_000_000, 2.199_998_365_642],
        outside: 0,
    },
    points: &[
        [
            -0.299_522_653_489,
            -0.988_207_543_563,
            0.019_182_051_032,
            0.591_098_108_674,
            0.078_534_104_510,
        ],
        [
            -0.913_555_922_973,
            1.618_771_163_474,
            -0.190_304_343_455,
            2.096_072_452_395,
            0.079_386_774_182,
        ],
        [
            0.648_453_091_862,
            0.161_727_645_168,
            0.011_098_055_542,
            0.518_028_895_728,
            0.069_773_806_506,
        ],
        [
            0.523_104_030_193,
            1.419_492_714_340,
            0.093_388_093_792,
            1.298_720_406_668,
            0.137_516_668_955,
        ],
        [
            -0.184_483_742_831,
            -2.003_972_662_565,
            0.032_101_702_842,
            2.055_545_571_722,
            0.080_374_734_000,
        ],
        [
            1.444_545_865_521,
            -0.075_657_346_689,
            -0.014_954_839_608,
            2.045_015_498_884,
            0.087_939_619_685,
        ],
        [
            0.704_664_352_746,
            -1.048_105_546_287,
            -0.085_370_154_046,
            1.074_155_758_914,
            0.131_360_516_337,
        ],
        [
            0.154_710_652_515,
            -0.381_640_473_088,
            -0.008_593_389_423,
            0.233_979_152_871,
            0.020_517_527_464,
        ],
        [
            -1.236_193_170_189,
            -0.334_509_604_331,
            0.044_262_264_260,
            1.382_794_882_082,
            0.152_829_792_989,
        ],
        [
            -0.484_484_379_844,
            -0.047_444_605_909,
            0.001_629_450_125,
            0.287_086_272_390,
            0.033_158_326_341,
        ],
        [
            -0.597_293_874_536,
            0.942_708_361_233,
            -0.046_882_621_733,
            0.743_653_908_588,
            0.100_401_645_231,
        ],
        [
            0.035_185_171_034,
            0.542_344_569_650,
            0.006_540_543_699,
            0.268_798_829_085,
            0.028_206_483_799,
        ],
    ],
};
