//! Validation of sections.

use super::rules::{check_curvature, each_positive, finite, non_negative, positive, show};
use super::sections::check_adaptive;
use super::validate::check_bonds;
use super::{Filament, Material, RodChanges, SceneProblem, Section};

const BOUNDARY_TOLERANCE_NM: f64 = 1e-9;

/// Largest change of the turn per monomer (deg).
const LARGEST_TURN_DEG: f64 = 30.0;

pub(super) fn check(filament: &Filament, note: &mut impl FnMut(Result<(), SceneProblem>)) {
    if let Some(adaptive) = filament.sections.adaptive() {
        note(check_adaptive(adaptive));
        return;
    }
    if filament.sections.following().is_some() {
        return;
    }
    let sections = &filament.sections;
    if sections.is_empty() {
        let rule = "a filament has at least one section";
        note(Err(SceneProblem::new("filament.sections", "[]", rule)));
    }
    for (i, section) in sections.iter().enumerate() {
        let previous = i.checked_sub(1).map(|p| &sections[p]);
        note(check_span(i, section).and_then(|()| check_boundary(i, section, previous)));
    }
    for (i, section) in sections.iter().enumerate() {
        let key = format!("filament.sections[{i}].altered");
        note(check_altered(&key, section, filament));
        note(
            section
                .altered_rod()
                .map_or(Ok(()), |altered| check_altered_rod(&key, altered)),
        );
    }
}

fn check_altered_rod(key: &str, altered: &RodChanges) -> Result<(), SceneProblem> {
    for (name, factor) in [
        ("bend_rigidity_factor", altered.bend_rigidity_factor),
        ("twist_rigidity_factor", altered.twist_rigidity_factor),
        ("stretch_rigidity_factor", altered.stretch_rigidity_factor),
        ("shear_rigidity_factor", altered.shear_rigidity_factor),
    ] {
        positive(&format!("{key}.{name}"), factor)?;
    }
    finite(
        &format!("{key}.rest_twist_per_nm"),
        altered.rest_twist_per_nm,
    )?;
    let [x, y] = altered.rest_curvature_per_nm;
    let key_of_curvature = format!("{key}.rest_curvature_per_nm");
    finite(&key_of_curvature, x)?;
    finite(&key_of_curvature, y)?;
    check_curvature(&key_of_curvature, show((x, y)), x.hypot(y))?;
    if let Some(Material::Rigidities {
        shear_pn,
        bend_pn_nm2,
    }) = altered.material
    {
        each_positive(&format!("{key}.material.shear_pn"), shear_pn)?;
        each_positive(&format!("{key}.material.bend_pn_nm2"), bend_pn_nm2)?;
    }
    Ok(())
}

fn check_altered(key: &str, section: &Section, filament: &Filament) -> Result<(), SceneProblem> {
    let Some(altered) = section.altered() else {
        return Ok(());
    };
    for (name, factor) in [
        ("lateral_rigidity_factor", altered.lateral_rigidity_factor),
        (
            "longitudinal_rigidity_factor",
            altered.longitudinal_rigidity_factor,
        ),
        ("mass_factor", altered.mass_factor),
    ] {
        positive(&format!("{key}.{name}"), factor)?;
    }
    for (name, bonds) in [
        ("lateral_bonds", altered.lateral_bonds),
        ("longitudinal_bonds", altered.longitudinal_bonds),
    ] {
        if let Some(bonds) = bonds {
            check_bonds(&format!("{key}.{name}"), filament.monomers.anchors, bonds)?;
        }
    }
    let (turn, own) = (
        filament.monomers.turn_deg,
        altered.turn_deg.unwrap_or(filament.monomers.turn_deg),
    );
    // NaN is refused.
    if (own - turn).abs() <= LARGEST_TURN_DEG {
        return Ok(());
    }
    let rule = format!(
        "must be within {LARGEST_TURN_DEG:?} degrees of the turn of the filament, {turn:.1} degrees"
    );
    Err(SceneProblem::new(
        format!("{key}.turn_deg"),
        show(own),
        rule,
    ))
}

fn check_span(i: usize, section: &Section) -> Result<(), SceneProblem> {
    let (from, to) = section.span_nm();
    let key = |name: &str| format!("filament.sections[{i}].{name}");
    non_negative(&key("from_nm"), from)?;
    finite(&key("to_nm"), to)?;
    if to <= from {
        return Err(SceneProblem::new(
            key("to_nm"),
            show(to),
            format!("must be greater than from_nm = {from:?}"),
        ));
    }
    if let Section::Rod {
        segments: Some(0), ..
    } = section
    {
        return Err(SceneProblem::new(
            key("segments"),
            0,
            "a rod has at least one segment",
        ));
    }
    Ok(())
}

fn check_boundary(
    i: usize,
    section: &Section,
    previous: Option<&Section>,
) -> Result<(), SceneProblem> {
    let (from, _) = section.span_nm();
    let before = previous.map_or(0.0, |p| p.span_nm().1);
    let rule = match previous {
        None => "the first section starts at 0".to_owned(),
        Some(_) if from < before => {
            format!("overlaps the previous section, which ends at {before:?}")
        }
        Some(_) => format!("leaves a gap after the previous section, which ends at {before:?}"),
    };
    let key = format!("filament.sections[{i}]");
    if (from - before).abs() > BOUNDARY_TOLERANCE_NM {
        return Err(SceneProblem::new(
            format!("{key}.from_nm"),
            show(from),
            rule,
        ));
    }
    let same = |p: &Section| !p.is_rod() && !section.is_rod() && p.altered() == section.altered();
    if previous.is_some_and(same) {
        return Err(SceneProblem::new(
            format!("{key}.from_nm"),
            show(from),
            "adjacent sections have the same monomers: write them as one section",
        ));
    }
    Ok(())
}
