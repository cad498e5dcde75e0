//! Validation of scenes.

use super::adaptive_resolution::check_following;
use super::problem::Problems;
use super::rules::{check_index, check_potential, show};
use super::support::{check_support, check_swings};
use super::{
    Adaptive, Anchors, Clamp, ClampedEnds, Dynamics, End, Equilibrium, Filament, FreeTranslation,
    Hold, Monomers, Quantity, Resultant, Scene, SceneProblem, Task, bead, brownian, drag,
    imperfection, linker, load_rules, numbers, observable, periodic, rest, section_rules, shape,
    stage, thermal,
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
    problems(scene, 1).into_result()
}

/// Finds the first `most` violated rules, one for each key. Rules of the whole scene are checked only if all
/// other rules are met.
pub(super) fn problems(scene: &Scene, most: usize) -> Problems {
    let held = ClampedEnds::new(scene);
    let mut problems = Problems::new(most);
    numbers::check(&scene.to_value(), &mut problems);
    for (i, one) in scene.filaments().enumerate() {
        check_filament(one, &scene.filament_key(i), &mut problems);
    }
    if scene.filaments().any(|one| one.sections.is_empty()) {
        return problems;
    }
    each(&mut problems, "clamps", &scene.clamps, |i, clamp| {
        check_clamp(scene, &held, i, clamp)
    });
    each(&mut problems, "loads", &scene.loads, |i, load| {
        load.check(i, scene, &held)
    });
    each(&mut problems, "linkers", &scene.linkers, |i, linker| {
        linker::check(scene, i, linker)
    });
    each(&mut problems, "beads", &scene.beads, |i, bead| {
        bead::check(scene, i, bead)
    });
    if let Some(repulsion) = &scene.repulsion {
        repulsion.check(&mut problems);
    }
    periodic::check(scene, &mut problems);
    each(&mut problems, "path", &scene.path, |i, stage| {
        stage::check(scene, &held, i, stage)
    });
    observable::check_all(scene, &held, &mut problems);
    problems.check("task", || match &scene.task {
        Task::Dynamics(dynamics) => check_dynamics(dynamics),
        Task::Brownian(brownian) => brownian::check(brownian),
        Task::Equilibrium(equilibrium) => check_equilibrium(equilibrium),
    });
    if problems.found.is_empty() {
        problems.note(check_whole(scene, &held));
    }
    problems
}

/// Checks all elements of the list at `key`.
fn each<T>(
    problems: &mut Problems,
    key: &str,
    list: &[T],
    check: impl Fn(usize, &T) -> Result<(), SceneProblem>,
) {
    for (i, one) in list.iter().enumerate() {
        problems.check(&format!("{key}[{i}]"), || check(i, one));
    }
}

type FilamentRule = fn(&Filament) -> Result<(), SceneProblem>;

/// Checks a filament whose keys begin with `key`.
pub(super) fn check_filament(one: &Filament, key: &str, problems: &mut Problems) {
    section_rules::check(one, &format!("{key}.sections"), problems);
    let checks: [(&str, FilamentRule); 4] = [
        ("junction", check_junction),
        ("monomers", check_monomers),
        ("imperfection", imperfection::check),
        ("shape", shape::check),
    ];
    for (part, check) in checks {
        problems.check(&format!("{key}.{part}"), || {
            check(one).map_err(|problem| problem.with_filament(key))
        });
    }
}

fn check_start(scene: &Scene) -> Result<(), SceneProblem> {
    if scene.start.is_none() {
        return Ok(());
    }
    let rule = if scene.filaments().any(|one| one.imperfection.is_some()) {
        "replaces the imperfection of a filament: remove one of them"
    } else if scene.filaments().any(|one| one.sections.is_automatic()) {
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
            rest::check(scene, dynamics)?;
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
        let key = format!("{}.sections.want", scene.filament_key(i));
        let adaptive = filament.sections.adaptive().into_iter();
        for target in adaptive.flat_map(Adaptive::targets) {
            check_wanted(scene, &key, target.quantity())
                .map_err(|problem| problem.with_filament(&scene.filament_key(i)))?;
        }
    }
    Ok(())
}

