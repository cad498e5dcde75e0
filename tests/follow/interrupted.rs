//! Interruptions of a following motion between and at switches.

use super::{ToAndFro, scene};
use actin_sim::follow::{Follower, Stretch, StretchEnd};
use actin_sim::{Plan, Record, RecordSummary, RunPosition, SavedRun, Scene, Sink, Status};

fn thermal() -> Scene {
    let rest = "task: Dynamics(
            duration_ns: 3.0,
            time_step_ns: 0.0025,
            record_every_ns: 0.1,
            drag: (translational_per_ns: 5.0, rotational_per_ns: 5.0),
            thermal: (temperature_k: 298.0, seed: 7),
        ),";
    scene(108.0, 0.25, rest)
}

fn overdamped() -> Scene {
    let rest = "task: Brownian(
            duration_ms: 1.6e-3,
            temperature_k: 298.0,
            seed: 7,
            time_step_ns: 40.0,
            record_every_ns: 80.0,
            interfaces: QuasiHarmonic(sampled_ns: 20.0),
        ),";
    scene(108.0, 1.0, rest)
}

struct Stops {
    records: Vec<Record>,
    asked: u32,
    every: u32,
    saved: Option<SavedRun>,
}

impl Sink for Stops {
    fn record(&mut self, record: &Record) {
        self.records.push(record.clone());
    }

    fn is_interrupted(&mut self) -> bool {
        self.asked += 1;
        self.asked.is_multiple_of(self.every)
    }

    fn checkpoint(&mut self, position: &RunPosition, recorded: &RecordSummary, wall_s: f64) {
        self.saved = Some(SavedRun {
            position: position.clone(),
            recorded: recorded.clone(),
            wall_s,
        });
    }
}

fn run(scene: &Scene, every_ns: f64, every: u32) -> (Vec<(usize, Record)>, u32) {
    let follower = Follower::new(scene).unwrap();
    let follower = follower.with_criterion(Box::new(ToAndFro { every_ns }));
    let mut sink = Stops {
        records: Vec::new(),
        asked: 0,
        every,
        saved: None,
    };
    let (mut stretch, mut saved): (Stretch, Option<SavedRun>) = (follower.begin().unwrap(), None);
    let (mut all, mut interruptions) = (Vec::new(), 0);
    loop {
        let plan = Plan::new(&stretch.assembly).unwrap();
        let left = follower.advance((&stretch, &plan), saved.take(), &mut sink);
        let left = left.unwrap_or_else(|error| panic!("{error}"));
        all.extend(
            sink.records
                .drain(..)
                .map(|record| (stretch.beginning.index, record)),
        );
        match left {
            StretchEnd::Over(outcome) if outcome.status == Status::Interrupted => {
                saved = sink.saved.take();
                interruptions += 1;
            }
            StretchEnd::Over(_) => return (all, interruptions),
            StretchEnd::Switched(_, next) => (stretch, saved) = (next.stretch, Some(next.saved)),
        }
    }
}

#[test]
fn an_interrupted_motion_is_the_same_to_the_bit() {
    for (scene, every_ns) in [(thermal(), 0.5), (overdamped(), 120.0)] {
        let (whole, none) = run(&scene, every_ns, u32::MAX);
        assert_eq!(none, 0);
        assert!(whole.last().unwrap().0 >= 4);
        for every in [1, 3, 7] {
            let (parts, interruptions) = run(&scene, every_ns, every);
            assert!(interruptions > 1);
            assert_eq!(parts.len(), whole.len());
            for (part, one) in parts.iter().zip(&whole) {
                assert_eq!(part, one);
            }
        }
    }
}
