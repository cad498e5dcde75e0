//! Rates of breaking, forming and stepping of linkers, and their validation.

use super::rules::show;
use super::{Linker, Scene, SceneProblem, Task};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

const MOST_PLACES: f64 = 1e5;

/// Default averaging time of forces, relative to the mean time between events.
const AVERAGED: f64 = 0.1;

/// Random breaking, forming and stepping of a linker: a dynamic cross-link or a motor. For `Dynamics` and
/// `Brownian`.
///
/// At the end of each time step `h` an event of rate `k` occurs with probability `1 - exp(-k h)`, at most one
/// per linker. Zero-force rates times the step may be at most 0.1: the relative error of event times is `k
/// h/2`. Below, `f` is the tension of the linker, or 0 in compression, averaged over `averaging_ns`. Thermal
/// fluctuations that are faster do not change rates.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Kinetics {
    /// Seed of the events. They depend only on the seed, the number of the step and the index of the linker.
    pub seed: u64,
    /// True if the linker is bound at the start.
    #[serde(default = "yes")]
    pub bound: bool,
    /// Breaking; by default the linker does not break.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub breaks: Option<Breaking>,
    /// Forming; by default the linker does not form.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub forms: Option<Forming>,
    /// Stepping of the site along the filament; by default the site is fixed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub steps: Option<Stepping>,
    /// Time constant of the exponential average of forces, behind which rates lag; at least 0. By default a tenth of the
    /// mean time between events of a bound linker without force. If the force has changed by `F/2` in that time, breaking
    /// follows the average over `50 kT (k h/2 + 400 pN ns/nm) / F^2`, if that is less than a quarter. `F` is the force of the
    /// rate, `k` the stiffness, and `h` the time step. With 0, rates depend on the force at the end of each step.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub averaging_ns: Option<f64>,
    /// Binding of both ends to any site of any filament. By default only the first end can be released. Written by
    /// `crosslinkers`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub roams: Option<Roaming>,
}

/// Linker with two hands that bind to free sites of all filaments.
///
/// A free linker attaches one hand to a random site. The second hand binds to sites of other filaments within reach.
/// The rate per site is `k exp(-U/kT)` with the rate `k` of `forms` and the energy `U` of the linker. Without mean load,
/// detailed balance holds. With `averaging_ns: 0`, binding has the factor of `breaks` at the present tension, and
/// detailed balance holds under any load. `at_nm` and `to` do not apply.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Roaming {
    /// Rate at which a free linker attaches one hand; positive.
    pub attach_per_ns: f64,
    /// Distance between neighbouring sites of a filament; positive. With `steps`, the length of a step.
    pub site_spacing_nm: f64,
}

/// Breaking at the rate `k exp(f/F)` (Bell), plus the rate of a catch bond.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Breaking {
    /// Rate `k` without force; positive.
    pub rate_per_ns: f64,
    /// Force `F` at which the rate is `e` times `k`; positive. By default the rate does not depend on force.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub force_pn: Option<f64>,
    /// Additional breaking path whose rate decreases with force.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub catch: Option<Catch>,
}

/// Catch bond: breaking at the rate `k exp(-f/F)`, in addition to the rate of `Breaking`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Catch {
    /// Rate `k` without force; positive.
    pub rate_per_ns: f64,
    /// Force `F` at which the rate is `k/e`; positive.
    pub force_pn: f64,
}

/// Forming within reach of the other end; of several sites the one with the least strain is chosen.
///
/// The rate is constant within reach, independent of the energy `U` of the linker. Detailed balance requires
/// the ratio `exp(-U/kT)` of forming to breaking rates, which `breaks` does not satisfy. The steady state in a
/// heat bath is therefore not thermal equilibrium, and events exchange energy with the filament
/// (`events_pn_nm`). `Roaming` has a rate that depends on the energy.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Forming {
    /// Rate within reach; positive.
    pub rate_per_ns: f64,
    /// Largest difference between the length at forming and the rest length; positive.
    pub reach_nm: f64,
}

/// Stepping of a bound site at the rate `k (1 - f/F)`, limited to 0 to `k`. Here `f` is the resisting force of the
/// linker along the filament.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Stepping {
    /// Step length along the filament; not zero, negative towards the start. The first site is `at_nm`.
    pub step_nm: f64,
    /// Rate `k` without force; positive.
    pub rate_per_ns: f64,
    /// Stall force `F`; positive.
    pub stall_pn: f64,
    /// True if the linker detaches when it would step beyond the end of the filament; otherwise it stays there.
    #[serde(default)]
    pub leaves_at_end: bool,
}

fn yes() -> bool {
    true
}

impl Kinetics {
    /// Returns the zero-force rates (1/ns) with their keys below `kinetics`.
    pub fn rates(&self) -> Vec<(&'static str, f64)> {
        let breaks = self.breaks.map(|b| ("breaks.rate_per_ns", b.rate_per_ns));
        let catch = self.breaks.and_then(|b| b.catch);
        let catch = catch.map(|c| ("breaks.catch.rate_per_ns", c.rate_per_ns));
        let forms = self.forms.map(|f| ("forms.rate_per_ns", f.rate_per_ns));
        let steps = self.steps.map(|s| ("steps.rate_per_ns", s.rate_per_ns));
        let roams = self.roams.map(|r| ("roams.attach_per_ns", r.attach_per_ns));
        [breaks, catch, forms, steps, roams]
            .into_iter()
            .flatten()
            .collect()
    }

