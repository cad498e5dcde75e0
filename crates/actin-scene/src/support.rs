//! Checks that loads are supported, and that turns of sliding ends are possible.

use super::path::{self, Values};
use super::{Clamp, ClampedEnds, FreeTranslation, Hold, Resultant, Scene, SceneProblem, Setting};
use actin_mechanics::Vector3;
use std::collections::BTreeSet;

/// Relative residual force that counts as round-off.
const ROUNDING: f64 = 1e-12;

/// Angle (rad) below which two directions are equal: the accuracy of six digits.
const WRITTEN: f64 = 1e-5;

/// Relative residual force below which digits are probably missing.
const DIGITS: f64 = 1e-3;

/// Refuses turns that move a sliding end along its free directions: its inertia is modelled for straight motion
/// only.
pub(super) fn check_swings(scene: &Scene, held: &ClampedEnds) -> Result<(), SceneProblem> {
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
            if slides == Some(FreeTranslation::Freely)
                || (slides == Some(FreeTranslation::AlongAxis) && tilts)
            {
                let rule = "in Dynamics and Brownian an end that slides AlongAxis can turn about its axis only, and \
                            an end that slides Freely cannot turn: write Equilibrium, or change slides";
                let key = format!("path[{i}].set[{k}].turn_deg");
                return Err(SceneProblem::new(key, format!("{turn_deg:?}"), rule));
            }
        }
    }
    Ok(())
}

/// Returns whether a vector is not parallel to the unit vector `axis`, to six digits.
///
/// The relative error of a cosine of the angle is below 5e-11 for parallel vectors.
pub fn is_across(vector: Vector3, axis: Vector3) -> bool {
    vector.cross(&axis).norm() > WRITTEN * vector.norm()
}

/// Returns whether a vector has a component along orthonormal directions, to six digits.
pub(super) fn is_along(vector: Vector3, directions: &[Vector3]) -> bool {
    let along = directions.iter().map(|d| d.dot(&vector).powi(2));
    along.sum::<f64>().sqrt() > WRITTEN * vector.norm()
}

/// Checks that forces balance along the free directions of filaments, which an equilibrium requires. A residual
/// torque is no obstacle: the filament rotates until it vanishes.
///
/// Clamps also support the filaments that linkers join. A linker to an anchor supports every force. Load
/// factors are linear within a stage, so a balance at the ends of all stages is sufficient. Walls may support
/// any load.
pub(super) fn check_support(scene: &Scene) -> Result<(), SceneProblem> {
    if scene.has_walls() {
        return Ok(());
    }
    let linkers = scene.linkers.iter();
    let pairs = linkers.filter_map(|linker| Some([linker.filament, linker.to?.filament]));
    let joined = lowest_joined(scene.number_of_filaments(), pairs);
    let groups = groups(scene, &joined);
    let factors = path::load_factors(&scene.path, scene.loads.len());
    groups
        .iter()
        .enumerate()
        .filter(|(f, group)| joined[*f] == *f && !group.is_anchored)
        .try_for_each(|(_, group)| {
            group.check(scene, &factors)?;
            group.check_couples(scene, &factors)
        })
}

#[derive(Clone)]
struct Group {
    is_anchored: bool,
    /// Orthonormal directions in which the clamps permit translation.
    free: Vec<Vector3>,
    turns: Turning,
    /// Indices and forces (pN, factor 1) of its loads.
    loads: Vec<(usize, Vector3)>,
    /// Indices and torques (pN nm, factor 1) of its couples.
    couples: Vec<(usize, Vector3)>,
}

/// Rotations that the clamps of a group permit.
#[derive(Clone, Copy)]
enum Turning {
    Freely,
    /// About the pin of a filament.
    AboutPin(usize),
    /// About the line between both pins of a filament.
    AboutLine(Vector3),
    Not,
}

