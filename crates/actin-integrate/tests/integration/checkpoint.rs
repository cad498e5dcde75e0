use crate::common;
use actin_integrate::{
    Bath, Checkpoint, Composition, Drag, Moment, Observer, Pause, Run, RunOutcome, StopRule,
};
use actin_mechanics::{Drive, State, System, Vector3};
use common::{chain, vibrating_tops};
use proptest::prelude::*;
use std::ops::ControlFlow;

/// Thermal energy of runs with noise, with velocities of 0.07 like the other motions.
const KT: f64 = 5e-3;

#[derive(Debug)]
struct Circle;

impl Drive for Circle {
    fn place(&self, state: &mut State, time: f64) {
        let (sin, cos) = (2.0 * time).sin_cos();
        let position = Vector3::new(9.0 + 0.1 * cos, 0.1 * sin, 0.0);
        state.points.position.set(9, position);
        let velocity = Vector3::new(-0.2 * sin, 0.2 * cos, 0.0);
        state.points.velocity.set(9, velocity);
    }
}

fn build(kind: usize) -> System {
    let mut system = match kind {
        0 => vibrating_tops(3),
        _ => chain(10, 4.0, 1.0),
    };
    if kind > 0 {
        let state = system.state_mut();
        state.points.position.add(4, Vector3::new(0.2, 0.1, -0.1));
    }
    if kind == 2 {
        system.set_drive(Box::new(Circle));
    }
    system
}

/// Records observations, interrupts at pause `leave`, and changes the state after every fifth
/// observation if `nudges`.
#[derive(Default)]
struct Witness {
    seen: Vec<(u64, f64, f64, f64)>,
    pauses: usize,
    leave: Option<usize>,
    kept: Option<Checkpoint>,
    /// End of the run.
    ended: Option<Checkpoint>,
    nudges: bool,
}

impl Observer for Witness {
    fn observe(&mut self, moment: &mut Moment<'_>) -> ControlFlow<()> {
        // The residual evaluates loads between steps.
        let force = moment.residual().force;
        let energy = moment.potential_energy() + moment.kinetic_energy();
        self.seen.push((moment.step, moment.time, energy, force));
        ControlFlow::Continue(())
    }

    fn intervene(&mut self, _: f64, _: bool, system: &mut System) -> bool {
        let is_due = self.nudges && self.seen.len() % 5 == 2;
        if is_due {
            let position = &mut system.state_mut().points.position;
            position.add(1, Vector3::new(0.01, 0.02, 0.0));
        }
        is_due
    }

    fn pause(&mut self, pause: &Pause<'_>) -> ControlFlow<()> {
        self.pauses += 1;
        if self.leave == Some(self.pauses) {
            self.kept = Some(pause.checkpoint());
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    }

    fn finish(&mut self, end: &Pause<'_>) {
        assert!(self.ended.replace(end.checkpoint()).is_none(), "ends once");
    }
}

fn execute(run: &Run, system: &mut System, witness: &mut Witness) -> RunOutcome {
    run.execute(system, &mut [witness]).unwrap()
}

/// Run of `steps` steps with the given settings; `noise` is a seed.
fn plan(
    (scheme, steps, every): (usize, u64, (u64, u64)),
    drag: f64,
    noise: Option<u64>,
    stops: bool,
) -> Run {
    let scheme = &Composition::all()[scheme];
    let drag = Drag::new(drag, 0.5 * drag).unwrap();
    let mut run = Run::new(scheme, 0.05, steps)
        .and_then(|run| run.observing_every(every.0))
        .and_then(|run| run.checking_every(every.1))
        .unwrap()
        .with_drag(drag);
    if let Some(seed) = noise {
        run = run.with_bath(Bath::new(drag, KT, seed).unwrap());
    }
    if stops {
        let rule = StopRule::new(0.3, 0.3, 0.05).unwrap();
        return run.with_stop_rule(rule).stopping_from(1.0);
    }
    run
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn a_resumed_run_agrees_bitwise(
        kind in 0_usize..3,
        scheme in 0..Composition::all().len(),
        steps in 1_u64..400,
        every in (1_u64..60, 1_u64..60),
        drag in prop_oneof![Just(0.0), 0.01..1.0],
        noise in proptest::option::of(any::<u64>()),
        stops: bool,
        nudges: bool,
        leave in proptest::collection::vec(1_usize..40, 1..4),
    ) {
        let run = plan((scheme, steps, every), drag, noise, stops);
        let mut whole = build(kind);
        let mut one = Witness { nudges, ..Witness::default() };
        let expected = execute(&run, &mut whole, &mut one);

        let mut system = build(kind);
        let mut witness = Witness { leave: Some(leave[0]), nudges, ..Witness::default() };
        let mut outcome = execute(&run, &mut system, &mut witness);
        for next in leave.iter().skip(1).map(Some).chain([None]) {
            let Some(checkpoint) = witness.kept.take() else { break };
            // A new system, as in another process.
            system = build(kind);
            witness.leave = next.map(|next| witness.pauses + next);
            outcome = run.execute_from(Some(&checkpoint), None, &mut system, &mut [&mut witness]).unwrap();
        }
        prop_assert_eq!(system.state(), whole.state());
        prop_assert_eq!(outcome, expected);
        prop_assert_eq!(witness.seen, one.seen);
        prop_assert_eq!(witness.pauses, one.pauses);

        // Resuming from the end makes no step.
        let end = one.ended.unwrap();
        prop_assert_eq!(Some(&end), witness.ended.as_ref());
        let (mut system, mut witness) = (build(kind), Witness::default());
        let outcome = run.execute_from(Some(&end), None, &mut system, &mut [&mut witness]).unwrap();
        prop_assert_eq!(system.state(), whole.state());
        prop_assert_eq!(outcome, expected);
        prop_assert!(witness.seen.is_empty());
        prop_assert_eq!(witness.ended, Some(end));
    }
}

struct Steps(Vec<u64>);

impl Observer for Steps {
    fn observe(&mut self, _: &mut Moment<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    fn pause(&mut self, pause: &Pause<'_>) -> ControlFlow<()> {
        self.0.push(pause.step);
        let _ = pause.checkpoint();
        ControlFlow::Continue(())
    }
}

#[test]
fn pauses_are_close_and_cost_nothing() {
    for scheme in Composition::all() {
        let run = Run::new(scheme, 0.05, 1000).unwrap();
        let run = run.observing_every(7).unwrap();
        let mut steps = Steps(vec![0]);
        let outcome = run
            .execute(&mut vibrating_tops(1), &mut [&mut steps])
            .unwrap();
        assert!(steps.0.windows(2).all(|pair| pair[1] - pair[0] <= 100));
        let per_step = scheme.force_evaluations_per_step() as u64;
        assert_eq!(outcome.force_evaluations, 1000 * per_step + 1, "{scheme}");
    }
}
