use crate::common;
use actin_integrate::{
    Body, Checkpoint, FailureKind, Moment, Observer, PEFRL, POSITION_VERLET, Pause, Run,
    RunFailure, RunSettingError, largest_frequency, stable_step,
};
use actin_mechanics::{Interaction, Loads, State, System, Vector3};
use common::{chain, springs};
use std::ops::ControlFlow;

const H: f64 = 0.05;

/// Far above the energy of the chains (0.04 pN nm), far below the energy of a [`Source`].
const LIMIT: f64 = 1e3;

#[derive(Clone, Copy, Debug)]
struct Source {
    point: usize,
    from: f64,
    energy: f64,
}

impl Interaction for Source {
    fn term(&self) -> &'static str {
        "source"
    }

    fn add_loads(&self, state: &State, loads: &mut Loads) {
        if state.time >= self.from {
            loads.force.add(self.point, Vector3::y() * 100.0);
        }
    }

    fn elements(&self) -> usize {
        1
    }

    fn write_energies(&self, state: &State, energies: &mut [f64]) {
        energies[0] = if state.time >= self.from {
            self.energy
        } else {
            0.0
        };
    }
}

fn heated(step: u64, energy: f64) -> System {
    let mut state = chain(6, 4.0, 1.0).state().clone();
    let springs = springs(&state, 4.0, 1.0);
    state.points.position.add(2, Vector3::x() * 0.1);
    let source = Source {
        point: 3,
        // Position Verlet evaluates loads in the middle of a step.
        from: (step as f64 - 0.75) * H,
        energy,
    };
    System::new(state, vec![Box::new(springs), Box::new(source)])
}

fn run(observe: u64, check: u64) -> Run {
    Run::new(&POSITION_VERLET, H, 3000)
        .and_then(|run| run.observing_every(observe)?.checking_every(check))
        .and_then(|run| run.with_energy_limit(LIMIT))
        .unwrap()
}

/// Step, body and term of the excess are reported for any intervals, also for energies that are not
/// numbers.
#[test]
fn the_first_step_with_too_much_energy_is_reported() {
    for energy in [1e6, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for (observe, check) in [(1000, 100), (50, 100), (7, 3), (1, 1)] {
            for step in [1, 2, 99, 100, 101, 128, 777, 2100] {
                let mut system = heated(step, energy);
                let failure = run(observe, check)
                    .execute(&mut system, &mut [])
                    .unwrap_err();
                let last_good = (step - 1) / observe * observe;
                assert_eq!((failure.step, failure.last_good_step), (step, last_good));
                assert_eq!((failure.body, failure.term), (Body::Point(3), "source"));
                let FailureKind::TooMuchEnergy(found) = failure.problem else {
                    panic!("{failure}");
                };
                assert!(!(found.is_finite() && found <= LIMIT));
                assert_eq!(failure.to_string().contains("finite"), !energy.is_finite());
                // The energy of the chain is far below the limit.
                assert!(system.total_energy() < 1.0);
            }
        }
    }
}

#[derive(Default)]
struct Keeper {
    pauses: Vec<Checkpoint>,
    last_good: Option<Checkpoint>,
}

impl Observer for Keeper {
    fn observe(&mut self, _: &mut Moment<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    fn pause(&mut self, pause: &Pause<'_>) -> ControlFlow<()> {
        self.pauses.push(pause.checkpoint());
        ControlFlow::Continue(())
    }

    fn fail(&mut self, last_good: &Checkpoint) {
        self.last_good = Some(last_good.clone());
    }
}

#[test]
fn a_resumed_run_fails_with_the_same_message() {
    let run = run(1000, 100);
    let mut keeper = Keeper::default();
    let execute = |keeper| run.execute(&mut heated(1450, 1e6), &mut [keeper]);
    let failure = execute(&mut keeper).unwrap_err();
    assert_eq!(failure.step, 1450);
    let last_good = keeper.last_good.unwrap();
    let places = keeper.pauses.iter().chain([&last_good]);
    let again = |place: &Checkpoint| -> RunFailure {
        let mut system = heated(1450, 1e6);
        run.execute_from(Some(place), None, &mut system, &mut [])
            .unwrap_err()
    };
    assert!(keeper.pauses.iter().any(|pause| pause.here.step == 1900));
    for place in places {
        assert_eq!(again(place), failure, "from step {}", place.here.step);
    }
}

#[test]
fn strain_at_the_start_counts() {
    let mut system = chain(10, 4.0, 1.0);
    let end = &mut system.state_mut().points.position;
    end.add(9, Vector3::x() * 0.5);
    let energy = system.total_energy();
    let h = stable_step(&PEFRL, largest_frequency(&system).unwrap(), 0.1).unwrap();
    let run = Run::new(&PEFRL, h, 10).unwrap().observing_every(5).unwrap();
    let below = run.with_energy_limit(0.5 * energy).unwrap();
    let failure = below.execute(&mut system, &mut []).unwrap_err();
    assert_eq!(failure.problem, FailureKind::TooMuchEnergy(energy));
    assert_eq!((failure.step, failure.last_good_step), (0, 0));
    let above = run.with_energy_limit(2.0 * energy).unwrap();
    assert!(above.execute(&mut system, &mut []).is_ok());
    let refused = run.with_energy_limit(f64::NAN);
    assert!(matches!(refused, Err(RunSettingError::EnergyLimit(_))));
    let below_all = run.with_energy_limit(f64::NEG_INFINITY).unwrap();
    assert!(below_all.execute(&mut system, &mut []).is_err());
}
