//! The points of the default parameters, as [`Cubature::find`] finds them.
//!
//! `cargo run -p actin-ellipsoid --example weighted_bonds` prints this table; a test finds it anew.

use super::moments::Site;
use super::{Certificate, Cubature, CubaturePoint, cache};
use crate::{EllipsoidParameters, InterfaceKind};

/// Relative difference up to which two numbers of a geometry are the same: angles that went through
/// degrees and back differ in the last digits.
const SAME: f64 = 1e-12;

/// Points of one kind of interface.
struct Known {
    certificate: Certificate,
    /// Place (nm), height (nm), length (nm), weight.
    points: &'static [[f64; 5]],
}

impl Known {
    fn of(kind: InterfaceKind) -> &'static Self {
        match kind {
            InterfaceKind::Lateral => &LATERAL,
            InterfaceKind::Longitudinal => &LONGITUDINAL,
        }
    }

    /// The points; weights add up to 1 but for the digits that the table leaves out.
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

/// The points of parameters that are the default ones in all that matters.
pub(super) fn built_in(parameters: &EllipsoidParameters, kind: InterfaceKind) -> Option<Cubature> {
    let known = Known::of(kind);
    let standard = EllipsoidParameters::default();
    let pairs = cache::numbers(parameters, kind)
        .into_iter()
        .zip(cache::numbers(&standard, kind));
    let mut is_same = pairs.map(|(a, b)| (a - b).abs() <= SAME * b.abs());
    let count = kind.parameters(parameters).bonds;
    (known.points.len() == count && is_same.all(|same| same)).then(|| Cubature {
        points: known.points().collect(),
        certificate: known.certificate,
    })
}

/// The points in units of their own geometry, to start searches of another from: root mean squares
/// are moments, which the points meet.
pub(super) fn sites(kind: InterfaceKind) -> Vec<(Site, f64)> {
    let known = Known::of(kind);
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

static LATERAL: Known = Known {
    certificate: Certificate {
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

static LONGITUDINAL: Known = Known {
    certificate: Certificate {
        residual: 7.571e-5,
        weights: [0.017_311_224_409, 0.148_453_414_378],
        lengths: [0.147_451_036_668, 1.648_558_349_111],
        drawn_lengths: [0.146_210_091_337, 2.199_998_013_017],
        outside: 0,
    },
    points: &[
        [
            -0.982_824_835_836,
            1.262_543_880_343,
            -0.139_539_765_449,
            1.617_970_794_483,
            0.142_481_583_680,
        ],
        [
            0.383_779_688_618,
            0.248_396_793_216,
            0.010_674_815_126,
            0.311_629_912_395,
            0.042_079_811_177,
        ],
        [
            -0.662_203_863_183,
            0.273_826_001_240,
            -0.014_349_852_383,
            0.463_457_498_372,
            0.063_346_570_001,
        ],
        [
            0.523_426_800_569,
            1.515_221_756_090,
            0.102_672_748_738,
            1.434_779_493_562,
            0.137_451_265_401,
        ],
        [
            0.243_793_588_616,
            -1.662_396_051_184,
            -0.060_777_071_423,
            1.444_536_933_212,
            0.148_453_414_378,
        ],
        [
            1.236_565_007_516,
            -0.302_902_307_702,
            -0.045_412_773_066,
            1.648_558_349_111,
            0.094_646_377_020,
        ],
        [
            1.086_600_210_719,
            -0.176_283_336_441,
            -0.021_694_746_768,
            1.109_817_789_127,
            0.074_719_182_231,
        ],
        [
            -0.104_448_906_636,
            0.009_536_577_651,
            -0.000_000_922_228,
            0.147_451_036_668,
            0.017_311_224_409,
        ],
        [
            -1.210_493_414_008,
            -0.809_583_869_814,
            0.111_527_839_581,
            1.597_733_188_270,
            0.129_410_625_101,
        ],
        [
            0.234_409_559_368,
            -0.549_989_869_008,
            -0.016_413_349_255,
            0.327_175_602_171,
            0.045_919_703_022,
        ],
        [
            -0.423_179_883_483,
            -0.632_553_983_644,
            0.018_825_486_080,
            0.410_815_202_444,
            0.054_656_043_938,
        ],
        [
            -0.100_861_661_139,
            0.777_168_579_039,
            -0.000_152_212_134,
            0.388_229_018_262,
            0.049_524_199_640,
        ],
    ],
};
