//! Sections of a filament with neighbouring rods as one: these differ in the lengths of their segments alone, and are
//! one rod to monomers and walls.

use crate::assembly::Rod;
use crate::{Assembly, Resolution, SectionSpan};

/// Monomers, or all rods that follow one another.
pub(super) struct Run<'a> {
    /// Where; of rods the shortest segments are told.
    pub span: SectionSpan,
    /// The first of its rods, which has the law of all; none of monomers.
    pub rod: Option<&'a Rod>,
}

/// The runs of filament 0, in order.
pub(super) fn runs(assembly: &Assembly) -> Vec<Run<'_>> {
    let mut all: Vec<Run<'_>> = Vec::new();
    for (i, section) in assembly.sections_of(0).iter().enumerate() {
        match all.last_mut().filter(|last| last.rod.is_some()) {
            Some(last) if !section.is_ellipsoids() => extend(&mut last.span, section),
            _ => all.push(Run {
                span: section.clone(),
                rod: assembly.rods.iter().find(|rod| rod.section == i),
            }),
        }
    }
    all
}

/// The first of two neighbouring rods, with the second.
fn extend(rod: &mut SectionSpan, next: &SectionSpan) {
    rod.to_nm = next.to_nm;
    rod.points.end = next.points.end;
    rod.frames.end = next.frames.end;
    if let (Resolution::Rod { segment_nm }, Resolution::Rod { segment_nm: other }) =
        (&mut rod.resolution, &next.resolution)
    {
        *segment_nm = segment_nm.min(*other);
    }
}
