//! What a stretch of filament does otherwise than monomers under the same loads would: law, junctions.

use super::adjoint::Adjoint;
use super::cells::{Cells, strain_scale};
use super::ideal::{Ideal, PERIOD};
use super::sampling::{Defect, Segments};
use super::section_loads::{SectionLoads, Segment, linear, rotational, segments, six};
use crate::assembly::{BodyKind, Rod};
use crate::shape::axis::CrossSection;
use crate::{Assembly, SectionSpan};
use actin_ellipsoid::SixVector;
use actin_mechanics::{State, Vector3, rotation};

/// How far into a rod a junction is looked at (nm).
const INTO_ROD_NM: f64 = 20.0;
/// How far beside a place loads are those to one side of it (nm).
pub(super) const BESIDE_NM: f64 = 1e-6;
/// Share by which loads within a segment have to differ to count as others.
const DIFFER: f64 = 0.1;
/// Scale of the strains under a load below which there is none: far above what solvers leave.
const UNLOADED: f64 = 1e-8;
/// Cells on the way across a junction.
const ACROSS: u32 = 5;

/// Contribution of an error, and the stretch that it comes from (nm).
#[derive(Clone, Copy, Debug)]
pub(super) struct Contribution {
    pub span_nm: [f64; 2],
    pub error: f64,
}

/// An equilibrium that is looked at.
pub(super) struct Look<'a> {
    pub assembly: &'a Assembly,
    pub state: &'a State,
    pub loads: &'a SectionLoads,
    pub adjoint: &'a Adjoint,
    pub cells: &'a Cells,
    /// Share of the number that the law's part may miss.
    pub missed: f64,
}

