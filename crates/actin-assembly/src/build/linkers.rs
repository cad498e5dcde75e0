//! Sites of linkers on monomers and rods.

use super::{Body, Builder, Strand};
use crate::lattice::ResolvedSection;
use crate::scene::{self, LinkerSite, SceneProblem, path};
use crate::{Assembly, Kinetics, Part, SiteTable, problem_at};
use actin_cosserat::RodLayout;
use actin_coupling::{
    Anchor, Hand, Linker, LinkerAngles, LinkerEnd, LinkerError, PeriodicCell, PeriodicImage,
    RodPlace, Site, SwitchedLinker,
};
use actin_ellipsoid::Monomers;
use actin_mechanics::{ControlId, Vector3};
use std::collections::HashMap;
use std::sync::Arc;

/// Length (nm) below which a linker has no direction. Positions are rounded to about 1e-14 nm.
const SHUT_NM: f64 = 1e-9;

impl Builder<'_> {
    pub(super) fn push_linkers(&mut self) -> Result<(), SceneProblem> {
        let mut nodes = Nodes::default();
        let periodic = self.scene.periodic.as_ref();
        self.cell = periodic.map(|periodic| PeriodicCell {
            size: periodic.size_nm.into(),
            strain: periodic.strain,
            factor: self.stock.state.add_control(path::UNSET),
        });
        for (i, linker) in self.scene.linkers.iter().enumerate() {
            let state = &mut self.stock.state;
            let has_anchor = linker.to.is_none();
            let controls = has_anchor.then(|| [0.0; 3].map(|value| state.add_control(value)));
            let built = self.linker((i, linker), controls, &mut nodes)?;
            match linker.kinetics {
                None => self
                    .stock
                    .push_term(Box::new(built.clone()), Part::Linker(i)),
                Some(kinetics) => self.push_switched((i, linker), kinetics, &built, &mut nodes)?,
            }
            self.linkers.push(built);
        }
        Ok(())
    }

    /// Stiffness of linker `i` against tilt and twist, if it has any.
    fn angles(
        &self,
        (i, linker): (usize, &scene::Linker),
        built: &Linker,
    ) -> Result<Option<LinkerAngles>, SceneProblem> {
        let [tilt, twist] = linker.angular();
        let mut stiff = [tilt, twist].into_iter().filter(|one| one.1 > 0.0);
        let Some((name, _)) = stiff.next() else {
            return Ok(None);
        };
        let stiffness = (tilt.1, twist.1);
        let angles = if linker.roams() {
            LinkerAngles::normal_to_sites(stiffness)
        } else {
            built.angles_as_built(stiffness, &self.stock.state)
        };
        angles
            .map(Some)
            .map_err(problem_at(format!("linkers[{i}].{name}")))
    }

    /// Pushes the centres of beads.
    ///
    /// # Errors
    /// If a bead has no site.
    pub(super) fn push_beads(&mut self) -> Result<(), SceneProblem> {
        let mut nodes = Nodes::default();
        for (i, bead) in self.scene.beads.iter().enumerate() {
            let site = self.site(&bead.site, &mut nodes);
            let site = site.map_err(problem_at(format!("beads[{i}].site")))?;
            self.beads.push((site, bead.radius_nm));
        }
        Ok(())
    }

    /// Pushes linker `i`, whose state changes in time.
    fn push_switched(
        &mut self,
        (i, linker): (usize, &scene::Linker),
        kinetics: scene::Kinetics,
        built: &Linker,
        nodes: &mut Nodes,
    ) -> Result<(), SceneProblem> {
        let table = match (&kinetics.roams, &kinetics.steps) {
            (Some(roams), steps) => {
                let is_reversed = steps.is_some_and(|steps| steps.step_nm < 0.0);
                let spaced = (roams.site_spacing_nm, is_reversed);
                self.sites_of_all(spaced, linker.radius_nm, nodes)
            }
            (None, steps) => {
                let length = self.strands[linker.filament].filament.length_nm();
                let places = steps.as_ref().map_or_else(
                    || vec![linker.at_nm],
                    |steps| steps.places_nm(linker.at_nm, length),
                );
                let at = |at_nm: f64| LinkerSite {
                    at_nm,
                    ..linker.site()
                };
                self.table(places.into_iter().map(at), nodes)
            }
        };
        let table = table.map_err(problem_at(format!("linkers[{i}]")))?;
        let state = &mut self.stock.state;
        let hand = Hand::new(state, Arc::clone(&table.sites), 0, kinetics.bound);
        let switched = if linker.roams() {
            let other = Hand::new(state, Arc::clone(&table.sites), 0, kinetics.bound);
            SwitchedLinker::between_hands(state, [hand, other], built)
        } else {
            SwitchedLinker::to_end(state, hand, built)
        };
        let thermal_energy = self.scene.thermal_energy_pn_nm();
        let all = self
            .kinetics
            .get_or_insert_with(|| Kinetics::new(state, thermal_energy));
        all.push(i, (switched.clone(), table), kinetics, state);
        self.stock.push_term(Box::new(switched), Part::Linker(i));
        Ok(())
    }

    fn table(
        &self,
        places: impl Iterator<Item = LinkerSite>,
        nodes: &mut Nodes,
    ) -> Result<SiteTable, LinkerError> {
        let places: Vec<LinkerSite> = places.collect();
        let sites = places.iter().map(|place| self.site(place, nodes));
        Ok(SiteTable {
            sites: sites.collect::<Result<_, _>>()?,
            places: places.iter().map(|one| (one.filament, one.at_nm)).collect(),
        })
    }

    /// Sites of all filaments at equal distances, in the direction of steps, at a radius. Linkers with the
    /// same sites share a table.
    fn sites_of_all(
        &mut self,
        (spacing_nm, is_reversed): (f64, bool),
        radius_nm: f64,
        nodes: &mut Nodes,
    ) -> Result<SiteTable, LinkerError> {
        let key = (spacing_nm.to_bits(), is_reversed, radius_nm.to_bits());
        if let Some(known) = self.site_tables.get(&key) {
            return Ok(known.clone());
        }
        let mut places = Vec::new();
        for (filament, strand) in self.strands.iter().enumerate() {
            let mut own = strand.filament.sites_nm(spacing_nm);
            if is_reversed {
                own.reverse();
            }
            places.extend(own.into_iter().map(|at_nm| LinkerSite {
                filament,
                at_nm,
                radius_nm,
                azimuth_deg: strand.filament.azimuth_at_radius_deg(at_nm, radius_nm),
            }));
        }
        let table = self.table(places.into_iter(), nodes)?;
        self.site_tables.insert(key, table.clone());
        Ok(table)
    }

    /// Linker `i` of a scene. `controls` move its anchor.
    ///
    /// # Errors
    /// If a linker with a rest length has coincident ends.
    fn linker(
        &self,
        (i, linker): (usize, &scene::Linker),
        controls: Option<[ControlId; 3]>,
        nodes: &mut Nodes,
    ) -> Result<Linker, SceneProblem> {
        let refused = problem_at(format!("linkers[{i}]"));
        let site = self.site(&linker.site(), nodes).map_err(&refused)?;
        let end = match &linker.to {
            Some(other) => LinkerEnd::Site(self.site(other, nodes).map_err(&refused)?),
            None => LinkerEnd::Anchor(Anchor {
                position: self.anchor(linker, &site),
                controls,
            }),
        };
        let (stiffness, rest_length) = (linker.stiffness_pn_per_nm, linker.rest_length_nm);
        let built = Linker::new(site, end, stiffness, rest_length).map_err(refused)?;
        let built = built.with_image(self.image(linker));
        let length = built.extension(&self.stock.state) + rest_length;
        if rest_length > 0.0 && length < SHUT_NM {
            let value = linker.anchor();
            return Err(SceneProblem::new(
                format!("linkers[{i}].{}", linker.end_key()),
                value.map_or_else(String::new, |v| format!("{v:?}")),
                "puts the anchor at the site: a linker with a rest length needs a direction",
            ));
        }
        let angles = self.angles((i, linker), &built)?;
        Ok(built.with_angles(angles))
    }

    /// Image of the second end: as written, or the nearest one for hands that roam.
    fn image(&self, linker: &scene::Linker) -> Option<PeriodicImage> {
        let roams = linker.roams();
        Some(PeriodicImage {
            cell: self.cell.filter(|_| roams || linker.image != [0; 3])?,
            index: (!roams).then_some(linker.image),
        })
    }

    fn anchor(&self, linker: &scene::Linker, site: &Site) -> Vector3 {
        let displaced = |d: [f64; 3]| site.position(&self.stock.state) + Vector3::from(d);
        let place = linker.anchor_nm.map(Vector3::from);
        place.unwrap_or_else(|| displaced(linker.displaced_nm.unwrap_or_default()))
    }

    pub(super) fn site(&self, at: &LinkerSite, nodes: &mut Nodes) -> Result<Site, LinkerError> {
        let strand = &self.strands[at.filament];
        let s_nm = at.at_nm;
        // A boundary belongs to the section before it; places beyond the last monomer belong to the
        // last section.
        let is_past = |r: &ResolvedSection| r.to_nm < s_nm;
        let last = strand.resolved.len() - 1;
        let section = strand.resolved.partition_point(is_past).min(last);
        let azimuth = at.azimuth_deg.to_radians();
        match &strand.bodies[section] {
            Body::Rod(layout) => {
                let nodes = nodes.of(strand.first_section + section, layout);
                let from_start = s_nm - strand.resolved[section].from_nm;
                let place = RodPlace {
                    radius: at.radius_nm,
                    azimuth,
                    ..RodPlace::on_axis(layout, nodes, from_start)
                };
                Site::on_rod(layout, place)
            }
            Body::Monomers(monomers) => {
                let (sin, cos) = azimuth.sin_cos();
                let normal = Vector3::new(cos, sin, 0.0);
                let place = normal * at.radius_nm + Vector3::z() * s_nm;
                self.on_monomer(strand, monomers, (place, normal))
            }
        }
    }

    /// Site fixed in the nearest monomer, at a position (nm) with a normal, relative to the straight filament along +z
    /// from the origin.
    fn on_monomer(
        &self,
        strand: &Strand<'_>,
        monomers: &Monomers,
        (place, normal): (Vector3, Vector3),
    ) -> Result<Site, LinkerError> {
        let distance = |k: &usize| (strand.lattice.s_nm(monomers.index(*k)) - place.z).abs();
        let last = monomers.count - 1;
        // The first monomer not below the place, and the one before it.
        let above = partition_point(last, |k| strand.lattice.s_nm(monomers.index(k)) < place.z);
        let below = above.saturating_sub(1);
        // A tie selects the lower monomer.
        let nearest = if distance(&below) <= distance(&above) {
            below
        } else {
            above
        };
        let (point, frame) = (monomers.point(nearest), monomers.frame(nearest));
        let state = &self.stock.state;
        let arm = strand.place(place) - state.points.position.get(point);
        let q = state.frames.orientation.get(frame);
        let normal = strand.place(place + normal) - strand.place(place);
        let site = Site::on_monomer(point, frame, q.inverse_transform_vector(&arm))?;
        Ok(site.with_normal(q.inverse_transform_vector(&normal)))
    }
}

