//! Whether a scene's loads are borne, and whether its turns go with how its ends slide.

use super::path::{self, Values};
use super::{Clamp, HeldEnds, Hold, Resultant, Scene, SceneProblem, Setting, Slides};
use actin_mechanics::Vector3;
use std::collections::BTreeSet;

/// Part of the forces below which what is left of them is a rounding: sums and components of a few
/// forces are exact to a few units of 1e-16.
const ROUNDING: f64 = 1e-12;

/// Angle (rad) below which two written directions are the same: what six digits of each component
/// leave open.
const WRITTEN: f64 = 1e-5;

/// Part of the forces below which what is left of them looks like too few digits.
const DIGITS: f64 = 1e-3;

/// In time, the inertia of an end that slides is that of its motion along straight lines: a turn must
/// not swing it along them.
pub(super) fn check_swings(scene: &Scene, held: &HeldEnds) -> Result<(), SceneProblem> {
    for (i, stage) in scene.path.iter().enumerate() {
        for (k, setting) in stage.set.iter().enumerate() {
            let Setting::Turn {
                filament,
                end,
                turn_deg,
            } = *setting
            else {
                continue;
            };
            let clamp = held.clamp_at(filament, end);
            let slides = clamp.map(|c| scene.clamps[c].slides);
            let axis = scene.filament_at(filament).map(|f| f.axis_at(end));
            let tilts = axis.is_some_and(|axis| is_across(turn_deg.into(), axis));
            if slides == Some(Slides::Freely) || (slides == Some(Slides::AlongAxis) && tilts) {
                return Err(SceneProblem::new(
                    format!("path[{i}].set[{k}].turn_deg"),
                    format!("{turn_deg:?}"),
                    "in Dynamics and Brownian an end that slides turns about its axis only, and one that slides \
                     Freely not at all: Equilibrium follows such paths",
                ));
            }
        }
    }
    Ok(())
}

/// Whether `vector` has a component across the unit vector `axis`, beyond what six digits leave open.
///
/// Numbers that depend on the angle between them by its cosine are then right to 5e-11.
pub fn is_across(vector: Vector3, axis: Vector3) -> bool {
    vector.cross(&axis).norm() > WRITTEN * vector.norm()
}

/// Whether `vector` has a component along one of some orthonormal `directions`, beyond what six digits leave open.
pub(super) fn is_along(vector: Vector3, directions: &[Vector3]) -> bool {
    let along = directions.iter().map(|d| d.dot(&vector).powi(2));
    along.sum::<f64>().sqrt() > WRITTEN * vector.norm()
}

/// Forces that do not balance along a direction in which nothing is held have no equilibrium. Where
/// they do balance they have one: the filament turns until their couple vanishes.
///
/// What holds a filament also holds those that linkers join to it. A linker to an anchor holds
/// against every force: it follows its site around the anchor until it points along it. Load factors
/// are linear within a stage, so that what balances at the ends of all stages balances between. Walls may bear
/// anything.
pub(super) fn check_support(scene: &Scene) -> Result<(), SceneProblem> {
    if scene.has_walls() {
        return Ok(());
    }
    let joined = joined(scene);
    let groups = groups(scene, &joined);
    let factors = path::load_factors(&scene.path, scene.loads.len());
    // Of each group the lowest index stands for all.
    groups
        .iter()
        .enumerate()
        .filter(|(f, group)| joined[*f] == *f && !group.is_anchored)
        .try_for_each(|(_, group)| {
            group.check(scene, &factors)?;
            group.check_couples(scene, &factors)
        })
}

/// Filaments that linkers join.
#[derive(Clone)]
struct Group {
    /// Whether a linker leads to an anchor.
    is_anchored: bool,
    /// Directions, orthonormal, along which the clamps let it move.
    free: Vec<Vector3>,
    /// How it may turn.
    turns: Turning,
    /// Its loads by their indices, with their forces at factor 1 (pN).
    loads: Vec<(usize, Vector3)>,
    /// The same of couples (pN nm).
    couples: Vec<(usize, Vector3)>,
}

/// How the clamps of filaments that linkers join let them turn.
#[derive(Clone, Copy)]
enum Turning {
    /// In any way.
    Freely,
    /// In any way, about the pin of a filament.
    AboutPin(usize),
    /// About the line between both pins of one filament, its axis as built.
    AboutLine(Vector3),
    /// Not at all.
    Not,
}

