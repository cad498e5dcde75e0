//! Forms of the fits and columns of a user's table, in `data/fits.ron`.

use serde::Deserialize;
use std::sync::LazyLock;

#[derive(Debug, Deserialize)]
pub(super) struct Catalogue {
    pub forms: Vec<Form>,
    /// In the order of the columns of [`super::FitData`].
    pub groups: [Group; 4],
}

/// Names of the parameters of a form (keys of `--allow-bounds`) and units.
#[derive(Debug, Deserialize, PartialEq)]
pub(super) struct Form {
    /// Name of the fitted quantity.
    pub what: String,
    pub parameters: Vec<(String, String)>,
}

/// Columns that belong together, and their law.
#[derive(Debug, Deserialize)]
pub(super) struct Group {
    pub x: String,
    pub value: String,
    pub error: String,
    /// `true` if values must be positive.
    pub is_rigidity: bool,
    /// Stem of file names.
    pub name: String,
    pub title: String,
    pub formula: String,
}

pub(super) static CATALOGUE: LazyLock<Catalogue> = LazyLock::new(|| {
    actin_sim::read_ron(include_str!("../../data/fits.ron"), "Catalogue")
        .expect("`data/fits.ron` is well formed")
});

impl Form {
    /// The form of a fitted quantity.
    pub(super) fn of(what: &str) -> &'static Self {
        let found = CATALOGUE.forms.iter().find(|form| form.what == what);
        found.expect("`data/fits.ron` has all forms of the fits")
    }
}
