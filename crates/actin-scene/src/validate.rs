//! Validation of scenes.

use super::adaptive_resolution::check_following;
use super::rules::{
    all_finite, check_potential, direction, each_positive, finite, non_negative, positive, show,
};
use super::support::{check_support, check_swings};
use super::{
    Adaptive, Anchors, Clamp, ClampedEnds, Dynamics, End, Equilibrium, Filament, FreeTranslation,
    Hold, Monomers, Quantity, Resultant, Scene, SceneProblem, Sections, StopTolerances, Task, bead,
    brownian, drag, imperfection, kinetics, linker, load_rules, magnitude, observable, periodic,
    repulsion, saddles, section_rules, shape, stage, thermal,
};
use actin_ellipsoid::{MAX_POINTS, MIN_POINTS};

/// Largest number of bodies of a section and largest lattice index: 2^53, the limit of exact integers in `f64`.
pub const MAX_EXACT_INTEGER: f64 = 9_007_199_254_740_992.0;

/// Largest number of bonds of an interface. Sampling noise is negligible with a hundredth of it.
const MOST_BONDS_PER_INTERFACE: usize = 10_000;
const MOST_STATES: usize = 10_000;

/// Checks all rules that do not require the assembled filament.
///
/// # Errors
/// The first violated rule.
pub(super) fn validate(scene: &Scene) -> Result<(), SceneProblem> {
    problems(scene, 1).into_iter().next().map_or(Ok(()), Err)
}

/// Returns the first `most` violated rules, one for each key. Rules of the whole scene are checked only if all
/// numbers are valid.
pub(super) fn problems(scene: &Scene, most: usize) -> Vec<SceneProblem> {
    let mut found = Vec::new();
    let held = ClampedEnds::new(scene);
    let mut note = |checked: Result<(), SceneProblem>| {
        let problem = checked.err().filter(|_| found.len() < most);
        let is_new = |p: &SceneProblem| found.iter().all(|f: &SceneProblem| f.key != p.key);
        let new = problem.filter(is_new);
        found.extend(new);
    };
    note(magnitude::check(scene));
    filaments(scene, &mut note);
    if scene.filaments().any(|one| one.sections.is_empty()) {
        return found;
    }
    for (i, clamp) in scene.clamps.iter().enumerate() {
        note(check_clamp(scene, &held, (i, clamp)));
    }
    for (i, load) in scene.loads.iter().enumerate() {
        note(load.check(i, (scene, &held)));
    }
    for (i, linker) in scene.linkers.iter().enumerate() {
        note(linker::check(scene, i, linker));
    }
    for (i, bead) in scene.beads.iter().enumerate() {
        note(bead::check(scene, i, bead));
    }
    repulsion::check(scene, &mut note);
    periodic::check(scene, &mut note);
    for (i, stage) in scene.path.iter().enumerate() {
        note(stage::check(scene, &held, (i, stage)));
    }
    observable::check_all(scene, &held, &mut note);
    note(match &scene.task {
        Task::Dynamics(dynamics) => check_dynamics(dynamics),
        Task::Brownian(brownian) => brownian::check(brownian),
        Task::Equilibrium(equilibrium) => check_equilibrium(equilibrium),
    });
    if found.is_empty() {
        found.extend(check_whole(scene, &held).err());
    }
    found
}

fn filaments(scene: &Scene, note: &mut impl FnMut(Result<(), SceneProblem>)) {
    for (i, one) in scene.filaments().enumerate() {
        filament(one, &scene.filament_key(i), note);
    }
}

fn filament(one: &Filament, key: &str, note: &mut impl FnMut(Result<(), SceneProblem>)) {
    let named = |problem: SceneProblem| problem.with_filament(key);
    section_rules::check(one, &mut |checked| note(checked.map_err(named)));
    for check in [check_model, check_place, imperfection::check, shape::check] {
        note(check(one).map_err(named));
    }
}

/// Checks a filament whose keys begin with `key`.
///
/// # Errors
/// The first violated rule.
pub(super) fn check_filament(one: &Filament, key: &str) -> Result<(), SceneProblem> {
    let mut first = Ok(());
    filament(one, key, &mut |checked| {
        if first.is_ok() {
            first = checked;
        }
    });
    first
}

fn check_start(scene: &Scene) -> Result<(), SceneProblem> {
    if scene.start.is_none() {
        return Ok(());
    }
    let is_automatic =
        |sections: &Sections| sections.adaptive().is_some() || sections.following().is_some();
    let rule = if scene.filaments().any(|one| one.imperfection.is_some()) {
        "replaces the imperfection of a filament: remove one of them"
    } else if scene.filaments().any(|one| is_automatic(&one.sections)) {
        "needs the sections of that run: copy them from its scene.ron"
    } else {
        return Ok(());
    };
    Err(SceneProblem::new("start", "", rule))
}

