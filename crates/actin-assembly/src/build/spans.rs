//! Arc length intervals of the elements of interactions.

use super::sampled::Sampling;
use super::{Body, Builder, Strand};
use crate::Part;
use crate::scene::End;
use actin_cosserat::RodLayout;
use actin_ellipsoid::{InterfaceKind, Monomers};

impl Builder<'_> {
    /// Arc length interval (nm) of each element of each term; empty for parts outside filaments.
    pub(super) fn spans(&self) -> Vec<Vec<[f64; 2]>> {
        let strand_of = |section: usize| {
            let past = self.strands.partition_point(|s| s.first_section <= section);
            let strand = &self.strands[past - 1];
            (strand, section - strand.first_section)
        };
        let has_bonds = Sampling::from_task(&self.scene.task).is_none();
        let of = |part: Part| match part {
            Part::Section(section) => {
                let (strand, i) = strand_of(section);
                strand.section_spans(i, has_bonds)
            }
            Part::Junction(section) => {
                let (strand, i) = strand_of(section);
                strand.junction_bonds(i)
            }
            Part::Load(_) | Part::Linker(_) | Part::Clamp(_) | Part::Contacts | Part::Wall(_) => {
                Vec::new()
            }
        };
        self.stock.terms.iter().map(|term| of(term.part)).collect()
    }
}

impl Strand<'_> {
    fn section_spans(&self, i: usize, has_bonds: bool) -> Vec<[f64; 2]> {
        let monomers = match &self.bodies[i] {
            Body::Rod(layout) => return rod(layout, self.resolved[i].from_nm),
            Body::Monomers(monomers) => monomers,
        };
        let reached = self.bonded_run(i, monomers);
        let bonds = InterfaceKind::ALL.map(InterfaceKind::steps);
        self.interfaces(monomers, &reached, if has_bonds { &bonds } else { &[1] })
    }

    /// Intervals of interfaces from each lower monomer to the monomer `steps` above it. For bonds,
    /// lateral and longitudinal interfaces alternate. Upper monomers belong to the run `reached`,
    /// which begins with `monomers`.
    fn interfaces(
        &self,
        monomers: &Monomers,
        reached: &Monomers,
        steps: &[usize],
    ) -> Vec<[f64; 2]> {
        let s_nm = |k: usize| self.lattice.s_nm(reached.index(k));
        let of = |lower: usize| {
            let uppers = steps.iter().map(move |steps| lower + steps);
            let inside = uppers.filter(|&upper| upper < reached.count);
            inside.map(move |upper| [s_nm(lower), s_nm(upper)])
        };
        (0..monomers.count).flat_map(of).collect()
    }

    fn junction_bonds(&self, i: usize) -> Vec<[f64; 2]> {
        let n = self.attached();
        let s_nm = |m: &Monomers, k: usize| self.lattice.s_nm(m.index(k));
        let boundary = self.resolved[i].to_nm;
        match (&self.bodies[i], &self.bodies[i + 1]) {
            (Body::Monomers(m), Body::Rod(layout)) => {
                let middle = boundary + 0.5 * layout.end_length(End::Start);
                (m.count - n..m.count)
                    .map(|k| [s_nm(m, k), middle])
                    .collect()
            }
            (Body::Rod(layout), Body::Monomers(m)) => {
                let middle = boundary - 0.5 * layout.end_length(End::End);
                (0..n).map(|k| [middle, s_nm(m, k)]).collect()
            }
            _ => unreachable!("a junction is between monomers and a rod"),
        }
    }
}

/// Intervals of segments, followed by the intervals of bending elements between middles. A wall
/// bends the outer half of its segment.
fn rod(layout: &RodLayout, from_nm: f64) -> Vec<[f64; 2]> {
    let mut nodes = vec![from_nm];
    for length in layout.segment_lengths() {
        nodes.push(nodes[nodes.len() - 1] + length);
    }
    let last = nodes.len() - 1;
    let middle = |k: usize| 0.5 * (nodes[k] + nodes[k + 1]);
    let about = |k: usize| {
        let from = if k == 0 { nodes[0] } else { middle(k - 1) };
        let to = if k == last { nodes[last] } else { middle(k) };
        [from, to]
    };
    let first = usize::from(layout.wall(End::Start).is_none());
    let past = nodes.len() - usize::from(layout.wall(End::End).is_none());
    let segments = nodes.windows(2).map(|pair| [pair[0], pair[1]]);
    segments.chain((first..past).map(about)).collect()
}