impl Look<'_> {
    /// What the law of a rod, or of several that follow one another, makes of each segment, against monomers under the same couple and force.
    ///
    /// Cells are relaxed where most of the wanted number comes from, and compared with the law far from ends. None where one
    /// finds no minimum.
    pub(super) fn law(&self, span: &SectionSpan, rod: &Rod) -> Option<Vec<Contribution>> {
        let all = segments(self.assembly, self.state, span);
        let lengths = Segments {
            s_nm: all.iter().map(|segment| segment.s_nm).collect(),
            weights: all.iter().map(|segment| self.weight(segment)).collect(),
            shares: all.iter().map(|segment| self.share(segment)).collect(),
        };
        let errors = lengths.errors((self.adjoint.value, self.missed), |i| {
            self.of_segment(&all, i, rod)
        })?;
        let part = |(segment, error): (&Segment, f64)| Contribution {
            span_nm: segment.span_nm(),
            error,
        };
        Some(all.iter().zip(errors).map(part).collect())
    }

    /// The defect of segment `i` of a rod, against cells.
    ///
    /// A couple on the frame of a segment makes its load jump there. It has one strain for both halves, so that the segments
    /// before and behind it tell what they do.
    fn of_segment(&self, all: &[Segment], i: usize, rod: &Rod) -> Option<Defect> {
        if !self.jumps(&all[i]) {
            return self.of_cells(&all[i], rod);
        }
        let before = all[..i].iter().rev().find(|segment| !self.jumps(segment));
        let behind = all[i..].iter().find(|segment| !self.jumps(segment));
        let sides = before.into_iter().chain(behind);
        let defects: Option<Vec<Defect>> = sides.map(|side| self.of_cells(side, rod)).collect();
        let defects = defects?;
        Some(defects.iter().sum::<Defect>() / (defects.len().max(1) as f64))
    }

    /// Whether what acts on the frame of a segment changes its load there.
    fn jumps(&self, segment: &Segment) -> bool {
        let beside = [-BESIDE_NM, BESIDE_NM].map(|from| self.loads.at(segment.s_nm + from));
        let most = strain_scale(&beside[0]).max(strain_scale(&beside[1]));
        most > UNLOADED && strain_scale(&(beside[1] - beside[0])) > DIFFER * most
    }

    /// By how much more monomers are strained than a segment far from ends, under its load, with what they store beyond it: the
    /// mean of both halves, where their loads differ. Nothing without a load, where a number may depend on twist without bounds: rods
    /// at rest may not resist it.
    fn of_cells(&self, segment: &Segment, rod: &Rod) -> Option<Defect> {
        let halves = segment.halves_nm().map(|s_nm| self.loads.at(s_nm));
        let middle = self.loads.at(segment.s_nm);
        if strain_scale(&middle) < UNLOADED {
            return Some(Defect::zeros());
        }
        let energy = energy_of(rod, &segment.far);
        let differ = strain_scale(&(halves[1] - halves[0])) > DIFFER * strain_scale(&middle);
        let loads = if differ { &halves[..] } else { &[middle][..] };
        let mut sum = Defect::zeros();
        for load in loads {
            let cell = self.cells.under(load)?;
            let strain = cell.strain - segment.far;
            sum += strain.push(cell.energy - energy - load.dot(&strain));
        }
        Some(sum / loads.len() as f64)
    }

    /// What the ends of a rod do to its segments beside them, taken from the number: what monomers do there is told in full.
    pub(super) fn ends_of_rod(&self, span: &SectionSpan, rod: &Rod) -> Vec<Contribution> {
        let all = segments(self.assembly, self.state, span);
        let beside = all.iter().filter_map(|segment| {
            let strain = segment.far - segment.strain;
            let more = energy_of(rod, &segment.far) - segment.stored?;
            let defect = strain.push(more - self.loads.at(segment.s_nm).dot(&strain));
            Some(Contribution {
                span_nm: segment.span_nm(),
                error: self.weight(segment).dot(&defect),
            })
        });
        beside.collect()
    }

    /// What a defect of a segment makes of the number: by the mean of its halves, where a couple on its frame makes them differ.
    fn weight(&self, segment: &Segment) -> Defect {
        let by_strain = if self.jumps(segment) {
            let halves = segment.halves_nm().map(|s_nm| self.adjoint.weight(s_nm));
            0.5 * (halves[0] + halves[1])
        } else {
            self.adjoint.weight(segment.s_nm)
        };
        by_strain.push(self.adjoint.of_stored(1.0)) * segment.length_nm
    }

    /// How much of the number comes from a segment, about.
    fn share(&self, segment: &Segment) -> f64 {
        let weight = self.adjoint.weight(segment.s_nm);
        let strain = segment.strain.component_mul(&weight);
        segment.length_nm * strain.abs().sum()
    }

    /// What a junction makes of the stretch about it, but for the law of its rod.
    ///
    /// From about ten monomers before it (the mean of 13) to 20 nm into the rod, against monomers under the same
    /// loads.
    pub(super) fn junction(
        &self,
        monomers: &SectionSpan,
        rod: &SectionSpan,
    ) -> Option<Contribution> {
        let out = if rod.from_nm >= monomers.to_nm {
            1.0
        } else {
            -1.0
        };
        let joint = if out > 0.0 { rod.from_nm } else { rod.to_nm };
        let rise = self.assembly.monomers_of(0).rise_nm;
        let into = (0.5 * (monomers.to_nm - monomers.from_nm)).min(10.0 * rise);
        let from = joint - out * into;
        let along = (0.5 * (rod.to_nm - rod.from_nm)).min(INTO_ROD_NM);
        let to = self.node_near(rod, joint + out * along);
        let before = (from - out * 6.0 * rise).clamp(monomers.from_nm, monomers.to_nm);
        let ideal = Ideal::along(self.cells, |s| self.loads.at(s), ([before, to], ACROSS))?;
        let base = self.loads.cross_section(from);
        let at = |s_nm: f64| ideal.carry(base, [from, s_nm]);
        let (turn, shift) = mean_motion((self.assembly, self.state), monomers, from, at);
        let base = (base.0 + shift, rotation::exp(turn) * base.1);
        let (place, axes) = ideal.carry(base, [from, to]);
        let (place_here, axes_here) = self.loads.cross_section(to);
        let all = (
            rotation::log(axes * axes_here.inverse()),
            place - place_here,
        );
        let here = (self.assembly, self.state, self.loads);
        let law = of_law(here, rod, &ideal, [joint, to]);
        let body = axes_here.inverse();
        let defect = six(body * (all.0 - law.0), body * (all.1 - law.1)) * out;
        Some(Contribution {
            span_nm: [from.min(to), from.max(to)],
            error: self
                .adjoint
                .change(to, &defect, ideal.stored(&defect, &self.loads.at(to))),
        })
    }

    fn node_near(&self, rod: &SectionSpan, s_nm: f64) -> f64 {
        let nodes = rod.points.clone().map(|i| self.assembly.points[i].s_nm);
        let nearest = nodes.min_by(|a, b| (a - s_nm).abs().total_cmp(&(b - s_nm).abs()));
        nearest.unwrap_or(s_nm)
    }
}

