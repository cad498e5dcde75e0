//! Carried steps of single filaments.

use super::open::Components;
use super::{Chain, Link};
use crate::layout::{Layout, Node};
use crate::motion::StepSize;
use crate::ties::Ties;
use actin_mechanics::{Coordinates, State, UnitQuaternion, Vector3, Vectors, rotation};
use std::collections::BTreeMap;

/// Component of tied bodies.
#[derive(Debug, Default)]
struct Cluster {
    nodes: Vec<usize>,
    points: Vec<usize>,
    frames: Vec<usize>,
    /// Empty if held at two places.
    links: Vec<Link>,
    holds: usize,
}

#[derive(Debug, Default)]
pub(crate) struct Clusters(Vec<Cluster>);

impl Clusters {
    pub(crate) fn new(layout: &Layout, ties: &Ties, chain: &Chain) -> Self {
        let mut components = Components::of(layout, ties);
        let holds = components.holds();
        let mut places = BTreeMap::new();
        let mut clusters: Vec<Cluster> = Vec::new();
        for k in 0..layout.len() {
            let body = match layout.node(k) {
                Node::Point(i) => Coordinates::Point(i),
                Node::Frame(i) => Coordinates::Frame(i),
                Node::Group(_) => {
                    clusters.push(Cluster {
                        nodes: vec![k],
                        holds: 2,
                        ..Cluster::default()
                    });
                    continue;
                }
            };
            let root = components.root(body);
            let place = *places.entry(root).or_insert_with(|| {
                clusters.push(Cluster {
                    holds: holds.get(&root).copied().unwrap_or(0),
                    ..Cluster::default()
                });
                clusters.len() - 1
            });
            clusters[place].nodes.push(k);
            match body {
                Coordinates::Point(i) => clusters[place].points.push(i),
                Coordinates::Frame(i) => clusters[place].frames.push(i),
            }
        }
        let place_of = |components: &mut Components, body| places[&components.root(body)];
        for &link in &chain.0 {
            let cluster = &mut clusters[place_of(&mut components, link.follower())];
            if cluster.holds < 2 {
                cluster.links.push(link);
            }
        }
        Self(clusters)
    }

    /// Free frames of clusters with one of the unknowns (ascending).
    pub(crate) fn frames_with(&self, layout: &Layout, unknowns: &[usize]) -> Vec<usize> {
        let has_one = |cluster: &&Cluster| {
            let mut nodes = cluster.nodes.iter();
            nodes.any(|&k| {
                let range = layout.range(k);
                let at = unknowns.partition_point(|&unknown| unknown < range.start);
                unknowns
                    .get(at)
                    .is_some_and(|unknown| range.contains(unknown))
            })
        };
        let clusters = self.0.iter().filter(has_one);
        clusters
            .flat_map(|cluster| cluster.frames.iter().copied())
            .collect()
    }

    /// Moves the bodies of `to`, a copy of `from`, and returns the extent of the whole step. The
    /// step of each cluster is limited to `largest_turn` (rad). Free clusters keep their mean
    /// displacement. Spins about third axes are applied last.
    pub(crate) fn advance(
        &self,
        layout: &Layout,
        (from, to): (&State, &mut State),
        step: &[f64],
        (spins, largest_turn): (&[bool], f64),
    ) -> StepSize {
        if step.iter().any(|value| !value.is_finite()) {
            return StepSize {
                displacement: f64::INFINITY,
                rotation: f64::INFINITY,
                strain: f64::INFINITY,
            };
        }
        let spinning = layout.spinning(spins);
        let mut tilts = step.to_vec();
        for &(_, at) in &spinning {
            tilts[at] = 0.0;
        }
        let velocities = layout.velocities(from, &tilts);
        let mut scales = vec![1.0; from.frames.len()];
        let mut extent = StepSize::default();
        for cluster in &self.0 {
            let own = layout.extent_of(&cluster.nodes, &tilts);
            let scale = (largest_turn / own.rotation).min(1.0);
            layout.apply_to(&cluster.nodes, to, &tilts, scale);
            cluster.carry(from, &velocities, scale, to);
            for &i in &cluster.frames {
                scales[i] = scale;
            }
            extent.displacement = extent.displacement.max(own.displacement);
            extent.rotation = extent.rotation.max(own.rotation);
        }
        for &(_, at) in &spinning {
            extent.rotation = extent.rotation.max(step[at].abs());
        }
        for (i, at) in spinning {
            let turn = rotation::exp(Vector3::z() * (step[at] * scales[i]));
            let q = to.frames.orientation.get(i) * turn;
            let q = UnitQuaternion::new_normalize(q.into_inner());
            to.frames.orientation.set(i, q);
        }
        extent
    }
}

impl Layout {
    /// Frames that may spin, with the index of their unknown.
    fn spinning(&self, spins: &[bool]) -> Vec<(usize, usize)> {
        let frames = self.nodes().filter_map(|(node, range)| match node {
            Node::Frame(i) => Some((i, range.start + 2)),
            Node::Point(_) | Node::Group(_) => None,
        });
        frames
            .filter(|(i, _)| spins.get(*i).copied().unwrap_or(false))
            .collect()
    }
}

impl Cluster {
    fn carry(
        &self,
        from: &State,
        (moved, turned): &(Vectors, Vectors),
        scale: f64,
        to: &mut State,
    ) {
        let sum = |state: &State| -> Vector3 {
            let points = self.points.iter();
            points.map(|&i| state.points.position.get(i)).sum()
        };
        let straight = sum(to);
        for link in &self.links {
            link.carry(from, (moved, turned), scale, to);
        }
        if self.holds > 0 || self.points.is_empty() {
            return;
        }
        let shift = (straight - sum(to)) / self.points.len() as f64;
        for &i in &self.points {
            to.points.position.add(i, shift);
        }
    }
}
