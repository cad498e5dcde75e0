//! One rod law for each group of columns.

use super::catalogue::{CATALOGUE, Group};
use super::column::Column;
use super::parameter_fit::Fault;
use super::search::{Basis, LawFit, rooted, sided, stiffened, stretched};
use super::table::FitData;
use actin_cosserat::{StretchLaw, TwistStretch};
use actin_fit::Model;
use actin_sim::{BendLaw, RodLaws, TwistLaw};

/// Law fitted to the columns of a group.
pub(crate) struct GroupFit {
    pub(super) group: &'static Group,
    pub(super) column: Column,
    pub law: Box<dyn Fn(f64) -> f64>,
    pub basis: Basis,
    /// Line with the value of a single stretching rigidity.
    pub(super) remark: Option<String>,
}

pub(crate) struct GroupFits {
    pub(super) fits: Vec<GroupFit>,
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
