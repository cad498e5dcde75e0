//! Motion of bodies by unknowns, and generalised loads.

use crate::group::Group;
use crate::layout::{Layout, Node};
use actin_mechanics::Residual;
use actin_mechanics::{Loads, State, UnitQuaternion, Vector3, Vectors, rotation};

/// Extent of a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StepSize {
    /// Largest displacement of a body or group (nm).
    pub displacement: f64,
    /// Largest rotation of a body or group (rad).
    pub rotation: f64,
    /// Largest relative motion of coupled bodies: rotation between two frames (rad), or relative
    /// displacement of two points over their distance.
    pub strain: f64,
}

/// Step of a component: bodies that are coupled other than by links, such as a filament.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ComponentStep {
    /// Extent.
    pub size: StepSize,
    /// Half the work of the loads along the step (pN nm): decrease of energy that the quadratic
    /// model predicts.
    pub decrease: f64,
}

impl StepSize {
    pub(crate) const INFINITE: Self = Self {
        displacement: f64::INFINITY,
        rotation: f64::INFINITY,
        strain: f64::INFINITY,
    };

    pub(crate) fn scaled(&self, factor: f64) -> Self {
        Self {
            displacement: self.displacement * factor,
            rotation: self.rotation * factor,
            strain: self.strain * factor,
        }
    }
}

impl Layout {
    /// Moves the bodies of `state` by `scale` times `step`; rotations are exact.
    ///
    /// # Panics
    /// If the length of `step` is wrong.
    pub fn apply(&self, state: &mut State, step: &[f64], scale: f64) {
        assert_eq!(step.len(), self.unknowns(), "one number per unknown");
        for (node, range) in self.nodes() {
            self.apply_node(node, state, &step[range], scale);
        }
    }

    pub(crate) fn apply_to(&self, nodes: &[usize], state: &mut State, step: &[f64], scale: f64) {
        for &k in nodes {
            self.apply_node(self.node(k), state, &step[self.range(k)], scale);
        }
    }

    fn apply_node(&self, node: Node, state: &mut State, step: &[f64], scale: f64) {
        match node {
            Node::Point(i) => state.points.position.add(i, three(step) * scale),
            Node::Frame(i) => {
                let q = state.frames.orientation.get(i) * rotation::exp(three(step) * scale);
                state.frames.orientation.set(i, with_unit_length(q));
            }
            Node::Group(g) => move_group(&self.groups()[g], state, step, scale),
        }
    }

    /// Generalised loads: negative derivative of the energy.
    pub(crate) fn reduce(&self, state: &State, loads: &Loads, reduced: &mut [f64]) {
        for (node, range) in self.nodes() {
            let out = &mut reduced[range];
            match node {
                Node::Point(i) => out.copy_from_slice(loads.force.get(i).as_slice()),
                Node::Frame(i) => out.copy_from_slice(loads.torque.get(i).as_slice()),
                Node::Group(g) => {
                    let group = &self.groups()[g];
                    let (force, couple) = resultant(group, state, loads);
                    let (along, about) = out.split_at_mut(group.translations.len());
                    project(along, &group.translations, force);
                    project(about, &group.rotations, couple);
                }
            }
        }
    }

    pub(crate) fn largest(&self, reduced: &[f64]) -> Residual {
        self.nodes()
            .map(|(node, range)| self.norms(node, &reduced[range]))
            .fold(Residual::default(), |largest, of_node| {
                largest.max(&of_node)
            })
    }

    pub(crate) fn total(&self, reduced: &[f64]) -> Residual {
        let norms = self
            .nodes()
            .map(|(node, range)| self.norms(node, &reduced[range]));
        norms.fold(Residual::default(), |total, of_node| Residual {
            force: total.force.hypot(of_node.force),
            torque: total.torque.hypot(of_node.torque),
        })
    }

    /// All loads are within `limit` or `multiple` times their rounding error, if finite.
    pub(crate) fn are_within(
        &self,
        loads: &[f64],
        limit: &Residual,
        (rounding, multiple): (&[f64], f64),
    ) -> bool {
        self.nodes().all(|(node, range)| {
            let floor = self.norms(node, &rounding[range.clone()]).scaled(multiple);
            let of_node = self.norms(node, &loads[range]);
            of_node.is_within(&limit.max(&if_finite(&floor)))
        })
    }