impl Turning {
    /// How it turns once `clamp` holds it too; `axis` is that of the clamp's filament.
    fn held_by(self, clamp: &Clamp, axis: Vector3) -> Self {
        let is_bare_pin = clamp.hold == Hold::Pin && clamp.hinge.is_none();
        match self {
            Self::Freely if is_bare_pin => Self::AboutPin(clamp.filament),
            Self::AboutPin(other) if is_bare_pin && other == clamp.filament => {
                Self::AboutLine(axis)
            }
            _ => Self::Not,
        }
    }
}

/// For each filament that stands for a group what holds and loads that group; what is joined to
/// which is in `joined`.
fn groups(scene: &Scene, joined: &[usize]) -> Vec<Group> {
    let unheld = Group {
        is_anchored: false,
        free: Slides::Freely.directions(Vector3::z()),
        turns: Turning::Freely,
        loads: Vec::new(),
        couples: Vec::new(),
    };
    let mut groups = vec![unheld; joined.len()];
    for linker in scene.linkers.iter().filter(|linker| linker.to.is_none()) {
        groups[joined[linker.filament]].is_anchored = true;
    }
    for clamp in &scene.clamps {
        let axis = (scene.filament_at(clamp.filament)).map(|f| f.axis_at(clamp.end));
        let axis = axis.unwrap_or_default();
        let group = &mut groups[joined[clamp.filament]];
        group.hold(clamp.slides.directions(axis));
        group.turns = group.turns.held_by(clamp, axis);
    }
    for (i, load) in scene.loads.iter().enumerate() {
        let group = &mut groups[joined[load.filament()]];
        match load.resultant(scene) {
            Resultant::Force(force) => group.loads.push((i, force)),
            Resultant::Couple(couple) => group.couples.push((i, couple)),
        }
    }
    groups
}

/// The factors of all loads of a scene, by their indices.
type Factors = [Option<Values<f64>>];

impl Group {
    /// Holds it by a clamp that lets it move along the directions `slides` alone.
    fn hold(&mut self, slides: Vec<Vector3>) {
        let free = &mut self.free;
        match slides.len() {
            0 => free.clear(),
            1 if free.len() == 1 && is_across(free[0], slides[0]) => free.clear(),
            1 if !free.is_empty() => *free = slides,
            _ => {}
        }
    }

    /// Whether its loads balance before the path and after each stage that changes one of them.
    fn check(&self, scene: &Scene, factors: &Factors) -> Result<(), SceneProblem> {
        if self.free.is_empty() {
            return Ok(());
        }
        let mut ends = ends(&self.loads, factors);
        ends.try_for_each(|stages| self.check_balance(scene, factors, stages))
    }

    /// Couples about axes of the lab on what nothing keeps from turning: one spins it, and several that
    /// balance leave it no minimum, since it gains by bending wherever it turns to. What turns about the
    /// line between two pins alone takes couples that balance about it.
    fn check_couples(&self, scene: &Scene, factors: &Factors) -> Result<(), SceneProblem> {
        let mut acting = self.couples.iter().filter(|(_, m)| m.norm() > 0.0);
        let Some(&(first, _)) = acting.next() else {
            return Ok(());
        };
        let rule = match self.turns {
            Turning::Not => return Ok(()),
            Turning::AboutLine(axis) => {
                if ends(&self.couples, factors).all(|stages| self.balances(axis, factors, stages)) {
                    return Ok(());
                }
                "both ends are pinned and turn about the line between them: nothing resists this couple \
                 about it; a hinge or another hold would"
            }
            Turning::Freely | Turning::AboutPin(_) => {
                "no clamp holds the orientation of this filament: under couples it has no stable \
                 equilibrium"
            }
        };
        Err(scene.loads[first].problem(first, rule.to_owned()))
    }

    /// Whether its couples have no sum about an axis after so many stages.
    fn balances(&self, axis: Vector3, factors: &Factors, stages: usize) -> bool {
        let parts = self
            .couples
            .iter()
            .map(|&(i, couple)| (couple * factor(factors, i, stages), couple));
        let (sum, all) = parts.fold((0.0, 0.0), |(sum, all), (now, full)| {
            (sum + now.dot(&axis), all + full.norm())
        });
        sum.abs() <= WRITTEN * all
    }

