//! Bonds between monomers and bonds of junctions, for pictures and measurements.

use super::{Assembly, BodyKind, Resolution, models};
use crate::scene::Section;
use actin_ellipsoid::{Bonds, Monomers};
use std::ops::Range;

/// Bond of a junction, from the centre of an attached monomer to the end of the rod.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct JunctionBond {
    /// Index of the section before the junction.
    pub junction: usize,
    /// Index of the monomer's point.
    pub monomer: usize,
    /// Index of the monomer's frame.
    pub monomer_frame: usize,
    /// Index of the node at the rod's end.
    pub node: usize,
    /// Index of the bond's frame, `Q_MR` of the paper.
    pub frame: usize,
}

impl Assembly {
    /// Returns the bonds between the monomers of a section, or `None` for a rod.
    ///
    /// The bonds are sampled again from the scene's parameters. They equal the acting bonds,
    /// because samples are keyed by seed, interface and lattice index.
    ///
    /// # Panics
    /// If the parameters of the assembly's scene were changed after the build to values that allow
    /// no bonds.
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
        let (filament, i) = self.place_of_section(section);
        let sections = &self.written(filament).sections;
        let of = |section: &Section| section.monomers(self.monomers_of(filament));
        let own = of(&sections[i]);
        let next = sections.get(i + 1).map(of);
        let next_turn = next.as_ref().unwrap_or(&own).turn_deg.to_radians();
        let model = models::ellipsoids(&own, filament)
            .expect("the assembly was built with these parameters");
        let lowers = monomers.count;
        let run = Monomers {
            count: lowers + if self.goes_on_bonded(section) { 2 } else { 0 },
            ..monomers
        };
        let bonds = model.bonds_above(&run, lowers, next_turn);
        Some(bonds.expect("the assembly was built with these bonds"))
    }

    /// Returns `true` if a section of monomers is bonded to a following section of monomers.
    pub(crate) fn goes_on_bonded(&self, section: usize) -> bool {
        let filament = &self.filaments[self.filament_of_section(section)];
        let is_ellipsoids = |i: usize| self.sections[i].is_ellipsoids();
        section + 1 < filament.sections.end && is_ellipsoids(section) && is_ellipsoids(section + 1)
    }

    pub(crate) fn is_junction(&self, section: usize) -> bool {
        let is_ellipsoids = |i: usize| self.sections[i].is_ellipsoids();
        is_ellipsoids(section) != is_ellipsoids(section + 1)
    }

    /// Returns the bonds of all junctions in filament order.
    pub fn junction_bonds(&self) -> Vec<JunctionBond> {
        let junctions = self.filaments.iter().map(|f| f.sections.clone());
        let junctions = junctions.flat_map(|sections| sections.start..sections.end - 1);
        let junctions = junctions.filter(|&i| self.is_junction(i));
        junctions.flat_map(|i| self.bonds_of_junction(i)).collect()
    }

    fn bonds_of_junction(&self, junction: usize) -> Vec<JunctionBond> {
        let (before, after) = (&self.sections[junction], &self.sections[junction + 1]);
        let frames = (before.frames.end..after.frames.start)
            .filter(|&frame| self.frames[frame].kind == BodyKind::Junction);
        let filament = self.written(self.filament_of_section(junction));
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
    use crate::scene::Scene;
    use actin_mechanics::{Interaction, Xorshift, perturb};

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

    /// In a state where every bond is stretched, wrong anchors or pairs would change the energy.
    #[test]
    fn the_listed_bonds_are_those_that_act() {
        let mut assembly = build();
        perturb(
            assembly.system.state_mut(),
            &mut Xorshift::new(5),
            0.2,
            0.05,
        );
        let term = assembly.terms.iter().position(|t| t.name == "bonds");
        let acting = assembly.system.energies()[term.unwrap()];
        let bonds = assembly.bonds_of(1).unwrap();
        let own = bonds.energy(assembly.system.state());
        // Sums of a few thousand terms.
        assert!((own / acting - 1.0).abs() < 1e-12, "{own} {acting}");
        assert_eq!(bonds.number_of_bonds(), assembly.sections[1].bonds());
        assert!(assembly.bonds_of(0).is_none() && assembly.bonds_of(9).is_none());
    }

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
