//! How soon a broken state is noticed, counted in evaluations of the loads.

use crate::common;
use actin_integrate::{
    Body, Checkpoint, DEFAULT_CHECK_EVERY, Moment, Observer, POSITION_VERLET, Run, RunFailure,
    VELOCITY_VERLET, largest_frequency,
};
use actin_mechanics::{Interaction, Loads, Split, State, System, Vector3};
use common::{Springs, chain, vibrating_tops};
use proptest::prelude::*;
use std::ops::ControlFlow;

/// A load on one body that is no number from some time on.
#[derive(Debug)]
struct Poison {
    body: Body,
    from: f64,
    value: f64,
}

impl Interaction for Poison {
    fn term(&self) -> &'static str {
        "poison"
    }

    fn add_loads(&self, state: &State, loads: &mut Loads) {
        if state.time < self.from {
            return;
        }
        match self.body {
            Body::Point(i) => loads.force.add(i, Vector3::y() * self.value),
            Body::Frame(i) => loads.torque.add(i, Vector3::y() * self.value),
        }
    }

    fn elements(&self) -> usize {
        0
    }

    fn write_energies(&self, _state: &State, _energies: &mut [f64]) {}
}

/// Six points in a row, stretched, with what poisons one of them.
fn poisoned(poison: Poison) -> System {
    let springs = Springs {
        name: "springs",
        pairs: (1..6).map(|i| (i - 1, i)).collect(),
        stiffness: 4.0,
        rest: 1.0,
    };
    let mut state = chain(6, 4.0, 1.0).state().clone();
    state.points.position.add(2, Vector3::x() * 0.1);
    System::new(state, vec![Box::new(springs), Box::new(poison)])
}

proptest! {
    /// Wherever in a run a load ceases to be a number, the step, the body and the term are named,
    /// after at most the steps between two checks (and as many again to retrace them), however far
    /// apart observations are.
    #[test]
    fn what_is_no_number_is_noticed_within_a_check(
        step in 1_u64..5000,
        body in 1_usize..5,
        value in prop_oneof![Just(f64::NAN), Just(f64::INFINITY), Just(f64::NEG_INFINITY)],
    ) {
        let h = 0.05;
        // Position Verlet evaluates loads in the middle of a step.
        let from = (step as f64 - 0.75) * h;
        let mut system = poisoned(Poison { body: Body::Point(body), from, value });
        let failure = Run::new(&POSITION_VERLET, h, 1_000_000)
            .unwrap()
            .observing_every(1_000_000)
            .unwrap()
            .execute(&mut system, &mut [])
            .unwrap_err();
        prop_assert_eq!((failure.step, failure.body), (step, Body::Point(body)));
        prop_assert_eq!((failure.term, failure.last_good_step), ("poison", 0));
    }
}

/// The bound itself, in evaluations that the caller can count: one per step up to the check that
/// notices, one per step from the check before, one to find the term.
#[test]
fn noticing_costs_at_most_two_intervals() {
    struct Work(u64);
    impl Observer for Work {
        fn observe(&mut self, _: &mut Moment<'_>) -> ControlFlow<()> {
            ControlFlow::Continue(())
        }

        fn fail(&mut self, last_good: &Checkpoint) {
            self.0 = last_good.here.step;
        }
    }
    for step in [1, 99, 100, 101, 777, 5003] {
        let from = (step as f64 - 0.75) * 0.05;
        let body = Body::Point(3);
        let mut counted = Counting::new(Poison {
            body,
            from,
            value: f64::NAN,
        });
        let evaluations = counted.evaluations.clone();
        let run = Run::new(&POSITION_VERLET, 0.05, 1_000_000).unwrap();
        let run = run.observing_every(1000).unwrap();
        let mut work = Work(u64::MAX);
        let failure = run
            .execute(&mut counted.system, &mut [&mut work])
            .unwrap_err();
        assert_eq!(failure.step, step);
        // The checkpoint of the last good state is that of the last observation.
        assert_eq!(work.0, (step - 1) / 1000 * 1000);
        let made = evaluations.load(std::sync::atomic::Ordering::Relaxed);
        // Two more for what the report asks of the terms, and one for the state put back.
        let most = step + 2 * DEFAULT_CHECK_EVERY + 4;
        assert!(
            made <= most,
            "{made} evaluations for a break at step {step}"
        );
    }
}

/// A system whose evaluations can be counted after its counter has been put back.
struct Counting {
    system: System,
    evaluations: std::sync::Arc<std::sync::atomic::AtomicU64>,
}

/// Counts evaluations.
#[derive(Debug)]
struct Tally(std::sync::Arc<std::sync::atomic::AtomicU64>);

impl Interaction for Tally {
    fn term(&self) -> &'static str {
        "tally"
    }

    fn add_loads(&self, _state: &State, _loads: &mut Loads) {
        self.0.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
    }

    fn elements(&self) -> usize {
        0
    }

    fn write_energies(&self, _state: &State, _energies: &mut [f64]) {}
}

impl Counting {
    fn new(poison: Poison) -> Self {
        let evaluations = std::sync::Arc::default();
        let tally = Tally(std::sync::Arc::clone(&evaluations));
        let state = chain(6, 4.0, 1.0).state().clone();
        let system = System::new(state, vec![Box::new(poison), Box::new(tally)]);
        Self {
            system,
            evaluations,
        }
    }
}

/// Runs at `excess` above the stability limit until it is noticed.
fn unstable(system: &mut System, excess: f64) -> RunFailure {
    let limit = 2.0 / largest_frequency(system).unwrap();
    Run::new(&VELOCITY_VERLET, (1.0 + excess) * limit, 10_000_000)
        .unwrap()
        .observing_every(10_000_000)
        .unwrap()
        .execute(system, &mut [])
        .unwrap_err()
}

/// Above the limit by `d` the fastest mode grows by `exp(2 sqrt(2 d))` a step: it is noticed after
/// the steps in which that leads from its first velocity, 0.01 sqrt(2 d) of the fastest, to
/// overflow, `e^355`, or before, where motion ceases to be linear.
#[test]
fn growth_is_noticed_in_a_bounded_number_of_steps() {
    for excess in [1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.5] {
        let linear = Springs {
            name: "springs",
            pairs: (1..10).map(|i| (i - 1, i)).collect(),
            stiffness: 4.0,
            rest: 0.0,
        };
        let state = chain(10, 4.0, 1.0).state().clone();
        let mut chain = System::new(state, vec![Box::new(linear)]);
        for i in 1..9 {
            let sign = if i % 2 == 0 { 0.01 } else { -0.01 };
            chain
                .state_mut()
                .points
                .position
                .add(i, Vector3::y() * sign);
        }
        let failure = unstable(&mut chain, excess);
        let growth = 2.0 * (2.0 * excess).sqrt();
        let bound = (355.0 - (0.01 * (2.0 * excess).sqrt()).ln()) / growth.min(1.0);
        println!(
            "chain {excess:e}: step {}, bound {bound:.0}: {failure}",
            failure.step
        );
        assert!((failure.step as f64) < bound + DEFAULT_CHECK_EVERY as f64);

        let mut tops = vibrating_tops(7);
        let before = tops.force_evaluations();
        let failure = unstable(&mut tops, excess);
        println!(
            "tops  {excess:e}: step {}: {}",
            failure.step, failure.problem
        );
        assert_eq!(tops.force_evaluations(), before, "put back to the start");
        assert!((failure.step as f64) < bound + DEFAULT_CHECK_EVERY as f64);
    }
}