impl Assembly {
    /// Site on the axis of a filament at an arc length (nm): on a rod or in the nearest monomer.
    ///
    /// # Errors
    /// If the arc length is outside of the filament.
    ///
    /// # Panics
    /// If the index of the filament is out of range.
    pub fn axis_site(&self, filament: usize, s_nm: f64) -> Result<Site, SceneProblem> {
        let span = &self.filaments[filament];
        let sections = self.sections_of(filament);
        let length = sections.last().map_or(0.0, |section| section.to_nm);
        let refused = |rule: String| SceneProblem::new("at_nm", format!("{s_nm:?}"), rule);
        if !(0.0..=length).contains(&s_nm) {
            return Err(refused(format!("must be from 0 to {length:?}")));
        }
        let past = sections.partition_point(|section| section.to_nm < s_nm);
        let section = span.sections.start + past.min(sections.len() - 1);
        let site = if let Some(rod) = self.rod_of(section) {
            let from_start = s_nm - self.sections[section].from_nm;
            let place = RodPlace::on_axis(&rod.layout, &rod.layout.node_positions(), from_start);
            Site::on_rod(&rod.layout, place)
        } else {
            let distance = |i: &usize| (self.points[*i].s_nm - s_nm).abs();
            let monomers = self.sections[section].points.clone();
            let monomers = monomers.filter_map(|i| Some((i, self.points[i].frame?)));
            let nearest = monomers.min_by(|(i, _), (k, _)| distance(i).total_cmp(&distance(k)));
            let (point, frame) = nearest.ok_or_else(|| refused("has no monomer".into()))?;
            let arm = span.axis_place(s_nm) - self.rest.points.position.get(point);
            let q = self.rest.frames.orientation.get(frame);
            Site::on_monomer(point, frame, q.inverse_transform_vector(&arm))
        };
        site.map_err(|error| refused(error.to_string()))
    }
}

