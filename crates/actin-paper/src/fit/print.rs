//! Printed results of the fits.

use super::bend::BendFits;
use super::groups::{GroupFit, GroupFits};
use super::measured::BendData;
use super::parameter_fit::ParameterFit;
use super::search::Basis;
use super::table::FitData;
use super::twist::TwistFits;
use crate::ProgressSink;
use actin_cosserat::{PolynomialStretch, TanhTwist};
use actin_fit::{LinearFit, Precision, Status};

/// Relative difference of chi squared below which two starts found the same minimum.
const SAME: f64 = 1e-6;

pub(super) fn twist(tell: ProgressSink<'_>, data: &FitData, fits: &TwistFits) {
    tell(format_args!("data: {}", data.source));
    length(tell, data, fits);
    rigidity(tell, data, fits);
    groups(tell, &fits.smallest);
}

fn length(tell: ProgressSink<'_>, data: &FitData, fits: &TwistFits) {
    let xi = &data.length;
    tell(format_args!(
        "\nxi - 1 = sum p_i kappa^i, {} values",
        xi.value.len()
    ));
    let published = PolynomialStretch::published().coefficients;
    polynomial(tell, &fits.polynomial, &published);
    tell(format_args!(
        "  rms of the published p_i: {:.3e}, without p_0 {:.3e}",
        fits.published_xi_rms[0], fits.published_xi_rms[1]
    ));
    tell(format_args!("\nthe same without p_0"));
    polynomial(tell, &fits.without_offset, &published[1..]);
}

fn rigidity(tell: ProgressSink<'_>, data: &FitData, fits: &TwistFits) {
    let b3 = &data.rigidity;
    tell(format_args!(
        "\nB3, published form, {} values, equal weights",
        b3.value.len()
    ));
    let published = TanhTwist::published();
    nonlinear(tell, &fits.tanh, Some(&published.lambda));
    tell(format_args!(
        "  rms {:.1} pN nm^2; of the published lambda {:.1} ({:.1} % relative)",
        fits.tanh.fit.goodness.rms,
        fits.published_b3_rms[0],
        100.0 * fits.published_b3_rms[1]
    ));
    tell(format_args!("\nB3, published form, relative weights"));
    nonlinear(tell, &fits.tanh_relative, Some(&published.lambda));
    let relative =
        |found: &ParameterFit| 100.0 * b3.rms(|k| fits.tanh_law(&found.fit).secant(k), true);
    tell(format_args!(
        "  rms {:.2} % relative (equal weights: {:.2} %)",
        relative(&fits.tanh_relative),
        relative(&fits.tanh)
    ));
}

/// Prints form, parameters and deviations of all groups.
pub(super) fn groups(tell: ProgressSink<'_>, fits: &GroupFits) {
    for fit in &fits.fits {
        group(tell, fit);
    }
}

fn group(tell: ProgressSink<'_>, fit: &GroupFit) {
    let (column, law) = (&fit.column, &fit.law);
    let weights = match (column.is_known(), fit.group.is_rigidity) {
        (true, _) => "weighted by their standard errors",
        (false, true) => "with relative weights",
        (false, false) => "with equal weights",
    };
    let (formula, count) = (&fit.group.formula, column.len());
    tell(format_args!("\n{formula}, {count} values {weights}"));
    basis(tell, &fit.basis);
    if let Some(remark) = &fit.remark {
        tell(format_args!("{remark}"));
    }
    if column.is_known() {
        let goodness = fit.basis.goodness();
        let (chi_squared, freedom) = (goodness.chi_squared, goodness.degrees_of_freedom);
        tell(format_args!(
            "  chi^2 = {chi_squared:.4} for {freedom} degrees of freedom; errors follow the given standard errors"
        ));
    }
    let (rms, largest) = (column.rms(law, false), column.largest_error(law, false));
    tell(format_args!("  rms {rms:.3e}, largest {largest:.1e}"));
    if fit.group.is_rigidity {
        let [rms, largest] = [column.rms(law, true), column.largest_error(law, true)];
        tell(format_args!(
            "  relative: rms {:.2} %, largest {:.1} %",
            100.0 * rms,
            100.0 * largest
        ));
    }
}

