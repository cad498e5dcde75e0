//! Motion of bodies by unknowns, and generalised loads.

use crate::layout::{Layout, Node};
use actin_mechanics::Residual;
use actin_mechanics::{Loads, Slider, State, UnitQuaternion, Vector3, Vectors, rotation};

/// Extent of a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StepSize {
    /// Largest displacement of a body or slider (nm).
    pub displacement: f64,
    /// Largest rotation of a frame (rad).
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
            Node::Slider(s) => {
                let slider = &self.sliders()[s];
                let shift = displacement_of(slider, step) * scale;
                for &i in &slider.points {
                    state.points.position.add(i, shift);
                }
            }
        }
    }

    /// Generalised loads: negative derivative of the energy.
    pub(crate) fn reduce(&self, loads: &Loads, reduced: &mut [f64]) {
        for (node, range) in self.nodes() {
            let out = &mut reduced[range];
            match node {
                Node::Point(i) => out.copy_from_slice(loads.force.get(i).as_slice()),
                Node::Frame(i) => out.copy_from_slice(loads.torque.get(i).as_slice()),
                Node::Slider(s) => {
                    let slider = &self.sliders()[s];
                    let force = slider.points.iter().map(|&i| loads.force.get(i)).sum();
                    project(out, slider, force);
                }
            }
        }
    }

    pub(crate) fn largest(&self, reduced: &[f64]) -> Residual {
        self.nodes()
            .map(|(node, range)| norms(node, &reduced[range]))
            .fold(Residual::default(), |largest, of_node| {
                largest.max(&of_node)
            })
    }

    pub(crate) fn total(&self, reduced: &[f64]) -> Residual {
        let norms = self
            .nodes()
            .map(|(node, range)| norms(node, &reduced[range]));
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
            let floor = norms(node, &rounding[range.clone()]).scaled(multiple);
            let of_node = norms(node, &loads[range]);
            of_node.is_within(&limit.max(&if_finite(&floor)))
        })
    }

    pub(crate) fn residual(&self, loads: &Loads) -> Residual {
        let mut reduced = vec![0.0; self.unknowns()];
        self.reduce(loads, &mut reduced);
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
            .map(|&k| norms(self.node(k), &step[self.range(k)]));
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
                Node::Slider(s) => {
                    let slider = &self.sliders()[s];
                    let shift = displacement_of(slider, step);
                    slider.points.iter().for_each(|&i| moved.set(i, shift));
                }
            }
        }
    }

    /// Step between two states: inverse of [`apply`](Layout::apply).
    ///
    /// For a slider, only motion along its directions is included.
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
                Node::Slider(s) => {
                    let slider = &self.sliders()[s];
                    project(out, slider, displacement(from, to, slider.points[0]));
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
                Node::Slider(s) => {
                    let points = self.sliders()[s].points.iter();
                    let largest = points.map(|&i| state.points.position.get(i).amax());
                    out.fill(largest.fold(0.0, f64::max));
                }
            }
        }
    }

    /// 1 for displacements, `length^2` for rotations.
    pub(crate) fn metric(&self, length: f64, metric: &mut [f64]) {
        for (node, range) in self.nodes() {
            let is_frame = matches!(node, Node::Frame(_));
            metric[range].fill(if is_frame { length * length } else { 1.0 });
        }
    }
}

fn norms(node: Node, values: &[f64]) -> Residual {
    let norm = values.iter().map(|v| v * v).sum::<f64>().sqrt();
    match node {
        Node::Frame(_) => Residual {
            force: 0.0,
            torque: norm,
        },
        Node::Point(_) | Node::Slider(_) => Residual {
            force: norm,
            torque: 0.0,
        },
    }
}

fn three(step: &[f64]) -> Vector3 {
    Vector3::new(step[0], step[1], step[2])
}

fn displacement_of(slider: &Slider, step: &[f64]) -> Vector3 {
    let directions = slider.directions.iter().zip(step);
    directions.map(|(d, amount)| d * *amount).sum()
}

fn project(out: &mut [f64], slider: &Slider, v: Vector3) {
    for (out, direction) in out.iter_mut().zip(&slider.directions) {
        *out = direction.dot(&v);
    }
}

/// Corrects rounding of products.
fn with_unit_length(q: UnitQuaternion) -> UnitQuaternion {
    UnitQuaternion::new_normalize(q.into_inner())
}

fn displacement(from: &State, to: &State, i: usize) -> Vector3 {
    to.points.position.get(i) - from.points.position.get(i)
}

fn if_finite(residual: &Residual) -> Residual {
    let part = |value: f64| if value.is_finite() { value } else { 0.0 };
    Residual {
        force: part(residual.force),
        torque: part(residual.torque),
    }
}
