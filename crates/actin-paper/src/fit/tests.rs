//! Fits to synthetic tables recover the parameters of known laws at any scale.

use super::column::Column;
use super::forms::LawForm;
use super::groups::GroupFits;
use super::search::{Basis, LawFit, rooted, sided, stiffened, stretched};
use super::table::FitData;
use super::{Options, run};
use crate::measure::{Specimen, bend_by_couples, stretch_by_force, twist};
use actin_cosserat::StretchLaw;
use actin_fit::{Fit, Model};
use actin_sim::{Scene, Solve};
use std::path::Path;

/// Normal deviates: sums of twelve uniform deviates.
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f64 {
        let uniform = |_| {
            // Linear congruential generator (Knuth, MMIX); upper bits.
            self.0 = self
                .0
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 11) as f64 / (1u64 << 53) as f64
        };
        (0..12).map(uniform).sum::<f64>() - 6.0
    }
}

/// Arguments on both sides, denser near zero.
fn sides(count: i32, range: f64) -> Vec<f64> {
    let place = |i: i32| (f64::from(i) / f64::from(count)).powi(2) * range * f64::from(i.signum());
    (-count..=count).map(place).collect()
}

/// Values of a model with relative noise `share`, and their standard errors.
fn observed(model: &dyn Model, x: &[f64], p: &[f64], share: f64, seed: u64) -> Column {
    let mut noise = Noise(seed);
    let mut column = Column::default();
    for &x in x {
        let value = model.value(&[x], p);
        let error = share * value.abs().max(1e-12);
        column.push(x, value + error * noise.next());
        if share > 0.0 {
            column.error.push(error);
        }
    }
    column
}

/// Parameters are within 4 standard errors of the truth, and chi squared within 4 standard
/// deviations.
fn assert_near(fit: &Fit, truth: &[f64]) {
    for (j, (got, is)) in fit.parameters.iter().zip(truth).enumerate() {
        let error = fit.precision.standard_error(j).expect("determined");
        assert!(
            (got - is).abs() < 4.0 * error,
            "{j}: {got:e} {is:e} +- {error:e}"
        );
        assert!(
            error < is.abs(),
            "{j}: standard error {error:e} exceeds the value {is:e}"
        );
    }
    let freedom = fit.goodness.degrees_of_freedom as f64;
    let excess = (fit.goodness.chi_squared - freedom) / (2.0 * freedom).sqrt();
    assert!(
        excess.abs() < 4.0,
        "chi^2 {} of {freedom}",
        fit.goodness.chi_squared
    );
}

fn full<L>(fit: &LawFit<L>) -> &Fit {
    match &fit.basis {
        Basis::Full(found) => {
            assert!(found.faults().is_empty(), "{:?}", found.faults());
            &found.fit
        }
        Basis::Simple { note, .. } => panic!("{note}"),
    }
}

/// Twisting rigidities of any size with 1 % noise. A bound of 5e3 pN nm^2 on `rest` would fail at
/// the second size.
#[test]
fn twist_is_recovered_at_every_scale() {
    for (seed, rest) in [(1, 100.0), (2, 1e4), (3, 1e5), (4, 3e3)] {
        for range in [0.05, 2e-3] {
            let truth = [
                rest,
                2.0 * rest,
                0.2 * range,
                0.4 * range,
                4.0 * rest,
                0.3 * range,
                0.3 * range,
            ];
            let column = observed(
                &LawForm::sided(range),
                &sides(40, range),
                &truth,
                0.01,
                seed,
            );
            let fit = sided(&column).unwrap();
            assert_near(full(&fit), &truth);
            assert!((fit.law.range / range - 1.0).abs() < 1e-12);
        }
    }
}

#[test]
fn laws_are_recovered_without_noise() {
    let range = 0.05;
    for size in [1e-3, 1.0, 1e5] {
        let near = |fit: &Fit, truth: &[f64]| {
            for (got, is) in fit.parameters.iter().zip(truth) {
                assert!((got / is - 1.0).abs() < 1e-6, "{size}: {got} {is}");
            }
        };
        let truth = [size, 3.0 * size, 0.01, 0.02, 5.0 * size, 0.012, 0.01];
        let column = observed(&LawForm::sided(range), &sides(15, range), &truth, 0.0, 1);
        near(full(&sided(&column).unwrap()), &truth);
        let truth = [-0.3 * size, 0.45 * size, 7e-3, 30.0 * size];
        let column = observed(&LawForm::rooted(range), &sides(15, range), &truth, 0.0, 1);
        near(full(&rooted(&column).unwrap()), &truth);
        let truth = [size, 0.3 * size, 0.2 * range];
        let x: Vec<f64> = sides(15, range)[16..].to_vec();
        let column = observed(&LawForm::stiffened(range), &x, &truth, 0.0, 1);
        near(full(&stiffened(&column).unwrap()), &truth);
        let truth = [3.0 * size, size, 1e-3];
        let column = observed(
            &LawForm::stretched(),
            &sides(15, 0.02 * size),
            &truth,
            0.0,
            1,
        );
        near(full(&stretched(&column).unwrap()), &truth);
    }
}

