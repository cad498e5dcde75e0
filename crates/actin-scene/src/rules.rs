//! Rules for numbers that several parts of a scene share.

use super::{Filament, ForceLaw, SceneProblem, Section};
use actin_cosserat::constants::cross_section_radius;
use std::fmt::Debug;

/// Value with all its digits.
pub(super) fn show(value: impl Debug) -> String {
    format!("{value:?}")
}

pub(super) fn positive(key: &str, value: f64) -> Result<(), SceneProblem> {
    if value.is_finite() && value > 0.0 {
        return Ok(());
    }
    let rule = "must be finite and greater than 0";
    Err(SceneProblem::new(key, show(value), rule))
}

/// Checks an arc length (nm) on a filament of a length (nm).
pub(super) fn check_on_filament(key: &str, at_nm: f64, length: f64) -> Result<(), SceneProblem> {
    if (0.0..=length).contains(&at_nm) {
        return Ok(());
    }
    let rule = format!("must lie on the filament, from 0 to {length:?}");
    Err(SceneProblem::new(key, show(at_nm), rule))
}

/// Checks the index of one of `count` elements, such as a `linker`.
pub(super) fn check_index(
    key: &str,
    element: &str,
    index: usize,
    count: usize,
) -> Result<(), SceneProblem> {
    let rule = match count {
        _ if index < count => return Ok(()),
        0 => format!("the scene has no {element}s"),
        1 => format!("the only {element} has index 0"),
        _ => format!("there are {count} {element}s, counted from 0"),
    };
    Err(SceneProblem::new(key, index, rule))
}

/// Checks that the radius of curvature exceeds the radius of the filament. `curvature` is in 1/nm.
pub(super) fn check_curvature(
    key: &str,
    value: String,
    curvature: f64,
) -> Result<(), SceneProblem> {
    let radius = cross_section_radius();
    if curvature * radius < 1.0 {
        return Ok(());
    }
    let rule = format!(
        "the radius of curvature must be greater than the radius of the filament, {radius:.1} nm"
    );
    Err(SceneProblem::new(key, value, rule))
}

/// Checks that the forces of a filament have a potential, which `PaperBalance` does not.
pub(super) fn check_potential(filament: &Filament) -> Result<(), SceneProblem> {
    let has_rod = filament.sections.iter().any(Section::is_rod);
    if has_rod && filament.rod.force_law == ForceLaw::PaperBalance {
        let rule = "has no potential, which Equilibrium and Brownian require: write EnergyGradient";
        let key = "filament.rod.force_law";
        return Err(SceneProblem::new(key, "PaperBalance", rule));
    }
    Ok(())
}

/// Checks that exactly one of several keys below `key` is given.
pub(super) fn check_exactly_one<const N: usize>(
    key: &str,
    given: [(&str, Option<String>); N],
    what: &str,
) -> Result<(), SceneProblem> {
    let names = given.each_ref().map(|(name, _)| *name).join(" or ");
    let mut found = given.into_iter().filter_map(|(name, v)| Some((name, v?)));
    let Some((first, _)) = found.next() else {
        let rule = format!("no {what} is given: write {names}");
        return Err(SceneProblem::new(key, "", rule));
    };
    match found.next() {
        None => Ok(()),
        Some((name, value)) => {
            let rule =
                format!("the {what} is already given by `{first}`: write one of the two keys");
            Err(SceneProblem::new(format!("{key}.{name}"), value, rule))
        }
    }
}
