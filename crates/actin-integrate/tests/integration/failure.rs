use crate::common;
use actin_integrate::{
    Body, Checkpoint, DEFAULT_CHECK_EVERY, Moment, Observer, POSITION_VERLET, Run, RunFailure,
    VELOCITY_VERLET, largest_frequency,
};
use actin_mechanics::testing::Loading;
use actin_mechanics::{Interaction, Loads, Split, State, System, Vector3};
use common::{chain, springs, vibrating_tops};
use proptest::prelude::*;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

fn poison(point: usize, from: f64, value: f64) -> Box<dyn Interaction> {
    let add = move |state: &State, loads: &mut Loads| {
        if state.time >= from {
            loads.force.add(point, Vector3::y() * value);
        }
    };
    Box::new(Loading {
        term: "poison",
        add,
    })
}

fn poisoned(poison: Box<dyn Interaction>) -> System {
    let mut state = chain(6, 4.0, 1.0).state().clone();
    let springs = springs(&state, 4.0, 1.0);
    state.points.position.add(2, Vector3::x() * 0.1);
    System::new(state, vec![Box::new(springs), poison])
}

proptest! {
    #[test]
    fn loads_that_are_not_numbers_are_detected_within_a_check(
        step in 1_u64..5000,
        body in 1_usize..5,
        value in prop_oneof![Just(f64::NAN), Just(f64::INFINITY), Just(f64::NEG_INFINITY)],
    ) {
        let h = 0.05;
        // Position Verlet evaluates loads in the middle of a step.
        let from = (step as f64 - 0.75) * h;
        let mut system = poisoned(poison(body, from, value));
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

/// Evaluations: one per step up to the detecting check, one per step from the check before, one for
/// the term.
#[test]
fn detection_costs_at_most_two_intervals() {
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
        let evaluations = Arc::new(AtomicU64::new(0));
        let tally = Arc::clone(&evaluations);
        let add = move |_: &State, _: &mut Loads| {
            tally.fetch_add(1, Ordering::Relaxed);
        };
        let tally = Loading { term: "tally", add };
        let state = chain(6, 4.0, 1.0).state().clone();
        let mut system = System::new(state, vec![poison(3, from, f64::NAN), Box::new(tally)]);
        let run = Run::new(&POSITION_VERLET, 0.05, 1_000_000).unwrap();
        let run = run.observing_every(1000).unwrap();
        let mut work = Work(u64::MAX);
        let failure = run.execute(&mut system, &mut [&mut work]).unwrap_err();
        assert_eq!(failure.step, step);
        // The checkpoint of the last sound state is the last observation.
        assert_eq!(work.0, (step - 1) / 1000 * 1000);
        let made = evaluations.load(Ordering::Relaxed);
        // Two more for the report, and one for the restored state.
        let most = step + 2 * DEFAULT_CHECK_EVERY + 4;
        assert!(
            made <= most,
            "{made} evaluations for a break at step {step}"
        );
    }
}

fn unstable(system: &mut System, excess: f64) -> RunFailure {
    let limit = 2.0 / largest_frequency(system).unwrap();
    Run::new(&VELOCITY_VERLET, (1.0 + excess) * limit, 10_000_000)
        .unwrap()
        .observing_every(10_000_000)
        .unwrap()
        .execute(system, &mut [])
        .unwrap_err()
}

/// The fastest mode grows by `exp(2 sqrt(2 d))` per step for an excess `d`. It overflows (`e^355`)
/// from its initial velocity, 0.01 sqrt(2 d), unless the motion becomes nonlinear before.
#[test]
fn growth_is_detected_in_a_bounded_number_of_steps() {
    for excess in [1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.5] {
        let state = chain(10, 4.0, 1.0).state().clone();
        let linear = springs(&state, 4.0, 0.0);
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
        assert_eq!(tops.force_evaluations(), before, "restored to the start");
        assert!((failure.step as f64) < bound + DEFAULT_CHECK_EVERY as f64);
    }
}