/// Checks that the scene has a quantity, which `key` requests.
fn check_wanted(scene: &Scene, key: &str, quantity: Quantity) -> Result<(), SceneProblem> {
    if let Quantity::LinkerForce { linker } = quantity {
        let count = scene.linkers.len();
        check_index(&format!("{key}.linker"), "linker", linker, count)?;
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

fn check_junction(filament: &Filament) -> Result<(), SceneProblem> {
    let attached = filament.junction.attached_monomers;
    if (1..=2).contains(&attached) {
        return Ok(());
    }
    let rule = "a junction attaches 1 or 2 monomers";
    let key = "filament.junction.attached_monomers";
    Err(SceneProblem::new(key, attached, rule))
}

fn check_monomers(filament: &Filament) -> Result<(), SceneProblem> {
    let m = &filament.monomers;
    for (name, bonds) in [
        ("lateral_bonds", m.lateral_bonds),
        ("longitudinal_bonds", m.longitudinal_bonds),
    ] {
        check_bonds(&format!("filament.monomers.{name}"), m.anchors, bonds)?;
    }
    check_shortest(m)?;
    if m.anchors == Anchors::Cubature && m.seed != 0 {
        let rule = "quadrature bonds are not sampled: omit the seed, or write anchors: Independent";
        return Err(SceneProblem::new("filament.monomers.seed", m.seed, rule));
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
    i: usize,
    clamp: &Clamp,
) -> Result<(), SceneProblem> {
    let key = format!("clamps[{i}]");
    let filament = scene.named_filament(&format!("{key}.filament"), clamp.filament)?;
    if held.clamp_at(clamp.filament, clamp.end) != Some(i) {
        let rule = "this end is clamped already";
        let key = format!("{key}.end");
        return Err(SceneProblem::new(key, show(clamp.end), rule));
    }
    if !filament.is_rod_at(clamp.end) && clamp.hold != Hold::Wall {
        let rule = "this end consists of monomers: write Wall, which holds the last two monomers";
        let key = format!("{key}.hold");
        return Err(SceneProblem::new(key, show(clamp.hold), rule));
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
    if clamp.hinge.is_some() && !is_pinned {
        let rule = "a hinge requires a pinned end: write hold: Pin, or omit the hinge";
        return Err(SceneProblem::new(format!("{key}.hinge"), "", rule));
    }
    Ok(())
}

fn check_equilibrium(equilibrium: &Equilibrium) -> Result<(), SceneProblem> {
    let largest = equilibrium.largest_step;
    if largest > 1.0 || equilibrium.smallest_step > largest {
        let rule = "must be at most 1 and at least smallest_step";
        return Err(SceneProblem::new("task.largest_step", show(largest), rule));
    }
    if equilibrium.iterations == 0 {
        let rule = "must be at least 1";
        return Err(SceneProblem::new("task.iterations", 0, rule));
    }
    let states = equilibrium.states;
    if states > MOST_STATES {
        let rule = format!("must be at most {MOST_STATES}");
        return Err(SceneProblem::new("task.states", states, rule));
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
            let rule =
                format!("{rule}: otherwise the filament counts as at rest before it has moved");
            let key = format!("{key}.{name}");
            return Err(SceneProblem::new(key, show(tolerance), rule));
        }
    }
    Ok(())
}

fn check_dynamics(dynamics: &Dynamics) -> Result<(), SceneProblem> {
    let safety = dynamics.step_safety;
    if safety >= 1.0 {
        let rule = "must be below 1, the stability limit";
        return Err(SceneProblem::new("task.step_safety", show(safety), rule));
    }
    drag::check(dynamics)?;
    thermal::check(dynamics)
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
