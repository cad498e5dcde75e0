//! The law `Fitted` compared with filaments of monomers at other lengths, azimuths and turns than
//! its fit.

use actin_paper::measure::{
    Curve, SampleStatistics, Specimen, bend_by_tip_force, sampled_by, twist,
};
use actin_sim::{Filament, JunctionModel, JunctionWeight, Monomers, RodLaw, RodModel, Section};

const AZIMUTHS_DEG: [f64; 4] = [45.0, 135.0, 225.0, 315.0];

/// Length of a number of rises (nm).
fn rises(count: f64) -> f64 {
    count * Monomers::default().rise_nm
}

/// Deflections agree within 1 %. A rod of constant rigidities differs by 28 % at 0.1 pN.
#[test]
fn cantilevers_of_rod_and_monomers_bend_alike() {
    let length = rises(80.5);
    let forces = [0.1, 0.5, 1.0, 2.0, 5.0];
    let filament = Specimen::ellipsoids(length, Monomers::default());
    let at = |azimuth| bend_by_tip_force(&filament, &forces, azimuth).unwrap();
    let curves: Vec<Curve<_>> = AZIMUTHS_DEG.into_iter().map(at).collect();
    let measured = sampled_by(&curves, |p| p.force_pn, |p| p.deflection_nm);
    let of = |law| {
        let specimen = Specimen::rod(curves[0].length_nm, None, RodModel::with_law(law));
        bend_by_tip_force(&specimen, &forces, 0.0).unwrap()
    };
    let (fitted, constant) = (of(RodLaw::Fitted), of(RodLaw::Constant));
    for (k, (force, tips)) in measured.iter().enumerate() {
        assert_eq!(tips.count, 4);
        let [fitted, constant] =
            [&fitted, &constant].map(|curve| curve.points[k].deflection_nm / tips.mean - 1.0);
        println!(
            "{force} pN: {:.3} nm, sd {:.3}; Fitted {:+.2} %, Constant {:+.2} %",
            tips.mean,
            tips.deviation,
            100.0 * fitted,
            100.0 * constant
        );
        assert!(fitted.abs() < 0.01, "{force} pN: {fitted}");
    }
}

/// Secants agree within 2 % and lengths within 5e-4, up to 200 degrees.
#[test]
fn rod_and_monomers_twist_and_shorten_alike() {
    let turns = [
        -190.0, -160.0, -135.0, -110.0, -70.0, -50.0, -25.0, 25.0, 50.0, 70.0, 110.0, 135.0, 160.0,
        190.0,
    ];
    let filament = Specimen::ellipsoids(rises(27.0), Monomers::default());
    let monomers = twist(&filament, &turns).unwrap();
    let specimen = Specimen::rod(monomers.length_nm, None, RodModel::with_law(RodLaw::Fitted));
    let fitted = twist(&specimen, &turns).unwrap();
    for (rod, filament) in fitted.points.iter().zip(&monomers.points) {
        let stiffer = rod.rigidity_pn_nm2 / filament.rigidity_pn_nm2 - 1.0;
        let longer = rod.relative_length_change - filament.relative_length_change;
        let turn = filament.turn_deg;
        assert!(
            stiffer.abs() < 0.02 && longer.abs() < 5e-4,
            "{turn} deg: {stiffer} {longer}"
        );
    }
}

/// Tip deflection (nm) of a mixed cantilever of 160 nm with a length `rod_nm` of rod at the tip.
fn tip(rod_nm: f64, force: f64, law: &RodLaw, weight: JunctionWeight) -> f64 {
    let boundary = 160.0 - rod_nm;
    let sections = vec![
        Section::Ellipsoids {
            from_nm: 0.0,
            to_nm: boundary,
            altered: None,
        },
        Section::rod(boundary, 160.0, None),
    ];
    let specimen = Specimen::new(Filament {
        rod: RodModel::with_law(law.clone()),
        junction: JunctionModel {
            weight,
            ..JunctionModel::default()
        },
        ..Filament::new(sections)
    });
    let curve = bend_by_tip_force(&specimen, &[force], 180.0).unwrap();
    curve.points[0].deflection_nm
}

/// Tip deflections for 20, 40, ... 140 nm of rod, and their range over their mean.
fn spread(force: f64, law: &RodLaw, weight: JunctionWeight) -> f64 {
    let tips: Vec<f64> = (1..=7)
        .map(|k| tip(20.0 * f64::from(k), force, law, weight))
        .collect();
    let low = tips.iter().copied().fold(f64::INFINITY, f64::min);
    let high = tips.iter().copied().fold(0.0, f64::max);
    let spread = (high - low) / SampleStatistics::from_values(tips.iter().copied()).mean;
    println!(
        "{force} pN, {law:?}, {weight:?}: {tips:.2?}, spread {:.1} %",
        100.0 * spread
    );
    spread
}

/// Most of the spread over resolutions is due to the rod law, and the rest to the weight of the
/// junction. Both the fitted law and a shared weight reduce the spread.
#[test]
fn mixed_cantilevers_spread_less_under_the_fitted_law() {
    for force in [0.5, 2.0] {
        let of = |weight| [RodLaw::Constant, RodLaw::Fitted].map(|law| spread(force, &law, weight));
        let [constant, fitted] = of(JunctionWeight::Shared);
        let [stiff_constant, stiff_fitted] = of(JunctionWeight::Full);
        assert!(fitted < 0.6 * constant && stiff_fitted < 0.8 * stiff_constant);
        assert!(constant < stiff_constant && fitted < stiff_fitted);
    }
}
