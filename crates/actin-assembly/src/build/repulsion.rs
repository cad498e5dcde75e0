//! Repulsion between parts of filaments and walls.

use super::{Body, Builder, Strand};
use crate::repulsion::RepulsionModel;
use crate::scene::SceneProblem;
use crate::{Part, problem_at};
use actin_cosserat::RodLayout;
use actin_coupling::repulsion::{
    Axis, Capsule, ContactParameters, Contacts, RepulsionError, WallContact,
};
use actin_ellipsoid::Monomers;
use std::f64::consts::PI;

impl Builder<'_> {
    /// Pushes the repulsion of a scene.
    ///
    /// # Errors
    /// If a radius or length is not positive.
    pub(super) fn push_repulsion(&mut self) -> Result<(), SceneProblem> {
        let Some(repulsion) = &self.scene.repulsion else {
            return Ok(());
        };
        let refused = problem_at("repulsion");
        let capsules = self.capsules().map_err(&refused)?;
        let (radius, stiffness) = (repulsion.radius_nm, repulsion.stiffness_pn_per_nm);
        let parameters = ContactParameters {
            radius,
            stiffness,
            apart: PI * radius,
        };
        let contacts = repulsion
            .filaments
            .then(|| Contacts::new(capsules.clone(), parameters))
            .transpose()
            .map_err(&refused)?
            .map(|contacts| contacts.with_cell(self.cell));
        if let Some(contacts) = &contacts {
            self.stock
                .push_term(Box::new(contacts.clone()), Part::Contacts);
        }
        let mut walls = Vec::new();
        for (name, wall) in repulsion.walls().map_err(&refused)? {
            let part = Part::Wall(name);
            let wall =
                WallContact::new(capsules.clone(), wall, radius, stiffness).map_err(&refused)?;
            self.stock.push_term(Box::new(wall.clone()), part);
            walls.push((part, wall));
        }
        let repelled = RepulsionModel {
            capsules,
            contacts,
            walls,
            radius_nm: radius,
        };
        self.repelled = Some(repelled);
        Ok(())
    }

    fn capsules(&self) -> Result<Vec<Capsule>, RepulsionError> {
        let mut capsules = Vec::new();
        for (filament, strand) in self.strands.iter().enumerate() {
            let sections = &self.stock.sections[self.filaments[filament].sections.clone()];
            let bodies = strand.bodies.iter().zip(&strand.resolved);
            for ((body, resolved), section) in bodies.zip(sections) {
                let reach = section.reach_nm(strand.lattice.rise_nm);
                let of_body = match body {
                    Body::Rod(layout) => segments(layout, (filament, resolved.from_nm)),
                    Body::Monomers(monomers) => self.monomers(strand, monomers, filament),
                };
                capsules.extend(of_body?.into_iter().map(|c| c.with_reach(reach)));
            }
        }
        Ok(capsules)
    }

    fn monomers(
        &self,
        strand: &Strand<'_>,
        monomers: &Monomers,
        filament: usize,
    ) -> Result<Vec<Capsule>, RepulsionError> {
        let state = &self.stock.state;
        let capsule = |k: usize| {
            let s_nm = strand.lattice.s_nm(monomers.index(k));
            let (point, frame) = (monomers.point(k), monomers.frame(k));
            let q = state.frames.orientation.get(frame);
            let arms = strand.cell(s_nm).map(|s| {
                let arm = strand.axis_at(s) - state.points.position.get(point);
                q.inverse_transform_vector(&arm)
            });
            let axis = Axis::Body { point, frame, arms };
            Capsule::new(axis, strand.lattice.rise_nm, (filament, s_nm))
        };
        (0..monomers.count).map(capsule).collect()
    }
}

fn segments(
    layout: &RodLayout,
    (filament, from_nm): (usize, f64),
) -> Result<Vec<Capsule>, RepulsionError> {
    let nodes = layout.node_positions();
    let lengths = layout.segment_lengths().iter().enumerate();
    let capsule = |(segment, length): (usize, &f64)| {
        let first = layout.points().start + segment;
        let middle = from_nm + 0.5 * (nodes[segment] + nodes[segment + 1]);
        Capsule::new(
            Axis::Points([first, first + 1]),
            *length,
            (filament, middle),
        )
    };
    lengths.map(capsule).collect()
}
