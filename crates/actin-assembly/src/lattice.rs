//! Section boundaries on the lattice of monomers.
//!
//! Monomer `j` lies at arc length `origin + j rise`. A clamped start made of monomers holds
//! monomers -1 and 0, and monomer 0 lies at arc length 0. At a free start, arc length 0 is the
//! middle between monomers 0 and 1. This choice depends on the clamps alone, so that a change of
//! resolution moves no monomer.

use crate::scene::{Filament, MAX_EXACT_INTEGER, SceneProblem, Section};
use crate::whole::to_index;

#[derive(Clone, Debug, PartialEq)]
pub(super) struct ResolvedSection {
    /// Arc length of the start (nm).
    pub from_nm: f64,
    /// Arc length of the end (nm).
    pub to_nm: f64,
    /// Lattice indices of the first and last monomer, including held monomers; `None` for a rod.
    pub monomers: Option<(i64, i64)>,
}

impl ResolvedSection {
    pub(super) fn length_nm(&self) -> f64 {
        self.to_nm - self.from_nm
    }
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Lattice {
    /// Arc length of monomer 0 (nm).
    pub origin_nm: f64,
    /// Rise per monomer (nm).
    pub rise_nm: f64,
}

impl Lattice {
    pub(super) fn new(filament: &Filament, [start, _]: [bool; 2]) -> Self {
        let rise_nm = filament.monomers.rise_nm;
        let origin_nm = if start { 0.0 } else { -0.5 * rise_nm };
        Self { origin_nm, rise_nm }
    }

    pub(super) fn s_nm(&self, j: i64) -> f64 {
        self.origin_nm + j as f64 * self.rise_nm
    }

    /// Index of the monomer nearest to an arc length, which `check_reach` limits.
    fn nearest(&self, s_nm: f64) -> i64 {
        to_index(((s_nm - self.origin_nm) / self.rise_nm).round())
    }

    /// Index of the monomer whose upper boundary (place plus half a rise) is nearest to `s_nm`.
    fn last_before(&self, s_nm: f64) -> i64 {
        self.nearest(s_nm - 0.5 * self.rise_nm)
    }
}

/// Resolves every section of a filament with held or free start and end.
///
/// # Errors
/// If a boundary exceeds the largest exact lattice index, a section has fewer than two monomers, or
/// a rod has no length.
pub(super) fn resolve(
    filament: &Filament,
    is_held: [bool; 2],
) -> Result<Vec<ResolvedSection>, SceneProblem> {
    let lattice = Lattice::new(filament, is_held);
    let sections = &filament.sections;
    let last = sections.len() - 1;
    (0..sections.len())
        .map(|i| {
            check_reach(filament, &lattice, i)?;
            let resolved = match sections[i] {
                Section::Ellipsoids { from_nm, to_nm, .. } => {
                    monomers(&lattice, is_held, (i, last), (from_nm, to_nm))
                }
                Section::Rod { from_nm, to_nm, .. } => {
                    let is_rod = |i: usize| sections.get(i).is_none_or(Section::is_rod);
                    let keeps = [i == 0 || is_rod(i - 1), is_rod(i + 1)];
                    rod(&lattice, keeps, (from_nm, to_nm))
                }
            };
            check(i, &sections[i], resolved)
        })
        .collect()
}

fn check_reach(filament: &Filament, lattice: &Lattice, i: usize) -> Result<(), SceneProblem> {
    let sections = &filament.sections;
    let (_, to_nm) = sections[i].span_nm();
    let has_monomers = matches!(sections[i], Section::Ellipsoids { .. });
    let reach = to_nm / lattice.rise_nm;
    if reach > MAX_EXACT_INTEGER && (has_monomers || sections.len() > 1) {
        return Err(SceneProblem::new(
            format!("filament.sections[{i}].to_nm"),
            format!("{to_nm:?}"),
            format!(
                "the section ends at monomer {reach:.2e}: the index of a monomer must be at most \
                 {MAX_EXACT_INTEGER:.1e}"
            ),
        ));
    }
    Ok(())
}

fn monomers(
    lattice: &Lattice,
    [start_held, end_held]: [bool; 2],
    (i, last): (usize, usize),
    span: (f64, f64),
) -> ResolvedSection {
    let half = 0.5 * lattice.rise_nm;
    let (first, from_nm) = match (i == 0, start_held) {
        (true, true) => (-1, 0.0),
        (true, false) => (0, 0.0),
        (false, _) => {
            let before = lattice.last_before(span.0);
            (before + 1, lattice.s_nm(before) + half)
        }
    };
    let (end, to_nm) = match (i == last, end_held) {
        (true, true) => {
            let inner = lattice.nearest(span.1);
            (inner + 1, lattice.s_nm(inner))
        }
        (true, false) => {
            let outer = lattice.nearest(span.1 + half);
            (outer, lattice.s_nm(outer) - half)
        }
        (false, _) => {
            let end = lattice.last_before(span.1);
            (end, lattice.s_nm(end) + half)
        }
    };
    ResolvedSection {
        from_nm,
        to_nm,
        monomers: Some((first, end)),
    }
}

/// Rod of a section. `keeps` selects the ends that stay as written; other ends move to monomers.
fn rod(lattice: &Lattice, keeps: [bool; 2], span: (f64, f64)) -> ResolvedSection {
    let half = 0.5 * lattice.rise_nm;
    let boundary = |s_nm: f64| lattice.s_nm(lattice.last_before(s_nm)) + half;
    ResolvedSection {
        from_nm: if keeps[0] { span.0 } else { boundary(span.0) },
        to_nm: if keeps[1] { span.1 } else { boundary(span.1) },
        monomers: None,
    }
}

fn check(
    i: usize,
    section: &Section,
    resolved: ResolvedSection,
) -> Result<ResolvedSection, SceneProblem> {
    let key = format!("filament.sections[{i}].to_nm");
    let (_, to_nm) = section.span_nm();
    if let Some((first, last)) = resolved.monomers
        && last - first < 1
    {
        return Err(SceneProblem::new(
            key,
            format!("{to_nm:?}"),
            format!(
                "the section holds {} monomer(s) at this rise: it needs at least two",
                (last - first + 1).max(0)
            ),
        ));
    }
    if resolved.to_nm <= resolved.from_nm {
        return Err(SceneProblem::new(
            key,
            format!("{to_nm:?}"),
            "section ends are moved to positions between monomers, which leaves this section empty: \
             write a longer section",
        ));
    }
    Ok(resolved)
}