fn check_whole(scene: &Scene, held: &ClampedEnds) -> Result<(), SceneProblem> {
    check_start(scene)?;
    check_adaptive(scene)?;
    for following in scene.filaments().filter_map(|f| f.sections.following()) {
        check_following(scene, following)?;
    }
    stage::check_loads(scene)?;
    match &scene.task {
        Task::Dynamics(dynamics) => {
            stage::check_durations(scene, dynamics.duration_ns)?;
            check_swings(scene, held)?;
            saddles::check(scene, dynamics)?;
            load_rules::check_rest(scene, dynamics)?;
            kinetics::check_rest(scene, dynamics)?;
            if let Some(fluid) = dynamics.drag.fluid() {
                fluid.check_filaments(scene)?;
            }
            let stop = dynamics.stop.as_ref();
            stop.map_or(Ok(()), |s| {
                check_tolerance(scene, "task.stop", (s.force_pn, s.torque_pn_nm))
            })
        }
        Task::Brownian(task) => {
            stage::check_durations(scene, task.to_dynamics().duration_ns)?;
            check_swings(scene, held)?;
            brownian::check_whole(scene, task)
        }
        Task::Equilibrium(equilibrium) => {
            if let Some(quantity) = equilibrium.error_of {
                check_wanted(scene, "task.error_of", quantity)?;
            }
            for (i, one) in scene.filaments().enumerate() {
                check_potential(one).map_err(|p| p.with_filament(&scene.filament_key(i)))?;
            }
            load_rules::check_statics(scene)?;
            check_support(scene)?;
            let tolerances = (equilibrium.force_pn, equilibrium.torque_pn_nm);
            check_tolerance(scene, "task", tolerances)
        }
    }
}

fn check_adaptive(scene: &Scene) -> Result<(), SceneProblem> {
    for (i, filament) in scene.filaments().enumerate() {
        let targets = filament
            .sections
            .adaptive()
            .into_iter()
            .flat_map(Adaptive::targets);
        let mut checked =
            targets.map(|want| check_wanted(scene, "filament.sections.want", want.quantity()));
        checked
            .try_for_each(|one| one)
            .map_err(|problem| problem.with_filament(&scene.filament_key(i)))?;
    }
    Ok(())
}

/// Checks that the scene has a quantity, which `key` requests.
fn check_wanted(scene: &Scene, key: &str, quantity: Quantity) -> Result<(), SceneProblem> {
    if let Quantity::LinkerForce { linker } = quantity {
        observable::check_linker(scene, &format!("{key}.linker"), linker)?;
    }
    match missing(scene, quantity) {
        Some((key, rule)) => Err(SceneProblem::new(key, "", rule)),
        None => Ok(()),
    }
}

/// Key and reason if a scene does not have a quantity.
fn missing(scene: &Scene, quantity: Quantity) -> Option<(&'static str, String)> {
    if let Quantity::Curvature { at_nm } = quantity {
        let length_nm = scene.filament.length_nm();
        let is_inside = (0.0..=length_nm).contains(&at_nm);
        let rule = || {
            format!(
                "the curvature at {at_nm:?} nm is requested, outside the filament of {length_nm:?} nm"
            )
        };
        return (!is_inside).then(|| ("filament.sections", rule()));
    }
    let mut clamps = scene.clamps.iter();
    let clamp = clamps.find(|clamp| clamp.filament == 0 && clamp.end == End::End);
    let rule = match (quantity, clamp.map(|clamp| clamp.slides)) {
        (Quantity::Tip, Some(FreeTranslation::Nowhere)) => {
            "the displacement of the end is requested, but the end is clamped"
        }
        (Quantity::EndForce | Quantity::EndCouple, None) => {
            "the reaction at the end is requested, but the end is free"
        }
        (Quantity::EndForce, Some(FreeTranslation::AlongAxis | FreeTranslation::Freely)) => {
            "the force on the end is requested, but the end slides in its direction"
        }
        _ => return None,
    };
    Some(("clamps", rule.to_owned()))
}

fn check_place(filament: &Filament) -> Result<(), SceneProblem> {
    all_finite("filament.at_nm", filament.at_nm)?;
    direction("filament.direction", filament.direction)?;
    finite("filament.roll_deg", filament.roll_deg)
}

