//! Output of the fits: laws as RON for scenes, curves and data as CSV.

use super::bend::BendFits;
use super::groups::GroupFits;
use super::measured::{BendData, Point};
use super::pictures::curve_with_data;
use super::table::FitData;
use super::twist::TwistFits;
use actin_cosserat::{PolynomialStretch, TanhTwist, TwistStretch};
use actin_draw::report::{save, write_csv};
use actin_sim::{RodLaws, TwistLaw};
use std::fs;
use std::path::Path;

const CURVE: i32 = 400;

/// Writes `rod-law.ron`, the smallest forms, and `published-form.ron`, the refitted forms of the
/// paper. Both are values of `law:` in a scene's `RodModel`.
pub(super) fn laws(fits: &TwistFits, bend: Option<&BendFits>, out: &Path) -> Result<(), String> {
    let twist = fits.smallest.laws.clone();
    let smallest = RodLaws {
        twist: twist.twist,
        twist_stretch: twist.twist_stretch,
        ..bend.map(BendFits::laws).unwrap_or_default()
    };
    law(&smallest, "rod-law.ron", out)?;
    let published = RodLaws {
        twist: Some(TwistLaw::Tanh(fits.tanh_law(&fits.tanh.fit))),
        twist_stretch: Some(TwistStretch::Polynomial(
            fits.polynomial_law(&fits.without_offset),
        )),
        ..RodLaws::default()
    };
    law(&published, "published-form.ron", out)
}

/// Writes the laws of groups as RON, and each law with its data as CSV and SVG.
pub(super) fn groups(fits: &GroupFits, out: &Path) -> Result<(), String> {
    law(&fits.laws, "rod-law.ron", out)?;
    for fit in &fits.fits {
        let rows = fit.column.pairs().map(|(x, value)| {
            let numbers = [x, value, (fit.law)(x)];
            numbers.map(number).to_vec()
        });
        let header = [&*fit.group.x, &fit.group.value, "law"];
        write_csv(out, &format!("{}.csv", fit.group.name), &header, rows)?;
        curve_with_data(fit, out)?;
    }
    Ok(())
}

/// Writes a law in the format of scenes.
fn law(laws: &RodLaws, name: &str, out: &Path) -> Result<(), String> {
    let head = "// A rod law for a scene: `rod: RodModel(law: ...)`. Written by fit-parameters.\n";
    save(out, name, &format!("{head}{}\n", laws.to_ron()))
}

/// Writes `curves.csv`: all forms over the range of the data.
pub(super) fn curves(data: &FitData, fits: &TwistFits, out: &Path) -> Result<(), String> {
    let range = data.rigidity.range().max(data.length.range());
    let [tanh, relative] = [&fits.tanh, &fits.tanh_relative].map(|found| fits.tanh_law(&found.fit));
    let [sided, rooted] = ["twist", "length"].map(|name| &fits.smallest.named(name).law);
    let polynomial = fits.polynomial_law(&fits.polynomial);
    let (b3, xi) = (TanhTwist::published(), PolynomialStretch::published());
    let columns: [(&str, &dyn Fn(f64) -> f64); 8] = [
        ("kappa3_rad_per_nm", &|k| k),
        ("b3_published_pn_nm2", &|k| b3.secant(k)),
        ("b3_tanh_pn_nm2", &|k| tanh.secant(k)),
        ("b3_tanh_relative_pn_nm2", &|k| relative.secant(k)),
        ("b3_sided_pn_nm2", sided),
        ("dl_over_l_published", &|k| xi.extension(k)),
        ("dl_over_l_polynomial", &|k| polynomial.extension(k)),
        ("dl_over_l_rooted", rooted),
    ];
    let rows = (-CURVE..=CURVE).map(|i| {
        let k = range * f64::from(i) / f64::from(CURVE);
        columns.map(|(_, law)| number(law(k))).to_vec()
    });
    write_csv(out, "curves.csv", &columns.map(|(name, _)| name), rows)
}

fn number(x: f64) -> String {
    format!("{x:.8e}")
}

/// Writes `bend.csv` and `beams.csv`: measured values and the law.
pub(super) fn bend_csv(data: &BendData, fits: &BendFits, out: &Path) -> Result<(), String> {
    let bend = data.bend.iter().map(|p: &Point| {
        let law = fits.law.secant(p.x, 0.0);
        [p.x, p.mean, p.error, law].map(number).to_vec()
    });
    let header = [
        "curvature_rad_per_nm",
        "b_pn_nm2",
        "standard_error",
        "law_pn_nm2",
    ];
    write_csv(out, "bend.csv", &header, bend)?;
    let beams = fits.checks.iter().map(|row| row.map(number).to_vec());
    let header = ["length_nm", "force_pn", "rod_over_filament_less_1"];
    write_csv(out, "beams.csv", &header, beams)
}

pub(super) fn create(out: &Path) -> Result<(), String> {
    fs::create_dir_all(out).map_err(|e| format!("{}: {e}", out.display()))
}
