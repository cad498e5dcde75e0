//! What the fits say, as text.

use super::bend::BendFits;
use super::column::Column;
use super::data::TwistData;
use super::found::Found;
use super::measured::BendData;
use super::search::Basis;
use super::twist::{TwistFits, rms};
use actin_cosserat::{PolynomialStretch, TanhTwist};
use actin_fit::{Goodness, LinearFit, Precision, Status};

/// Agreement of chi squared that counts starts as having found the same minimum.
const SAME: f64 = 1e-6;

/// Fits of B3 and xi.
pub(super) fn twist(data: &TwistData, fits: &TwistFits) {
    println!("data: {}", data.source);
    length(data, fits);
    rigidity(data, fits);
}

fn length(data: &TwistData, fits: &TwistFits) {
    let xi = &data.length;
    println!("\nxi - 1 = sum p_i kappa^i, {} values", xi.value.len());
    let published = PolynomialStretch::published().coefficients;
    polynomial(&fits.polynomial, &published);
    println!(
        "  rms of the published p_i: {:.3e}, without p_0 {:.3e}",
        fits.published_xi_rms[0], fits.published_xi_rms[1]
    );
    println!("\nthe same without p_0");
    polynomial(&fits.without_offset, &published[1..]);
    println!("\nxi - 1 = slope k - bend (sqrt(k^2 + half^2) - half) + cubic k^3");
    basis(&fits.rooted.basis);
    let law = fits.rooted.law;
    println!(
        "  rms {:.3e}, largest {:.1e}",
        fits.rooted.basis.goodness().rms,
        largest(xi, |k| law.jet(k)[0], false)
    );
}

fn rigidity(data: &TwistData, fits: &TwistFits) {
    let b3 = &data.rigidity;

    println!(
        "\nB3, published form, {} values, equal weights",
        b3.value.len()
    );
    let published = TanhTwist::published();
    nonlinear(&fits.tanh, Some(&published.lambda));
    println!(
        "  rms {:.1} pN nm^2; of the published lambda {:.1} ({:.1} % relative)",
        fits.tanh.fit.goodness.rms,
        fits.published_b3_rms[0],
        100.0 * fits.published_b3_rms[1]
    );
    println!("\nB3, published form, relative weights");
    nonlinear(&fits.tanh_relative, Some(&published.lambda));
    let relative = |found: &Found| 100.0 * rms(b3, |k| fits.tanh_law(&found.fit).secant(k), true);
    println!(
        "  rms {:.2} % relative (equal weights: {:.2} %)",
        relative(&fits.tanh_relative),
        relative(&fits.tanh)
    );
    saturating(data, fits);
}

fn saturating(data: &TwistData, fits: &TwistFits) {
    let b3 = &data.rigidity;
    println!("\nB3 = rest + rise k^2/(k^2 + slow |k| + half^2), relative weights");
    nonlinear(&fits.sided.1, None);
    let law = fits.sided.0;
    println!(
        "  rms {:.2} % relative, largest {:.1} %; {:.1} pN nm^2",
        100.0 * rms(b3, |k| law.secant(k), true),
        100.0 * largest(b3, |k| law.secant(k), true),
        rms(b3, |k| law.secant(k), false)
    );
}

/// Largest difference, or relative difference, of `law` and a column.
pub(super) fn largest(column: &Column, law: impl Fn(f64) -> f64, relative: bool) -> f64 {
    let differences = column.pairs().map(|(k, value)| {
        let scale = if relative { value } else { 1.0 };
        ((law(k) - value) / scale).abs()
    });
    differences.fold(0.0, f64::max)
}