fn check_model(filament: &Filament) -> Result<(), SceneProblem> {
    let attached = filament.junction.attached_monomers;
    if !(1..=2).contains(&attached) {
        return Err(SceneProblem::new(
            "filament.junction.attached_monomers",
            attached,
            "a junction attaches 1 or 2 monomers",
        ));
    }
    check_monomers(&filament.monomers)?;
    if let super::Material::Rigidities {
        shear_pn,
        bend_pn_nm2,
    } = filament.rod.material
    {
        each_positive("filament.rod.material.shear_pn", shear_pn)?;
        each_positive("filament.rod.material.bend_pn_nm2", bend_pn_nm2)?;
    }
    Ok(())
}

fn check_monomers(m: &Monomers) -> Result<(), SceneProblem> {
    for (key, value) in [
        ("rise_nm", m.rise_nm),
        ("radius_nm", m.radius_nm),
        ("mass_ag", m.mass_ag),
        ("lateral_rigidity_pn_per_nm", m.lateral_rigidity_pn_per_nm),
        (
            "longitudinal_rigidity_pn_per_nm",
            m.longitudinal_rigidity_pn_per_nm,
        ),
        ("lateral_max_bond_nm", m.lateral_max_bond_nm),
        ("longitudinal_max_bond_nm", m.longitudinal_max_bond_nm),
    ] {
        positive(&format!("filament.monomers.{key}"), value)?;
    }
    for (key, value) in [("turn_deg", m.turn_deg), ("azimuth_deg", m.azimuth_deg)] {
        finite(&format!("filament.monomers.{key}"), value)?;
    }
    each_positive("filament.monomers.semi_axes_nm", m.semi_axes_nm)?;
    check_bonds(
        "filament.monomers.lateral_bonds",
        m.anchors,
        m.lateral_bonds,
    )?;
    check_bonds(
        "filament.monomers.longitudinal_bonds",
        m.anchors,
        m.longitudinal_bonds,
    )?;
    check_shortest(m)?;
    if m.anchors == Anchors::Cubature && m.seed != 0 {
        return Err(SceneProblem::new(
            "filament.monomers.seed",
            m.seed,
            "quadrature bonds are not sampled: omit the seed, or write anchors: Independent",
        ));
    }
    Ok(())
}

pub(super) fn check_bonds(key: &str, anchors: Anchors, bonds: usize) -> Result<(), SceneProblem> {
    let drawn = 1..=MOST_BONDS_PER_INTERFACE;
    let (range, rule) = match anchors {
        Anchors::Independent | Anchors::Identical => {
            let rule = format!("an interface has 1 to {MOST_BONDS_PER_INTERFACE} bonds");
            (drawn, rule)
        }
        Anchors::Cubature => {
            let weighted = format!("{MIN_POINTS} to {MAX_POINTS} quadrature bonds");
            let rule = format!(
                "an interface has {weighted}: write such a number, or anchors: Independent"
            );
            (MIN_POINTS..=MAX_POINTS, rule)
        }
    };
    if range.contains(&bonds) {
        return Ok(());
    }
    Err(SceneProblem::new(key, bonds, rule))
}

/// Checks the shortest bond, common to both kinds of interface. If it is the default, the error names the
/// longest bond.
fn check_shortest(monomers: &Monomers) -> Result<(), SceneProblem> {
    let key = "filament.monomers.min_bond_nm";
    let shortest = monomers.min_bond_nm;
    non_negative(key, shortest)?;
    let is_default = shortest.total_cmp(&Monomers::default().min_bond_nm).is_eq();
    for (longest_key, longest) in [
        ("lateral_max_bond_nm", monomers.lateral_max_bond_nm),
        (
            "longitudinal_max_bond_nm",
            monomers.longitudinal_max_bond_nm,
        ),
    ] {
        if shortest >= longest && is_default {
            let key = format!("filament.monomers.{longest_key}");
            let rule = format!("must be greater than min_bond_nm = {shortest:?}");
            return Err(SceneProblem::new(key, show(longest), rule));
        }
        if shortest >= longest {
            let rule = format!("must be less than {longest_key} = {longest:?}");
            return Err(SceneProblem::new(key, show(shortest), rule));
        }
    }
    Ok(())
}

fn check_clamp(
    scene: &Scene,
    held: &ClampedEnds,
    (i, clamp): (usize, &Clamp),
) -> Result<(), SceneProblem> {
    let key = format!("clamps[{i}]");
    let filament = scene.named_filament(&format!("{key}.filament"), clamp.filament)?;
    if held.clamp_at(clamp.filament, clamp.end) != Some(i) {
        return Err(SceneProblem::new(
            format!("{key}.end"),
            show(clamp.end),
            "this end is clamped already",
        ));
    }
    if !filament.is_rod_at(clamp.end) && clamp.hold != Hold::Wall {
        return Err(SceneProblem::new(
            format!("{key}.hold"),
            show(clamp.hold),
            "this end consists of monomers: write Wall, which holds the last two monomers",
        ));
    }
    check_pin(&key, clamp)
}

