//! Carried steps of single filaments.

use super::open::Components;
use super::{Chain, Link};
use crate::layout::{Layout, Node};
use crate::motion::StepSize;
use crate::ties::Ties;
use actin_mechanics::{Coordinates, State, UnitQuaternion, Vector3, Vectors, rotation};
use std::collections::BTreeMap;
use std::ops::Range;

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
pub(crate) struct Clusters {
    all: Vec<Cluster>,
    /// Cluster of each node.
    of_nodes: Vec<usize>,
}

impl Clusters {
    pub(crate) fn new(layout: &Layout, ties: &Ties, chain: &Chain) -> Self {
        let mut components = Components::new(layout, ties);
        let holds = components.holds();
        let mut places = BTreeMap::new();
        let mut clusters: Vec<Cluster> = Vec::new();
        for k in 0..layout.len() {
            let body = match layout.node(k) {
                Node::Point(i) => Coordinates::Point(i),
                Node::Frame(i) => Coordinates::Frame(i),
                Node::Slider(_) => {
                    clusters.push(Cluster::of_slider(k));
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
        Self {
            of_nodes: of_nodes(&clusters, layout),
            all: clusters,
        }
    }

    /// Clusters with one of the unknowns (ascending).
    pub(crate) fn with_unknowns(&self, layout: &Layout, unknowns: &[usize]) -> Vec<usize> {
        let has_one = |cluster: &Cluster| {
            let mut nodes = cluster.nodes.iter();
            nodes.any(|&k| {
                let range = layout.range(k);
                let at = unknowns.partition_point(|&unknown| unknown < range.start);
                unknowns
                    .get(at)
                    .is_some_and(|unknown| range.contains(unknown))
            })
        };
        (0..self.all.len())
            .filter(|&c| has_one(&self.all[c]))
            .collect()
    }

    pub(crate) fn len(&self) -> usize {
        self.all.len()
    }

    /// Cluster of each node.
    pub(crate) fn of_nodes(&self) -> &[usize] {
        &self.of_nodes
    }

    /// Ranges of the unknowns of the selected clusters (ascending).
    pub(crate) fn columns(&self, layout: &Layout, is_selected: &[bool]) -> Vec<Range<usize>> {
        let selected = self.all.iter().zip(is_selected).filter(|(_, is)| **is);
        let mut ranges: Vec<_> = selected
            .flat_map(|(cluster, _)| cluster.nodes.iter().map(|&k| layout.range(k)))
            .collect();
        ranges.sort_unstable_by_key(|range| range.start);
        let mut merged: Vec<Range<usize>> = Vec::new();
        for range in ranges {
            match merged.last_mut() {
                Some(last) if last.end == range.start => last.end = range.end,
                _ => merged.push(range),
            }
        }
        merged
    }

    /// Sum of terms, one per unknown, for each cluster.
    pub(crate) fn sums(&self, layout: &Layout, terms: &[f64]) -> Vec<f64> {
        let sum = |cluster: &Cluster| {
            let nodes = cluster.nodes.iter();
            nodes.flat_map(|&k| &terms[layout.range(k)]).sum()
        };
        self.all.iter().map(sum).collect()
    }

    /// Moves the bodies of `to`, a copy of `from`, and returns the unlimited extent of the step of
    /// each cluster. The step of a cluster is shortened to the limits, and then to a share. Free
    /// clusters keep their mean displacement. Spins about third axes are applied last and recorded in `spins`.
    pub(crate) fn advance(
        &self,
        layout: &Layout,
        (from, to): (&State, &mut State),
        step: &[f64],
        (spins, limits, shares): (&mut [Option<f64>], &StepSize, &[f64]),
    ) -> Vec<StepSize> {
        spins.iter_mut().flatten().for_each(|spin| *spin = 0.0);
        if step.iter().any(|value| !value.is_finite()) {
            return vec![StepSize::INFINITE; self.all.len()];
        }
        let mut tilts = step.to_vec();
        let mut velocities = (
            Vectors::zeros(from.points.len()),
            Vectors::zeros(from.frames.len()),
        );
        let mut sizes = Vec::with_capacity(self.all.len());
        for (cluster, share) in self.all.iter().zip(shares) {
            if cluster.is_still(layout, step) {
                sizes.push(StepSize::default());
                continue;
            }
            let spinning: Vec<_> = layout.spinning(&cluster.nodes, spins).collect();
            for &(_, at) in &spinning {
                tilts[at] = 0.0;
            }
            let own = layout.extent_of(&cluster.nodes, &tilts);
            let scale = (limits.rotation / own.rotation)
                .min(limits.displacement / own.displacement)
                .min(1.0)
                * share;
            layout.apply_to(&cluster.nodes, to, &tilts, scale);
            layout.find_velocities(&cluster.nodes, from, &tilts, &mut velocities);
            cluster.carry(from, &velocities, scale, to);
            for (i, at) in spinning {
                let spin = step[at] * scale;
                spins[i] = Some(spin);
                let turn = rotation::exp(Vector3::z() * spin);
                let q = to.frames.orientation.get(i) * turn;
                let q = UnitQuaternion::new_normalize(q.into_inner());
                to.frames.orientation.set(i, q);
            }
            sizes.push(layout.extent_of(&cluster.nodes, step));
        }
        sizes
    }
}

fn of_nodes(clusters: &[Cluster], layout: &Layout) -> Vec<usize> {
    let mut of_nodes = vec![0; layout.len()];
    for (c, cluster) in clusters.iter().enumerate() {
        cluster.nodes.iter().for_each(|&node| of_nodes[node] = c);
    }
    of_nodes
}

impl Layout {
    /// Frames that may spin, with the index of their unknown.
    fn spinning(
        &self,
        nodes: &[usize],
        spins: &[Option<f64>],
    ) -> impl Iterator<Item = (usize, usize)> {
        nodes.iter().filter_map(|&k| match self.node(k) {
            Node::Frame(i) if spins.get(i).is_some_and(Option::is_some) => {
                Some((i, self.range(k).start + 2))
            }
            Node::Frame(_) | Node::Point(_) | Node::Slider(_) => None,
        })
    }
}

impl Cluster {
    fn of_slider(node: usize) -> Self {
        Self {
            nodes: vec![node],
            holds: 2,
            ..Self::default()
        }
    }

    fn is_still(&self, layout: &Layout, step: &[f64]) -> bool {
        let mut own = self.nodes.iter().flat_map(|&k| &step[layout.range(k)]);
        own.all(|value| *value == 0.0)
    }

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