/// Energy per length (pN) of a rod at a strain (body axes).
fn energy_of(rod: &Rod, strain: &SixVector) -> f64 {
    let (material, law) = &rod.law;
    law.uniform_energy(material, linear(strain), rotational(strain))
}

/// By how much more an ideal stretch turns and moves the cross-section at `to` than the segments of a rod do from
/// `from` on; to first order, lab frame.
pub(super) fn of_law(
    (assembly, state, loads): (&Assembly, &State, &SectionLoads),
    rod: &SectionSpan,
    ideal: &Ideal,
    [from, to]: [f64; 2],
) -> (Vector3, Vector3) {
    let direction = (to - from).signum();
    let (low, high) = (from.min(to), from.max(to));
    let place_to = loads.cross_section(to).0;
    let (mut turn, mut shift) = (Vector3::zeros(), Vector3::zeros());
    for segment in segments(assembly, state, rod) {
        let half = 0.5 * segment.length_nm;
        let (a, b) = (
            (segment.s_nm - half).max(low),
            (segment.s_nm + half).min(high),
        );
        if b <= a {
            continue;
        }
        let middle = 0.5 * (a + b);
        let defect = (ideal.strain(middle) - segment.strain) * ((b - a) * direction);
        let (place, axes) = loads.cross_section(middle);
        let turned = axes * rotational(&defect);
        turn += turned;
        shift += axes * linear(&defect) + turned.cross(&(place_to - place));
    }
    (turn, shift)
}

/// Mean turn, and mean displacement at `centre`, of the 13 monomers of a section about it against those that stand rigidly on
/// cross-sections (lab frame).
pub(super) fn mean_motion(
    (assembly, state): (&Assembly, &State),
    section: &SectionSpan,
    centre: f64,
    at: impl Fn(f64) -> CrossSection,
) -> (Vector3, Vector3) {
    let far = |i: &usize| (assembly.points[*i].s_nm - centre).abs();
    let is_monomer = |i: &usize| assembly.points[*i].kind == BodyKind::Monomer;
    let mut near: Vec<usize> = section.points.clone().filter(is_monomer).collect();
    near.sort_by(|a, b| far(a).total_cmp(&far(b)));
    near.truncate(PERIOD);
    let pivot = at(centre).0;
    let (mut turn, mut shift) = (Vector3::zeros(), Vector3::zeros());
    for &i in &near {
        let s_nm = assembly.points[i].s_nm;
        let (place, axes) = at(s_nm);
        let (own, moved, _) = own_motion((assembly, state), i, (s_nm, (place, axes)));
        turn += own;
        shift += moved - own.cross(&(place - pivot));
    }
    let n = near.len() as f64;
    (turn / n, shift / n)
}

/// Turn of a monomer, and displacement of its centre, against where it stands rigidly on a cross-section; and where that is from
/// the axis (lab frame).
pub(super) fn own_motion(
    (assembly, state): (&Assembly, &State),
    monomer: usize,
    (s_nm, (place, axes)): (f64, CrossSection),
) -> (Vector3, Vector3, Vector3) {
    let span = &assembly.filaments[0];
    let turned = axes * span.rotation.inverse();
    let arm = turned * (assembly.rest.points.position.get(monomer) - span.axis_place(s_nm));
    let frame = assembly.points[monomer]
        .frame
        .expect("a monomer has a frame");
    let stands = turned * assembly.rest.frames.orientation.get(frame);
    let turn = rotation::log(state.frames.orientation.get(frame) * stands.inverse());
    (
        turn,
        state.points.position.get(monomer) - (place + arm),
        arm,
    )
}
