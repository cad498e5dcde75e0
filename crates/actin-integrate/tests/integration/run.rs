use crate::common;
use actin_integrate::{
    Body, Drag, FailureKind, Moment, Observer, PEFRL, POSITION_VERLET, Reason, Run,
    RunSettingError, StopRule, largest_frequency, stable_step,
};
use actin_mechanics::testing::Loading;
use actin_mechanics::{Interaction, Loads, Spring, Springs, State, System, Vector3};
use common::{Torsion, chain, distance, spinning_tops, springs, three_tops, vibrating_tops};
use std::ops::ControlFlow;

fn stretched_chain() -> System {
    let mut system = chain(10, 4.0, 1.0);
    system
        .state_mut()
        .points
        .position
        .add(9, Vector3::x() * 0.5);
    system
}

#[test]
fn settings_are_validated() {
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(
            Run::new(&PEFRL, bad, 1),
            Err(RunSettingError::Step(_))
        ));
    }
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e30] {
        let run = Run::from_duration(&PEFRL, 0.1, bad);
        assert!(matches!(run, Err(RunSettingError::Duration(_))), "{bad}");
    }
    let run = Run::new(&PEFRL, 0.1, 1).unwrap();
    assert_eq!(run.observing_every(0), Err(RunSettingError::Interval));
    assert_eq!(run.checking_every(0), Err(RunSettingError::Interval));
    assert!(run.with_kinetic_limit(f64::NAN).is_err());
    assert!(run.with_kinetic_limit(0.0).is_err());
}

/// 1 ns in steps of at most 0.3 ns takes 4 steps of 0.25 ns; 0.1 * 3 fits in 0.3 despite rounding.
#[test]
fn durations_are_met_exactly() {
    let run = Run::from_duration(&PEFRL, 0.3, 1.0).unwrap();
    assert_eq!((run.steps(), run.step()), (4, 0.25));
    assert_eq!(
        Run::from_duration(&PEFRL, 0.1, 0.1 * 3.0).unwrap().steps(),
        3
    );
    assert_eq!(Run::from_duration(&PEFRL, 5.0, 1.0).unwrap().steps(), 1);
}

/// Observations are at the start, at multiples of the interval and at the end. The energy of a
/// synchronised state varies by 1e-4 at a hundredth of the limit; velocities at half steps would
/// change it by percents.
#[test]
fn observers_see_synchronised_states() {
    let mut system = vibrating_tops(7);
    let energy = system.total_energy();
    let h = 0.01;
    let mut seen = Vec::new();
    let mut observer = |moment: &mut Moment<'_>| {
        let now = moment.potential_energy() + moment.kinetic_energy();
        assert!((now / energy - 1.0).abs() < 1e-4, "{now}");
        assert!((moment.energies().iter().sum::<f64>() - moment.potential_energy()).abs() < 1e-15);
        seen.push((moment.step, moment.time));
        ControlFlow::Continue(())
    };
    let outcome = Run::new(&POSITION_VERLET, h, 25)
        .unwrap()
        .observing_every(10)
        .unwrap()
        .checking_every(3)
        .unwrap()
        .execute(&mut system, &mut [&mut observer])
        .unwrap();
    let expected = [0, 10, 20, 25].map(|s: u32| (u64::from(s), f64::from(s) * h));
    assert_eq!(seen, expected);
    assert_eq!(outcome.reason, Reason::Completed);
    assert_eq!((outcome.steps, outcome.time), (25, 25.0 * h));
}

#[test]
fn stop_rule_ends_a_damped_run() {
    let rule = StopRule::new(1e-6, 1e-6, 1e-10).unwrap();
    let mut system = stretched_chain();
    let mut met = Vec::new();
    let mut observer = |moment: &mut Moment<'_>| {
        met.push(rule.is_met(moment.residual(), moment.kinetic_energy()));
        ControlFlow::Continue(())
    };
    let outcome = Run::new(&POSITION_VERLET, 0.4, 100_000)
        .unwrap()
        .with_drag(Drag::new(0.7, 0.7).unwrap())
        .with_stop_rule(rule)
        .observing_every(10)
        .unwrap()
        .execute(&mut system, &mut [&mut observer])
        .unwrap();
    assert_eq!(outcome.reason, Reason::Converged);
    assert!(outcome.steps < 10_000 && outcome.steps > 10);
    assert!(rule.is_met(outcome.residual, outcome.kinetic));
    let (last, earlier) = met.split_last().unwrap();
    assert!(*last && !earlier.contains(&true));
    // Each of the 9 springs of stiffness 4 has the same part of the extension of 0.5.
    let x = system.state().points.position.get(4).x;
    assert!((x - 4.0 * 9.5 / 9.0).abs() < 1e-5);
}