    fn norms(&self, node: Node, values: &[f64]) -> Residual {
        let translations = match node {
            Node::Point(_) => values.len(),
            Node::Frame(_) => 0,
            Node::Group(g) => self.groups()[g].translations.len(),
        };
        let (along, about) = values.split_at(translations);
        Residual {
            force: norm(along),
            torque: norm(about),
        }
    }

    /// Residual of `state` under `loads`.
    pub(crate) fn residual(&self, state: &State, loads: &Loads) -> Residual {
        let mut reduced = vec![0.0; self.unknowns()];
        self.reduce(state, loads, &mut reduced);
        self.largest(&reduced)
    }

    /// Without strain.
    pub(crate) fn step_extent(&self, step: &[f64]) -> StepSize {
        let largest = self.largest(step);
        StepSize {
            displacement: largest.force,
            rotation: largest.torque,
            strain: 0.0,
        }
    }

    pub(crate) fn extent_of(&self, nodes: &[usize], step: &[f64]) -> StepSize {
        let norms = nodes
            .iter()
            .map(|&k| self.norms(self.node(k), &step[self.range(k)]));
        let largest = norms.fold(Residual::default(), |largest, one| largest.max(&one));
        StepSize {
            displacement: largest.force,
            rotation: largest.torque,
            strain: 0.0,
        }
    }

    /// Linear and angular velocities (lab frame).
    pub(crate) fn velocities(&self, state: &State, step: &[f64]) -> (Vectors, Vectors) {
        let mut velocities = (
            Vectors::zeros(state.points.len()),
            Vectors::zeros(state.frames.len()),
        );
        let nodes: Vec<usize> = (0..self.len()).collect();
        self.find_velocities(&nodes, state, step, &mut velocities);
        velocities
    }

    /// Linear and angular velocities of the bodies of some nodes (lab frame).
    pub(crate) fn find_velocities(
        &self,
        nodes: &[usize],
        state: &State,
        step: &[f64],
        (moved, turned): &mut (Vectors, Vectors),
    ) {
        for &k in nodes {
            let step = &step[self.range(k)];
            match self.node(k) {
                Node::Point(i) => moved.set(i, three(step)),
                Node::Frame(i) => turned.set(i, state.frames.orientation.get(i) * three(step)),
                Node::Group(g) => {
                    let group = &self.groups()[g];
                    let (shift, turn) = (group.displacement(step), group.rotation(step));
                    let pivot = group.pivot.position(state);
                    for &i in &group.points {
                        let arm = state.points.position.get(i) - pivot;
                        moved.set(i, shift + turn.cross(&arm));
                    }
                    group.frames.iter().for_each(|&i| turned.set(i, turn));
                }
            }
        }
    }

    /// Step between two states: inverse of [`apply`](Layout::apply).
    ///
    /// For a group, only motion along its directions is included; the rotation of the
    /// group is the rotation of its first frame.
    pub fn difference(&self, from: &State, to: &State) -> Vec<f64> {
        let mut step = vec![0.0; self.unknowns()];
        for (node, range) in self.nodes() {
            let out = &mut step[range];
            match node {
                Node::Point(i) => out.copy_from_slice(displacement(from, to, i).as_slice()),
                Node::Frame(i) => {
                    let q = from.frames.orientation.get(i).inverse() * to.frames.orientation.get(i);
                    out.copy_from_slice(rotation::log(q).as_slice());
                }
                Node::Group(g) => {
                    let group = &self.groups()[g];
                    let (moved, turned) = group_difference(group, from, to);
                    let (along, about) = out.split_at_mut(group.translations.len());
                    project(along, &group.translations, moved);
                    project(about, &group.rotations, turned);
                }
            }
        }
        step
    }

