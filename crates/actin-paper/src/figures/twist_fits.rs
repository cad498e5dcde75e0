//! Figure 9: fits of twisting rigidity and length as functions of twist.

use super::draft::Draft;
use super::tables;
use crate::fit::{FitData, TwistFits, UnfittedData, draw};
use crate::statistics::rms;
use actin_cosserat::{PolynomialStretch, TanhTwist};
use actin_draw::report::{Origin, Picture, Row};

pub(super) fn figure9(draft: &mut Draft<'_>) -> Result<(), String> {
    let data = FitData::from_paper(false);
    let fits = TwistFits::new(&data)?;
    let [drawn, mean] = tables::monomers(draft)?;
    let beside = [(&drawn, true), (&mean, false)].map(|(data, dots)| UnfittedData { data, dots });
    let pictures = draw(&data, &fits, &beside, draft.out)?.into_iter();
    draft.pictures = pictures
        .map(|(file, caption)| Picture { file, caption })
        .collect();
    let starts = fits.tanh.fit.starts.len();
    draft.describe("fig9", &[("source", &data.source), ("starts", &starts)])?;
    goodness(draft, &fits);
    parameters(draft, &fits);
    for (name, ours) in [("monomers", &drawn), ("mean-filament", &mean)] {
        monomer_rows(draft, name, ours, &data);
    }
    Ok(())
}

/// Rows of the residuals of all fits, with notes in `data/expected.csv`.
fn goodness(draft: &mut Draft<'_>, fits: &TwistFits) {
    let b3 = "pN nm^2";
    let smallest = |name| fits.smallest.named(name).basis.goodness().rms;
    for (quantity, unit, rms) in [
        ("b3_rms/published", b3, fits.published_b3_rms[0]),
        ("b3_rms/fitted", b3, fits.tanh.fit.goodness.rms),
        ("b3_rms/saturating", b3, smallest("twist")),
        ("xi_rms/published", "", fits.published_xi_rms[0]),
        ("xi_rms/fitted", "", fits.polynomial.goodness.rms),
        (
            "xi_rms/without-offset",
            "",
            fits.without_offset.goodness.rms,
        ),
        ("xi_rms/two-slopes", "", smallest("length")),
    ] {
        draft.row(quantity, unit, rms, "");
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
        draft.compared(Row {
            standard_error: fit.precision.standard_error(i - 1),
            ..row.with_reference(paper, Origin::Derived)
        });
    }
}

/// Rows of the differences of our monomers from rows and laws of the paper.
fn monomer_rows(draft: &mut Draft<'_>, name: &str, ours: &FitData, paper: &FitData) {
    // Both columns contain the curvatures of the paper in the same order.
    let differences =
        |ours: &[f64], theirs: &[f64]| rms(ours.iter().zip(theirs).map(|(a, b)| a - b));
    let (b3, xi) = (TanhTwist::published(), PolynomialStretch::published());
    let (rows, law) = ("the rows of the paper", "the published law");
    let b3_rows = differences(&ours.rigidity.value, &paper.rigidity.value);
    let xi_rows = differences(&ours.length.value, &paper.length.value);
    let b3_law = ours.rigidity.rms(|k| b3.secant(k), false);
    let xi_law = ours.length.rms(|k| xi.extension(k), false);
    for (quantity, unit, value, from) in [
        ("b3_rms", "pN nm^2", b3_rows, rows),
        ("b3_rms/published", "pN nm^2", b3_law, law),
        ("xi_rms", "", xi_rows, rows),
        ("xi_rms/published", "", xi_law, law),
    ] {
        let note = format!(
            "{}; root mean square difference from {from}, to 200 deg",
            ours.source
        );
        draft.row(format!("{name}/{quantity}"), unit, value, note);
    }
}