/// Refuses pinned ends that slide freely, and hinges at other ends.
fn check_pin(key: &str, clamp: &Clamp) -> Result<(), SceneProblem> {
    let is_pinned = clamp.hold == Hold::Pin;
    if is_pinned && clamp.slides == FreeTranslation::Freely {
        let rule = "a pinned end that slides freely is a free end: omit the clamp";
        return Err(SceneProblem::new(format!("{key}.slides"), "Freely", rule));
    }
    let Some(hinge) = clamp.hinge else {
        return Ok(());
    };
    let key = format!("{key}.hinge");
    if !is_pinned {
        let rule = "a hinge requires a pinned end: write hold: Pin, or omit the hinge";
        return Err(SceneProblem::new(key, "", rule));
    }
    let (bend, twist) = (hinge.bend_pn_nm_per_rad, hinge.twist_pn_nm_per_rad);
    positive(&format!("{key}.bend_pn_nm_per_rad"), bend)?;
    positive(&format!("{key}.twist_pn_nm_per_rad"), twist)
}

fn check_equilibrium(equilibrium: &Equilibrium) -> Result<(), SceneProblem> {
    positive("task.force_pn", equilibrium.force_pn)?;
    positive("task.torque_pn_nm", equilibrium.torque_pn_nm)?;
    positive("task.largest_step", equilibrium.largest_step)?;
    positive("task.smallest_step", equilibrium.smallest_step)?;
    if equilibrium.largest_step > 1.0 || equilibrium.smallest_step > equilibrium.largest_step {
        return Err(SceneProblem::new(
            "task.largest_step",
            show(equilibrium.largest_step),
            "must be at most 1 and at least smallest_step",
        ));
    }
    if equilibrium.iterations == 0 {
        return Err(SceneProblem::new(
            "task.iterations",
            0,
            "must be at least 1",
        ));
    }
    if equilibrium.states > MOST_STATES {
        return Err(SceneProblem::new(
            "task.states",
            equilibrium.states,
            format!("must be at most {MOST_STATES}"),
        ));
    }
    Ok(())
}

/// Checks that every load exceeds the tolerance. Otherwise the filament counts as at rest before it has moved.
fn check_tolerance(
    scene: &Scene,
    key: &str,
    (force_pn, torque_pn_nm): (f64, f64),
) -> Result<(), SceneProblem> {
    for (i, load) in scene.loads.iter().enumerate() {
        let (name, unit, tolerance, least) = match load.least(scene) {
            Resultant::Force(force) => ("force_pn", "pN", force_pn, force.norm()),
            Resultant::Couple(couple) => ("torque_pn_nm", "pN nm", torque_pn_nm, couple.norm()),
        };
        if least > 0.0 && least <= tolerance {
            let rule = match load.interval(scene) {
                None => format!(
                    "must be below half of loads[{i}] ({:e} {unit})",
                    2.0 * least
                ),
                Some(_) => {
                    format!("must be below the load of loads[{i}] on 1 nm ({least:e} {unit})")
                }
            };
            return Err(SceneProblem::new(
                format!("{key}.{name}"),
                show(tolerance),
                format!("{rule}: otherwise the filament counts as at rest before it has moved"),
            ));
        }
    }
    Ok(())
}

fn check_dynamics(dynamics: &Dynamics) -> Result<(), SceneProblem> {
    let key = |name: &str| format!("task.{name}");
    positive(&key("duration_ns"), dynamics.duration_ns)?;
    if let Some(step) = dynamics.time_step_ns {
        positive(&key("time_step_ns"), step)?;
    }
    if let Some(every) = dynamics.record_every_ns {
        positive(&key("record_every_ns"), every)?;
    }
    let safety = dynamics.step_safety;
    positive(&key("step_safety"), safety)?;
    if safety >= 1.0 {
        return Err(SceneProblem::new(
            key("step_safety"),
            show(safety),
            "must be below 1, the stability limit",
        ));
    }
    drag::check(dynamics)?;
    thermal::check(dynamics)?;
    dynamics.stop.as_ref().map_or(Ok(()), check_stop)
}

fn check_stop(stop: &StopTolerances) -> Result<(), SceneProblem> {
    positive("task.stop.force_pn", stop.force_pn)?;
    positive("task.stop.torque_pn_nm", stop.torque_pn_nm)?;
    positive("task.stop.kinetic_pn_nm", stop.kinetic_pn_nm)
}

impl Scene {
    /// Checks all rules that do not require the assembled filament. Scenes from text have passed them.
    ///
    /// # Errors
    /// The first violated rule.
    pub fn validate(&self) -> Result<(), SceneProblem> {
        validate(self)
    }
}
