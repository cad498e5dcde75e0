//! Validation of paths.

use super::path::load_factors;
use super::rules::{positive, show};
use super::support::is_along;
use super::{
    ClampedEnds, End, FreeTranslation, Hold, Scene, SceneProblem, Setting, Stage, periodic,
};

pub(super) fn check(
    scene: &Scene,
    held: &ClampedEnds,
    i: usize,
    stage: &Stage,
) -> Result<(), SceneProblem> {
    for (k, setting) in stage.set.iter().enumerate() {
        let key = |name: &str| format!("path[{i}].set[{k}].{name}");
        let exists = |name: &str, index: usize, count: usize| {
            let rule = format!("there are {count} {name}s, counted from 0");
            let missing = || SceneProblem::new(key(name), index, rule);
            (index < count).then_some(()).ok_or_else(missing)
        };
        match *setting {
            Setting::LoadFactor { load, .. } => exists("load", load, scene.loads.len())?,
            Setting::Anchor { linker, .. } => {
                exists("linker", linker, scene.linkers.len())?;
                check_anchor(scene, &key("linker"), linker)?;
            }
            Setting::Shear { factor } => periodic::check_factor(scene, &key("factor"), factor)?,
            Setting::Shift {
                filament,
                end,
                shift_nm,
            } => check_shift((scene, held), &key(""), (filament, end), shift_nm)?,
            Setting::Turn { filament, end, .. } => {
                check_turns((scene, held), &key(""), (filament, end))?;
            }
        }
    }
    Ok(())
}

fn check_anchor(scene: &Scene, key: &str, linker: usize) -> Result<(), SceneProblem> {
    if scene.linkers[linker].to.is_none() {
        return Ok(());
    }
    let rule = "this linker joins two sites and has no anchor: write a linker with an anchor";
    Err(SceneProblem::new(key, linker, rule))
}

/// Checks that a path that sets load factors sets the factors of all loads without a factor in time.
pub(super) fn check_loads(scene: &Scene) -> Result<(), SceneProblem> {
    let unset = unset_loads(scene);
    match unset.first() {
        Some(&i) if scene.path.iter().any(sets_a_load) => {
            let rule = format!(
                "no stage of the path sets this load, but the path sets others: it would act in full from the start. \
                 Add LoadFactor(load: {i}, factor: ..) to a stage: 1.0 where it acts, 0.0 where it does not"
            );
            Err(scene.loads[i].problem(i, rule))
        }
        _ => Ok(()),
    }
}

/// Returns the indices of loads that act in full along the whole path: no stage sets them, and they have no
/// factor in time.
pub fn unset_loads(scene: &Scene) -> Vec<usize> {
    if scene.path.is_empty() {
        return Vec::new();
    }
    let factors = load_factors(&scene.path, scene.loads.len());
    let loads = scene.loads.iter().zip(factors).enumerate();
    let unset = loads.filter(|(_, (load, set))| set.is_none() && load.factor().is_constant());
    unset.map(|(i, _)| i).collect()
}

fn sets_a_load(stage: &Stage) -> bool {
    stage
        .set
        .iter()
        .any(|setting| matches!(setting, Setting::LoadFactor { .. }))
}

/// Checks that an end is clamped. Keys begin with `prefix`.
fn check_held(
    (scene, held): (&Scene, &ClampedEnds),
    prefix: &str,
    filament: usize,
    end: End,
) -> Result<(), SceneProblem> {
    scene.named_filament(&format!("{prefix}filament"), filament)?;
    if held.is_clamped(filament, end) {
        return Ok(());
    }
    let rule = "this end is free: only a clamped end can be moved";
    Err(SceneProblem::new(format!("{prefix}end"), show(end), rule))
}

/// Checks that an end is clamped and does not slide in the direction of a shift.
fn check_shift(
    (scene, held): (&Scene, &ClampedEnds),
    prefix: &str,
    (filament, end): (usize, End),
    shift_nm: [f64; 3],
) -> Result<(), SceneProblem> {
    check_held((scene, held), prefix, filament, end)?;
    let clamp = held.clamp_at(filament, end);
    let axis = scene.filament_at(filament).map(|f| f.axis_at(end));
    let (Some(clamp), Some(axis)) = (clamp, axis) else {
        return Ok(());
    };
    let slides = scene.clamps[clamp].slides;
    if !is_along(shift_nm.into(), &slides.directions(axis)) {
        return Ok(());
    }
    let remedy = match slides {
        FreeTranslation::Freely => "omit the shift, or write slides: AlongAxis or Nowhere",
        _ => "shift the end across its axis, or write slides: Nowhere",
    };
    let rule = format!(
        "has no effect along directions in which the end slides (clamps[{clamp}].slides = {slides:?}): {remedy}"
    );
    let key = format!("{prefix}shift_nm");
    Err(SceneProblem::new(key, show(shift_nm), rule))
}

/// Checks that an end is clamped and not free to rotate.
fn check_turns(
    (scene, held): (&Scene, &ClampedEnds),
    prefix: &str,
    (filament, end): (usize, End),
) -> Result<(), SceneProblem> {
    check_held((scene, held), prefix, filament, end)?;
    let clamp = held.clamp_at(filament, end).map(|c| &scene.clamps[c]);
    if clamp.is_some_and(|c| c.hold == Hold::Pin && c.hinge.is_none()) {
        let rule =
            "this end is pinned and rotates freely: add a hinge to the clamp, or omit the turn";
        return Err(SceneProblem::new(format!("{prefix}end"), show(end), rule));
    }
    Ok(())
}

/// Checks the durations of stages for tasks in time.
pub(super) fn check_durations(scene: &Scene, duration_ns: f64) -> Result<(), SceneProblem> {
    for (i, stage) in scene.path.iter().enumerate() {
        let key = format!("path[{i}].duration_ns");
        let Some(duration) = stage.duration_ns else {
            let rule =
                "Dynamics and Brownian require the duration of every stage: write duration_ns";
            return Err(SceneProblem::new(key, "none", rule));
        };
        positive(&key, duration)?;
    }
    let whole: f64 = scene.path.iter().filter_map(|s| s.duration_ns).sum();
    if whole > duration_ns {
        let rule = format!("must be at least the duration of the path, {whole:?}");
        let key = "task.duration_ns";
        return Err(SceneProblem::new(key, show(duration_ns), rule));
    }
    Ok(())
}
