//! Fits of bending and shear: bending rigidity against curvature, twist and shear strain.

use super::catalogue::Form;
use super::column::Column;
use super::measured::{BendData, Point};
use super::parameter_fit::{Fault, ParameterFit};
use super::search::{LawFit, stiffened};
use crate::measure::{Specimen, bend_by_tip_force, shear_by_force};
use crate::run::segments;
use crate::statistics::largest;
use actin_cosserat::{CubicShear, Stiffening, StretchLaw};
use actin_fit::{
    ClosureModel, Data, FitError, LevenbergMarquardt, Model, Observations, Options, Starts,
};
use actin_sim::{BendLaw, RodLaw, RodLaws, RodModel, ShearLaw};

/// Segment length of the fitted rods (nm).
const SEGMENT_NM: f64 = 5.0;
/// Tolerance on the cosine between residuals and derivatives. At this tolerance, parameters are
/// within 5e-5 standard errors of the minimum. The residuals of the equilibria limit the cosine to
/// 7e-7.
const COSINE: f64 = 1e-5;
/// Relative step of a parameter for numerical derivatives.
const MOVE: f64 = 1e-3;

/// Fitted bending and shear laws.
#[derive(Debug)]
pub(crate) struct BendFits {
    pub bend: LawFit<Stiffening>,
    /// Cubic shear rigidity (pN) and the shear strain at half the rise.
    pub shear: ParameterFit,
    /// Twist at half the rise (rad/nm).
    pub twist: ParameterFit,
    /// Bending law with all fitted scales.
    pub law: Stiffening,
    pub cubic_pn: f64,
    /// Stretching rigidity in tension (pN).
    pub stretch_pn: f64,
    /// Length (nm), force (pN) and relative deviation of the deflection.
    pub checks: Vec<[f64; 3]>,
}

impl BendFits {
    /// Fits bending first, then the scales of twist and shear.
    pub(crate) fn new(data: &BendData) -> Result<Self, String> {
        let column: Column = data.bend.iter().map(|p| (p.x, p.mean)).collect();
        let bend = stiffened(&column)?;
        let mut law = bend.law;
        let twist = fit_twist(data, law)?;
        law.twist = twist.fit.parameters[0];
        let shear = fit_shear(data, law)?;
        law.shear = shear.fit.parameters[1];
        let cubic_pn = shear.fit.parameters[0];
        let tension = data.stretch.iter().filter(|p| p.x > 0.0).map(|p| p.mean);
        let stretch_pn = tension.clone().sum::<f64>() / tension.count() as f64;
        let checks = beams(data).map(|(is_tip, p)| {
            let rod = shift(is_tip, &p, law, cubic_pn);
            [p.length_nm, p.x, rod / p.mean - 1.0]
        });
        Ok(Self {
            checks: checks.collect(),
            bend,
            shear,
            twist,
            law,
            cubic_pn,
            stretch_pn,
        })
    }

    /// Parameters that are undetermined or at a bound.
    pub(super) fn faults(&self) -> Vec<Fault> {
        [
            self.twist.faults(),
            self.shear.faults(),
            self.bend.basis.faults(),
        ]
        .concat()
    }

    pub(crate) fn laws(&self) -> RodLaws {
        RodLaws {
            stretch: Some(StretchLaw::Constant {
                rigidity: self.stretch_pn,
            }),
            ..laws(self.law, self.cubic_pn)
        }
    }
}

fn laws(law: Stiffening, cubic_pn: f64) -> RodLaws {
    RodLaws {
        bend: Some(BendLaw::Stiffening(law)),
        shear: Some(ShearLaw::Cubic(CubicShear {
            linear: [0.0; 2],
            cubic: cubic_pn,
        })),
        ..RodLaws::default()
    }
}

fn relative(x: &[f64], width: usize, y: &[f64]) -> Result<Data, FitError> {
    let weights: Vec<f64> = y.iter().map(|v| v.powi(-2)).collect();
    Data::from_rows(width, x, Observations::new(y)?.with_weights(&weights)?)
}

