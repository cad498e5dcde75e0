//! Rods for benchmarks: 160 nm from a wall, bent, under each law with a vector kernel.

use actin_cosserat::{
    BendLaw, CubicShear, EnergyGradient, Homogenised, Rigidities, RodLayout, RodMaterial,
    RootedStretch, SegmentCurvature, SegmentLaw, SidedTwist, Stiffening, StraightRod, StretchLaw,
    TanhTwist, TwistLaw, TwistRise, TwistStretch, Walls,
};
use actin_mechanics::State;
use actin_mechanics::{Xorshift, perturb};

/// Rod whose neighbouring frames differ by up to `angle` (rad) about each axis.
pub(crate) fn rod(segments: usize, angle: f64) -> (State, RodLayout) {
    let walls = Walls {
        start: true,
        end: false,
    };
    let rod = StraightRod {
        walls,
        ..StraightRod::uniform(segments, 160.0 / segments as f64)
    };
    let mut state = State::default();
    let layout = rod.push(&mut state).expect("use at least one segment");
    perturb(&mut state, &mut Xorshift::new(1), 1e-3, angle);
    (state, layout)
}

/// Name, material, and law of twist and stretch.
type Law = (&'static str, RodMaterial, Option<TwistStretch>);

pub(crate) fn laws() -> [Law; 4] {
    let constant = RodMaterial::new(Rigidities::table4()).expect("the table is valid");
    let twist = TwistLaw::Tanh(TanhTwist::published());
    let published = constant.with_twist(twist).expect("the law is valid");
    let (fitted, rooted) = fitted(constant);
    [
        ("constant", constant, None),
        ("published", published, Some(TwistStretch::published())),
        ("fitted", fitted, Some(rooted)),
        (
            "homogenised",
            RodMaterial::homogenised(Homogenised::mean_filament()),
            None,
        ),
    ]
}

pub(crate) fn interaction(layout: &RodLayout, (_, material, xi): Law) -> EnergyGradient {
    let rod = EnergyGradient::new(layout.clone(), material);
    let curvature = SegmentCurvature::new(layout, &[], &[]);
    match SegmentLaw::from_material(&material, xi) {
        Some(law) => rod.with_extension(law, curvature),
        None => rod,
    }
}

/// Law `Fitted` of scenes, with the numbers of `crates/actin-scene/src/fitted.rs`.
fn fitted(constant: RodMaterial) -> (RodMaterial, TwistStretch) {
    let material = constant
        .with_bend(BendLaw::Stiffening(BEND))
        .and_then(|m| m.with_twist(TwistLaw::Sided(TWIST)))
        .and_then(|m| m.with_stretch(StretchLaw::Constant { rigidity: 3.29e4 }))
        .and_then(|m| m.with_shear(SHEAR))
        .expect("the laws are valid");
    (material, TwistStretch::Rooted(LENGTH))
}

const BEND: Stiffening = Stiffening {
    rest: 31_717.0,
    rise: 8_070.5,
    curvature: 2.845e-3,
    twist: 2.871e-3,
    shear: 9.922e-3,
    range: 0.015,
};

const TWIST: SidedTwist = SidedTwist {
    rest: 225.65,
    under: TwistRise {
        rise: 12_877.3,
        half: 8.713_5e-3,
        slow: 1.862e-2,
    },
    over: TwistRise {
        rise: 23_082.2,
        half: 1.141_46e-2,
        slow: 1.843_1e-2,
    },
    range: 0.0472,
};

const SHEAR: CubicShear = CubicShear {
    linear: [0.0, 0.0],
    cubic: 8.282_4e5,
};

const LENGTH: RootedStretch = RootedStretch {
    slope: -0.288_514,
    bend: 0.460_159,
    half: 6.587_3e-3,
    cubic: 27.601_6,
    range: 0.0472,
};
