//! Which bodies are bonded, for pictures and measurements: the bonds between monomers and those of a
//! junction. What the bonds do is in the crates of the models.

use super::{Assembly, BodyKind, Resolution, models};
use actin_ellipsoid::{Bonds, Monomers};
use std::ops::Range;

/// One bond of a junction: from an attached monomer's centre to the rod's end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct JunctionBond {
    /// The junction, by the index of the section before it.
    pub junction: usize,
    /// Point at the monomer's centre.
    pub monomer: usize,
    /// The monomer's frame.
    pub monomer_frame: usize,
    /// Node at the rod's end.
    pub node: usize,
    /// Frame of the bond, `Q_MR` of the paper.
    pub frame: usize,
}

impl Assembly {
    /// The bonds between the monomers of a section; none of a rod.
    ///
    /// They are drawn anew from the scene's parameters: draws are keyed by seed, interface and
    /// lattice index, so that these are the bonds that act, at the cost of drawing them.
    ///
    /// # Panics
    /// If the assembly's scene was given other parameters since it was built, which cannot be
    /// bonded.
    pub fn bonds_of(&self, section: usize) -> Option<Bonds> {
        let span = self.sections.get(section)?;
        let Resolution::Ellipsoids { first_index, .. } = span.resolution else {
            return None;
        };
        let monomers = Monomers {
            first_point: span.points.start,
            first_frame: span.frames.start,
            first_index,
            count: span.points.len(),
        };
        let filament = self.filament_of_section(section);
        let first = self.filaments[filament].sections.start;
        let written = self
            .scene
            .filament_at(filament)?
            .sections
            .get(section - first)?;
        let model = models::ellipsoids(&written.monomers(self.monomers_of(filament)), filament)
            .expect("the assembly was built with these parameters");
        let lowers = monomers.count;
        let run = Monomers {
            count: lowers + if self.goes_on_bonded(section) { 2 } else { 0 },
            ..monomers
        };
        let bonds = model.bonds_above(&run, lowers);
        Some(bonds.expect("the assembly was built with these bonds"))
    }

    /// Whether a section of monomers is followed by another in its filament, to which it is bonded.
    pub(crate) fn goes_on_bonded(&self, section: usize) -> bool {
        let filament = &self.filaments[self.filament_of_section(section)];
        let is_ellipsoids = |i: usize| self.sections[i].is_ellipsoids();
        section + 1 < filament.sections.end && is_ellipsoids(section) && is_ellipsoids(section + 1)
    }

    /// Whether a section and the next of its filament are of different kinds.
    pub(crate) fn is_junction(&self, section: usize) -> bool {
        let is_ellipsoids = |i: usize| self.sections[i].is_ellipsoids();
        is_ellipsoids(section) != is_ellipsoids(section + 1)
    }

    /// The bonds of all junctions in filament order.
    pub fn junction_bonds(&self) -> Vec<JunctionBond> {
        let junctions = self.filaments.iter().map(|f| f.sections.clone());
        let junctions = junctions.flat_map(|sections| sections.start..sections.end - 1);
        let junctions = junctions.filter(|&i| self.is_junction(i));
        junctions.flat_map(|i| self.bonds_of_junction(i)).collect()
    }

    /// The bonds of the junction between a section and the next.
    fn bonds_of_junction(&self, junction: usize) -> Vec<JunctionBond> {
        let (before, after) = (&self.sections[junction], &self.sections[junction + 1]);
        let frames = (before.frames.end..after.frames.start)
            .filter(|&frame| self.frames[frame].kind == BodyKind::Junction);
        let filament = self.scene.filament_at(self.filament_of_section(junction));
        let filament = filament.expect("the scene has the filament of each section");
        let attached = filament.junction.attached_monomers;
        let (monomers, node) = if before.is_ellipsoids() {
            (before, after.points.start)
        } else {
            (after, before.points.end - 1)
        };
        let nearest = |bodies: &Range<usize>| {
            if before.is_ellipsoids() {
                bodies.end - attached..bodies.end
            } else {
                bodies.start..bodies.start + attached
            }
        };
        let (points, monomer_frames) = (nearest(&monomers.points), nearest(&monomers.frames));
        let bodies = points.zip(monomer_frames).zip(frames);
        bodies
            .map(|((monomer, monomer_frame), frame)| JunctionBond {
                junction,
                monomer,
                monomer_frame,
                node,
                frame,
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Scene;
    use actin_mechanics::{Xorshift, perturb};

    fn build() -> Assembly {
        let text = "Scene(
            filament: Filament(sections: [
                Rod(from_nm: 0.0, to_nm: 20.0),
                Ellipsoids(from_nm: 20.0, to_nm: 50.0),
                Rod(from_nm: 50.0, to_nm: 70.0),
            ]),
            task: Equilibrium(),
        )";
        Assembly::build(&Scene::from_ron(text).unwrap()).unwrap()
    }

    /// The energy of the listed bonds is that of the term, in a state where every bond is
    /// stretched: other anchors, another pairing or another run of monomers would miss it.
    #[test]
    fn the_listed_bonds_are_those_that_act() {
        let mut assembly = build();
        perturb(
            assembly.system.state_mut(),
            &mut Xorshift::new(5),
            0.2,
            0.05,
        );
        let energies = assembly.system.energies();
        let bonds = assembly.bonds_of(1).unwrap();
        let state = assembly.system.state();
        let energy: f64 = bonds
            .pairs()
            .iter()
            .flat_map(|pair| {
                let ends = bonds.ends_of(pair, state).zip(bonds.bonds_of(pair));
                ends.map(|([lower, upper], bond)| {
                    let stretch = (upper - lower).norm() - bond.rest_length;
                    0.5 * pair.rigidity * bond.weight * stretch * stretch
                })
            })
            .sum();
        let term = assembly.terms.iter().position(|t| t.name == bonds_term());
        let expected = energies[term.unwrap()];
        assert_eq!(bonds.number_of_bonds(), assembly.sections[1].bonds());
        // Round-off of a sum over some thousand bonds.
        assert!((energy - expected).abs() < 1e-10 * expected);
        assert!(assembly.bonds_of(0).is_none() && assembly.bonds_of(9).is_none());
    }

    fn bonds_term() -> &'static str {
        "bonds"
    }

    /// At rest a bond spans the helix's radius and half a rise or one and a half: attaching the
    /// wrong monomer, or the one at the other end, makes it longer.
    #[test]
    fn junction_bonds_reach_from_the_nearest_two_monomers() {
        let assembly = build();
        let bonds = assembly.junction_bonds();
        let rest = &assembly.rest.points.position;
        let monomers = &assembly.scene.filament.monomers;
        let steps = [0.5, 1.5, 1.5, 0.5];
        assert_eq!(bonds.len(), steps.len());
        for (bond, steps) in bonds.iter().zip(steps) {
            let length = (rest.get(bond.monomer) - rest.get(bond.node)).norm();
            let expected = monomers.radius_nm.hypot(steps * monomers.rise_nm);
            assert!((length - expected).abs() < 1e-12, "{bond:?}");
            assert_eq!(assembly.frames[bond.frame].kind, BodyKind::Junction);
            let between =
                0.5 * (assembly.points[bond.monomer].s_nm + assembly.points[bond.node].s_nm);
            assert!((assembly.frames[bond.frame].s_nm - between).abs() < 1e-12);
        }
    }
}