#[test]
fn bending_and_stretch_are_recovered_at_every_scale() {
    for (seed, rest) in [(5, 100.0), (6, 3e4), (7, 1e5)] {
        let (range, truth) = (0.02, [rest, 0.4 * rest, 4e-3]);
        let x: Vec<f64> = (1..60).map(|i| range * f64::from(i) / 59.0).collect();
        let column = observed(&LawForm::stiffened(range), &x, &truth, 0.01, seed);
        assert_near(full(&stiffened(&column).unwrap()), &truth);
        let truth = [3.0 * rest, rest, 1e-3];
        let column = observed(
            &LawForm::stretched(),
            &sides(30, 0.02 * rest),
            &truth,
            0.01,
            seed,
        );
        assert_near(full(&stretched(&column).unwrap()), &truth);
    }
}

/// Constant B, equal rigidities and a single slope are recognised with and without noise.
#[test]
fn simpler_laws_are_preferred_if_they_fit() {
    let x: Vec<f64> = (1..30).map(|i| 5e-4 * f64::from(i)).collect();
    for share in [0.0, 0.02] {
        let column = observed(&LawForm::stiffened(0.015), &x, &[2e4, 0.0, 1e-3], share, 9);
        let bend = stiffened(&column).unwrap();
        assert!((bend.law.rest / 2e4 - 1.0).abs() < 0.02 && bend.law.rise.abs() < 1e-9);
        bend.law.validate().unwrap();
        let column = observed(
            &LawForm::stretched(),
            &sides(12, 200.0),
            &[2e4, 2e4, 1e-3],
            share,
            9,
        );
        let stretch = stretched(&column).unwrap().law;
        let StretchLaw::Constant { rigidity } = stretch else {
            panic!("{stretch:?}");
        };
        assert!((rigidity / 2e4 - 1.0).abs() < 0.02);
        let truth = [-0.3, 0.0, 7e-3, 20.0];
        let column = observed(&LawForm::rooted(0.05), &sides(12, 0.05), &truth, share, 9);
        let length = rooted(&column).unwrap().law;
        assert!((length.slope / -0.3 - 1.0).abs() < 0.03 && length.bend.abs() < 1e-12);
        length.validate().unwrap();
    }
    let column = observed(&LawForm::stiffened(0.015), &x, &[2e4, -8e3, 4e-3], 0.01, 9);
    let message = stiffened(&column).unwrap_err();
    assert!(message.contains("no law softens"), "{message}");
}

/// Runs the command without output.
fn fitted(options: &Options) -> Result<(), String> {
    run(options, &|_| ())
}

/// Smooth rigidities of 8e3 to 20e3 pN nm^2, beyond a bound of 5e3 on `rest`.
#[test]
fn stiff_data_are_fitted() {
    let mut column = Column::default();
    for x in sides(12, 0.05) {
        column.push(x, 8e3 + 12e3 * x * x / (x * x + 4e-4));
    }
    let law = sided(&column).unwrap().law;
    // The form is exact with `slow` = 0, which is a bound.
    for (x, value) in column.pairs() {
        assert!(
            (law.secant(x) / value - 1.0).abs() < 1e-5,
            "{x}: {} {value}",
            law.secant(x)
        );
    }
    assert!((law.rest / 8e3 - 1.0).abs() < 1e-4);
}

fn options(data: &Path, out: &Path, allowed: &[&str]) -> Options {
    Options {
        data: Some(data.to_owned()),
        measure: false,
        all_rows: false,
        allow_bounds: allowed.iter().map(|key| (*key).to_owned()).collect(),
        out: out.to_owned(),
    }
}

