//! Bodies on which the loads of a scene act.

use super::linkers::Nodes;
use super::{Body, Builder, Strand};
use crate::scene::{Couple, End, Force, LinkerSite, Load, Resultant, SceneProblem, path::UNSET};
use crate::{BodyKind, Part, problem_at};
use actin_cosserat::RodLayout;
use actin_coupling::{ForceKind, LinkerError, RodPlace, Site, SiteForce};
use actin_ellipsoid::Monomers;
use actin_mechanics::{
    ControlId, Couple as FrameCouple, CoupleKind, Interaction, Loads, PointLoad, Residual, Vector3,
};
use std::error::Error;
use std::ops::Range;

type Shares = Vec<(usize, f64)>;

impl Builder<'_> {
    pub(super) fn push_loads(&mut self) -> Result<(), SceneProblem> {
        let mut nodes = Nodes::default();
        for (i, load) in self.scene.loads.iter().enumerate() {
            let control = self.stock.state.add_control(UNSET);
            let interaction = self.load(load, control, &mut nodes);
            let interaction = interaction.map_err(problem_at(format!("loads[{i}]")))?;
            let is_zero = load.written().1.iter().all(|x| *x == 0.0);
            if !is_zero && !self.moves(&*interaction, control) {
                let rule = "acts only on held bodies, so it has no effect";
                return Err(load.problem(i, rule.to_owned()));
            }
            self.loads.push(control);
            self.stock.push_term(interaction, Part::Load(i));
        }
        Ok(())
    }

    /// Returns `true` if a load acts on a free body.
    fn moves(&self, load: &dyn Interaction, control: ControlId) -> bool {
        let mut state = self.stock.state.clone();
        state.controls[control] = 1.0;
        let mut loads = Loads::zeros(&state);
        load.add_loads(&state, &mut loads);
        let Residual { force, torque } = loads.residual(&state);
        force.max(torque) > 0.0
    }

    fn load(
        &mut self,
        load: &Load,
        control: ControlId,
        nodes: &mut Nodes,
    ) -> Result<Box<dyn Interaction>, Box<dyn Error>> {
        let size = Vector3::from(load.written().1);
        let state = &self.stock.state;
        Ok(match (load, load.resultant(self.scene)) {
            (Load::EndForce { filament, end, .. }, _) => {
                let points = self.tip(*filament, *end);
                let share = 1.0 / points.len() as f64;
                let shares = points.map(|point| (point, share)).collect();
                Box::new(PointLoad::new(state, shares, size, control)?)
            }
            (Load::Acceleration(load), _) => {
                let masses = self.masses(load.filament);
                Box::new(PointLoad::new(state, masses, size, control)?)
            }
            (_, Resultant::Force(_)) => {
                let kind = if load.follows() {
                    ForceKind::Follower
                } else {
                    ForceKind::Dead
                };
                let sites = self.sites(load, nodes)?;
                Box::new(SiteForce::new(state, sites, size, kind, control)?)
            }
            (_, Resultant::Couple(_)) => {
                let kind = if load.follows() {
                    CoupleKind::Follower
                } else {
                    CoupleKind::Axial
                };
                let shares = self.couple_shares(load);
                let chain = self.chain(load.filament());
                let state = &mut self.stock.state;
                let couple = FrameCouple::new(state, &shares, size, kind, control);
                Box::new(couple.counted_along(state, &chain))
            }
        })
    }

    fn tip(&self, filament: usize, end: End) -> Range<usize> {
        let strand = &self.strands[filament];
        let section = strand.first_section + strand.filament.end_index(end);
        self.stock.sections[section].tip_points(end)
    }

    fn masses(&self, filament: usize) -> Vec<(usize, f64)> {
        let points = &self.stock.state.points;
        let all = self.filaments[filament].points.clone();
        all.map(|i| (i, points.mass(i))).collect()
    }

    /// Sites of a force with their shares, or with the lengths that they represent.
    fn sites(&self, load: &Load, nodes: &mut Nodes) -> Result<Vec<(Site, f64)>, LinkerError> {
        let filament = load.filament();
        let strand = &self.strands[filament];
        if let Load::Force(Force { end: Some(end), .. }) = load {
            return self.end_sites(strand, *end);
        }
        if let Load::Force(Force {
            at_nm: Some(at_nm), ..
        }) = *load
        {
            let (radius_nm, azimuth_deg) = (0.0, 0.0);
            let at = LinkerSite {
                filament,
                at_nm,
                radius_nm,
                azimuth_deg,
            };
            return Ok(vec![(self.site(&at, nodes)?, 1.0)]);
        }
        let interval = load.interval(self.scene).unwrap_or_default();
        let mut sites = Vec::new();
        for (section, body) in strand.bodies.iter().enumerate() {
            sites.extend(match body {
                Body::Rod(layout) => {
                    let nodes = nodes.of(strand.first_section + section, layout);
                    rod_sites(layout, nodes, strand.resolved[section].from_nm, interval)
                }
                Body::Monomers(monomers) => self.monomer_sites(strand, monomers, interval),
            }?);
        }
        Ok(rescaled(sites, interval))
    }

    fn monomer_sites(
        &self,
        strand: &Strand<'_>,
        monomers: &Monomers,
        interval: [f64; 2],
    ) -> Result<Vec<(Site, f64)>, LinkerError> {
        let reached = (0..monomers.count).filter_map(|k| {
            let s_nm = strand.lattice.s_nm(monomers.index(k));
            Some((k, s_nm, overlap(strand.cell(s_nm), interval)?))
        });
        reached
            .map(|(k, s_nm, [a, b])| {
                let body = (monomers.point(k), monomers.frame(k));
                Ok((self.on_axis(strand, body, s_nm)?, b - a))
            })
            .collect()
    }

    /// The end of a rod, or the last two monomers with a share of one half each.
    fn end_sites(&self, strand: &Strand<'_>, end: End) -> Result<Vec<(Site, f64)>, LinkerError> {
        match &strand.bodies[strand.filament.end_index(end)] {
            Body::Rod(layout) => {
                let (segment, fraction) = match end {
                    End::Start => (0, 0.0),
                    End::End => (layout.segments() - 1, 1.0),
                };
                let place = RodPlace {
                    segment,
                    fraction,
                    ..RodPlace::default()
                };
                Ok(vec![(Site::on_rod(layout, place)?, 1.0)])
            }
            Body::Monomers(monomers) => {
                let points = self.tip(strand.index, end);
                let share = 1.0 / points.len() as f64;
                let frame = |point: usize| monomers.frame(point - monomers.first_point);
                let site = |point| Site::on_monomer(point, frame(point), Vector3::zeros());
                points.map(|point| Ok((site(point)?, share))).collect()
            }
        }
    }

    fn on_axis(
        &self,
        strand: &Strand<'_>,
        (point, frame): (usize, usize),
        s_nm: f64,
    ) -> Result<Site, LinkerError> {
        let state = &self.stock.state;
        let arm = strand.axis_at(s_nm) - state.points.position.get(point);
        let q = state.frames.orientation.get(frame);
        Site::on_monomer(point, frame, q.inverse_transform_vector(&arm))
    }

    fn couple_shares(&self, load: &Load) -> Shares {
        let filament = load.filament();
        let strand = &self.strands[filament];
        match load {
            Load::Couple(Couple { end: Some(end), .. }) => self.end_frames(strand, *end),
            Load::Couple(Couple { at_nm, .. }) => {
                self.frames_about(filament, at_nm.unwrap_or_default())
            }
            _ => {
                let interval = load.interval(self.scene).unwrap_or_default();
                let cells = self.cells(filament);
                let parts =
                    cells.filter_map(|(frame, cell)| Some((frame, overlap(cell, interval)?)));
                let shares = parts.map(|(frame, [a, b])| (frame, b - a)).collect();
                rescaled(shares, interval)
            }
        }
    }

    /// Cross-section at the end of a rod, or the last two monomers with a share of one half each.
    fn end_frames(&self, strand: &Strand<'_>, end: End) -> Shares {
        let state = &self.stock.state;
        match &strand.bodies[strand.filament.end_index(end)] {
            Body::Rod(layout) => {
                // A free wall frame is the cross-section at the end.
                let wall = layout.wall(end).filter(|wall| state.frames.is_free(*wall));
                vec![(wall.unwrap_or_else(|| layout.end_frame(end)), 1.0)]
            }
            Body::Monomers(monomers) => {
                let k = match end {
                    End::Start => 0,
                    End::End => monomers.count - 2,
                };
                vec![(monomers.frame(k), 0.5), (monomers.frame(k + 1), 0.5)]
            }
        }
    }

    /// Frames along which turns accumulate: from the start, or from the end if only the end is
    /// held.
    fn chain(&self, filament: usize) -> Vec<usize> {
        let mut chain: Vec<usize> = self.frames_between_ends(filament).collect();
        let is_held = |end| self.held.fixed_at(filament, end).is_some();
        if is_held(End::End) && !is_held(End::Start) {
            chain.reverse();
        }
        chain
    }

    /// Frames of a filament by arc length, without junction frames and the held frames of hinges.
    fn frames_between_ends(&self, filament: usize) -> impl Iterator<Item = usize> {
        let behind_hinges = self.strands[filament].hinge_frames;
        let frames = self.filaments[filament].frames.clone();
        frames.filter(move |f| {
            let kind = self.stock.frames[*f].kind;
            kind != BodyKind::Junction && !behind_hinges.contains(&Some(*f))
        })
    }

    /// The two frames next to an arc length, weighted by proximity. The internal couple then jumps
    /// by the applied share at each.
    fn frames_about(&self, filament: usize, s_nm: f64) -> Shares {
        let frames = self.frames_between_ends(filament);
        let all: Vec<(usize, f64)> = frames.map(|f| (f, self.stock.frames[f].s_nm)).collect();
        let above = all.partition_point(|(_, s)| *s <= s_nm);
        if above == 0 || above == all.len() {
            return vec![(all[above.saturating_sub(1)].0, 1.0)];
        }
        let ((before, a), (behind, b)) = (all[above - 1], all[above]);
        let share = (s_nm - a) / (b - a);
        vec![(before, 1.0 - share), (behind, share)]
    }

    fn cells(&self, filament: usize) -> impl Iterator<Item = (usize, [f64; 2])> {
        let strand = &self.strands[filament];
        let bodies = strand.bodies.iter().zip(&strand.resolved);
        bodies.flat_map(|(body, resolved)| {
            let cells: Vec<(usize, [f64; 2])> = match body {
                Body::Rod(layout) => {
                    let nodes = layout.node_positions();
                    let ends = nodes.windows(2);
                    let ends = ends.map(|pair| [pair[0], pair[1]].map(|s| resolved.from_nm + s));
                    layout.frames().zip(ends).collect()
                }
                Body::Monomers(monomers) => (0..monomers.count)
                    .map(|k| {
                        let s_nm = strand.lattice.s_nm(monomers.index(k));
                        (monomers.frame(k), strand.cell(s_nm))
                    })
                    .collect(),
            };
            cells
        })
    }
}

