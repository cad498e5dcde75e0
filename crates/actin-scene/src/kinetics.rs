//! Rates at which linkers break, form and step, as a scene writes them, and the rules of their numbers.

use super::rules::{positive, show};
use super::{Dynamics, Linker, Scene, SceneProblem, Task};
use serde::{Deserialize, Serialize};

/// Most places on a filament at which a linker that steps may hold.
const MOST_PLACES: f64 = 1e5;

/// A linker that breaks, forms and steps at random: a dynamic cross-link, or a motor. In `Dynamics` and
/// `Brownian`.
///
/// At the end of each time step `h` an event of rate `k` happens with the probability `1 - exp(-k h)`, at most one for each
/// linker. Times are those of the rates at ends of steps: their error is of order one, `k h/2` relative, so rates without
/// force times the step may be 0.1 at most. `f` is the tension of the linker, 0 where it is shorter than at rest.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Kinetics {
    /// Seed of its events, which depend on it, the number of the step and the index of the linker alone.
    pub seed: u64,
    /// Whether it holds at the start.
    #[serde(default = "yes")]
    pub bound: bool,
    /// How it breaks; by default it does not.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub breaks: Option<Breaking>,
    /// How it forms; by default it does not.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub forms: Option<Forming>,
    /// How its site steps along the filament; by default it does not.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub steps: Option<Stepping>,
}

/// Breaking at the rate `k exp(f/F)` (Bell), plus that of a catch bond.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Breaking {
    /// Rate `k` without force; positive.
    pub rate_per_ns: f64,
    /// Force `F` by which it grows `e`-fold; positive. By default it does not depend on force.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub force_pn: Option<f64>,
    /// A second way to break that force closes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub catch: Option<Catch>,
}

/// Breaking at the rate `k exp(-f/F)`, added to that of `Breaking`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Catch {
    /// Rate `k` without force; positive.
    pub rate_per_ns: f64,
    /// Force `F` by which it falls `e`-fold; positive.
    pub force_pn: f64,
}

/// Forming where the site is within reach of the other end; of several places at the one where it is strained least.
///
/// The rate within reach is constant, whatever the energy `U` of the linker where it forms. Detailed balance would need rates
/// of forming and breaking in the ratio `exp(-U/kT)`, which neither a constant rate nor that of Bell has. So with `breaks` in
/// a heat bath the filament settles in a steady state that is not thermal equilibrium, and these events exchange energy with
/// it (`events_pn_nm`).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Forming {
    /// Rate within reach; positive.
    pub rate_per_ns: f64,
    /// By how much the linker may be longer or shorter than at rest where it forms; positive.
    pub reach_nm: f64,
}

/// Stepping of a site that holds, at the rate `k (1 - f/F)` between 0 and `k`; `f` is what the linker pulls back with along
/// the filament.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Stepping {
    /// Length of a step along the filament; negative towards its start, and not zero. The first place is `at_nm`.
    pub step_nm: f64,
    /// Rate `k` without force; positive.
    pub rate_per_ns: f64,
    /// Force `F` at which it stalls; positive.
    pub stall_pn: f64,
    /// Whether it lets go when it would step off the end of the filament; otherwise it stays there.
    #[serde(default)]
    pub leaves_at_end: bool,
}

fn yes() -> bool {
    true
}

impl Kinetics {
    /// Rates without force (1/ns), with their keys below `kinetics`.
    pub fn rates(&self) -> Vec<(&'static str, f64)> {
        let breaks = self.breaks.map(|b| ("breaks.rate_per_ns", b.rate_per_ns));
        let catch = self.breaks.and_then(|b| b.catch);
        let catch = catch.map(|c| ("breaks.catch.rate_per_ns", c.rate_per_ns));
        let forms = self.forms.map(|f| ("forms.rate_per_ns", f.rate_per_ns));
        let steps = self.steps.map(|s| ("steps.rate_per_ns", s.rate_per_ns));
        [breaks, catch, forms, steps]
            .into_iter()
            .flatten()
            .collect()
    }

