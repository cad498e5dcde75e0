//! Figure 9: fits of twisting rigidity and length as functions of twist.

use super::draft::Draft;
use super::expected::MeasuredRow;
use super::tables;
use crate::fit::{TwistData, TwistFits, UnfittedData, draw, rms};
use actin_cosserat::{PolynomialStretch, TanhTwist};
use actin_draw::report::{Origin, Picture, Row};

const PUBLISHED: &str = "published parameters, rows of the paper to 200 deg";
const REFITTED: &str = "published form, refitted to the same rows; not judged, because the minimum of the sum of \
    squares cannot exceed the published one";

pub(super) fn figure9(draft: &mut Draft<'_>) -> Result<(), String> {
    let data = TwistData::from_paper(false)?;
    let fits = TwistFits::new(&data)?;
    let [drawn, mean] = tables::monomers(draft)?;
    let beside = [(&drawn, true), (&mean, false)].map(|(data, dots)| UnfittedData { data, dots });
    let pictures = draw(&data, &fits, &beside, draft.out)?.into_iter();
    draft.pictures = pictures
        .map(|(file, caption)| Picture { file, caption })
        .collect();
    draft.settings = format!(
        "Least squares on {}; {} initial guesses for each nonlinear fit. For comparison, our filaments of Tables 3 \
         and 5: 64 sampled bonds per interface, and the mean filament.",
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

fn goodness(draft: &mut Draft<'_>, fits: &TwistFits) {
    let b3 = "pN nm^2";
    for (quantity, unit, rms, note) in [
        ("b3_rms/published", b3, fits.published_b3_rms[0], PUBLISHED),
        ("b3_rms/fitted", b3, fits.tanh.fit.goodness.rms, REFITTED),
        (
            "b3_rms/saturating",
            b3,
            fits.sided.1.fit.goodness.rms,
            "seven parameters, saturating in both directions, fitted with relative weights",
        ),
        ("xi_rms/published", "", fits.published_xi_rms[0], PUBLISHED),
        ("xi_rms/fitted", "", fits.polynomial.goodness.rms, REFITTED),
        (
            "xi_rms/without-offset",
            "",
            fits.without_offset.goodness.rms,
            "refitted with p_0 = 0, so that an untwisted rod keeps its length",
        ),
        (
            "xi_rms/two-slopes",
            "",
            fits.rooted.basis.goodness().rms,
            "four parameters, separate slopes in under-twist and over-twist",
        ),
    ] {
        draft.row(quantity, unit, rms, note);
    }
}

fn parameters(draft: &mut Draft<'_>, fits: &TwistFits) {
    let published = PolynomialStretch::published().coefficients;
    for (i, (&ours, paper)) in fits.polynomial.parameters.iter().zip(published).enumerate() {
        let note = "numbered from 1 in the paper; tolerance: effect of the rounding of its rows";
        let row = Row::measured(draft.id, format!("p/{i}"), "nm^i", ours, note);
        draft.compared(
            row.with_paper_value(paper, fits.rounding_error(i))
                .with_origin(Origin::Derived),
        );
    }
    for (&ours, i) in fits.without_offset.parameters.iter().zip(1..) {
        draft.row(format!("p/without-offset/{i}"), "nm^i", ours, "p_0 = 0");
    }
    let fit = &fits.tanh.fit;
    let published = TanhTwist::published().lambda;
    for ((&ours, paper), i) in fit.parameters.iter().zip(published).zip(1..) {
        let unit = if i == 3 { "" } else { "rad/nm" };
        let note = "not judged, because other parameters fit the rows better";
        let row = Row::measured(draft.id, format!("lambda/{i}"), unit, ours, note);
        let row = Row {
            standard_error: fit.precision.standard_error(i - 1),
            ..row.with_reference(paper, Origin::Derived)
        };
        draft.rows.push(MeasuredRow { row, sd: 0.0 });
    }
}

/// Rows of the differences of our monomers from rows and laws of the paper.
fn monomer_rows(draft: &mut Draft<'_>, name: &str, ours: &TwistData, paper: &TwistData) {
    // Both columns contain the curvatures of the paper in the same order.
    let differences = |ours: &[f64], theirs: &[f64]| {
        crate::statistics::rms(ours.iter().zip(theirs).map(|(a, b)| a - b))
    };
    let (b3, xi) = (TanhTwist::published(), PolynomialStretch::published());
    let (rows, law) = ("the rows of the paper", "the published law");
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
