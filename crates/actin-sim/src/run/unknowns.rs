//! Unknowns of an equilibrium, their order, and the tolerances.

use crate::Assembly;
use crate::scene::{Equilibrium as Settings, SceneProblem};
use actin_coupling::{LinkerEnd, Site};
use actin_equilibrium::{BodyOrder, Layout, Newton, NewtonOptions, Residual};
use actin_mechanics::Coordinates;

/// Offset between the arc lengths of successive filaments (nm), larger than any rise or segment
/// beyond an end.
const BETWEEN_FILAMENTS_NM: f64 = 1e3;

/// Largest displacement per step over the radius of repelling filaments. Two filaments then
/// approach by at most one radius and cannot pass through each other.
const DISPLACEMENT: f64 = 0.5;

/// Creates the Newton solver of an assembly, with unknowns ordered by filament and arc length.
///
/// With linkers, unknowns are eliminated in an order with less fill-in if one exists, and joined
/// bodies may rotate freely about each other. The same holds for repelling bodies. Their order is
/// determined in the state as built, and steps are limited by the thickness of the filaments.
///
/// # Errors
/// If the solver refuses tolerances or bodies.
pub fn newton(assembly: &Assembly, settings: &Settings) -> Result<Newton, SceneProblem> {
    let refused =
        |key: &str, error: &dyn std::error::Error| SceneProblem::new(key, "", error.to_string());
    let layout = layout(assembly)?;
    let options = NewtonOptions {
        tolerance: Residual {
            force: settings.force_pn,
            torque: settings.torque_pn_nm,
        },
        iterations: settings.iterations,
        ..NewtonOptions::default()
    };
    match &assembly.repelled {
        None => Newton::new(layout, options).map_err(|error| refused("task", &error)),
        Some(repelled) => {
            let options = NewtonOptions {
                largest_displacement: DISPLACEMENT * repelled.radius_nm,
                ..options
            };
            let reaches = (0..assembly.filaments.len()).map(|i| reach(assembly, i));
            let layout = layout.with_loose_beyond(order(assembly), reaches.fold(0.0, f64::max));
            let newton = Newton::new(layout, options);
            let mut newton = newton.map_err(|error| refused("task", &error))?;
            newton.determine_order(&assembly.rest, assembly.system.interactions());
            Ok(newton)
        }
    }
}

pub(crate) fn layout(assembly: &Assembly) -> Result<Layout, SceneProblem> {
    let layout = Layout::new(&assembly.rest, Some(&order(assembly)), Vec::new())
        .map_err(|error| SceneProblem::new("filament", "", error.to_string()))?;
    let loose = loose_pairs(assembly);
    if loose.is_empty() && assembly.repelled.is_none() {
        return Ok(layout);
    }
    Ok(layout.with_least_fill().with_loose(loose))
}

/// Pairs of bodies that only linkers join: in different filaments, or far apart in one filament.
fn loose_pairs(assembly: &Assembly) -> Vec<[Coordinates; 2]> {
    let reaches: Vec<f64> = (0..assembly.filaments.len())
        .map(|filament| reach(assembly, filament))
        .collect();
    let joined = assembly
        .linkers
        .iter()
        .filter_map(|linker| match linker.end() {
            LinkerEnd::Anchor(_) => None,
            LinkerEnd::Site(other) => Some((bodies_of(linker.site()), bodies_of(other))),
        });
    let pairs = joined.flat_map(|(site, other)| {
        let with_all = |a| other.iter().map(move |&b| [a, b]).collect::<Vec<_>>();
        site.iter().flat_map(|&a| with_all(a)).collect::<Vec<_>>()
    });
    pairs
        .filter(|&[a, b]| are_apart(assembly, &reaches, (a, b)))
        .collect()
}

fn bodies_of(site: &Site) -> Vec<Coordinates> {
    let points = site.shares().iter().map(|&(i, _)| Coordinates::Point(i));
    points.chain([Coordinates::Frame(site.frame())]).collect()
}

/// Upper bound of the coupling distance of bonds and segments of a filament (nm of arc length).
fn reach(assembly: &Assembly, filament: usize) -> f64 {
    let rise_nm = assembly.monomers_of(filament).rise_nm;
    let sections = assembly.sections_of(filament).iter();
    let reaches = sections.map(|section| section.reach_nm(rise_nm));
    reaches.fold(0.0, f64::max)
}

/// Returns `true` if no bond or segment couples two bodies; `reaches` are the coupling distances of
/// the filaments.
fn are_apart(assembly: &Assembly, reaches: &[f64], (a, b): (Coordinates, Coordinates)) -> bool {
    let place = |body| match body {
        Coordinates::Point(i) => (assembly.filament_of_point(i), assembly.points[i].s_nm),
        Coordinates::Frame(i) => (assembly.filament_of_frame(i), assembly.frames[i].s_nm),
    };
    let ((f, s_a), (g, s_b)) = (place(a), place(b));
    f != g || (s_a - s_b).abs() > reaches[f]
}

pub(crate) fn order(assembly: &Assembly) -> BodyOrder {
    let mut order = BodyOrder::default();
    let mut behind = 0.0;
    for filament in &assembly.filaments {
        let points = assembly.points[filament.points.clone()].iter();
        let frames = assembly.frames[filament.frames.clone()].iter();
        let first = order.points.len();
        order.points.extend(points.map(|p| behind + p.s_nm));
        order.frames.extend(frames.map(|f| behind + f.s_nm));
        let furthest = order.points[first..].iter().copied().fold(behind, f64::max);
        // Held monomers of the next filament lie one rise before its arc length 0.
        behind = furthest + BETWEEN_FILAMENTS_NM;
    }
    order
}