pub(super) fn bend(tell: ProgressSink<'_>, data: &BendData, fits: &BendFits) {
    tell(format_args!(
        "\nB = rest + rise q/(1 + q), q = k^2/k0^2, {} values",
        data.bend.len()
    ));
    basis(tell, &fits.bend.basis);
    tell(format_args!("  twist in q: {} values", data.twisted.len()));
    nonlinear(tell, &fits.twist, None);
    tell(format_args!(
        "  shear in q, and cubic: {} tips and guided ends",
        fits.checks.len()
    ));
    nonlinear(tell, &fits.shear, None);
    tell(format_args!(
        "  stretching rigidity against axial force, turn blocked:"
    ));
    for p in &data.stretch {
        tell(format_args!(
            "    {:7.1} pN: {:.0} +- {:.0} pN",
            p.x, p.mean, p.error
        ));
    }
    tell(format_args!(
        "  the law takes the mean in tension, {:.0} pN",
        fits.stretch_pn
    ));
    tell(format_args!("  rods of this law against the filaments:"));
    for [length, force, share] in &fits.checks {
        tell(format_args!(
            "    {length:6.1} nm, {force:6.3} pN: {:+.2} %",
            100.0 * share
        ));
    }
}

fn polynomial(tell: ProgressSink<'_>, fit: &LinearFit, published: &[f64]) {
    let first = 7 - published.len();
    for (j, (value, theirs)) in fit.parameters.iter().zip(published).enumerate() {
        let theirs = format!(", published {theirs:13.5e}");
        let name = format!("p_{}", j + first);
        parameter(tell, &name, *value, (&fit.precision, j), &theirs);
    }
    tell(format_args!(
        "  rms {:.3e}, rank {}, condition {:.1e}",
        fit.goodness.rms, fit.precision.rank, fit.precision.condition
    ));
}

/// Prints parameter `j` of a fit with its standard error.
fn parameter(
    tell: ProgressSink<'_>,
    name: &str,
    value: f64,
    (precision, j): (&Precision, usize),
    rest: &str,
) {
    let error = precision.standard_error(j);
    let error = error.map_or_else(|| "   -   ".into(), |e| format!("{e:7.1e}"));
    tell(format_args!("  {name:24} = {value:13.5e} +- {error}{rest}"));
}

fn basis(tell: ProgressSink<'_>, basis: &Basis) {
    match basis {
        Basis::Full(found) => nonlinear(tell, found, None),
        Basis::Simple { note, names, fit } => {
            tell(format_args!("  {note}"));
            for (j, (name, value)) in names.iter().zip(&fit.parameters).enumerate() {
                parameter(tell, name, *value, (&fit.precision, j), "");
            }
        }
    }
}

fn nonlinear(tell: ProgressSink<'_>, found: &ParameterFit, published: Option<&[f64]>) {
    let (fit, parameters) = (&found.fit, &found.form.parameters);
    for (j, ((key, unit), value)) in parameters.iter().zip(&fit.parameters).enumerate() {
        let theirs = published.map_or_else(String::new, |p| format!(", published {:11.4e}", p[j]));
        let status = match fit.statuses[j] {
            Status::Determined => "",
            Status::Weak => ", WEAK: standard error exceeds the width of its bounds",
            Status::Undetermined => ", NOT DETERMINED by the data",
            Status::AtLowerBound => ", AT ITS LOWER BOUND",
            Status::AtUpperBound => ", AT ITS UPPER BOUND",
            Status::Held => ", held",
        };
        let rest = format!(" {unit}{theirs}{status}");
        parameter(tell, key, *value, (&fit.precision, j), &rest);
    }
    let keys: Vec<&str> = parameters.iter().map(|(key, _)| key.as_str()).collect();
    tell(format_args!(
        "  largest correlation {}",
        strongest(&fit.precision, &keys)
    ));
    let converged = fit.starts.iter().filter(|s| s.ending.is_converged());
    let converged = converged.count();
    tell(format_args!(
        "  {} of {} starts found this minimum, {converged} converged; condition {:.1e}",
        fit.agreeing_starts(SAME),
        fit.starts.len(),
        fit.precision.condition
    ));
}

/// The two parameters with the largest correlation.
fn strongest(precision: &Precision, names: &[&str]) -> String {
    let correlation = precision.correlation();
    let pairs = (0..names.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
    let size = |pair: &(usize, usize)| correlation[*pair].abs();
    let strongest = pairs.max_by(|a, b| size(a).total_cmp(&size(b)));
    match strongest.filter(|pair| size(pair) > 0.0) {
        Some((i, j)) => format!("{:+.3} ({}, {})", correlation[(i, j)], names[j], names[i]),
        None => "none".into(),
    }
}
