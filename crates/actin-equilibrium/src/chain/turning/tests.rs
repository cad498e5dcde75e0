//! Second derivative along carried steps.

use crate::assemble::Assembly;
use crate::evaluation::Evaluation;
use crate::{BodyOrder, Layout};
use actin_mechanics::Coordinates::{Frame, Point};
use actin_mechanics::testing::derivative;
use actin_mechanics::{
    ControlId, Inertia, Interaction, Loads, Matrix3, PointLoad, SecondOrder, State, Stiffness,
    Vector3, Xorshift, rotation,
};

/// Springs of zero rest length between bodies `i` and `i + step`.
#[derive(Debug)]
struct Joints {
    bodies: usize,
    step: usize,
    ends: [Vector3; 2],
}

impl Joints {
    fn pairs(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        (0..self.bodies - self.step).map(|i| [i, i + self.step])
    }

    fn geometry(&self, state: &State, [i, j]: [usize; 2]) -> ([Vector3; 2], Vector3) {
        let q = &state.frames.orientation;
        let arms = [q.get(i) * self.ends[0], q.get(j) * self.ends[1]];
        let x = &state.points.position;
        (arms, x.get(j) + arms[1] - x.get(i) - arms[0])
    }
}

impl Interaction for Joints {
    fn term(&self) -> &'static str {
        "joints"
    }

    fn add_loads(&self, state: &State, loads: &mut Loads) {
        for pair in self.pairs() {
            let (arms, d) = self.geometry(state, pair);
            for ((k, arm), force) in pair.into_iter().zip(arms).zip([d, -d]) {
                let q = state.frames.orientation.get(k);
                loads.force.add(k, force);
                loads.torque.add(k, q.inverse() * arm.cross(&force));
            }
        }
    }

    fn elements(&self) -> usize {
        self.bodies - self.step
    }

    fn write_energies(&self, state: &State, energies: &mut [f64]) {
        for (energy, pair) in energies.iter_mut().zip(self.pairs()) {
            *energy = 0.5 * self.geometry(state, pair).1.norm_squared();
        }
    }

    fn second_order(&self) -> Option<&dyn SecondOrder> {
        Some(self)
    }
}

impl SecondOrder for Joints {
    fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
        let one = Matrix3::identity();
        for [i, j] in self.pairs() {
            let (_, d) = self.geometry(state, [i, j]);
            let axes = |k| super::matrix(state, k);
            let by_turn = [
                axes(i) * self.ends[0].cross_matrix(),
                axes(j) * self.ends[1].cross_matrix() * -1.0,
            ];
            stiffness.push(Point(i), Point(i), one);
            stiffness.push(Point(j), Point(j), one);
            stiffness.push(Point(i), Point(j), -one);
            for (k, slope, end, sign) in [
                (i, by_turn[0], self.ends[0], -1.0),
                (j, by_turn[1], self.ends[1], 1.0),
            ] {
                stiffness.push(Point(j), Frame(k), slope);
                stiffness.push(Point(i), Frame(k), -slope);
                let pull = axes(k).tr_mul(&d) * sign;
                let product = 0.5 * (pull * end.transpose() + end * pull.transpose());
                let geometric = product - one * pull.dot(&end);
                stiffness.push(Frame(k), Frame(k), slope.tr_mul(&slope) + geometric);
            }
            stiffness.push(Frame(i), Frame(j), by_turn[0].tr_mul(&by_turn[1]));
        }
    }
}

/// Irregular chain, each body tied to the next two, with a force on the last one.
fn chain(held: bool) -> (State, Vec<Box<dyn Interaction>>, Layout) {
    let bodies = 7;
    let (mut state, mut noise) = (State::default(), Xorshift::new(11));
    let mut draw = || Vector3::from_fn(|_, _| noise.sample());
    for i in 0..bodies {
        state.points.push(actin_mechanics::Point {
            position: Vector3::z() * (2.0 * i as f64) + 0.5 * draw(),
            mass: 1.0,
        });
        state.frames.push(actin_mechanics::Frame {
            orientation: rotation::exp(draw()),
            inertia: Inertia::from_moments([1.0, 1.0, 2.0]).unwrap(),
        });
    }
    if held {
        state.points.hold(0);
        state.frames.hold(0);
    }
    let control: ControlId = state.add_control(1.0);
    let force = PointLoad::new(&state, vec![(bodies - 1, 1.0)], Vector3::x(), control).unwrap();
    let joints = |step| {
        let ends = [Vector3::new(0.4, 0.1, 0.9), Vector3::new(-0.2, 0.3, -0.8)];
        Joints { bodies, step, ends }
    };
    let terms: Vec<Box<dyn Interaction>> =
        vec![Box::new(joints(1)), Box::new(joints(2)), Box::new(force)];
    let along: Vec<f64> = (0..bodies).map(|i| i as f64).collect();
    let order = BodyOrder {
        points: along.clone(),
        frames: along,
    };
    let layout = Layout::new(&state, Some(&order)).unwrap();
    (state, terms, layout)
}

#[test]
fn stiffness_is_the_second_derivative_along_carried_steps() {
    for held in [true, false] {
        let (state, terms, mut layout) = chain(held);
        let here = Evaluation::new(&terms, &state);
        let [mut plain, mut turned] = [Assembly::new(1.0), Assembly::new(1.0)];
        plain.update(&terms, &state, &mut layout);
        turned.update(&terms, &state, &mut layout);
        turned.add_turning(&state, &here.loads, &layout);
        let mut noise = Xorshift::new(3);
        for _ in 0..10 {
            let step: Vec<f64> = (0..layout.unknowns()).map(|_| noise.sample()).collect();
            let velocities = layout.velocities(&state, &step);
            let energy = |t: f64, is_carried: bool| {
                let mut moved = state.clone();
                layout.apply(&mut moved, &step, t);
                if is_carried {
                    plain.chain().carry(&state, &velocities, t, &mut moved);
                }
                Evaluation::new(&terms, &moved).energy_above(&here)
            };
            let second =
                |is_carried| derivative(1e-2, |s| derivative(1e-2, |t| energy(s + t, is_carried)));
            let along = |assembly: &Assembly| {
                let mut product = vec![0.0; step.len()];
                assembly.multiply(&step, &mut product);
                crate::direction::dot(&product, &step)
            };
            // Rounding of energies of size 100, over 1e-2 twice: 1e-10.
            let is_close = |a: f64, b: f64| (a - b).abs() < 1e-7 * b.abs().max(1.0);
            let (straight, carried) = (along(&plain), along(&turned));
            assert!(is_close(straight, second(false)), "{straight}");
            assert!(is_close(carried, second(true)), "{carried}");
            assert!(!is_close(straight, carried), "no turning");
        }
    }
}

#[test]
fn a_chain_held_at_one_end_is_open() {
    let seen = |layout: &mut Layout, state: &State, terms: &[Box<dyn Interaction>]| {
        let mut assembly = Assembly::new(1.0);
        assembly.update(terms, state, layout);
        crate::chain::is_open(layout, assembly.ties())
    };
    for held in [true, false] {
        let (mut state, terms, mut layout) = chain(held);
        assert!(seen(&mut layout, &state, &terms));
        let mut across = layout.clone().with_links();
        assert!(!seen(&mut across, &state, &terms));
        state.points.hold(6);
        let mut other_end = Layout::new(&state, None).unwrap();
        assert_eq!(seen(&mut other_end, &state, &terms), !held);
    }
}