impl Turning {
    /// Returns the permitted rotations after adding a clamp on a filament with this axis.
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

/// Returns the group of each filament that represents one; `joined` contains the representatives.
fn groups(scene: &Scene, joined: &[usize]) -> Vec<Group> {
    let unheld = Group {
        is_anchored: false,
        free: FreeTranslation::Freely.directions(Vector3::z()),
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

type Factors = [Option<Values<f64>>];

impl Group {
    /// Adds a clamp that permits translation only along the directions `slides`.
    fn hold(&mut self, slides: Vec<Vector3>) {
        let free = &mut self.free;
        match slides.len() {
            0 => free.clear(),
            1 if free.len() == 1 && is_across(free[0], slides[0]) => free.clear(),
            1 if !free.is_empty() => *free = slides,
            _ => {}
        }
    }

    /// Checks the balance of forces before the path and after each stage that changes one of the loads.
    fn check(&self, scene: &Scene, factors: &Factors) -> Result<(), SceneProblem> {
        if self.free.is_empty() {
            return Ok(());
        }
        let mut ends = ends(&self.loads, factors);
        ends.try_for_each(|stages| self.check_balance(scene, factors, stages))
    }

    /// Refuses couples on filaments that are free to rotate. A single couple spins the filament; balanced
    /// couples have no energy minimum. Filaments between two pins require couples that balance about the line
    /// between the pins.
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
                "both ends are pinned, and the filament rotates freely about the line between them under \
                 this couple: add a hinge, or write another hold"
            }
            Turning::Freely | Turning::AboutPin(_) => {
                "no clamp holds the orientation of this filament: under couples it has no stable \
                 equilibrium"
            }
        };
        Err(scene.loads[first].problem(first, rule.to_owned()))
    }

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
        let residual = along(&forces.clone().sum());
        let all: f64 = forces.clone().map(|force| force.norm()).sum();
        if residual.norm() <= ROUNDING * all {
            return Ok(());
        }
        let drifts = |force: &Vector3| along(force).norm() > ROUNDING * force.norm();
        let Some(first) = forces.clone().position(|force| drifts(&force)) else {
            return Ok(());
        };
        let (i, force) = loads[first];
        let size = residual.norm();
        let mut rule = vec!["no clamp or linker resists this force".to_owned()];
        if forces.filter(drifts).count() > 1 {
            rule.push(format!(
                ", and the other forces do not balance it: their sum is {size:.1e} pN"
            ));
        }
        let load = &scene.loads[i];
        if size <= DIGITS * all {
            let balanced = force - residual / factor(i);
            let [x, y, z] = (balanced / load.extent(scene)).into();
            rule.push(format!(" (the sum is zero with ({x:?}, {y:?}, {z:?}))"));
        }
        rule.push(": the filament has no equilibrium".to_owned());
        Err(load.problem(i, rule.concat()))
    }
}

/// Ends of stages at which a load changes, and the start.
fn ends(loads: &[(usize, Vector3)], factors: &Factors) -> impl Iterator<Item = usize> {
    let set = loads.iter().filter_map(|(i, _)| factors[*i].as_ref());
    let ends: BTreeSet<usize> = set.flat_map(Values::ends).chain([0]).collect();
    ends.into_iter()
}

fn factor(factors: &Factors, i: usize, stages: usize) -> f64 {
    factors[i].as_ref().map_or(path::UNSET, |v| v.after(stages))
}

/// Returns for each of `count` filaments the lowest index of the filaments that pairs join to it.
pub fn lowest_joined(count: usize, pairs: impl IntoIterator<Item = [usize; 2]>) -> Vec<usize> {
    let mut lower: Vec<usize> = (0..count).collect();
    for pair in pairs {
        let [one, other] = pair.map(|filament| lowest(&mut lower, filament));
        lower[one.max(other)] = one.min(other);
    }
    (0..count).map(|f| lowest(&mut lower, f)).collect()
}

