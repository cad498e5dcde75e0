//! Figure 9: how twisting rigidity and length depend on twist, fitted.

use super::bounds::CROSS_CHECK;
use super::{Run, tables};
use crate::fit::{Beside, TwistData, TwistFits, draw, rms};
use actin_cosserat::{PolynomialStretch, TanhTwist};
use actin_draw::report::{Artefact, Origin, Picture, Row};
use std::time::Instant;

const ID: &str = "fig9";
/// Root mean square that the published parameters of B3 leave (pN nm^2), by an earlier calculation.
const PUBLISHED_B3_RMS: &str = "349";

/// Fits the paper's rows and draws data, published and fitted curves.
pub(super) fn reproduce(run: Run<'_>) -> Result<Artefact, String> {
    let started = Instant::now();
    let data = TwistData::from_paper(false)?;
    let fits = TwistFits::new(&data)?;
    let [drawn, mean] = tables::monomers(run)?;
    let beside = [(&drawn, true), (&mean, false)].map(|(data, dots)| Beside { data, dots });
    let pictures = draw(&data, &fits, &beside, run.out)?;
    let pictures = pictures.into_iter();
    let pictures = pictures.map(|(file, caption)| Picture { file, caption });
    let mut rows = rigidity_rows(&fits);
    rows.extend(length_rows(&fits));
    rows.extend(polynomial_rows(&fits));
    rows.extend(lambda_rows(&fits));
    for (name, ours) in [("monomers", &drawn), ("mean-filament", &mean)] {
        rows.extend(monomer_rows(name, ours, &data));
    }
    Ok(Artefact {
        id: ID,
        title: "Twisting rigidity and change of length against twist, fitted",
        settings: format!(
            "Least squares on {}; {} starts for each nonlinear fit. Beside them our own filaments of \
             Tables 3 and 5: 64 drawn bonds per interface, and the mean filament.",
            data.source,
            fits.tanh.fit.starts.len()
        ),
        rows,
        pictures: pictures.collect(),
        views: Vec::new(),
        wall_s: started.elapsed().as_secs_f64(),
    })
}

const PUBLISHED: &str = "published parameters on the paper's rows to 200 deg";
const REFITTED: &str = "the published form, refitted to the same rows; not judged, since the least of all sums \
    of squares is no larger than the published one";

fn rigidity_rows(fits: &TwistFits) -> Vec<Row> {
    let b3 = "pN nm^2";
    vec![
        Row::measured(
            ID,
            "b3_rms/published",
            b3,
            fits.published_b3_rms[0],
            format!("{CROSS_CHECK}; {PUBLISHED}"),
        )
        .against_printed(PUBLISHED_B3_RMS, 0.0)
        .of(Origin::CrossCheck),
        Row::measured(
            ID,
            "b3_rms/fitted",
            b3,
            fits.tanh.fit.goodness.rms,
            REFITTED,
        ),
        Row::measured(
            ID,
            "b3_rms/saturating",
            b3,
            fits.sided.1.fit.goodness.rms,
            "seven parameters, saturating to either side, fitted with relative weights",
        ),
    ]
}

fn length_rows(fits: &TwistFits) -> Vec<Row> {
    vec![
        Row::measured(
            ID,
            "xi_rms/published",
            "",
            fits.published_xi_rms[0],
            PUBLISHED,
        ),
        Row::measured(
            ID,
            "xi_rms/fitted",
            "",
            fits.polynomial.goodness.rms,
            REFITTED,
        ),
        Row::measured(
            ID,
            "xi_rms/without-offset",
            "",
            fits.without_offset.goodness.rms,
            "the same with p_0 = 0: a rod at rest keeps its length",
        ),
        Row::measured(
            ID,
            "xi_rms/two-slopes",
            "",
            fits.rooted.basis.goodness().rms,
            "four parameters, one slope on either side of rest",
        ),
    ]
}

fn polynomial_rows(fits: &TwistFits) -> Vec<Row> {
    let published = PolynomialStretch::published().coefficients;
    let pairs = fits.polynomial.parameters.iter().zip(published).enumerate();
    let with = pairs.map(|(i, (&ours, paper))| {
        let note = "the paper counts from 1; a difference within the rounding of its rows passes";
        Row::measured(ID, format!("p/{i}"), "nm^i", ours, note)
            .against(paper, fits.rounding_error(i))
            .of(Origin::Derived)
    });
    let free = fits.without_offset.parameters.iter().zip(1..);
    let free = free.map(|(&ours, i)| {
        Row::measured(ID, format!("p/without-offset/{i}"), "nm^i", ours, "p_0 = 0")
    });
    with.chain(free).collect()
}

fn lambda_rows(fits: &TwistFits) -> Vec<Row> {
    let published = TanhTwist::published().lambda;
    let fit = &fits.tanh.fit;
    let ours = fit.parameters.iter().zip(published).zip(1..);
    let rows = ours.map(|((&ours, paper), i)| {
        let row = Row::measured(
            ID,
            format!("lambda/{i}"),
            if i == 3 { "" } else { "rad/nm" },
            ours,
            "the refitted form meets the rows better with other parameters; no verdict",
        );
        Row {
            standard_error: fit.precision.standard_error(i - 1),
            ..row.beside(paper, Origin::Derived)
        }
    });
    rows.collect()
}

/// How far our own monomers are from the paper's rows, and from its laws.
fn monomer_rows(name: &str, ours: &TwistData, paper: &TwistData) -> Vec<Row> {
    let of = &ours.source;
    let row = |quantity: &str, unit, value, from: &str| {
        let note = format!("{of}; root mean square difference from {from}, to 200 deg");
        Row::measured(ID, format!("{name}/{quantity}"), unit, value, note)
    };
    // Both columns hold the paper's curvatures in the same order.
    let differences = |ours: &[f64], theirs: &[f64]| {
        let squares = ours.iter().zip(theirs).map(|(a, b)| (a - b).powi(2));
        (squares.sum::<f64>() / ours.len() as f64).sqrt()
    };
    let (b3, xi) = (TanhTwist::published(), PolynomialStretch::published());
    let (rows, law) = ("the paper's rows", "the published law");
    let b3_rows = differences(&ours.rigidity.value, &paper.rigidity.value);
    let b3_law = rms(&ours.rigidity, |k| b3.secant(k), false);
    let xi_rows = differences(&ours.length.value, &paper.length.value);
    let xi_law = rms(&ours.length, |k| xi.extension(k), false);
    vec![
        row("b3_rms", "pN nm^2", b3_rows, rows),
        row("b3_rms/published", "pN nm^2", b3_law, law),
        row("xi_rms", "", xi_rows, rows),
        row("xi_rms/published", "", xi_law, law),
    ]
}