/// Middles and lengths of the parts of segments within an interval, for a rod with these nodes (nm)
/// from `from_nm`. A uniform load is equivalent to its resultant at the middle, because shape
/// functions of nodes are linear.
fn rod_sites(
    layout: &RodLayout,
    nodes: &[f64],
    from_nm: f64,
    interval: [f64; 2],
) -> Result<Vec<(Site, f64)>, LinkerError> {
    let segments = nodes.windows(2).enumerate();
    let reached = segments.filter_map(|(segment, ends)| {
        let cell = [from_nm + ends[0], from_nm + ends[1]];
        Some((segment, cell, overlap(cell, interval)?))
    });
    reached
        .map(|(segment, cell, [a, b])| {
            let fraction = (0.5 * (a + b) - cell[0]) / (cell[1] - cell[0]);
            let place = RodPlace {
                segment,
                fraction: fraction.clamp(0.0, 1.0),
                ..RodPlace::default()
            };
            Ok((Site::on_rod(layout, place)?, b - a))
        })
        .collect()
}

impl Strand<'_> {
    pub(super) fn cell(&self, s_nm: f64) -> [f64; 2] {
        let half = 0.5 * self.lattice.rise_nm;
        [s_nm - half, s_nm + half]
    }
}

/// Rescales lengths to the length of the interval, whose ends can lie beyond the last monomers.
fn rescaled<T>(mut parts: Vec<(T, f64)>, [from, to]: [f64; 2]) -> Vec<(T, f64)> {
    let whole: f64 = parts.iter().map(|(_, length)| length).sum();
    let scale = (to - from) / whole;
    for (_, length) in &mut parts {
        *length *= scale;
    }
    parts
}

fn overlap(a: [f64; 2], b: [f64; 2]) -> Option<[f64; 2]> {
    let common = [a[0].max(b[0]), a[1].min(b[1])];
    (common[1] > common[0]).then_some(common)
}
