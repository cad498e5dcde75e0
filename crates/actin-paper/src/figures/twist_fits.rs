//! Figure 9: how twisting rigidity and length depend on twist, fitted.

use super::draft::{Draft, Measured};
use super::tables;
use crate::fit::{Beside, TwistData, TwistFits, draw, rms};
use actin_cosserat::{PolynomialStretch, TanhTwist};
use actin_draw::report::{Origin, Picture, Row};

const PUBLISHED: &str = "published parameters on the paper's rows to 200 deg";
const REFITTED: &str = "the published form, refitted to the same rows; not judged, since the least of all sums of \
    squares is no larger than the published one";

/// Fits the paper's rows and draws data, published and fitted curves.
pub(super) fn figure9(draft: &mut Draft<'_>) -> Result<(), String> {
    let data = TwistData::from_paper(false)?;
    let fits = TwistFits::new(&data)?;
    let [drawn, mean] = tables::monomers(draft)?;
    let beside = [(&drawn, true), (&mean, false)].map(|(data, dots)| Beside { data, dots });
    let pictures = draw(&data, &fits, &beside, draft.out)?.into_iter();
    draft.pictures = pictures
        .map(|(file, caption)| Picture { file, caption })
        .collect();
    draft.settings = format!(
        "Least squares on {}; {} starts for each nonlinear fit. For comparison our own filaments of Tables 3 and 5: \
         64 drawn bonds per interface, and the mean filament.",
        data.source,
        fits.tanh.fit.starts.len()
    );
    goodness(draft, &fits);
    parameters(draft, &fits);
    for (name, ours) in [("monomers", &drawn), ("mean-filament", &mean)] {
        monomer_rows(draft, name, ours, &data);
    }
    Ok(())
}

/// Root mean squares of all fits.
fn goodness(draft: &mut Draft<'_>, fits: &TwistFits) {
    let b3 = "pN nm^2";
    for (quantity, unit, rms, note) in [
        ("b3_rms/published", b3, fits.published_b3_rms[0], PUBLISHED),
        ("b3_rms/fitted", b3, fits.tanh.fit.goodness.rms, REFITTED),
        (
            "b3_rms/saturating",
            b3,
            fits.sided.1.fit.goodness.rms,
            "seven parameters, saturating to either side, fitted with relative weights",
        ),
        ("xi_rms/published", "", fits.published_xi_rms[0], PUBLISHED),
        ("xi_rms/fitted", "", fits.polynomial.goodness.rms, REFITTED),
        (
            "xi_rms/without-offset",
            "",
            fits.without_offset.goodness.rms,
            "the same with p_0 = 0: a rod at rest keeps its length",
        ),
        (
            "xi_rms/two-slopes",
            "",
            fits.rooted.basis.goodness().rms,
            "four parameters, one slope on either side of rest",
        ),
    ] {
        draft.row(quantity, unit, rms, note);
    }
}

fn parameters(draft: &mut Draft<'_>, fits: &TwistFits) {
    let published = PolynomialStretch::published().coefficients;
    for (i, (&ours, paper)) in fits.polynomial.parameters.iter().zip(published).enumerate() {
        let note = "the paper counts from 1; a difference within the rounding of its rows passes";
        let row = Row::measured(draft.id, format!("p/{i}"), "nm^i", ours, note);
        draft.compared(
            row.against(paper, fits.rounding_error(i))
                .of(Origin::Derived),
        );
    }
    for (&ours, i) in fits.without_offset.parameters.iter().zip(1..) {
        draft.row(format!("p/without-offset/{i}"), "nm^i", ours, "p_0 = 0");
    }
    let fit = &fits.tanh.fit;
    let published = TanhTwist::published().lambda;
    for ((&ours, paper), i) in fit.parameters.iter().zip(published).zip(1..) {
        let unit = if i == 3 { "" } else { "rad/nm" };
        let note = "the refitted form meets the rows better with other parameters; no verdict";
        let row = Row::measured(draft.id, format!("lambda/{i}"), unit, ours, note);
        let row = Row {
            standard_error: fit.precision.standard_error(i - 1),
            ..row.beside(paper, Origin::Derived)
        };
        draft.rows.push(Measured { row, sd: 0.0 });
    }
}

/// Differences of our own monomers from the paper's rows and from its laws.
fn monomer_rows(draft: &mut Draft<'_>, name: &str, ours: &TwistData, paper: &TwistData) {
    // Both columns hold the paper's curvatures in the same order.
    let differences = |ours: &[f64], theirs: &[f64]| {
        crate::statistics::rms(ours.iter().zip(theirs).map(|(a, b)| a - b))
    };
    let (b3, xi) = (TanhTwist::published(), PolynomialStretch::published());
    let (rows, law) = ("the paper's rows", "the published law");
    for (quantity, unit, value, from) in [
        (
            "b3_rms",
            "pN nm^2",
            differences(&ours.rigidity.value, &paper.rigidity.value),
            rows,
        ),
        (
            "b3_rms/published",
            "pN nm^2",
            rms(&ours.rigidity, |k| b3.secant(k), false),
            law,
        ),
        (
            "xi_rms",
            "",
            differences(&ours.length.value, &paper.length.value),
            rows,
        ),
        (
            "xi_rms/published",
            "",
            rms(&ours.length, |k| xi.extension(k), false),
            law,
        ),
    ] {
        let note = format!(
            "{}; root mean square difference from {from}, to 200 deg",
            ours.source
        );
        draft.row(format!("{name}/{quantity}"), unit, value, note);
    }
}
