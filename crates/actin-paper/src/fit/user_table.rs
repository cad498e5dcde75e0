//! Fits of a user's table: one rod law for each group of columns.

use super::column::Column;
use super::parameter_fit::{self, Fault, ParameterFit};
use super::pictures::{self, LawCurve};
use super::search::{LawFit, rooted, sided, stiffened, stretched};
use super::table::Table;
use super::twist::rms;
use super::{print, write};
use crate::ProgressSink;
use actin_cosserat::{RootedStretch, SidedTwist, Stiffening, StretchLaw, TwistStretch};
use actin_draw::report::write_csv;
use actin_fit::{Goodness, Model};
use actin_sim::{BendLaw, RodLaws, TwistLaw};
use std::path::Path;

#[derive(Clone, Debug)]
pub(super) struct UserTableFits {
    twist: Option<(SidedTwist, ParameterFit)>,
    length: Option<LawFit<RootedStretch>>,
    bend: Option<LawFit<Stiffening>>,
    stretch: Option<LawFit<StretchLaw>>,
}

/// Reads, fits, prints and writes.
pub(super) fn run(
    path: &Path,
    allowed: &[String],
    out: &Path,
    tell: ProgressSink<'_>,
) -> Result<(), String> {
    let table = Table::from_csv(path)?;
    let fits = UserTableFits::new(&table)?;
    fits.print(tell, &table);
    parameter_fit::accept(&fits.faults(), allowed)?;
    write::create(out)?;
    write::law(&fits.laws(), "rod-law.ron", out)?;
    for curve in fits.curves(&table) {
        let rows = curve.data.pairs().map(|(x, value)| {
            [x, value, (curve.law)(x)]
                .map(|x| format!("{x:.8e}"))
                .to_vec()
        });
        let header = [curve.x_label, curve.y_label, "law"];
        write_csv(out, &format!("{}.csv", curve.name), &header, rows)?;
        pictures::curve_with_data(&curve, out)?;
    }
    Ok(())
}

/// Fits a column; `None` if it is empty.
fn fit<L>(
    column: &Column,
    fit: impl FnOnce(&Column) -> Result<L, String>,
) -> Result<Option<L>, String> {
    (!column.is_empty()).then(|| fit(column)).transpose()
}

impl UserTableFits {
    pub(super) fn new(table: &Table) -> Result<Self, String> {
        Ok(Self {
            twist: fit(&table.rigidity, sided)?,
            length: fit(&table.length, rooted)?,
            bend: fit(&table.bend, stiffened)?,
            stretch: fit(&table.stretch, stretched)?,
        })
    }

    /// Parameters that are undetermined or at a bound.
    pub(super) fn faults(&self) -> Vec<Fault> {
        let twist = self.twist.iter().flat_map(|(_, found)| found.faults());
        let length = self.length.iter().flat_map(|fit| fit.basis.faults());
        let bend = self.bend.iter().flat_map(|fit| fit.basis.faults());
        let stretch = self.stretch.iter().flat_map(|fit| fit.basis.faults());
        twist.chain(length).chain(bend).chain(stretch).collect()
    }

    /// The value of `law:` in a scene. Parts without data keep the values of the material.
    pub(super) fn laws(&self) -> RodLaws {
        RodLaws {
            twist: self.twist.as_ref().map(|(law, _)| TwistLaw::Sided(*law)),
            twist_stretch: self
                .length
                .as_ref()
                .map(|fit| TwistStretch::Rooted(fit.law)),
            bend: self.bend.as_ref().map(|fit| BendLaw::Stiffening(fit.law)),
            stretch: self.stretch.as_ref().map(|fit| fit.law),
            ..RodLaws::default()
        }
    }

    fn print(&self, tell: ProgressSink<'_>, table: &Table) {
        tell(format_args!("data: {}", table.source));
        if let Some((law, found)) = &self.twist {
            let form = "B3 = rest + rise k^2/(k^2 + slow |k| + half^2)";
            head(tell, form, &table.rigidity);
            print::nonlinear(tell, found, None);
            quality(tell, &table.rigidity, &found.fit.goodness, |k| {
                law.secant(k)
            });
        }
        if let Some(LawFit { law, basis }) = &self.length {
            let form = "dL/L = slope k - bend (sqrt(k^2 + half^2) - half) + cubic k^3";
            head(tell, form, &table.length);
            print::basis(tell, basis);
            quality(tell, &table.length, basis.goodness(), |k| law.jet(k)[0]);
        }
        if let Some(LawFit { law, basis }) = &self.bend {
            let form = "B = rest + rise q/(1 + q), q = k^2/curvature^2";
            head(tell, form, &table.bend);
            print::basis(tell, basis);
            quality(tell, &table.bend, basis.goodness(), |k| law.secant(k, 0.0));
        }
        if let Some(LawFit { law, basis }) = &self.stretch {
            head(
                tell,
                "strain of a force, with one rigidity or two",
                &table.stretch,
            );
            print::basis(tell, basis);
            if let StretchLaw::Constant { rigidity } = law {
                tell(format_args!("  rigidity {rigidity:.5e} pN"));
            }
            quality(tell, &table.stretch, basis.goodness(), |f| strain(*law, f));
        }
    }

    pub(super) fn curves<'a>(&'a self, table: &'a Table) -> Vec<LawCurve<'a>> {
        let mut curves = Vec::new();
        let mut add = |name, title, labels: [&'static str; 2], data, law| {
            curves.push(LawCurve {
                name,
                title,
                x_label: labels[0],
                y_label: labels[1],
                data,
                law,
            });
        };
        if let Some((law, _)) = &self.twist {
            let labels = ["kappa3_rad_per_nm", "b3_pn_nm2"];
            let law = Box::new(|k| law.secant(k));
            add("twist", "Twisting rigidity", labels, &table.rigidity, law);
        }
        if let Some(LawFit { law, .. }) = &self.length {
            let labels = ["kappa3_rad_per_nm", "dl_over_l"];
            let law = Box::new(|k| law.jet(k)[0]);
            add("length", "Change of length", labels, &table.length, law);
        }
        if let Some(LawFit { law, .. }) = &self.bend {
            let labels = ["curvature_rad_per_nm", "b_pn_nm2"];
            let law = Box::new(|k| law.secant(k, 0.0));
            add("bend", "Bending rigidity", labels, &table.bend, law);
        }
        if let Some(LawFit { law, .. }) = &self.stretch {
            let labels = ["force_pn", "strain"];
            let law = Box::new(|f| strain(*law, f));
            add("stretch", "Strain", labels, &table.stretch, law);
        }
        curves
    }
}

fn strain(law: StretchLaw, force: f64) -> f64 {
    match law {
        StretchLaw::Constant { rigidity } => force / rigidity,
        StretchLaw::Sided {
            tension,
            compression,
            width,
        } => super::forms::Stretched.value(&[force], &[tension, compression, width]),
    }
}

fn head(tell: ProgressSink<'_>, form: &str, column: &Column) {
    let weights = if column.is_known() {
        "weighted by their standard errors"
    } else {
        "without standard errors"
    };
    tell(format_args!("\n{form}, {} values {weights}", column.len()));
}

/// Prints the deviations of a law from its data.
fn quality(tell: ProgressSink<'_>, column: &Column, goodness: &Goodness, law: impl Fn(f64) -> f64) {
    if column.is_known() {
        print::chi_squared(tell, goodness);
    }
    tell(format_args!(
        "  rms {:.3e}, largest {:.1e}",
        rms(column, &law, false),
        print::largest(column, &law, false)
    ));
}