#[test]
fn rest_is_recognised_at_once() {
    let outcome = Run::new(&PEFRL, 0.1, 100)
        .unwrap()
        .with_stop_rule(StopRule::new(1e-9, 1e-9, 1e-9).unwrap())
        .execute(&mut chain(5, 4.0, 1.0), &mut [])
        .unwrap();
    assert_eq!((outcome.reason, outcome.steps), (Reason::Converged, 0));
}

struct Until(u64);

impl Observer for Until {
    fn observe(&mut self, moment: &mut Moment<'_>) -> ControlFlow<()> {
        if moment.step >= self.0 {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }
}

#[test]
fn interruption() {
    let mut system = spinning_tops();
    let mut last = 0;
    let mut late = |moment: &mut Moment<'_>| {
        last = moment.step;
        ControlFlow::Continue(())
    };
    let outcome = Run::new(&PEFRL, 0.01, 1000)
        .unwrap()
        .observing_every(50)
        .unwrap()
        .execute(&mut system, &mut [&mut Until(120), &mut late])
        .unwrap();
    assert_eq!((outcome.reason, outcome.steps), (Reason::Interrupted, 150));
    assert_eq!(last, 150);
}

/// One spring is far too stiff for the step. The error names its term and one of its points, and
/// the last observed state is restored.
#[test]
fn divergence_is_attributed_to_the_stiff_term() {
    let soft = chain(10, 4.0, 1.0);
    let mut state = soft.state().clone();
    state.points.position.add(9, Vector3::x() * 0.5);
    let one = Spring {
        points: [6, 7],
        stiffness: 400.0,
        rest_length: 1.0,
    };
    let one = Springs::new(&state, vec![one]).unwrap();
    let stiff = Loading {
        term: "stiff",
        add: move |state: &State, loads: &mut Loads| one.add_loads(state, loads),
    };
    let soft = springs(&state, 4.0, 1.0);
    let terms: Vec<Box<dyn Interaction>> = vec![Box::new(soft), Box::new(stiff)];
    let mut system = System::new(state, terms);
    let mut good: Option<(u64, State)> = None;
    let mut keep = |moment: &mut Moment<'_>| {
        good = Some((moment.step, moment.state().clone()));
        ControlFlow::Continue(())
    };
    let failure = Run::new(&POSITION_VERLET, 0.3, 100_000)
        .unwrap()
        .observing_every(10)
        .unwrap()
        .execute(&mut system, &mut [&mut keep])
        .unwrap_err();
    println!("{failure}");
    assert_eq!(failure.term, "stiff");
    assert!(matches!(failure.body, Body::Point(6 | 7)), "{failure}");
    assert!(failure.step > failure.last_good_step && failure.step <= failure.last_good_step + 10);
    assert!((failure.time - 0.3 * failure.step as f64).abs() < 1e-9);
    let (step, state) = good.unwrap();
    assert_eq!(failure.last_good_step, step);
    assert_eq!(*system.state(), state);
    let message = failure.to_string();
    assert!(message.contains("\"stiff\"") && message.contains("point"));
}

