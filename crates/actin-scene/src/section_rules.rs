//! Validation of sections.

use super::problem::Problems;
use super::rules::{check_curvature, show};
use super::sections::check_adaptive;
use super::validate::check_bonds;
use super::{Filament, SceneProblem, Section};

const BOUNDARY_TOLERANCE_NM: f64 = 1e-9;

/// Largest change of the turn per monomer (deg).
const LARGEST_TURN_DEG: f64 = 30.0;

/// Checks the sections of a filament, whose keys begin with `key`.
pub(super) fn check(filament: &Filament, key: &str, problems: &mut Problems) {
    let sections = &filament.sections;
    if let Some(adaptive) = sections.adaptive() {
        return problems.check(key, || check_adaptive(key, adaptive));
    }
    if sections.following().is_some() {
        return;
    }
    if sections.is_empty() {
        let rule = "a filament has at least one section";
        problems.note(Err(SceneProblem::new(key, "[]", rule)));
    }
    for (i, section) in sections.iter().enumerate() {
        let previous = i.checked_sub(1).map(|p| &sections[p]);
        let key = format!("{key}[{i}]");
        problems.check(&key, || {
            check_span(&key, section)?;
            check_boundary(&key, section, previous)
        });
        let key = format!("{key}.altered");
        problems.check(&key, || {
            check_altered(&key, section, filament)?;
            check_altered_rod(&key, section)
        });
    }
}

fn check_altered_rod(key: &str, section: &Section) -> Result<(), SceneProblem> {
    let Some(altered) = section.altered_rod() else {
        return Ok(());
    };
    let [x, y] = altered.rest_curvature_per_nm;
    check_curvature(
        &format!("{key}.rest_curvature_per_nm"),
        show((x, y)),
        x.hypot(y),
    )
}

fn check_altered(key: &str, section: &Section, filament: &Filament) -> Result<(), SceneProblem> {
    let Some(altered) = section.altered() else {
        return Ok(());
    };
    for (name, bonds) in [
        ("lateral_bonds", altered.lateral_bonds),
        ("longitudinal_bonds", altered.longitudinal_bonds),
    ] {
        if let Some(bonds) = bonds {
            check_bonds(&format!("{key}.{name}"), filament.monomers.anchors, bonds)?;
        }
    }
    let turn = filament.monomers.turn_deg;
    let own = altered.turn_deg.unwrap_or(turn);
    if !turn.is_finite() || (own - turn).abs() <= LARGEST_TURN_DEG {
        return Ok(());
    }
    let rule = format!(
        "must be within {LARGEST_TURN_DEG:?} degrees of the turn of the filament, {turn:.1} degrees"
    );
    let key = format!("{key}.turn_deg");
    Err(SceneProblem::new(key, show(own), rule))
}

fn check_span(key: &str, section: &Section) -> Result<(), SceneProblem> {
    let (from, to) = section.span_nm();
    if to <= from {
        let rule = format!("must be greater than from_nm = {from:?}");
        return Err(SceneProblem::new(format!("{key}.to_nm"), show(to), rule));
    }
    if matches!(section, Section::Rod { segments, .. } if *segments == Some(0)) {
        let rule = "a rod has at least one segment";
        return Err(SceneProblem::new(format!("{key}.segments"), 0, rule));
    }
    Ok(())
}

fn check_boundary(
    key: &str,
    section: &Section,
    previous: Option<&Section>,
) -> Result<(), SceneProblem> {
    let (from, _) = section.span_nm();
    let before = previous.map_or(0.0, |p| p.span_nm().1);
    let same = |p: &Section| !p.is_rod() && !section.is_rod() && p.altered() == section.altered();
    let rule = match previous {
        None if from > BOUNDARY_TOLERANCE_NM => "the first section starts at 0".to_owned(),
        Some(_) if from < before - BOUNDARY_TOLERANCE_NM => {
            format!("overlaps the previous section, which ends at {before:?}")
        }
        Some(_) if from > before + BOUNDARY_TOLERANCE_NM => {
            format!("leaves a gap after the previous section, which ends at {before:?}")
        }
        Some(previous) if same(previous) => {
            "adjacent sections have the same monomers: write them as one section".to_owned()
        }
        _ => return Ok(()),
    };
    let key = format!("{key}.from_nm");
    Err(SceneProblem::new(key, show(from), rule))
}
