//! Fits of rod laws to columns. Bounds and starts scale with the data. A simpler form is used if it
//! fits the data as well.

use super::catalogue::{CATALOGUE, Form};
use super::column::{Column, Weight};
use super::forms::LawForm;
use super::parameter_fit::{Fault, ParameterFit};
use actin_cosserat::{RootedStretch, SidedTwist, Stiffening, StretchLaw};
use actin_fit::{Data, Goodness, LinearFit, Mat, Noise, Starts, fit_linear};

/// Number of random starts of each search, and their seed.
pub(super) const STARTS: (usize, u64) = (200, 20_220_304);
/// Fewest values on each side for a law with two sides.
const FEWEST: usize = 3;
/// Probability of a chance improvement below which the form with two more parameters is used.
const CHANCE: f64 = 1e-3;
/// Relative residual below which a form fits to rounding.
const ROUNDING: f64 = 1e-12;

/// A law with its fit.
#[derive(Clone, Debug)]
pub(crate) struct LawFit<L> {
    pub law: L,
    /// Value of the law at an argument.
    pub(super) value: fn(&L, f64) -> f64,
    pub basis: Basis,
}

/// The fit of a law.
#[derive(Clone, Debug)]
pub(crate) enum Basis {
    /// Full form.
    Full(ParameterFit),
    /// Form with two parameters fewer that fits the data as well.
    Simple {
        /// Reason for the simpler form.
        note: &'static str,
        names: &'static [&'static str],
        fit: LinearFit,
    },
}

impl Basis {
    pub(crate) fn goodness(&self) -> &Goodness {
        match self {
            Self::Full(found) => &found.fit.goodness,
            Self::Simple { fit, .. } => &fit.goodness,
        }
    }

    /// Parameters that are undetermined or at a bound.
    pub(super) fn faults(&self) -> Vec<Fault> {
        match self {
            Self::Full(found) => found.faults(),
            Self::Simple { .. } => Vec::new(),
        }
    }
}

/// Fits B3 against twist with a rise on each side; needs three values on each side.
pub(super) fn sided(column: &Column) -> Result<LawFit<SidedTwist>, String> {
    let form = Form::of("B3 against twist");
    for (side, sign) in [("under", -1.0), ("over", 1.0)] {
        let count = column.on_side(sign);
        if count < FEWEST {
            return Err(format!(
                "{}: {count} values of {side}-twist, at least {FEWEST} are needed",
                form.what
            ));
        }
    }
    let data = observed(form, column, Weight::Relative)?;
    let (most, range) = (column.largest(), column.range());
    let side = [
        (1e-3 * most, 20.0 * most),
        (2e-3 * range, 5.0 * range),
        (0.0, 5.0 * range),
    ];
    let bounds = [&[(0.0, most)][..], &side, &side].concat();
    let rise = |sign| (column.at_end(sign) - column.at_rest()).max(0.1 * most);
    let (under, over, scale) = (rise(-1.0), rise(1.0), 0.25 * range);
    let start = [column.at_rest(), under, scale, scale, over, scale, scale];
    full(form, &LawForm::sided(range), &data, bounds, start)
}

/// Fits length against twist with two slopes and a cubic term, or one slope and a cubic term.
pub(super) fn rooted(column: &Column) -> Result<LawFit<RootedStretch>, String> {
    let form = Form::of("length against twist");
    let data = observed(form, column, Weight::Equal)?;
    let range = column.range();
    let model = LawForm::rooted(range);
    let fit = linear(form, &data, &[1, 3])?;
    let (straight, cubic) = (fit.parameters[0], fit.parameters[1]);
    let simple = LawFit {
        law: (model.law)(&[straight, 0.0, range, cubic]),
        value: model.value,
        basis: Basis::Simple {
            note: "one slope fits as well as two",
            names: &["slope (nm)", "cubic (nm^3)"],
            fit,
        },
    };
    unless_simple(&data, simple, || {
        let slope = column.largest() / range;
        let heights = (-20.0 * slope, 20.0 * slope);
        let cube = 20.0 * slope / (range * range);
        let bounds = vec![heights, heights, (2e-3 * range, 2.0 * range), (-cube, cube)];
        let straight = straight.clamp(heights.0, heights.1);
        full(
            form,
            &model,
            &data,
            bounds,
            [straight, slope, range / 7.0, 0.0],
        )
    })
}

/// Fits B against curvature: a rise from `rest`, or a constant. Softening is an error.
pub(super) fn stiffened(column: &Column) -> Result<LawFit<Stiffening>, String> {
    let form = Form::of("B against curvature");
    let data = observed(form, column, Weight::Relative)?;
    let (most, range) = (column.largest(), column.range());
    let model = LawForm::stiffened(range);
    let constant = linear(form, &data, &[0])?;
    let simple = LawFit {
        law: (model.law)(&[constant.parameters[0], 0.0, range]),
        value: model.value,
        basis: Basis::Simple {
            note: "a constant fits as well as a rise",
            names: &["B (pN nm^2)"],
            fit: constant,
        },
    };
    let chosen = unless_simple(&data, simple, || {
        // The search includes negative rises, so that softening data are refused and not fitted by
        // a constant.
        let bounds = vec![
            (1e-3 * most, 2.0 * most),
            (-0.999 * most, 20.0 * most),
            (2e-3 * range, 5.0 * range),
        ];
        let rest = column.at_rest();
        let start = [rest, (most - rest).max(0.05 * most), 0.2 * range];
        full(form, &model, &data, bounds, start)
    })?;
    let refused = |e| format!("{}: {e}: no law softens", form.what);
    chosen.law.validate().map_err(refused)?;
    Ok(chosen)
}

