//! Whether a scene's loads are borne, and whether its turns go with how its ends slide.

use super::{Filament, Load, Problem, Scene, Setting, Slides};
use actin_mechanics::Vector3;

/// Part of a vector's length below which a component of it is a rounding: unit vectors along a
/// filament are exact to a few units of 1e-16.
const ROUNDING: f64 = 1e-12;

/// In time, the inertia of an end that slides is that of its motion along straight lines: a turn must
/// not swing it along them.
pub(super) fn check_swings(scene: &Scene) -> Result<(), Problem> {
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
            let slides = scene.clamp_at(filament, end).map(|c| c.slides);
            let axis = scene.filament_at(filament).map(Filament::axis);
            let tilts = axis.is_some_and(|axis| is_across(turn_deg.into(), axis));
            if slides == Some(Slides::Freely) || (slides == Some(Slides::AlongAxis) && tilts) {
                return Err(Problem::new(
                    format!("path[{i}].set[{k}].turn_deg"),
                    format!("{turn_deg:?}"),
                    "in Dynamics an end that slides turns about its axis only, and one that slides \
                     Freely not at all: Equilibrium follows such paths",
                ));
            }
        }
    }
    Ok(())
}

/// Whether `vector` has a component across the unit vector `axis`.
pub(crate) fn is_across(vector: Vector3, axis: Vector3) -> bool {
    vector.cross(&axis).norm() > ROUNDING * vector.norm()
}

/// A load along a direction in which nothing is held has no equilibrium.
///
/// What holds a filament also holds those that linkers join to it. A linker to an anchor holds
/// against every force: it follows its site around the anchor until it points along it.
pub(super) fn check_support(scene: &Scene) -> Result<(), Problem> {
    let joined = joined(scene);
    let anchored: Vec<usize> = scene
        .linkers
        .iter()
        .filter(|linker| linker.to.is_none())
        .map(|linker| joined[linker.filament])
        .collect();
    for (i, load) in scene.loads.iter().enumerate() {
        let Load::EndForce {
            filament, force_pn, ..
        } = load;
        let group = joined[*filament];
        let force = Vector3::from(*force_pn);
        let drifts = |direction: &Vector3| force.dot(direction).abs() > ROUNDING * force.norm();
        let is_unheld =
            !anchored.contains(&group) && unheld(scene, &joined, group).iter().any(drifts);
        if is_unheld {
            return Err(Problem::new(
                format!("loads[{i}].force_pn"),
                format!("{force_pn:?}"),
                "nothing holds the filament against this force: it has no equilibrium",
            ));
        }
    }
    Ok(())
}

/// For each filament the lowest index among those that linkers join it to, itself included.
fn joined(scene: &Scene) -> Vec<usize> {
    let mut lowest: Vec<usize> = (0..scene.number_of_filaments()).collect();
    let pairs = scene
        .linkers
        .iter()
        .filter_map(|linker| Some((linker.filament, linker.to?.filament)));
    for (one, other) in pairs {
        let (from, to) = (
            lowest[one].max(lowest[other]),
            lowest[one].min(lowest[other]),
        );
        lowest
            .iter_mut()
            .filter(|l| **l == from)
            .for_each(|l| *l = to);
    }
    lowest
}

/// Directions, orthonormal, along which the clamps of a group of joined filaments let it move.
fn unheld(scene: &Scene, joined: &[usize], group: usize) -> Vec<Vector3> {
    let mut free = Slides::Freely.directions(Vector3::z());
    let clamps = scene
        .clamps
        .iter()
        .filter(|clamp| joined[clamp.filament] == group);
    for clamp in clamps {
        let axis = scene.filament_at(clamp.filament).map(Filament::axis);
        let slides = clamp.slides.directions(axis.unwrap_or_default());
        free = match slides.len() {
            0 => Vec::new(),
            1 if free.len() == 1 && is_across(free[0], slides[0]) => Vec::new(),
            1 if !free.is_empty() => slides,
            _ => free,
        };
    }
    free
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
            message.contains("loads[0].force_pn = [0.0, 0.0, 1.0]: nothing holds"),
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
}