/// Fits of bending and shear.
pub(super) fn bend(data: &BendData, fits: &BendFits) {
    println!(
        "\nB = rest + rise q/(1 + q), q = k^2/k0^2, {} values",
        data.bend.len()
    );
    basis(&fits.bend.basis);
    println!("  twist in q: {} values", data.twisted.len());
    nonlinear(&fits.twist, None);
    println!(
        "  shear in q, and cubic: {} tips and guided ends",
        fits.checks.len()
    );
    nonlinear(&fits.shear, None);
    println!("  stretching rigidity against axial force, turn blocked:");
    for p in &data.stretch {
        println!("    {:7.1} pN: {:.0} +- {:.0} pN", p.x, p.mean, p.error);
    }
    println!(
        "  the law takes the mean in tension, {:.0} pN",
        fits.stretch_pn
    );
    println!("  rods of this law against the filaments:");
    for [length, force, share] in &fits.checks {
        println!(
            "    {length:6.1} nm, {force:6.3} pN: {:+.2} %",
            100.0 * share
        );
    }
}

fn polynomial(fit: &LinearFit, published: &[f64]) {
    let first = 7 - published.len();
    for (j, (value, theirs)) in fit.parameters.iter().zip(published).enumerate() {
        let error = standard_error(&fit.precision, j);
        println!(
            "  p_{} = {value:13.5e} +- {error}, published {theirs:13.5e}",
            j + first
        );
    }
    println!(
        "  rms {:.3e}, rank {}, condition {:.1e}",
        fit.goodness.rms, fit.precision.rank, fit.precision.condition
    );
}

fn standard_error(precision: &Precision, j: usize) -> String {
    precision
        .standard_error(j)
        .map_or_else(|| "   -   ".into(), |e| format!("{e:7.1e}"))
}

/// The fit behind a law.
pub(super) fn basis(basis: &Basis) {
    match basis {
        Basis::Full(found) => nonlinear(found, None),
        Basis::Simple { note, names, fit } => {
            println!("  {note}");
            for (j, (name, value)) in names.iter().zip(&fit.parameters).enumerate() {
                let error = standard_error(&fit.precision, j);
                println!("  {name:24} = {value:12.5e} +- {error}");
            }
        }
    }
}

/// Chi squared of values with standard errors.
pub(super) fn chi_squared(goodness: &Goodness) {
    let freedom = goodness.degrees_of_freedom;
    println!(
        "  chi^2 = {:.4} for {freedom} degrees of freedom; errors are those of the given ones",
        goodness.chi_squared
    );
}

pub(super) fn nonlinear(found: &Found, published: Option<&[f64]>) {
    let (fit, parameters) = (&found.fit, found.form.parameters);
    for (j, ((key, unit), value)) in parameters.iter().zip(&fit.parameters).enumerate() {
        let error = standard_error(&fit.precision, j);
        let theirs = published.map_or_else(String::new, |p| format!(", published {:11.4e}", p[j]));
        let status = match fit.statuses[j] {
            Status::Determined => "",
            Status::Weak => ", WEAK: known worse than its bounds",
            Status::Undetermined => ", NOT DETERMINED by the data",
            Status::AtLowerBound => ", AT ITS LOWER BOUND",
            Status::AtUpperBound => ", AT ITS UPPER BOUND",
            Status::Held => ", held",
        };
        println!("  {key:18} = {value:12.5e} +- {error} {unit}{theirs}{status}");
    }
    let keys: Vec<&str> = parameters.iter().map(|(key, _)| *key).collect();
    println!("  largest correlation {}", strongest(&fit.precision, &keys));
    let converged = fit
        .starts
        .iter()
        .filter(|s| s.ending.is_converged())
        .count();
    println!(
        "  {} of {} starts found this minimum, {converged} converged; condition {:.1e}",
        fit.agreeing_starts(SAME),
        fit.starts.len(),
        fit.precision.condition
    );
}

/// The two parameters that the data tell apart worst.
fn strongest(precision: &Precision, names: &[&str]) -> String {
    let correlation = precision.correlation();
    let mut worst = (0.0_f64, 0, 0);
    for i in 0..names.len() {
        for j in 0..i {
            if correlation[(i, j)].abs() > worst.0.abs() {
                worst = (correlation[(i, j)], i, j);
            }
        }
    }
    match worst {
        (0.0, ..) => "none".into(),
        (value, i, j) => format!("{value:+.3} ({}, {})", names[j], names[i]),
    }
}
