//! Fits of rod laws to columns. Bounds and starts scale with the data. A simpler form is used if it
//! fits the data as well.

use super::catalogue::{CATALOGUE, Form};
use super::column::{Column, Weight};
use super::forms::{Rooted, Sided, Stiffened, Stretched};
use super::parameter_fit::{Fault, ParameterFit};
use actin_cosserat::{RootedStretch, SidedTwist, Stiffening, StretchLaw};
use actin_fit::{Data, FitError, Goodness, LinearFit, Mat, Noise, Starts, fit_linear};

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
    let rest = (0.0, most);
    let bounds = std::iter::once(rest).chain(side).chain(side).collect();
    let rise = |sign| (column.at_end(sign) - column.at_rest()).max(0.1 * most);
    let scale = 0.25 * range;
    let start = [
        column.at_rest(),
        rise(-1.0),
        scale,
        scale,
        rise(1.0),
        scale,
        scale,
    ];
    let starts = Starts::at(&start).and_random(STARTS.0, STARTS.1);
    let model = Sided { range };
    let found = ParameterFit::search(form, &model, &data, bounds, &starts)?;
    Ok(LawFit {
        law: model.law(&found.fit.parameters),
        basis: Basis::Full(found),
    })
}

/// Fits length against twist with two slopes and a cubic term, or one slope and a cubic term.
pub(super) fn rooted(column: &Column) -> Result<LawFit<RootedStretch>, String> {
    let form = Form::of("length against twist");
    let data = observed(form, column, Weight::Equal)?;
    let range = column.range();
    let design = Mat::from_fn(data.len(), 2, |i, j| data.row(i)[0].powi([1, 3][j]));
    let straight = simple(form, fit_linear(design.as_ref(), data.observations()))?;
    let slope = column.largest() / range;
    let full = || {
        let heights = (-20.0 * slope, 20.0 * slope);
        let cube = 20.0 * slope / (range * range);
        let bounds = vec![heights, heights, (2e-3 * range, 2.0 * range), (-cube, cube)];
        let start = [
            straight.parameters[0].clamp(heights.0, heights.1),
            slope,
            range / 7.0,
            0.0,
        ];
        let starts = Starts::at(&start).and_random(STARTS.0, STARTS.1);
        ParameterFit::search(form, &Rooted { range }, &data, bounds, &starts)
    };
    if let Some(found) = unless_simple(&data, &straight, full)? {
        let law = Rooted { range }.law(&found.fit.parameters);
        let basis = Basis::Full(found);
        return Ok(LawFit { law, basis });
    }
    let law = RootedStretch {
        slope: straight.parameters[0],
        bend: 0.0,
        half: range,
        cubic: straight.parameters[1],
        range,
    };
    let basis = Basis::Simple {
        note: "one slope fits as well as two",
        names: &["slope (nm)", "cubic (nm^3)"],
        fit: straight,
    };
    Ok(LawFit { law, basis })
}

/// Fits B against curvature: a rise from `rest`, or a constant. Softening is an error.
pub(super) fn stiffened(column: &Column) -> Result<LawFit<Stiffening>, String> {
    let form = Form::of("B against curvature");
    let data = observed(form, column, Weight::Relative)?;
    let (most, range) = (column.largest(), column.range());
    let ones = Mat::full(data.len(), 1, 1.0);
    let constant = simple(form, fit_linear(ones.as_ref(), data.observations()))?;
    let full = || {
        // The search includes negative rises, so that softening data are refused and not fitted by
        // a constant.
        let bounds = vec![
            (1e-3 * most, 2.0 * most),
            (-0.999 * most, 20.0 * most),
            (2e-3 * range, 5.0 * range),
        ];
        let rest = column.at_rest();
        let start = [rest, (most - rest).max(0.05 * most), 0.2 * range];
        let starts = Starts::at(&start).and_random(STARTS.0, STARTS.1);
        ParameterFit::search(form, &Stiffened { range }, &data, bounds, &starts)
    };
    let chosen = match unless_simple(&data, &constant, full)? {
        Some(found) => LawFit {
            law: Stiffened { range }.law(&found.fit.parameters),
            basis: Basis::Full(found),
        },
        None => LawFit {
            law: Stiffened { range }.law(&[constant.parameters[0], 0.0, range]),
            basis: Basis::Simple {
                note: "a constant fits as well as a rise",
                names: &["B (pN nm^2)"],
                fit: constant,
            },
        },
    };
    let refused = |e| format!("{}: {e}: no law softens", form.what);
    chosen.law.validate().map_err(refused)?;
    Ok(chosen)
}