    /// Checks the numbers of a linker's rates, whose keys stand under `key`; the site of the linker is sound.
    fn check(&self, key: &str, length: f64) -> Result<(), SceneProblem> {
        for (name, rate) in self.rates() {
            positive(&format!("{key}.{name}"), rate)?;
        }
        if let Some(force) = self.breaks.and_then(|b| b.force_pn) {
            positive(&format!("{key}.breaks.force_pn"), force)?;
        }
        if let Some(catch) = self.breaks.and_then(|b| b.catch) {
            positive(&format!("{key}.breaks.catch.force_pn"), catch.force_pn)?;
        }
        if let Some(forms) = &self.forms {
            positive(&format!("{key}.forms.reach_nm"), forms.reach_nm)?;
        }
        if let Some(steps) = &self.steps {
            steps.check(&format!("{key}.steps"), length)?;
        }
        let happens = self.breaks.is_some() || self.forms.is_some() || self.steps.is_some();
        if !happens {
            let rule = "nothing happens: write breaks, forms or steps, or leave kinetics out";
            return Err(SceneProblem::new(key, "", rule));
        }
        if !self.bound && self.forms.is_none() {
            let rule = "a linker that does not hold at the start and never forms: write forms";
            return Err(SceneProblem::new(format!("{key}.bound"), false, rule));
        }
        Ok(())
    }
}

impl Stepping {
    fn check(&self, key: &str, length: f64) -> Result<(), SceneProblem> {
        positive(&format!("{key}.stall_pn"), self.stall_pn)?;
        let step = self.step_nm;
        let places = length / step.abs();
        if step.is_finite() && places <= MOST_PLACES {
            return Ok(());
        }
        let rule = "must be finite, and at least a hundred-thousandth of the filament's length";
        Err(SceneProblem::new(
            format!("{key}.step_nm"),
            show(step),
            rule,
        ))
    }

    /// Arc lengths (nm) of a site that starts at `from_nm` of a filament of a length (nm).
    pub fn places_nm(&self, from_nm: f64, length: f64) -> Vec<f64> {
        let at = |k: u32| from_nm + f64::from(k) * self.step_nm;
        let places = (0..).map(at);
        // Room for the round-off of a sum of steps that ends at an end.
        let is_on = |s: &f64| *s >= -1e-9 && *s <= length + 1e-9;
        let on = places.take_while(is_on);
        on.map(|s| s.clamp(0.0, length)).collect()
    }
}

/// Checks the rates of linker `i`, if it has some, whose other numbers are sound.
pub(super) fn check(scene: &Scene, i: usize, linker: &Linker) -> Result<(), SceneProblem> {
    let Some(kinetics) = &linker.kinetics else {
        return Ok(());
    };
    let key = format!("linkers[{i}].kinetics");
    if let Task::Equilibrium(_) = scene.task {
        let rule = "Equilibrium knows no time, in which linkers break, form or step: write Dynamics or Brownian, or \
                    leave kinetics out";
        return Err(SceneProblem::new(key, "", rule));
    }
    let filament = scene.filament_at(linker.filament);
    let length = filament.map_or(0.0, super::Filament::length_nm);
    kinetics.check(&key, length)
}

/// What `stop` and pushes off saddles ask of linkers: that nothing happens to them.
pub(super) fn check_rest(scene: &Scene, dynamics: &Dynamics) -> Result<(), SceneProblem> {
    let Some(i) = scene.linkers.iter().position(|l| l.kinetics.is_some()) else {
        return Ok(());
    };
    let rule = |key: &str| {
        format!(
            "linkers[{i}] breaks, forms or steps at random, so that nothing comes to rest: leave {key} out"
        )
    };
    if dynamics.stop.is_some() {
        return Err(SceneProblem::new("task.stop", "", rule("stop")));
    }
    if dynamics.leave_saddles > 0 {
        let (key, value) = ("task.leave_saddles", dynamics.leave_saddles);
        return Err(SceneProblem::new(key, value, rule("leave_saddles")));
    }
    Ok(())
}

impl Breaking {
    /// Rate (1/ns) at a tension (pN).
    pub fn rate(&self, tension: f64) -> f64 {
        let growth = self.force_pn.map_or(0.0, |force| tension / force);
        let catch = self.catch.map_or(0.0, |catch| {
            catch.rate_per_ns * (-tension / catch.force_pn).exp()
        });
        self.rate_per_ns * growth.exp() + catch
    }
}

impl Stepping {
    /// Rate (1/ns) against a force (pN).
    pub fn rate(&self, resistance: f64) -> f64 {
        self.rate_per_ns * (1.0 - resistance / self.stall_pn).clamp(0.0, 1.0)
    }
}