/// Finds the representative of a filament in a union-find structure, with path halving.
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

    #[test]
    fn linkers_transmit_support() {
        let link = |a: usize, b: usize| {
            format!(
                "Linker(filament: {a}, at_nm: 30.0, to: Site(filament: {b}, at_nm: 30.0), stiffness_pn_per_nm: 1.0),"
            )
        };
        let chain = [link(2, 1), link(0, 2)].concat();
        let anchor = "Linker(at_nm: 0.0, displaced_nm: (1.0, 0.0, 0.0), stiffness_pn_per_nm: 1.0)";
        let force = "(0.0, 0.0, 1.0)";
        let is_supported = |clamps: &str, linkers: &str| refusal(clamps, linkers, force).is_empty();
        assert!(!is_supported("", "") && !is_supported("Clamp(end: Start)", ""));
        assert!(is_supported("Clamp(filament: 1, end: Start)", ""));
        assert!(is_supported("Clamp(end: Start)", &chain));
        assert!(!is_supported("", &chain) && is_supported("", &[&chain, anchor].concat()));
        assert!(!is_supported("Clamp(end: Start)", &link(2, 1)) && !is_supported("", anchor));
        let message = refusal("", "", force);
        assert!(
            message.contains("loads[0].force_pn = [0.0, 0.0, 1.0]: no clamp or linker"),
            "{message}"
        );
    }

    /// A sliding end does not support a force along its axis, unless linkers join it to an end with another
    /// axis.
    #[test]
    fn sliding_ends_with_different_axes_support_all_forces() {
        let slide = |f: usize| format!("Clamp(filament: {f}, end: Start, slides: AlongAxis),");
        let join = "Linker(filament: 1, at_nm: 30.0, to: Site(filament: 2, at_nm: 30.0), stiffness_pn_per_nm: 1.0),";
        assert!(!refusal(&slide(1), "", "(0.0, 0.0, 1.0)").is_empty());
        assert!(refusal(&slide(1), "", "(0.0, 2.0, 0.0)").is_empty());
        assert!(!refusal(&slide(2), join, "(2.0, 0.0, 0.0)").is_empty());
        let both = [slide(1), slide(2)].concat();
        assert!(refusal(&both, join, "(1.0, 1.0, 1.0)").is_empty());
    }

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

    #[test]
    fn balanced_forces_need_no_support() {
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
        let one = "Stage(set: [LoadFactor(load: 0, factor: 1.0)])";
        assert!(balance(pair, one).contains("no stage of the path sets this load"));
        let half = pair.replace("-2.0", "-1.0");
        assert!(balance(&half, "").contains("the other forces do not balance it"));
    }

    #[test]
    fn missing_digits_are_suggested() {
        let forces = |third: &str| {
            format!(
                "EndForce(end: End, force_pn: (0.333333, 0.0, 1.0)),
                 EndForce(end: End, force_pn: {third}),
                 EndForce(end: Start, force_pn: (-1.0, 0.0, -1.0)),"
            )
        };
        let message = balance(&forces("(0.666666, 0.0, 0.0)"), "");
        let (_, suggested) = message.split_once("the sum is zero with (").unwrap();
        let first = suggested.split_once(')').unwrap().0;
        let corrected = forces("(0.666666, 0.0, 0.0)").replace("0.333333, 0.0, 1.0", first);
        assert_eq!(balance(&corrected, ""), "", "{message}");
        assert!(!balance(&forces("(0.6, 0.0, 0.0)"), "").contains("the sum is zero"));
    }

    /// A turn vector with six digits counts as parallel to a tilted axis; four digits do not.
    #[test]
    fn turn_vectors_need_six_digits() {
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
        // 90 deg about the axis (1, 2, 2.5) / 3.354102.
        assert_eq!(turned("(26.8328, 53.6656, 67.0820)"), "");
        let message = turned("(26.84, 53.67, 67.07)");
        assert!(message.contains("turn about its axis only"), "{message}");
    }
}