    /// Magnitudes of coordinates, to which rounding is proportional: 1 for rotations.
    pub(crate) fn magnitudes(&self, state: &State, magnitudes: &mut [f64]) {
        for (node, range) in self.nodes() {
            let out = &mut magnitudes[range];
            match node {
                Node::Point(i) => {
                    out.copy_from_slice(state.points.position.get(i).abs().as_slice());
                }
                Node::Frame(_) => out.fill(1.0),
                Node::Group(g) => {
                    let group = &self.groups()[g];
                    let (along, about) = out.split_at_mut(group.translations.len());
                    let largest = largest_component(&state.points.position, &group.points);
                    along.fill(largest);
                    about.fill(1.0);
                }
            }
        }
    }

    /// 1 for displacements, `length^2` for rotations.
    pub(crate) fn metric(&self, length: f64, metric: &mut [f64]) {
        for (node, range) in self.nodes() {
            let translations = match node {
                Node::Point(_) => 3,
                Node::Frame(_) => 0,
                Node::Group(g) => self.groups()[g].translations.len(),
            };
            let (along, about) = metric[range].split_at_mut(translations);
            along.fill(1.0);
            about.fill(length * length);
        }
    }
}

fn three(step: &[f64]) -> Vector3 {
    Vector3::new(step[0], step[1], step[2])
}

fn norm(values: &[f64]) -> f64 {
    values.iter().map(|v| v * v).sum::<f64>().sqrt()
}

fn project(out: &mut [f64], directions: &[Vector3], v: Vector3) {
    for (out, direction) in out.iter_mut().zip(directions) {
        *out = direction.dot(&v);
    }
}

/// Corrects rounding of products.
fn with_unit_length(q: UnitQuaternion) -> UnitQuaternion {
    UnitQuaternion::new_normalize(q.into_inner())
}

fn move_group(group: &Group, state: &mut State, step: &[f64], scale: f64) {
    let shift = group.displacement(step) * scale;
    let turn = rotation::exp(group.rotation(step) * scale);
    let pivot = group.pivot.position(state);
    let turns = !group.rotations.is_empty();
    for &i in &group.points {
        let x = state.points.position.get(i);
        let moved = if turns { pivot + turn * (x - pivot) } else { x };
        state.points.position.set(i, moved + shift);
    }
    if turns {
        for &i in &group.frames {
            let q = turn * state.frames.orientation.get(i);
            state.frames.orientation.set(i, with_unit_length(q));
        }
    }
}

/// Force and torque about the pivot (lab frame).
fn resultant(group: &Group, state: &State, loads: &Loads) -> (Vector3, Vector3) {
    let pivot = group.pivot.position(state);
    let mut force = Vector3::zeros();
    let mut couple = Vector3::zeros();
    for &i in &group.points {
        let f = loads.force.get(i);
        force += f;
        couple += (state.points.position.get(i) - pivot).cross(&f);
    }
    for &i in &group.frames {
        couple += state.frames.orientation.get(i) * loads.torque.get(i);
    }
    (force, couple)
}

fn displacement(from: &State, to: &State, i: usize) -> Vector3 {
    to.points.position.get(i) - from.points.position.get(i)
}

/// Displacement of the material point at the pivot, and rotation.
fn group_difference(group: &Group, from: &State, to: &State) -> (Vector3, Vector3) {
    let turned = group.frames.first().map_or(Vector3::zeros(), |&i| {
        rotation::log(to.frames.orientation.get(i) * from.frames.orientation.get(i).inverse())
    });
    let moved = group.points.first().map_or(Vector3::zeros(), |&i| {
        let pivot = group.pivot.position(from);
        let x = from.points.position.get(i);
        to.points.position.get(i) - (pivot + rotation::exp(turned) * (x - pivot))
    });
    (moved, turned)
}

fn largest_component(positions: &Vectors, points: &[usize]) -> f64 {
    points
        .iter()
        .map(|&i| positions.get(i).amax())
        .fold(0.0, f64::max)
}

fn if_finite(residual: &Residual) -> Residual {
    let part = |value: f64| if value.is_finite() { value } else { 0.0 };
    Residual {
        force: part(residual.force),
        torque: part(residual.torque),
    }
}
