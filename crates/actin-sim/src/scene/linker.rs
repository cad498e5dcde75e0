//! Linkers, as a scene writes them, and the rules of their numbers.

use super::validate::{finite, non_negative, positive};
use super::{Problem, Scene};
use serde::{Deserialize, Serialize};

/// A Hookean linker between a site of the filament and an anchor outside of it.
///
/// Where it holds is said by arc length, distance from the axis and azimuth in the filament as
/// built, so that a scene means the same whichever model resolves the site. The anchor is given by
/// its place or by its displacement from the site: exactly one of the two.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Linker {
    /// Arc length of the site (nm).
    pub at_nm: f64,
    /// Distance of the site from the axis (nm).
    #[serde(default)]
    pub radius_nm: f64,
    /// Azimuth of the site in the filament as built; 0 is lab +x (deg).
    #[serde(default)]
    pub azimuth_deg: f64,
    /// Place of the anchor (nm, lab frame).
    #[serde(default)]
    pub anchor_nm: Option<[f64; 3]>,
    /// Place of the anchor from that of the site in the filament as built (nm, lab frame).
    #[serde(default)]
    pub displaced_nm: Option<[f64; 3]>,
    /// Stiffness (pN/nm).
    pub stiffness_pn_per_nm: f64,
    /// Rest length (nm).
    #[serde(default)]
    pub rest_length_nm: f64,
}

impl Linker {
    /// The key by which the anchor is given.
    pub(crate) fn anchor_key(&self) -> &'static str {
        if self.anchor_nm.is_some() {
            "anchor_nm"
        } else {
            "displaced_nm"
        }
    }
}

/// Checks linker `i` of a scene whose sections are known to be sound.
pub(super) fn check(scene: &Scene, i: usize, linker: &Linker) -> Result<(), Problem> {
    let key = |name: &str| format!("linkers[{i}].{name}");
    let length = scene
        .filament
        .sections
        .last()
        .map_or(0.0, |s| s.span_nm().1);
    if !(0.0..=length).contains(&linker.at_nm) {
        let rule = format!("must lie on the filament, from 0 to {length:?}");
        return Err(Problem::new(key("at_nm"), show(linker.at_nm), rule));
    }
    non_negative(&key("radius_nm"), linker.radius_nm)?;
    finite(&key("azimuth_deg"), linker.azimuth_deg)?;
    positive(&key("stiffness_pn_per_nm"), linker.stiffness_pn_per_nm)?;
    non_negative(&key("rest_length_nm"), linker.rest_length_nm)?;
    let place = match (linker.anchor_nm, linker.displaced_nm) {
        (Some(place), None) | (None, Some(place)) => place,
        (None, None) => {
            let rule = "has no anchor: write anchor_nm or displaced_nm";
            return Err(Problem::new(format!("linkers[{i}]"), "", rule));
        }
        (Some(_), Some(displaced)) => {
            let rule = "the anchor is given by anchor_nm already: write one of the two";
            return Err(Problem::new(key("displaced_nm"), show(displaced), rule));
        }
    };
    if place.iter().all(|v| v.is_finite()) {
        return Ok(());
    }
    Err(Problem::new(
        key(linker.anchor_key()),
        show(place),
        "must be finite",
    ))
}

fn show(value: impl std::fmt::Debug) -> String {
    format!("{value:?}")
}
