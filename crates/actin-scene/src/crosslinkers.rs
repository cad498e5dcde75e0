//! Crosslinkers and motors that bind to filaments and unbind from them.

use super::linkers_between::{MOST_SITES, SITE_SPACING_NM};
use super::{
    Breaking, Filament, Forming, Kinetics, Linker, LinkerSite, Roaming, SceneProblem, Stepping,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Default energy of the longest linker that forms, in units of kT at 298 K. Longer ones are 2e4 times
/// less probable.
const REACH_KT: f64 = 10.0;

/// Thermal energy at 298 K (pN nm).
const KT_PN_NM: f64 = 4.114;

const MOST: usize = 1_000_000;

/// Pool of crosslinkers or motors. Each has two hands, which bind to sites of filaments. It exerts a force while both
/// are bound to different filaments. Free crosslinkers are well mixed. A site holds one hand of the pools with the same
/// sites.
///
/// In a scene in memory, each crosslinker is a linker with `kinetics`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct Crosslinkers {
    /// Number of crosslinkers; from 1 to a million.
    pub count: usize,
    /// Stiffness; positive.
    pub stiffness_pn_per_nm: f64,
    /// Rest length; at least 0.
    #[serde(default)]
    pub rest_length_nm: f64,
    /// Rate at which a free crosslinker binds one hand to a random site of all filaments, if that is free; positive.
    pub attach_per_ns: f64,
    /// Rate at which the second hand binds to each free site of another filament within reach, without extension;
    /// positive. The rate decreases with the energy of the linker, see `Roaming`.
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
    /// Distance of sites from the axis; at least 0. With a distance, each site has the azimuth of the nearest monomer:
    /// sites follow the helix, and crosslinkers transmit torsion.
    #[serde(default)]
    pub radius_nm: f64,
    /// Stiffness `k` against tilt at both ends: the energy of each end is `k (1 - cos a)` for the angle `a` between the
    /// crosslinker and the normal of the filament at the site; at least 0. Requires `radius_nm`, `rest_length_nm`, and
    /// `site_spacing_nm` or `steps`: at the default distance, most sites of a filament face the same side.
    #[serde(default)]
    pub tilt_pn_nm: f64,
    /// Stiffness `k` against twist: the energy is `k (1 - cos b)` for the angle `b` between the directions of both
    /// filaments; at least 0. Antiparallel filaments have the energy `2 k`.
    #[serde(default)]
    pub twist_pn_nm: f64,
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
        self.check(k, filaments)?;
        let length = filaments.first().map_or(0.0, Filament::length_nm);
        let last = self.site(length);
        Ok(vec![self.linker(Some(last)); self.count])
    }

    fn site(&self, at_nm: f64) -> LinkerSite {
        LinkerSite {
            filament: 0,
            at_nm,
            radius_nm: self.radius_nm,
            azimuth_deg: 0.0,
        }
    }

    /// A free crosslinker of the pool.
    fn linker(&self, to: Option<LinkerSite>) -> Linker {
        Linker {
            to,
            rest_length_nm: self.rest_length_nm,
            tilt_pn_nm: self.tilt_pn_nm,
            twist_pn_nm: self.twist_pn_nm,
            kinetics: Some(self.kinetics()),
            ..Linker::new(self.site(0.0), self.stiffness_pn_per_nm)
        }
    }

    /// Removes the crosslinkers at the end of `linkers` and returns their pools.
    pub(super) fn from_linkers(linkers: &mut Vec<Linker>) -> Vec<Self> {
        let mut pools: Vec<Self> = Vec::new();
        let mut last: Option<Linker> = None;
        while let Some(linker) = linkers.pop() {
            match (
                Self::from_linker(&linker).filter(|pool| pool.linker(linker.to) == linker),
                pools.last_mut(),
            ) {
                (None, _) => {
                    linkers.push(linker);
                    break;
                }
                (Some(_), Some(pool)) if last == Some(linker) => pool.count += 1,
                (Some(pool), _) => pools.push(pool),
            }
            last = Some(linker);
        }
        pools.reverse();
        pools
    }

    fn from_linker(linker: &Linker) -> Option<Self> {
        let kinetics = linker.kinetics?;
        let (roams, forms) = (kinetics.roams?, kinetics.forms?);
        let spacing = Some(roams.site_spacing_nm);
        Some(Self {
            count: 1,
            stiffness_pn_per_nm: linker.stiffness_pn_per_nm,
            rest_length_nm: linker.rest_length_nm,
            radius_nm: linker.radius_nm,
            tilt_pn_nm: linker.tilt_pn_nm,
            twist_pn_nm: linker.twist_pn_nm,
            attach_per_ns: roams.attach_per_ns,
            bind_per_ns: forms.rate_per_ns,
            reach_nm: Some(forms.reach_nm),
            unbinds: kinetics.breaks?,
            steps: kinetics.steps,
            site_spacing_nm: spacing.filter(|_| kinetics.steps.is_none()),
            averaging_ns: kinetics.averaging_ns,
            seed: kinetics.seed,
        })
    }

    /// Distance between neighbouring sites (nm).
    fn spacing(&self) -> f64 {
        let default = self
            .steps
            .map_or(SITE_SPACING_NM, |steps| steps.step_nm.abs());
        self.site_spacing_nm.unwrap_or(default)
    }

    fn check(&self, k: usize, filaments: &[Filament]) -> Result<(), SceneProblem> {
        let key = |name: &str| format!("crosslinkers[{k}].{name}");
        if !(1..=MOST).contains(&self.count) {
            let rule = format!("must be from 1 to {MOST}");
            return Err(SceneProblem::new(key("count"), self.count, rule));
        }
        if let Some(steps) = &self.steps {
            let lengths = filaments.iter().map(Filament::length_nm);
            steps.check(&key("steps"), lengths.fold(0.0, f64::max))?;
        }
        if filaments.len() < 2 {
            let rule = "crosslinkers bind to different filaments: a scene has at least two";
            return Err(SceneProblem::new(format!("crosslinkers[{k}]"), "", rule));
        }
        let spacing = self.spacing();
        let sites = filaments
            .iter()
            .map(|one| (one.length_nm() / spacing + 0.5).floor());
        let sites: f64 = sites.sum();
        if !(1.0..=MOST_SITES).contains(&sites) {
            let rule = format!(
                "sites {spacing:?} nm apart, the first at half this distance, give {sites} sites: must be from 1 to \
                 {MOST_SITES:.0}; change site_spacing_nm or the length of steps"
            );
            return Err(SceneProblem::new(key("site_spacing_nm"), spacing, rule));
        }
        if self.tilt_pn_nm > 0.0 && self.site_spacing_nm.is_none() && self.steps.is_none() {
            let rule = "requires site_spacing_nm, such as 5.5: most sites at the default distance face the same side";
            return Err(SceneProblem::new(key("tilt_pn_nm"), self.tilt_pn_nm, rule));
        }
        if let (Some(spacing), Some(_)) = (self.site_spacing_nm, self.steps) {
            let rule = "the steps set the distance of sites: omit this key or steps";
            return Err(SceneProblem::new(key("site_spacing_nm"), spacing, rule));
        }
        Ok(())
    }

    fn kinetics(&self) -> Kinetics {
        let reach = (2.0 * REACH_KT * KT_PN_NM / self.stiffness_pn_per_nm).sqrt();
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
                site_spacing_nm: self.spacing(),
            }),
        }
    }
}
