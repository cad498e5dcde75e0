//! What was measured: the rows behind the advice, one for each scene and setting.
//!
//! `measured.csv` is `advice.csv` as `cargo xtask tradeoff` writes it; errors are relative, rms over
//! azimuths of the lattice, against the same filament with every monomer resolved.

use super::FilamentSetting;
use crate::scene::{JunctionWeight, RodLaw};
use serde::{Deserialize, Serialize};

/// The table, as committed.
const MEASURED: &str = include_str!("measured.csv");

/// One setting of one scene, as measured.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// The scene: a name of [`scenes`](super::scenes).
    pub scene: String,
    /// Stretches of monomers (nm), such as `0-40+120-160.2`; empty for a pure rod.
    pub monomers_nm: String,
    /// The rod's law: `Constant`, `PublishedExtension`, `Fitted` or `Homogenised`.
    pub law: String,
    /// Length of segments (nm).
    pub segment_nm: f64,
    /// Bonds per interface.
    pub bonds: usize,
    /// `Shared` or `Full`.
    pub weight: String,
    /// Monomers that a junction attaches to.
    pub attached: usize,
    /// Azimuths of the lattice.
    pub azimuths: usize,
    /// Error of the displacement.
    pub displacement: Option<f64>,
    /// Error of the elastic energy.
    pub energy: Option<f64>,
    /// Error of the force at an end or of the linkers.
    pub force: Option<f64>,
    /// Error of the torque at an end or of the linkers.
    pub torque: Option<f64>,
    /// Error of curvature or twist about the site of interest.
    pub local: Option<f64>,
    /// Scatter of the displacement over samplings of 64 drawn bonds, fully resolved: sd over mean.
    pub scatter: Option<f64>,
}

impl Measured {
    /// The setting of the row; `None` of a table that is not well formed.
    pub fn setting(&self) -> Option<FilamentSetting> {
        let stretch = |text: &str| {
            let (from, to) = text.split_once('-')?;
            Some([from.parse().ok()?, to.parse().ok()?])
        };
        let stretches = self.monomers_nm.split('+').filter(|text| !text.is_empty());
        Some(FilamentSetting {
            monomers: stretches.map(stretch).collect::<Option<_>>()?,
            law: law(&self.law)?,
            segment_nm: self.segment_nm,
            bonds: self.bonds,
            weight: match self.weight.as_str() {
                "Shared" => JunctionWeight::Shared,
                "Full" => JunctionWeight::Full,
                _ => return None,
            },
            attached: self.attached,
            rigid_segments: false,
        })
    }
}

/// The laws of the table, by name.
fn law(name: &str) -> Option<RodLaw> {
    LAWS.iter()
        .find(|known| known.0 == name)
        .map(|known| (known.1)())
}

/// A law and its name.
type NamedLaw = (&'static str, fn() -> RodLaw);

const LAWS: [NamedLaw; 4] = [
    ("Constant", || RodLaw::Constant),
    ("PublishedExtension", || RodLaw::PublishedExtension),
    ("Fitted", || RodLaw::Fitted),
    ("Homogenised", || RodLaw::Homogenised),
];

/// The name of a law in the table.
pub fn law_name(law: &RodLaw) -> &'static str {
    let known = LAWS.iter().find(|known| (known.1)() == *law);
    known.map_or("Laws", |known| known.0)
}

/// Stretches of monomers as the table writes them.
pub fn stretches(monomers: &[[f64; 2]]) -> String {
    let each: Vec<String> = monomers.iter().map(|[a, b]| format!("{a}-{b}")).collect();
    each.join("+")
}

/// Reads a table.
///
/// # Errors
/// A column that is missing or no number.
pub fn read(text: &str) -> Result<Vec<Measured>, csv::Error> {
    csv::Reader::from_reader(text.as_bytes())
        .deserialize()
        .collect()
}

/// The committed table.
///
/// # Panics
/// Never: a test reads it.
pub fn measured() -> Vec<Measured> {
    read(MEASURED).expect("a test reads it")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every row is well formed, of a known scene, and resolves to something that is accepted.
    #[test]
    fn the_table_is_sound() {
        let scenes = super::super::scenes::all();
        let rows = measured();
        assert!(!rows.is_empty());
        for row in rows {
            let (_, scene) = scenes.iter().find(|(name, _)| *name == row.scene).unwrap();
            let setting = row.setting().unwrap();
            assert_eq!(stretches(&setting.monomers), row.monomers_nm);
            setting.apply(scene).validate().unwrap();
            let errors = [
                row.displacement,
                row.energy,
                row.force,
                row.torque,
                row.local,
            ];
            for error in errors.into_iter().flatten() {
                assert!(error.is_finite() && error >= 0.0, "{row:?}");
            }
        }
    }
}
