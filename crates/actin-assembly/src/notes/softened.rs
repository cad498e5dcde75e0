//! Warnings on softened stretches that are rods or resolved in part.

use crate::scene::{Monomers, RodChanges, Section};
use crate::{Assembly, SectionSpan};

/// Number of unaltered monomers between softened monomers and a rod for an error of 5 %.
///
/// # Source
/// `docs/measured/studies.md`, "Boundary of cofilin": in ends turned by up to 45 degrees, six
/// monomers leave errors of up to 4 %, four of up to 5 %, two of up to 8 %.
const BESIDE: usize = 6;

impl Assembly {
    /// Warnings on softened monomers near rods, at most one for each filament.
    pub(super) fn partly_resolved(&self) -> Vec<String> {
        let filaments = 0..self.filaments.len();
        let notes = filaments.filter_map(|filament| {
            let (span, monomers) = self.nearest_to_a_rod(filament)?;
            (monomers < BESIDE).then(|| {
                format!(
                    "filament {filament}: {monomers} unaltered monomers separate the softened monomers from {:.0} to {:.0} nm \
                     from a rod. In stretches with cofilin that were resolved in part, the largest energy per length was 0.84 to \
                     2.1 times that of monomers and up to 47 nm from its place. Resolve the whole stretch and 16 nm on \
                     both sides for an error of 5 % (docs/measured/studies.md)",
                    span.from_nm, span.to_nm
                )
            })
        });
        let filaments = 0..self.filaments.len();
        let rods = filaments.filter_map(|filament| {
            let span = self.softened_rod(filament)?;
            Some(format!(
                "filament {filament}: a softened rod from {:.0} to {:.0} nm. Beside unaltered parts, in ends turned by up to \
                 45 degrees, rods had 0.76 to 0.86 times the largest energy per length of monomers, up to 44 nm from its \
                 place. Resolve the stretch and 16 nm on both sides for an error of 5 % (docs/measured/studies.md)",
                span.from_nm, span.to_nm
            ))
        });
        notes.chain(rods).collect()
    }

    /// First softened rod of a filament whose sections have different rigidities.
    fn softened_rod(&self, filament: usize) -> Option<&SectionSpan> {
        let written = &self.written(filament).sections;
        let factors = |section: &Section| section.altered_rod().map(RodChanges::factors);
        let differs = |one: &Section| written.iter().any(|other| factors(other) != factors(one));
        let mut sections = written.iter().zip(self.sections_of(filament));
        let softened = sections.find(|(section, _)| {
            let is_softened =
                factors(section).is_some_and(|factors| factors.bend.min(factors.twist) < 1.0);
            is_softened && differs(section)
        });
        softened.map(|(_, span)| span)
    }

    /// Section of softened monomers with the fewest unaltered monomers before a rod, and their number.
    fn nearest_to_a_rod(&self, filament: usize) -> Option<(&SectionSpan, usize)> {
        let written = self.written(filament);
        let spans = self.sections_of(filament);
        let sections = written.sections.iter().zip(spans);
        let sections: Vec<_> = sections
            .map(|(section, span)| (span, is_softened(section, &written.monomers)))
            .collect();
        let softened = (0..sections.len()).filter(|&i| sections[i].1);
        let distances = softened.filter_map(|i| {
            let sides = [
                unaltered(sections[i + 1..].iter()),
                unaltered(sections[..i].iter().rev()),
            ];
            let nearest = sides.into_iter().flatten().min();
            nearest.map(|monomers| (sections[i].0, monomers))
        });
        distances.min_by_key(|&(_, monomers)| monomers)
    }
}

fn is_softened(section: &Section, filament: &Monomers) -> bool {
    let own = section.monomers(filament);
    own.lateral_rigidity_pn_per_nm < filament.lateral_rigidity_pn_per_nm
        || own.longitudinal_rigidity_pn_per_nm < filament.longitudinal_rigidity_pn_per_nm
}

/// Number of monomers up to the first rod; `None` if an end or softened monomers come first.
fn unaltered<'a>(sections: impl Iterator<Item = &'a (&'a SectionSpan, bool)>) -> Option<usize> {
    let mut monomers = 0;
    for (span, is_softened) in sections {
        if !span.is_ellipsoids() {
            return Some(monomers);
        }
        if *is_softened {
            return None;
        }
        monomers += span.points.len();
    }
    None
}

#[cfg(test)]
mod tests {
    use super::super::tests::notes;

    const SOFT: &str = "altered: (lateral_rigidity_factor: 0.1)";

    #[test]
    fn softened_monomers_near_rods_are_noted() {
        let found = |from: f64, to: f64, change: &str| {
            let filament = format!(
                "Filament(sections: [
                    Rod(from_nm: 0.0, to_nm: 100.0), Ellipsoids(from_nm: 100.0, to_nm: {from:?}),
                    Ellipsoids(from_nm: {from:?}, to_nm: {to:?}, {change}),
                    Ellipsoids(from_nm: {to:?}, to_nm: 200.0), Rod(from_nm: 200.0, to_nm: 300.0),
                ]),"
            );
            notes(&filament, "")
        };
        let near = found(117.0, 194.5, SOFT);
        assert_eq!(near.len(), 1);
        let begins =
            "filament 0: 2 unaltered monomers separate the softened monomers from 118 to 194 nm";
        assert!(near[0].starts_with(begins), "{near:?}");
        assert_eq!(found(117.0, 183.0, SOFT), [""; 0]);
        assert_eq!(found(111.0, 183.0, SOFT).len(), 1);
        assert_eq!(found(106.0, 194.0, "altered: (turn_deg: -162.0)"), [""; 0]);
    }

    #[test]
    fn softened_rods_beside_others_are_noted() {
        let found = |others: &str, factor: f64| {
            notes(
                &format!(
                    "Filament(sections: [Rod(from_nm: 0.0, to_nm: 100.0{others}),
                        Rod(from_nm: 100.0, to_nm: 200.0, altered: (bend_rigidity_factor: {factor:?}))]),"
                ),
                "",
            )
        };
        let soft = found("", 0.2);
        assert!(
            soft.len() == 1 && soft[0].starts_with("filament 0: a softened rod from 100 to 200 nm"),
            "{soft:?}"
        );
        assert_eq!(found("", 2.0), [""; 0]);
        assert_eq!(
            found(", altered: (bend_rigidity_factor: 0.2)", 0.2),
            [""; 0]
        );
    }

    #[test]
    fn ends_of_a_filament_are_not_noted() {
        let whole = format!("Filament(sections: [Ellipsoids(from_nm: 0.0, to_nm: 40.0, {SOFT})]),");
        assert_eq!(notes(&whole, ""), [""; 0]);
        let part = whole.replace(")]),", "), Rod(from_nm: 40.0, to_nm: 140.0)]),");
        let found = notes(&part, "");
        let begins =
            "filament 0: 0 unaltered monomers separate the softened monomers from 0 to 41 nm";
        assert!(
            found.len() == 1 && found[0].starts_with(begins),
            "{found:?}"
        );
    }
}
