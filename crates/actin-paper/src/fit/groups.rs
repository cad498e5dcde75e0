//! One rod law for each group of columns.

use super::catalogue::{CATALOGUE, Group};
use super::column::Column;
use super::parameter_fit::Fault;
use super::search::{Basis, LawFit, rooted, sided, stiffened, stretched};
use super::table::FitData;
use actin_cosserat::{StretchLaw, TwistStretch};
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
            let law = fits.add(0, &data.rigidity, sided(&data.rigidity)?);
            fits.laws.twist = Some(TwistLaw::Sided(law));
        }
        if !data.length.is_empty() {
            let law = fits.add(1, &data.length, rooted(&data.length)?);
            fits.laws.twist_stretch = Some(TwistStretch::Rooted(law));
        }
        if !data.bend.is_empty() {
            let law = fits.add(2, &data.bend, stiffened(&data.bend)?);
            fits.laws.bend = Some(BendLaw::Stiffening(law));
        }
        if !data.stretch.is_empty() {
            let law = fits.add(3, &data.stretch, stretched(&data.stretch)?);
            fits.laws.stretch = Some(law);
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

    fn add<L: Copy + 'static>(&mut self, group: usize, column: &Column, fit: LawFit<L>) -> L {
        let LawFit { law, value, basis } = fit;
        self.fits.push(GroupFit {
            group: &CATALOGUE.groups[group],
            column: column.clone(),
            law: Box::new(move |x| value(&law, x)),
            basis,
            remark: None,
        });
        law
    }
}