/// Fits strain against force with one rigidity for each side, or one for both. A strain that
/// opposes its force is an error.
pub(super) fn stretched(column: &Column) -> Result<LawFit<StretchLaw>, String> {
    let form = Form::of("strain against force");
    let data = observed(form, column, Weight::Equal)?;
    let forces = Mat::from_fn(data.len(), 1, |i, _| data.row(i)[0]);
    let constant = simple(form, fit_linear(forces.as_ref(), data.observations()))?;
    let rigidity = constant.parameters[0].recip();
    if !(rigidity > 0.0 && rigidity.is_finite()) {
        let what = &form.what;
        return Err(format!(
            "{what}: strain must grow with force, tension being positive"
        ));
    }
    let full = || {
        let most = column.largest();
        let sides = (1e-2 * rigidity, 1e2 * rigidity);
        let bounds = vec![sides, sides, (1e-3 * most, 2.0 * most)];
        let starts = Starts::at(&[rigidity, rigidity, 0.1 * most]).and_random(STARTS.0, STARTS.1);
        ParameterFit::search(form, &Stretched, &data, bounds, &starts)
    };
    let has_sides = [-1.0, 1.0].map(|sign| column.on_side(sign) >= FEWEST) == [true; 2];
    let found = if has_sides {
        unless_simple(&data, &constant, full)?
    } else {
        None
    };
    Ok(match found {
        Some(found) => LawFit {
            law: Stretched::law(&found.fit.parameters),
            basis: Basis::Full(found),
        },
        None => LawFit {
            law: StretchLaw::Constant { rigidity },
            basis: Basis::Simple {
                note: ONE_RIGIDITY[usize::from(has_sides)],
                names: &["strain per force (1/pN)"],
                fit: constant,
            },
        },
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

fn simple(form: &Form, fit: Result<LinearFit, FitError>) -> Result<LinearFit, String> {
    fit.map_err(|e| format!("{}: {e}", form.what))
}

/// Fits the full form, with two more parameters. Returns `None` if the simple form fits to rounding
/// or if the improvement is explained by chance.
fn unless_simple(
    data: &Data,
    simple: &LinearFit,
    full: impl FnOnce() -> Result<ParameterFit, String>,
) -> Result<Option<ParameterFit>, String> {
    let observations = data.observations();
    let scaled = observations.values().iter().zip(observations.deviations());
    let size: f64 = scaled.map(|(y, s)| (y / s).powi(2)).sum();
    let parameters = simple.parameters.len() + 2;
    if simple.goodness.chi_squared <= ROUNDING.powi(2) * size || data.len() <= parameters {
        return Ok(None);
    }
    let found = full()?;
    let [before, after] = [&simple.goodness, &found.fit.goodness].map(|g| g.chi_squared);
    let freedom = (data.len() - parameters) as f64;
    // Tail probability of chi squared with 2 degrees of freedom, or of F with 2 and `freedom`.
    let chance = match observations.noise() {
        Noise::Known => (-0.5 * (before - after)).exp(),
        Noise::Unknown | Noise::Relative => (after / before).powf(0.5 * freedom),
    };
    Ok((chance < CHANCE).then_some(found))
}