    /// Whether the forces balance along the free directions after so many stages.
    fn check_balance(
        &self,
        scene: &Scene,
        factors: &Factors,
        stages: usize,
    ) -> Result<(), SceneProblem> {
        let (loads, free) = (&self.loads, &self.free);
        let factor = |i: usize| factor(factors, i, stages);
        let along = |force: &Vector3| -> Vector3 { free.iter().map(|d| d * d.dot(force)).sum() };
        let forces = loads.iter().map(|&(i, force)| force * factor(i));
        let left_over = along(&forces.clone().sum());
        let all: f64 = forces.clone().map(|force| force.norm()).sum();
        if left_over.norm() <= ROUNDING * all {
            return Ok(());
        }
        let drifts = |force: &Vector3| along(force).norm() > ROUNDING * force.norm();
        let Some(blamed) = forces.clone().position(|force| drifts(&force)) else {
            return Ok(());
        };
        let (i, force) = loads[blamed];
        let size = left_over.norm();
        let mut rule = vec!["no clamp or linker resists this force".to_owned()];
        if forces.filter(drifts).count() > 1 {
            rule.push(format!(
                ", and the other forces do not balance it: their sum is {size:.1e} pN"
            ));
        }
        let load = &scene.loads[i];
        if size <= DIGITS * all {
            let balanced = force - left_over / factor(i);
            let [x, y, z] = (balanced / load.extent(scene)).into();
            rule.push(format!(" (it would be balanced as ({x:?}, {y:?}, {z:?}))"));
        }
        rule.push(": it has no equilibrium".to_owned());
        Err(load.problem(i, rule.concat()))
    }
}

/// The ends of stages at which one of some loads changes, the beginning included.
fn ends(loads: &[(usize, Vector3)], factors: &Factors) -> impl Iterator<Item = usize> {
    let set = loads.iter().filter_map(|(i, _)| factors[*i].as_ref());
    let ends: BTreeSet<usize> = set.flat_map(Values::ends).chain([0]).collect();
    ends.into_iter()
}

/// Factor of load `i` after so many stages.
fn factor(factors: &Factors, i: usize, stages: usize) -> f64 {
    factors[i].as_ref().map_or(path::UNSET, |v| v.after(stages))
}

/// For each filament the lowest index among those that linkers join it to, itself included.
fn joined(scene: &Scene) -> Vec<usize> {
    let mut lower: Vec<usize> = (0..scene.number_of_filaments()).collect();
    let pairs = scene
        .linkers
        .iter()
        .filter_map(|linker| Some((linker.filament, linker.to?.filament)));
    for (one, other) in pairs {
        let (one, other) = (lowest(&mut lower, one), lowest(&mut lower, other));
        lower[one.max(other)] = one.min(other);
    }
    (0..lower.len()).map(|f| lowest(&mut lower, f)).collect()
}

/// The lowest index that `filament` leads to, each one in `lower` leading to one of its group that is
/// not above it; halves the way for those who come later.
fn lowest(lower: &mut [usize], mut filament: usize) -> usize {
    while lower[filament] != filament {
        lower[filament] = lower[lower[filament]];
        filament = lower[filament];
    }
    filament
}

#[cfg(test)]
mod tests {
    use crate::Scene;