/// Fits strain against force with one rigidity for each side, or one for both. A strain that
/// opposes its force is an error.
pub(super) fn stretched(column: &Column) -> Result<LawFit<StretchLaw>, String> {
    let form = Form::of("strain against force");
    let data = observed(form, column, Weight::Equal)?;
    let model = LawForm::stretched();
    let constant = linear(form, &data, &[1])?;
    let rigidity = constant.parameters[0].recip();
    if !(rigidity > 0.0 && rigidity.is_finite()) {
        let what = &form.what;
        return Err(format!(
            "{what}: strain must grow with force, tension being positive"
        ));
    }
    let has_sides = [-1.0, 1.0].map(|sign| column.on_side(sign) >= FEWEST) == [true; 2];
    let simple = LawFit {
        law: StretchLaw::Constant { rigidity },
        value: model.value,
        basis: Basis::Simple {
            note: ONE_RIGIDITY[usize::from(has_sides)],
            names: &["strain per force (1/pN)"],
            fit: constant,
        },
    };
    if !has_sides {
        return Ok(simple);
    }
    unless_simple(&data, simple, || {
        let most = column.largest();
        let sides = (1e-2 * rigidity, 1e2 * rigidity);
        let bounds = vec![sides, sides, (1e-3 * most, 2.0 * most)];
        full(
            form,
            &model,
            &data,
            bounds,
            [rigidity, rigidity, 0.1 * most],
        )
    })
}

/// Reasons for one rigidity: too few values on one side, or an equally good fit.
const ONE_RIGIDITY: [&str; 2] = [
    "one rigidity: two need three values on each side",
    "one rigidity fits both sides as well as two",
];

/// Returns an error if a key is not a parameter of a search.
pub(super) fn check_keys(keys: &[String]) -> Result<(), String> {
    let known = CATALOGUE.forms.iter().flat_map(|form| &form.parameters);
    let known: Vec<&str> = known.map(|(key, _)| key.as_str()).collect();
    match keys.iter().find(|key| !known.contains(&key.as_str())) {
        None => Ok(()),
        Some(key) => Err(format!(
            "--allow-bounds {key}: unknown parameter; known: {}",
            known.join(", ")
        )),
    }
}

fn observed(form: &Form, column: &Column, weight: Weight) -> Result<Data, String> {
    let data = column.observed(weight);
    data.map_err(|e| format!("{}: {e}", form.what))
}

/// Linear fit of powers of the variable.
fn linear(form: &Form, data: &Data, powers: &[i32]) -> Result<LinearFit, String> {
    let power = |i: usize, j: usize| data.row(i)[0].powi(powers[j]);
    let design = Mat::from_fn(data.len(), powers.len(), power);
    let fit = fit_linear(design.as_ref(), data.observations());
    fit.map_err(|e| format!("{}: {e}", form.what))
}

/// Searches the parameters of a form, from `start` and from random starts.
fn full<L, const N: usize>(
    form: &'static Form,
    model: &LawForm<L, N>,
    data: &Data,
    bounds: Vec<(f64, f64)>,
    start: [f64; N],
) -> Result<LawFit<L>, String> {
    let starts = Starts::at(&start).and_random(STARTS.0, STARTS.1);
    let found = ParameterFit::search(form, model, data, bounds, &starts)?;
    Ok(LawFit {
        law: (model.law)(&found.fit.parameters),
        value: model.value,
        basis: Basis::Full(found),
    })
}

/// Fits the full form, with two more parameters. Keeps the simple form if it fits to rounding or if
/// the improvement is explained by chance.
fn unless_simple<L>(
    data: &Data,
    simple: LawFit<L>,
    full: impl FnOnce() -> Result<LawFit<L>, String>,
) -> Result<LawFit<L>, String> {
    let Basis::Simple { names, .. } = &simple.basis else {
        return Ok(simple);
    };
    let observations = data.observations();
    let scaled = observations.values().iter().zip(observations.deviations());
    let size: f64 = scaled.map(|(y, s)| (y / s).powi(2)).sum();
    let parameters = names.len() + 2;
    let before = simple.basis.goodness().chi_squared;
    if before <= ROUNDING.powi(2) * size || data.len() <= parameters {
        return Ok(simple);
    }
    let found = full()?;
    let after = found.basis.goodness().chi_squared;
    let freedom = (data.len() - parameters) as f64;
    // Tail probability of chi squared with 2 degrees of freedom, or of F with 2 and `freedom`.
    let chance = match observations.noise() {
        Noise::Known => (-0.5 * (before - after)).exp(),
        Noise::Unknown | Noise::Relative => (after / before).powf(0.5 * freedom),
    };
    Ok(if chance < CHANCE { found } else { simple })
}
