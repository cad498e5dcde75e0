//! Validation of `stop` and `leave_saddles`, which require that filaments come to rest.

use super::{Dynamics, Load, Scene, SceneProblem, rules};

pub(super) fn check(scene: &Scene, dynamics: &Dynamics) -> Result<(), SceneProblem> {
    let saddles = dynamics.leave_saddles;
    let key = match (dynamics.stop, saddles) {
        (Some(_), _) => "stop",
        (None, 1..) => "leave_saddles",
        (None, 0) => return Ok(()),
    };
    if let Some(rule) = obstacle_to_saddles(scene, dynamics).filter(|_| saddles > 0) {
        return Err(SceneProblem::new("task.leave_saddles", saddles, rule));
    }
    let rule = obstacle_to_rest(scene, dynamics, key);
    rule.map_or(Ok(()), |rule| {
        Err(SceneProblem::new(format!("task.{key}"), "", rule))
    })
}

/// Returns the reason why a filament cannot be at rest on a saddle of its energy.
fn obstacle_to_saddles(scene: &Scene, dynamics: &Dynamics) -> Option<&'static str> {
    let has_potential = |one| rules::check_potential(one).is_ok();
    if dynamics.thermal.is_some() {
        Some(
            "a filament in thermal motion is never at rest on a saddle: omit leave_saddles or thermal",
        )
    } else if scene.loads.iter().any(Load::follows) {
        Some("requires an energy, which loads with follows: true do not have: omit this key")
    } else if !scene.filaments().all(has_potential) {
        Some("requires an energy, which PaperBalance does not have: write EnergyGradient")
    } else {
        None
    }
}

/// Returns the reason why a filament cannot come to rest within the duration, which `task.{key}` requires.
fn obstacle_to_rest(scene: &Scene, dynamics: &Dynamics, key: &str) -> Option<String> {
    if dynamics.thermal.is_some() {
        let rule = "a filament in thermal motion never comes to rest: omit stop or thermal";
        return Some(rule.to_owned());
    }
    let duration = dynamics.duration_ns;
    for (i, load) in scene.loads.iter().enumerate() {
        let until = load.factor().settles_at();
        if until.is_infinite() {
            return Some(format!(
                "loads[{i}] has the factor Sine, so the filament never comes to rest: omit {key}"
            ));
        }
        if until >= duration {
            return Some(format!(
                "the factor of loads[{i}] changes until {until:?} ns, so the filament cannot come to rest within \
                 duration_ns = {duration:?}: increase duration_ns, or omit {key}"
            ));
        }
    }
    let i = scene.linkers.iter().position(|l| l.kinetics.is_some())?;
    Some(format!(
        "linkers[{i}] breaks, forms or steps at random, so that the filament never comes to rest: omit {key}"
    ))
}