/// Arc lengths of the nodes of rods with linkers, computed once per rod.
#[derive(Default)]
pub(super) struct Nodes(HashMap<usize, Vec<f64>>);

impl Nodes {
    pub(super) fn of(&mut self, section: usize, layout: &RodLayout) -> &[f64] {
        self.0
            .entry(section)
            .or_insert_with(|| layout.node_positions())
    }
}

fn partition_point(count: usize, is_before: impl Fn(usize) -> bool) -> usize {
    let (mut from, mut to) = (0, count);
    while from < to {
        let middle = usize::midpoint(from, to);
        if is_before(middle) {
            from = middle + 1;
        } else {
            to = middle;
        }
    }
    from
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;

    fn sites(sections: &str, linkers: &str) -> (Assembly, Vec<Vector3>) {
        let text = format!(
            "Scene(
                filament: Filament(sections: [{sections}]),
                clamps: [Clamp(end: Start)],
                linkers: [{linkers}],
                task: Equilibrium(),
            )"
        );
        let assembly = Assembly::build(&Scene::from_ron(&text).unwrap()).unwrap();
        let at = |linker: &Linker| linker.site().position(&assembly.rest);
        let places = assembly.linkers.iter().map(at).collect();
        (assembly, places)
    }

    const ROD: &str = "Rod(from_nm: 0.0, to_nm: 60.0, segments: 6)";
    const MONOMERS: &str = "Ellipsoids(from_nm: 0.0, to_nm: 60.0)";
    const MIXED: &str = "Ellipsoids(from_nm: 0.0, to_nm: 30.0), Rod(from_nm: 30.0, to_nm: 60.0)";

    #[test]
    fn sites_have_the_same_position_in_every_model() {
        for sections in [ROD, MONOMERS, MIXED] {
            for s_nm in [0.0, 12.3, 25.0, 30.0, 31.0, 60.0] {
                let linker = format!(
                    "Linker(at_nm: {s_nm:?}, radius_nm: 1.8, azimuth_deg: 90.0,
                        displaced_nm: (1.0, 2.0, 3.0), stiffness_pn_per_nm: 5.0)"
                );
                let (assembly, places) = sites(sections, &linker);
                let expected = Vector3::new(0.0, 1.8, s_nm);
                // Round-off of positions of 60 nm.
                assert!((places[0] - expected).norm() < 1e-13, "{}", places[0]);
                let force = assembly.linkers[0].force(&assembly.rest);
                assert!((force - Vector3::new(5.0, 10.0, 15.0)).norm() < 1e-11);
            }
        }
    }

    #[test]
    fn sites_are_on_the_nearest_body() {
        let linker = |s_nm: f64| {
            format!(
                "Linker(at_nm: {s_nm:?}, anchor_nm: (9.0, 0.0, 0.0), stiffness_pn_per_nm: 5.0),"
            )
        };
        let all: String = [0.0, 20.0, 25.0, 60.0].map(linker).concat();
        let (rod, _) = sites(ROD, &all);
        let shares: Vec<_> = rod.linkers.iter().map(|l| l.site().shares()).collect();
        assert_eq!(shares[0], [(0, 1.0), (1, 0.0)]);
        assert_eq!(shares[1], [(1, 0.0), (2, 1.0)]);
        assert_eq!(shares[2], [(2, 0.5), (3, 0.5)]);
        assert_eq!(shares[3], [(5, 0.0), (6, 1.0)]);
        let (monomers, _) = sites(MONOMERS, &linker(25.0));
        // The first point is monomer -1.
        assert_eq!(monomers.linkers[0].site().shares(), [(10, 1.0)]);
        assert_eq!(rod.linkers[1].end_position(&rod.rest), Vector3::x() * 9.0);
    }

    #[test]
    fn controls_move_the_anchors() {
        let text = "Scene(
            filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 60.0)]),
            clamps: [Clamp(end: Start)],
            loads: [EndForce(end: End, force_pn: (0.0, 0.0, 1.0))],
            linkers: [
                Linker(at_nm: 20.0, displaced_nm: (0.0, 0.0, 0.0), stiffness_pn_per_nm: 5.0),
                Linker(at_nm: 40.0, displaced_nm: (0.0, 0.0, 0.0), stiffness_pn_per_nm: 5.0),
            ],
            task: Equilibrium(),
        )";
        let assembly = Assembly::build(&Scene::from_ron(text).unwrap()).unwrap();
        let mut state = assembly.rest.clone();
        assert_eq!(state.controls.values(), [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        let [_, y, _] = assembly.linkers[1].anchor_controls().unwrap();
        state.controls[y] = 2.0;
        let forces = assembly.linkers.iter().map(|l| l.force(&state));
        let expected = [Vector3::zeros(), Vector3::y() * 10.0];
        assert_eq!(forces.collect::<Vec<_>>(), expected);
    }
}