/// Rigidities that grow as the square of the twist without limit: the rises end at their bounds.
/// Each of them must be allowed, or no file is written.
#[test]
fn a_parameter_at_a_bound_is_a_failure() {
    let folder = tempfile::tempdir().unwrap();
    let (file, out) = (folder.path().join("data.csv"), folder.path().join("out"));
    let rows = sides(10, 0.05)
        .into_iter()
        .map(|k| format!("{k},{}\n", 500.0 + 1e7 * k * k));
    let table = format!("kappa3_rad_per_nm,b3_pn_nm2\n{}", rows.collect::<String>());
    std::fs::write(&file, table).unwrap();
    let message = fitted(&options(&file, &out, &[])).unwrap_err();
    assert!(
        message.starts_with("no law is written: B3 against twist: b3."),
        "{message}"
    );
    assert!(message.contains(" is at its upper bound, "), "{message}");
    assert!(
        message.contains("pN nm^2") && message.contains("--allow-bounds b3."),
        "{message}"
    );
    assert!(!out.exists());
    let (_, keys) = message.split_once("--allow-bounds ").unwrap();
    let keys: Vec<&str> = keys.trim_end_matches(" accepts").split(',').collect();
    let fewer = fitted(&options(&file, &out, &keys[1..])).unwrap_err();
    assert!(fewer.contains(keys[0]) && !out.exists(), "{fewer}");
    fitted(&options(&file, &out, &keys)).unwrap();
    assert!(out.join("rod-law.ron").exists());
    let unknown = fitted(&options(&file, &out, &["b3.rests"])).unwrap_err();
    assert!(
        unknown.starts_with("--allow-bounds b3.rests: unknown parameter; known: b3.rest, "),
        "{unknown}"
    );
}

/// Data on one side do not determine the other, and a single absolute twist determines no law.
#[test]
fn undetermined_parameters_are_refused() {
    let mut column = Column::default();
    for x in (1..20).map(|i| 2e-3 * f64::from(i)) {
        column.push(x, 1e3 + 1e6 * x);
    }
    let message = sided(&column).unwrap_err();
    assert_eq!(
        message,
        "B3 against twist: 0 values of under-twist, at least 3 are needed"
    );
    let mut column = Column::default();
    for i in 0..10 {
        column.push(0.01 * f64::from(2 * (i % 2) - 1), 1e3 + f64::from(i));
    }
    let faults = sided(&column).unwrap().basis.faults();
    let message = super::parameter_fit::accept(&faults, &[]).unwrap_err();
    assert!(
        message.contains("the data do not determine b3."),
        "{message}"
    );
}

fn scene_with(law: &str) -> Scene {
    let text = format!(
        "Scene(title: \"mine\", filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 75.0)], \
         rod: RodModel(law:\n{law})), clamps: [Clamp(end: Start), Clamp(end: End, slides: AlongAxis)], \
         path: [Stage(set: [Turn(end: End, turn_deg: (0.0, 0.0, 90.0))])], task: Equilibrium())"
    );
    Scene::from_ron(&text).unwrap()
}

/// The example of the documentation gives a law file. A scene with that law has the rigidities of
/// the table.
#[test]
fn a_scene_reads_the_written_law() {
    let page = include_str!("../../../../docs/how-to/rod-laws.md");
    let (_, rest) = page.split_once("```csv\n").unwrap();
    let (example, _) = rest.split_once("```").unwrap();
    let folder = tempfile::tempdir().unwrap();
    let (file, out) = (folder.path().join("data.csv"), folder.path().join("out"));
    std::fs::write(&file, example).unwrap();
    fitted(&options(&file, &out, &[])).unwrap();
    let law = std::fs::read_to_string(out.join("rod-law.ron")).unwrap();
    let scene = scene_with(&law);
    let rod = scene.filament.rod.clone();
    scene.solve().unwrap();

    let table = FitData::from_csv(&file).unwrap();
    let fits = GroupFits::new(&table).unwrap();
    let expected = |name: &str, x: f64| (fits.named(name).law)(x);
    let near = |got: f64, is: f64| assert!((got / is - 1.0).abs() < 1e-5, "{got} {is}");
    let specimen = Specimen::rod(75.0, None, rod);
    for point in twist(&specimen, &[-120.0, 60.0]).unwrap().points {
        near(
            point.rigidity_pn_nm2,
            expected("twist", point.curvature_rad_per_nm),
        );
    }
    for point in bend_by_couples(&specimen, &[1e-3, 5e-3], 0.0)
        .unwrap()
        .points
    {
        near(
            point.rigidity_pn_nm2,
            expected("bend", point.curvature_rad_per_nm),
        );
    }
    for point in stretch_by_force(&specimen, &[10.0, 100.0]).unwrap().points {
        near(point.strain, expected("stretch", point.force_pn));
    }
}