    fn check(&self, key: &str, length: f64) -> Result<(), SceneProblem> {
        if let Some(steps) = &self.steps {
            steps.check(&format!("{key}.steps"), length)?;
        }
        if self.breaks.is_none() && self.forms.is_none() && self.steps.is_none() {
            let rule = "has no events: write breaks, forms or steps, or omit kinetics";
            return Err(SceneProblem::new(key, "", rule));
        }
        if let Some(roams) = &self.roams {
            self.check_roaming(roams, key)?;
        }
        if !self.bound && self.forms.is_none() {
            let rule =
                "the linker is unbound at the start and never forms: write forms, or bound: true";
            return Err(SceneProblem::new(format!("{key}.bound"), false, rule));
        }
        Ok(())
    }

    /// Smallest change of the force (pN) at which a rate of breaking changes by a factor of e; `None` if rates of breaking
    /// do not depend on the force.
    pub fn force_scale(&self) -> Option<f64> {
        let breaks = self.breaks?;
        let catch = breaks.catch.map(|catch| catch.force_pn);
        let scales = breaks.force_pn.into_iter().chain(catch);
        scales.min_by(f64::total_cmp)
    }

    /// Averaging time of forces (ns).
    pub fn averaging_time(&self) -> f64 {
        let of_bound = self
            .rates()
            .into_iter()
            .filter(|(name, _)| name.starts_with("breaks") || name.starts_with("steps"));
        let rate: f64 = of_bound.map(|(_, rate)| rate).sum();
        let default = if rate > 0.0 { AVERAGED / rate } else { 0.0 };
        self.averaging_ns.unwrap_or(default)
    }

    fn check_roaming(&self, roams: &Roaming, key: &str) -> Result<(), SceneProblem> {
        let name = format!("{key}.roams");
        if self.bound {
            let rule = "linkers that roam are free at the start: write bound: false";
            return Err(SceneProblem::new(format!("{key}.bound"), true, rule));
        }
        if self.breaks.is_none() || self.forms.is_none() {
            let rule = "requires breaks and forms";
            return Err(SceneProblem::new(name, "", rule));
        }
        match &self.steps {
            Some(steps) if (steps.step_nm.abs() - roams.site_spacing_nm).abs() > 0.0 => {
                let rule = format!("must be the length of a step, {:?}", steps.step_nm.abs());
                let key = format!("{name}.site_spacing_nm");
                Err(SceneProblem::new(key, show(roams.site_spacing_nm), rule))
            }
            _ => Ok(()),
        }
    }
}

impl Stepping {
    pub(super) fn check(&self, key: &str, length: f64) -> Result<(), SceneProblem> {
        let step = self.step_nm;
        let places = length / step.abs();
        if (1.0..=MOST_PLACES).contains(&places) {
            return Ok(());
        }
        let rule =
            "must be at most the length of the filament, and at least a hundred-thousandth of it";
        let key = format!("{key}.step_nm");
        Err(SceneProblem::new(key, show(step), rule))
    }

    /// Returns the arc lengths (nm) of all sites of a linker that steps from `from_nm`, on a filament of a
    /// length (nm).
    pub fn places_nm(&self, from_nm: f64, length: f64) -> Vec<f64> {
        let at = |k: u32| from_nm + f64::from(k) * self.step_nm;
        let places = (0..).map(at);
        // Tolerance for round-off of steps that end at an end.
        let is_on = |s: &f64| *s >= -1e-9 && *s <= length + 1e-9;
        let on = places.take_while(is_on);
        on.map(|s| s.clamp(0.0, length)).collect()
    }

    /// Returns the rate (1/ns) against a force (pN).
    pub fn rate(&self, resistance: f64) -> f64 {
        self.rate_per_ns * (1.0 - resistance / self.stall_pn).clamp(0.0, 1.0)
    }
}

/// Checks the rates of linker `i`. Its other numbers must be valid.
pub(super) fn check(scene: &Scene, i: usize, linker: &Linker) -> Result<(), SceneProblem> {
    let Some(kinetics) = &linker.kinetics else {
        return Ok(());
    };
    let key = format!("linkers[{i}].kinetics");
    if let Task::Equilibrium(_) = scene.task {
        let rule = "Equilibrium is time-independent, without events of linkers: write Dynamics or Brownian, or \
                    omit kinetics";
        return Err(SceneProblem::new(key, "", rule));
    }
    let filament = scene.filament_at(linker.filament);
    let length = filament.map_or(0.0, super::Filament::length_nm);
    if linker.roams() {
        check_pool(scene, linker, &key)?;
    }
    kinetics.check(&key, length)
}

/// A roaming linker requires two ends on filaments and a heat bath.
fn check_pool(scene: &Scene, linker: &Linker, key: &str) -> Result<(), SceneProblem> {
    let key = format!("{key}.roams");
    if linker.to.is_none() {
        let rule = "requires a linker between two sites: write to";
        return Err(SceneProblem::new(key, "", rule));
    }
    let first = scene.linkers.iter().find(|linker| linker.roams());
    let is_first = first.is_some_and(|first| std::ptr::eq(first, linker));
    if is_first && scene.thermal_energy_pn_nm() <= 0.0 {
        let rule = "the rate of binding depends on the temperature: write a positive temperature_k or thermal";
        return Err(SceneProblem::new(key, "", rule));
    }
    Ok(())
}

impl Breaking {
    /// Returns the rate (1/ns) at a tension (pN).
    pub fn rate(&self, tension: f64) -> f64 {
        let growth = self.force_pn.map_or(0.0, |force| tension / force);
        let catch = self.catch.map_or(0.0, |catch| {
            catch.rate_per_ns * (-tension / catch.force_pn).exp()
        });
        self.rate_per_ns * growth.exp() + catch
    }
}