    /// The message with which a scene of three filaments is refused; empty if it is taken.
    fn refusal(clamps: &str, linkers: &str, force: &str) -> String {
        let rod = "sections: [Rod(from_nm: 0.0, to_nm: 30.0)]";
        let text = format!(
            "Scene(
                filaments: [
                    Filament({rod}),
                    Filament({rod}, at_nm: (20.0, 0.0, 0.0)),
                    Filament({rod}, direction: (1.0, 0.0, 0.0)),
                ],
                clamps: [{clamps}],
                linkers: [{linkers}],
                loads: [EndForce(filament: 1, end: End, force_pn: {force})],
                task: Equilibrium(),
            )"
        );
        Scene::from_ron(&text).map_or_else(|error| error.to_string(), |_| String::new())
    }

    /// A clamp or an anchor bears what linkers lead to it, and nothing else.
    #[test]
    fn support_goes_along_linkers() {
        let link = |a: usize, b: usize| {
            format!(
                "Linker(filament: {a}, at_nm: 30.0, to: Site(filament: {b}, at_nm: 30.0), stiffness_pn_per_nm: 1.0),"
            )
        };
        let chain = [link(2, 1), link(0, 2)].concat();
        let anchor = "Linker(at_nm: 0.0, displaced_nm: (1.0, 0.0, 0.0), stiffness_pn_per_nm: 1.0)";
        let force = "(0.0, 0.0, 1.0)";
        let is_borne = |clamps: &str, linkers: &str| refusal(clamps, linkers, force).is_empty();
        assert!(!is_borne("", "") && !is_borne("Clamp(end: Start)", ""));
        assert!(is_borne("Clamp(filament: 1, end: Start)", ""));
        assert!(is_borne("Clamp(end: Start)", &chain));
        assert!(!is_borne("", &chain) && is_borne("", &[&chain, anchor].concat()));
        assert!(!is_borne("Clamp(end: Start)", &link(2, 1)) && !is_borne("", anchor));
        let message = refusal("", "", force);
        assert!(
            message.contains("loads[0].force_pn = [0.0, 0.0, 1.0]: no clamp or linker"),
            "{message}"
        );
    }

    /// An end that slides along its axis bears no force along it, unless another end that slides
    /// along another axis is joined to it.
    #[test]
    fn axes_that_differ_hold_each_other() {
        let slide = |f: usize| format!("Clamp(filament: {f}, end: Start, slides: AlongAxis),");
        let join = "Linker(filament: 1, at_nm: 30.0, to: Site(filament: 2, at_nm: 30.0), stiffness_pn_per_nm: 1.0),";
        assert!(!refusal(&slide(1), "", "(0.0, 0.0, 1.0)").is_empty());
        assert!(refusal(&slide(1), "", "(0.0, 2.0, 0.0)").is_empty());
        assert!(!refusal(&slide(2), join, "(2.0, 0.0, 0.0)").is_empty());
        let both = [slide(1), slide(2)].concat();
        assert!(refusal(&both, join, "(1.0, 1.0, 1.0)").is_empty());
    }

    /// The message with which a free rod under these forces, after these stages, is refused.
    fn balance(loads: &str, stages: &str) -> String {
        let text = format!(
            "Scene(
                filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 30.0)]),
                loads: [{loads}],
                path: [{stages}],
                task: Equilibrium(),
            )"
        );
        Scene::from_ron(&text).map_or_else(|error| error.to_string(), |_| String::new())
    }

    /// Forces are judged by their sum, at the end of every stage: balance at the end is not enough.
    #[test]
    fn forces_that_balance_need_no_support() {
        let pair = "EndForce(end: End, force_pn: (0.3, -0.1, 2.0)),
                    EndForce(end: Start, force_pn: (-0.3, 0.1, -2.0)),";
        let stage = |a: f64, b: f64| {
            format!(
                "Stage(set: [LoadFactor(load: 0, factor: {a:?}), LoadFactor(load: 1, factor: {b:?})]),"
            )
        };
        assert_eq!(balance(pair, ""), "");
        assert_eq!(
            balance(pair, &[stage(0.5, 0.5), stage(2.0, 2.0)].concat()),
            ""
        );
        let message = balance(pair, &[stage(0.5, 0.6), stage(1.0, 1.0)].concat());
        assert!(message.contains("loads[0].force_pn"), "{message}");
        assert!(message.contains("their sum is 2.0e-1 pN"), "{message}");
        // A stage that sets one of the two leaves out the other.
        let one = "Stage(set: [LoadFactor(load: 0, factor: 1.0)])";
        assert!(balance(pair, one).contains("no stage of the path sets this load"));
        let half = pair.replace("-2.0", "-1.0");
        assert!(balance(&half, "").contains("the other forces do not balance it"));
    }

    /// What was written with too few digits is told in full, and is taken then.
    #[test]
    fn digits_that_are_missing_are_told() {
        let forces = |third: &str| {
            format!(
                "EndForce(end: End, force_pn: (0.333333, 0.0, 1.0)),
                 EndForce(end: End, force_pn: {third}),
                 EndForce(end: Start, force_pn: (-1.0, 0.0, -1.0)),"
            )
        };
        let message = balance(&forces("(0.666666, 0.0, 0.0)"), "");
        let (_, told) = message.split_once("balanced as (").unwrap();
        let first = told.split_once(')').unwrap().0;
        let corrected = forces("(0.666666, 0.0, 0.0)").replace("0.333333, 0.0, 1.0", first);
        assert_eq!(balance(&corrected, ""), "", "{message}");
        assert!(!balance(&forces("(0.6, 0.0, 0.0)"), "").contains("balanced as"));
    }

    /// A turn about a tilted axis that was written with six digits is one about that axis; one in five
    /// digits more is not.
    #[test]
    fn six_digits_are_enough_for_a_turn() {
        let turned = |turn: &str| {
            let text = format!(
                "Scene(
                    filament: Filament(
                        sections: [Rod(from_nm: 0.0, to_nm: 30.0)],
                        direction: (1.0, 2.0, 2.5),
                    ),
                    clamps: [Clamp(end: Start), Clamp(end: End, slides: AlongAxis)],
                    path: [Stage(set: [Turn(end: End, turn_deg: {turn})], duration_ns: 1.0)],
                    task: Dynamics(duration_ns: 1.0),
                )"
            );
            Scene::from_ron(&text).map_or_else(|error| error.to_string(), |_| String::new())
        };
        // 90 deg about the axis, (1, 2, 2.5) / 3.354102.
        assert_eq!(turned("(26.8328, 53.6656, 67.0820)"), "");
        let message = turned("(26.84, 53.67, 67.07)");
        assert!(message.contains("turns about its axis only"), "{message}");
    }
}
