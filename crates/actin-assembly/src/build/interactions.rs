//! Interactions within one filament: sections and the junctions between them.

use super::SceneParts;
use super::strand::{Body, Strand};
use crate::law::EndConditions;
use crate::scene::SceneProblem;
use crate::{Part, Resolution, Rod, models, problem_at};
use actin_cosserat::RodLayout;
use actin_coupling::{AttachedMonomer, Junction, JunctionParts, JunctionSide};
use actin_ellipsoid::{Monomers, QuasiHarmonic};
use actin_mechanics::Interaction;

impl Strand<'_> {
    /// Pushes the interactions of all sections and junctions in filament order. `chains` are the
    /// quasi-harmonic sections.
    pub(super) fn push_interactions(
        &self,
        chains: &[Option<QuasiHarmonic>],
        stock: &mut SceneParts,
    ) -> Result<(), SceneProblem> {
        let junctions: Vec<Option<Junction>> = (1..self.bodies.len())
            .map(|i| {
                let is_junction = self.is_junction(i - 1);
                is_junction.then(|| self.junction(i - 1, stock)).transpose()
            })
            .collect::<Result<_, _>>()?;
        let joined = |junction: Option<&Option<Junction>>| {
            let junction = junction.and_then(Option::as_ref);
            junction.map_or_else(Vec::new, Junction::joined_elements)
        };
        for i in 0..self.bodies.len() {
            let before = i.checked_sub(1).map(|k| &junctions[k]);
            let run = self.run_of(i);
            let around = EndConditions {
                joined: [joined(before), joined(junctions.get(i))],
                ends: self.end_shear(run),
                beyond_nm: self.beyond_nm(i, run),
            };
            if let Some(Some(junction)) = before {
                let part = Part::Junction(self.first_section + i - 1);
                stock.push_term(Box::new(junction.clone()), part);
            }
            let interaction = match chains.get(i) {
                Some(Some(chain)) => Box::new(chain.clone()),
                _ => self.interaction_of(i, &around, stock)?,
            };
            stock.push_term(interaction, Part::Section(self.first_section + i));
        }
        Ok(())
    }

    fn interaction_of(
        &self,
        i: usize,
        around: &EndConditions,
        stock: &mut SceneParts,
    ) -> Result<Box<dyn Interaction>, SceneProblem> {
        Ok(match &self.bodies[i] {
            Body::Monomers(monomers) => {
                let run = self.bonded_run(i, monomers);
                let bonds = self.models[i]
                    .bonds_above(&run, monomers.count, self.turns(i)[1])
                    .map_err(|e| models::unbonded(&e, &self.filament.monomers))?;
                if let Resolution::Ellipsoids { bonds: count, .. } =
                    &mut stock.sections[self.first_section + i].resolution
                {
                    *count = bonds.number_of_bonds();
                }
                Box::new(bonds)
            }
            Body::Rod(layout) => {
                stock.rods.push(self.rod(i, layout, around));
                self.laws[i].interaction(layout, around)
            }
        })
    }

    /// The rod of section `i` with the ranges of the data of its laws.
    fn rod(&self, i: usize, layout: &RodLayout, around: &EndConditions) -> Rod {
        Rod {
            section: self.first_section + i,
            layout: layout.clone(),
            material: self.laws[i].material,
            ranges: self.laws[i].ranges(),
            joined: around.joined.clone(),
            twist_watch: self.laws[i].twist_watch(layout, around),
        }
    }

    fn junction(&self, i: usize, stock: &SceneParts) -> Result<Junction, SceneProblem> {
        let n = self.attached();
        let attach = |monomers: &Monomers, from: usize| -> Vec<AttachedMonomer> {
            (from..from + n)
                .map(|k| AttachedMonomer {
                    point: monomers.point(k),
                    frame: monomers.frame(k),
                })
                .collect()
        };
        let (side, attached, [monomers, rod], layout) = match (&self.bodies[i], &self.bodies[i + 1])
        {
            (Body::Monomers(m), Body::Rod(layout)) => (
                JunctionSide::MonomersFirst,
                attach(m, m.count - n),
                [i, i + 1],
                layout,
            ),
            (Body::Rod(layout), Body::Monomers(m)) => {
                (JunctionSide::RodFirst, attach(m, 0), [i + 1, i], layout)
            }
            _ => unreachable!("a junction is between monomers and a rod"),
        };
        let parts = JunctionParts {
            side,
            weight: self.filament.junction.weight,
            monomers: &attached,
            frames: self.junction_frames[i].clone(),
            rod: layout,
            material: self.laws[rod].material,
        };
        let junction = Junction::new(&stock.state, parts);
        let twist = self.filament.sections[monomers].rest_curvature(&self.filament.monomers);
        let junction = junction.map_err(problem_at("filament.junction"))?;
        let junction = junction.with_monomer_twist(twist.z);
        Ok(if self.laws[rod].is_extended() {
            junction.with_extended_rod()
        } else {
            junction
        })
    }
}