/// Model with central differences as derivatives with respect to the parameters.
fn with_differences(
    parameters: usize,
    value: impl Fn(&[f64], &[f64]) -> f64 + Clone,
) -> impl Model {
    let moved = value.clone();
    ClosureModel::new(parameters, value, move |x, p, gradient: &mut [f64]| {
        for (j, slope) in gradient.iter_mut().enumerate() {
            let h = MOVE * p[j];
            let at = |by: f64| {
                let mut p = p.to_vec();
                p[j] += by;
                moved(x, &p)
            };
            *slope = (at(h) - at(-h)) / (2.0 * h);
        }
    })
}

/// Fits the twist at half the rise.
fn fit_twist(data: &BendData, law: Stiffening) -> Result<ParameterFit, String> {
    let form = Form::of("B against twist");
    let rows = data.twisted.iter();
    let x: Vec<f64> = rows.clone().flat_map(|row| [row[0], row[1]]).collect();
    let y: Vec<f64> = rows.clone().map(|row| row[2]).collect();
    let secant = move |x: &[f64], p: &[f64]| {
        let law = Stiffening { twist: p[0], ..law };
        law.secant(x[1], x[0])
    };
    let model = with_differences(1, secant);
    let range = largest(rows.map(|row| row[0].abs()));
    let bounds = vec![(5e-3 * range, 50.0 * range)];
    let starts = Starts::at(&[0.15 * range]).and_random(10, 1);
    let data = relative(&x, 2, &y).map_err(|e| format!("{}: {e}", form.what))?;
    ParameterFit::search(form, &model, &data, bounds, &starts)
}

/// Tips (`true`) and guided ends (`false`).
fn beams(data: &BendData) -> impl Iterator<Item = (bool, Point)> + '_ {
    let tips = data.tips.iter().map(|p| (true, *p));
    tips.chain(data.guided.iter().map(|p| (false, *p)))
}

/// Fits cubic shear and the shear scale of the bending law to deflections under the same loads.
fn fit_shear(data: &BendData, law: Stiffening) -> Result<ParameterFit, String> {
    let form = Form::of("shear");
    let all: Vec<(bool, Point)> = beams(data).collect();
    let x: Vec<f64> = (0..all.len()).map(|i| i as f64).collect();
    let y: Vec<f64> = all.iter().map(|(_, p)| p.mean).collect();
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "an index that was made a number"
    )]
    let rod = move |x: &[f64], p: &[f64]| {
        let (is_tip, point) = all[x[0] as usize];
        shift(is_tip, &point, Stiffening { shear: p[1], ..law }, p[0])
    };
    let bounds = vec![(1e4, 1e8), (1e-4, 1.0)];
    let model = with_differences(2, rod);
    let data = relative(&x, 1, &y).map_err(|e| format!("{}: {e}", form.what))?;
    let options = Options {
        cosine: COSINE,
        ..Options::default()
    };
    let method = LevenbergMarquardt::new(options).map_err(|e| e.to_string())?;
    let starts = Starts::at(&[1e6, 1e-2]);
    ParameterFit::search_by(method, form, &model, &data, bounds, &starts)
}

/// Deflection (nm) of a rod under the load of `point`; NaN without an equilibrium.
fn shift(is_tip: bool, point: &Point, law: Stiffening, cubic_pn: f64) -> f64 {
    let rod = RodModel::with_law(RodLaw::Laws(Box::new(laws(law, cubic_pn))));
    let segments = segments(point.length_nm, SEGMENT_NM);
    let specimen = Specimen::rod(point.length_nm, Some(segments), rod);
    let forces = [point.x];
    let found = if is_tip {
        let curve = bend_by_tip_force(&specimen, &forces, 0.0).ok();
        curve.and_then(|curve| Some(curve.points.first()?.deflection_nm))
    } else {
        let curve = shear_by_force(&specimen, &forces, 0.0).ok();
        curve.and_then(|curve| Some(curve.points.first()?.shift_nm))
    };
    found.unwrap_or(f64::NAN)
}