/// Angles are bounded, so only the rotation per step shows the divergence of a stiff torsion
/// spring.
#[test]
fn a_frame_that_spins_up_is_found() {
    let mut system = three_tops();
    let state = system.state_mut().clone();
    let torsion = Torsion {
        pairs: vec![(0, 2)],
        stiffness: 1e4,
    };
    let mut system = System::new(state, vec![Box::new(torsion)]);
    let turned = system.state().frames.orientation.get(0)
        * actin_mechanics::rotation::exp(Vector3::new(0.1, 0.2, 0.3));
    system.state_mut().frames.orientation.set(0, turned);
    let failure = Run::new(&PEFRL, 0.2, 1000)
        .unwrap()
        .execute(&mut system, &mut [])
        .unwrap_err();
    println!("{failure}");
    assert!(matches!(failure.problem, FailureKind::TurnsTooFar(_)));
    assert!(matches!(failure.body, Body::Frame(0 | 2)));
    assert_eq!((failure.term, failure.last_good_step), ("torsion", 0));
}

#[test]
fn an_unsound_start_is_refused() {
    let mut system = chain(4, 4.0, 1.0);
    let nowhere = Vector3::new(f64::NAN, 0.0, 0.0);
    system.state_mut().points.position.set(2, nowhere);
    let failure = Run::new(&PEFRL, 0.1, 10)
        .unwrap()
        .execute(&mut system, &mut [])
        .unwrap_err();
    assert_eq!((failure.step, failure.problem), (0, FailureKind::NotFinite));
    assert!(matches!(failure.body, Body::Point(1..=3)));
}

#[test]
fn kinetic_limit() {
    let mut system = spinning_tops();
    let kinetic = system.state().kinetic_energy();
    let run = Run::new(&PEFRL, 0.01, 10).unwrap();
    let below = run.with_kinetic_limit(0.5 * kinetic).unwrap();
    let failure = below.execute(&mut system, &mut []).unwrap_err();
    assert_eq!(failure.problem, FailureKind::TooFast(kinetic));
    let above = run.with_kinetic_limit(100.0 * kinetic).unwrap();
    assert!(above.execute(&mut system, &mut []).is_ok());
}

#[test]
fn a_load_on_a_resting_state_is_no_failure() {
    let mut system = stretched_chain();
    let faint = Vector3::y() * 1e-14;
    system.state_mut().points.velocity.set(3, faint);
    let h = stable_step(&PEFRL, largest_frequency(&system).unwrap(), 0.5).unwrap();
    let run = Run::new(&PEFRL, h, 1000).unwrap();
    for every in [1, 100] {
        let mut system = stretched_chain();
        system.state_mut().points.velocity.set(3, faint);
        let run = run.checking_every(every).unwrap();
        assert!(run.execute(&mut system, &mut []).is_ok());
    }
    assert!(distance(system.state(), stretched_chain().state()) < 1e-13);
}

#[derive(Default)]
struct Restless {
    moved: Vec<f64>,
    asked_at_end: bool,
}

impl Observer for Restless {
    fn observe(&mut self, _: &mut Moment<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    fn intervene(&mut self, time: f64, at_rest: bool, system: &mut System) -> bool {
        self.asked_at_end |= time >= 400.0;
        let moves = at_rest && self.moved.len() < 2;
        if moves {
            self.moved.push(time);
            system
                .state_mut()
                .points
                .position
                .add(4, Vector3::y() * 0.3);
        }
        moves
    }
}

/// The run continues until it is at rest without an intervention. There is none at the end of its
/// time.
#[test]
fn a_run_continues_after_an_intervention() {
    let rule = StopRule::new(1e-6, 1e-6, 1e-10).unwrap();
    let run = |steps| {
        Run::new(&POSITION_VERLET, 0.4, steps)
            .unwrap()
            .with_drag(Drag::new(0.7, 0.7).unwrap())
            .with_stop_rule(rule)
            .observing_every(10)
            .unwrap()
    };
    let mut observer = Restless::default();
    let outcome = run(100_000)
        .execute(&mut stretched_chain(), &mut [&mut observer])
        .unwrap();
    assert_eq!(outcome.reason, Reason::Converged);
    let [first, second] = observer.moved[..] else {
        panic!("{:?}", observer.moved);
    };
    assert!(first < second && second < outcome.time);
    assert!(rule.is_met(outcome.residual, outcome.kinetic));
    let mut observer = Restless::default();
    run(1000)
        .execute(&mut stretched_chain(), &mut [&mut observer])
        .unwrap();
    assert!(!observer.asked_at_end);
}
