//! Crosslinkers and motors that bind to filaments and unbind from them.

use super::linkers_between::SITE_SPACING_NM;
use super::rules::{non_negative, positive};
use super::{
    Breaking, Filament, Forming, Kinetics, Linker, LinkerSite, Roaming, SceneProblem, Stepping,
};
use serde::{Deserialize, Serialize};

/// Default energy of the longest linker that forms, in units of kT at 298 K. Longer ones are 2e4 times
/// less probable.
const REACH_KT: f64 = 10.0;

/// Thermal energy at 298 K (pN nm).
const KT_PN_NM: f64 = 4.114;

const MOST: usize = 1_000_000;

/// Pool of crosslinkers or motors. Each has two hands, which bind to sites on the axes of filaments. It exerts a
/// force while both are bound to different filaments. Free crosslinkers are well mixed.
///
/// The resolved scene lists each crosslinker as a linker with `kinetics`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct Crosslinkers {
    /// Number of crosslinkers; from 1 to a million.
    pub count: usize,
    /// Stiffness; positive.
    pub stiffness_pn_per_nm: f64,
    /// Rest length; at least 0.
    #[serde(default)]
    pub rest_length_nm: f64,
    /// Rate at which a free crosslinker binds one hand to a random free site of all filaments; positive.
    pub attach_per_ns: f64,
    /// Rate at which the second hand binds to each free site of another filament within reach, without extension;
    /// positive. The rate decreases with the energy of the linker, see `Forming`.
    pub bind_per_ns: f64,
    /// Largest difference between the length at binding and the rest length; positive. By default the energy of the
    /// linker is 10 kT there.
    #[serde(default)]
    pub reach_nm: Option<f64>,
    /// Unbinding of each bound hand.
    pub unbinds: Breaking,
    /// Stepping of bound hands to the next site; by default hands do not step. The length of a step sets the
    /// distance of sites.
    #[serde(default)]
    pub steps: Option<Stepping>,
    /// Distance between neighbouring sites of a filament, for hands that do not step; positive. By default half the
    /// pitch of the long-pitch helix.
    #[serde(default)]
    pub site_spacing_nm: Option<f64>,
    /// Averaging time of forces, see `Kinetics`.
    #[serde(default)]
    pub averaging_ns: Option<f64>,
    /// Seed of the events.
    pub seed: u64,
}

impl Crosslinkers {
    /// Returns the linkers of pool `k` of a scene with these filaments.
    ///
    /// # Errors
    /// If a number breaks its rule.
    pub(super) fn linkers(
        &self,
        k: usize,
        filaments: &[Filament],
    ) -> Result<Vec<Linker>, SceneProblem> {
        self.check(k)?;
        let length = filaments.first().map_or(0.0, Filament::length_nm);
        let site = LinkerSite {
            filament: 0,
            at_nm: length,
            radius_nm: 0.0,
            azimuth_deg: 0.0,
        };
        let linker = Linker {
            filament: 0,
            at_nm: 0.0,
            radius_nm: 0.0,
            azimuth_deg: 0.0,
            to: Some(site),
            anchor_nm: None,
            displaced_nm: None,
            stiffness_pn_per_nm: self.stiffness_pn_per_nm,
            rest_length_nm: self.rest_length_nm,
            kinetics: Some(self.kinetics()),
        };
        Ok(vec![linker; self.count])
    }

    fn check(&self, k: usize) -> Result<(), SceneProblem> {
        let key = |name: &str| format!("crosslinkers[{k}].{name}");
        if !(1..=MOST).contains(&self.count) {
            let rule = format!("must be from 1 to {MOST}");
            return Err(SceneProblem::new(key("count"), self.count, rule));
        }
        positive(&key("stiffness_pn_per_nm"), self.stiffness_pn_per_nm)?;
        non_negative(&key("rest_length_nm"), self.rest_length_nm)?;
        positive(&key("attach_per_ns"), self.attach_per_ns)?;
        positive(&key("bind_per_ns"), self.bind_per_ns)?;
        if let (Some(spacing), Some(_)) = (self.site_spacing_nm, self.steps) {
            let rule = "the steps set the distance of sites: omit this key or steps";
            return Err(SceneProblem::new(key("site_spacing_nm"), spacing, rule));
        }
        Ok(())
    }

    fn kinetics(&self) -> Kinetics {
        let reach = (2.0 * REACH_KT * KT_PN_NM / self.stiffness_pn_per_nm).sqrt();
        let spacing = self
            .steps
            .map_or(SITE_SPACING_NM, |steps| steps.step_nm.abs());
        Kinetics {
            seed: self.seed,
            bound: false,
            breaks: Some(self.unbinds),
            forms: Some(Forming {
                rate_per_ns: self.bind_per_ns,
                reach_nm: self.reach_nm.unwrap_or(reach),
            }),
            steps: self.steps,
            averaging_ns: self.averaging_ns,
            roams: Some(Roaming {
                attach_per_ns: self.attach_per_ns,
                site_spacing_nm: self.site_spacing_nm.unwrap_or(spacing),
            }),
        }
    }
}
