//! One rod law for each group of columns.

use super::catalogue::{CATALOGUE, Group};
use super::column::Column;
use super::parameter_fit::Fault;
use super::search::{Basis, LawFit, rooted, sided, stiffened, stretched};
use super::table::FitData;
use super::twist::rms;
use super::{pictures, print, write};
use crate::ProgressSink;
use actin_cosserat::{StretchLaw, TwistStretch};
use actin_draw::report::write_csv;
use actin_fit::Model;
use actin_sim::{BendLaw, RodLaws, TwistLaw};
use std::path::Path;

/// Law fitted to the columns of a group.
pub(crate) struct GroupFit {
    pub(super) group: &'static Group,
    pub(super) column: Column,
    pub law: Box<dyn Fn(f64) -> f64>,
    pub basis: Basis,
    remark: Option<String>,
}

pub(crate) struct GroupFits {
    fits: Vec<GroupFit>,
    /// The value of `law:` in a scene. Parts without data keep the values of the material.
    pub(super) laws: RodLaws,
}

impl GroupFits {
    /// Fits all columns that are not empty.
    pub(super) fn new(data: &FitData) -> Result<Self, String> {
        let mut fits = Self {
            fits: Vec::new(),
            laws: RodLaws::default(),
        };
        if !data.rigidity.is_empty() {
            let LawFit { law, basis } = sided(&data.rigidity)?;
            fits.laws.twist = Some(TwistLaw::Sided(law));
            fits.add(0, &data.rigidity, basis, move |k| law.secant(k));
        }
        if !data.length.is_empty() {
            let LawFit { law, basis } = rooted(&data.length)?;
            fits.laws.twist_stretch = Some(TwistStretch::Rooted(law));
            fits.add(1, &data.length, basis, move |k| law.jet(k)[0]);
        }
        if !data.bend.is_empty() {
            let LawFit { law, basis } = stiffened(&data.bend)?;
            fits.laws.bend = Some(BendLaw::Stiffening(law));
            fits.add(2, &data.bend, basis, move |k| law.secant(k, 0.0));
        }
        if !data.stretch.is_empty() {
            let LawFit { law, basis } = stretched(&data.stretch)?;
            fits.laws.stretch = Some(law);
            fits.add(3, &data.stretch, basis, move |force| strain(law, force));
            if let (StretchLaw::Constant { rigidity }, Some(fit)) = (law, fits.fits.last_mut()) {
                fit.remark = Some(format!("  rigidity {rigidity:.5e} pN"));
            }
        }
        Ok(fits)
    }

    /// The fit of a group by its name.
    pub(crate) fn named(&self, name: &str) -> &GroupFit {
        let found = self.fits.iter().find(|fit| fit.group.name == name);
        found.expect("the data have values of the group")
    }

    /// Parameters that are undetermined or at a bound.
    pub(super) fn faults(&self) -> Vec<Fault> {
        let fits = self.fits.iter();
        fits.flat_map(|fit| fit.basis.faults()).collect()
    }

    pub(super) fn print(&self, tell: ProgressSink<'_>) {
        for fit in &self.fits {
            fit.print(tell);
        }
    }

    /// Writes the laws as RON, and each law with its data as CSV and SVG.
    pub(super) fn write(&self, out: &Path) -> Result<(), String> {
        write::law(&self.laws, "rod-law.ron", out)?;
        for fit in &self.fits {
            let rows = fit.column.pairs().map(|(x, value)| {
                let numbers = [x, value, (fit.law)(x)];
                numbers.map(write::number).to_vec()
            });
            let header = [&*fit.group.x, &fit.group.value, "law"];
            write_csv(out, &format!("{}.csv", fit.group.name), &header, rows)?;
            pictures::curve_with_data(fit, out)?;
        }
        Ok(())
    }

    fn add(
        &mut self,
        group: usize,
        column: &Column,
        basis: Basis,
        law: impl Fn(f64) -> f64 + 'static,
    ) {
        self.fits.push(GroupFit {
            group: &CATALOGUE.groups[group],
            column: column.clone(),
            law: Box::new(law),
            basis,
            remark: None,
        });
    }
}

impl GroupFit {
    /// Prints form, parameters and deviations.
    fn print(&self, tell: ProgressSink<'_>) {
        let (column, goodness) = (&self.column, self.basis.goodness());
        let weights = if column.is_known() {
            "weighted by their standard errors"
        } else {
            "without standard errors"
        };
        let formula = &self.group.formula;
        tell(format_args!(
            "\n{formula}, {} values {weights}",
            column.len()
        ));
        print::basis(tell, &self.basis);
        if let Some(remark) = &self.remark {
            tell(format_args!("{remark}"));
        }
        if column.is_known() {
            print::chi_squared(tell, goodness);
        }
        tell(format_args!(
            "  rms {:.3e}, largest {:.1e}",
            rms(column, &self.law, false),
            print::largest(column, &self.law, false)
        ));
        if self.group.is_rigidity {
            tell(format_args!(
                "  relative: rms {:.2} %, largest {:.1} %",
                100.0 * rms(column, &self.law, true),
                100.0 * print::largest(column, &self.law, true)
            ));
        }
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
