//! Comparison of ensembles with single runs.

use super::*;
use crate::Solve;
use crate::scene::SceneProblem;
use std::sync::atomic::{AtomicUsize, Ordering};

fn heated(duration_ns: f64, more: &str) -> Scene {
    let text = format!(
        "Scene(
            filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 40.0, segments: 4)]),
            clamps: [Clamp(end: Start)],
            task: Dynamics(
                duration_ns: {duration_ns:?},
                drag: (translational_per_ns: 5.0, rotational_per_ns: 5.0),
                thermal: Thermal(temperature_k: 298.0, seed: 1),
                {more}
            ),
        )"
    );
    Scene::from_ron(&text).unwrap()
}

const DRAWN: &str = "Scene(
    filament: Filament(
        sections: [Ellipsoids(from_nm: 0.0, to_nm: 20.0)],
        monomers: Monomers(anchors: Independent),
    ),
    clamps: [Clamp(end: Start)],
    loads: [EndForce(end: End, force_pn: (1.0, 0.0, 0.0))],
    task: Equilibrium(),
)";

fn threads(number: usize) -> NonZeroUsize {
    NonZeroUsize::new(number).unwrap()
}

fn records(scene: &Scene, number: usize) -> Vec<(usize, u64, Vec<Record>)> {
    let ensemble = Ensemble::new(scene, 5).unwrap();
    let ensemble = ensemble.on_threads(threads(number));
    let all = ensemble.run(|r| (r.index, r.seed, r.sink.records));
    all.unwrap()
}

#[test]
fn results_equal_single_runs_on_any_number_of_threads() {
    for mut scene in [heated(0.3, ""), Scene::from_ron(DRAWN).unwrap()] {
        let one = records(&scene, 1);
        assert_eq!(one, records(&scene, 2));
        assert_eq!(one, records(&scene, 3));
        assert_ne!(one[0].2, one[1].2);
        for (i, (index, seed, records)) in one.into_iter().enumerate() {
            assert_eq!((index, seed), (i, i as u64 + 1));
            for what in RandomPart::ALL {
                scene.reseed(what, seed);
            }
            let alone = scene.solve().unwrap().trajectory;
            assert_eq!(records, alone.records);
        }
    }
}

#[test]
fn replicas_that_would_be_the_same_are_refused() {
    let mut scene = heated(0.1, "");
    let seeds =
        |scene, drawn: &[RandomPart]| Ensemble::from_seeds(scene, vec![3, 9], drawn).is_ok();
    assert!(seeds(&scene, &[RandomPart::Noise]));
    assert!(!seeds(&scene, &[RandomPart::Bonds]));
    scene.reseed(RandomPart::Noise, 9);
    assert!(Ensemble::from_seeds(&scene, vec![3], &[]).is_ok());
    let none: Vec<u64> = Ensemble::new(&scene, 0).unwrap().run(|r| r.seed).unwrap();
    assert!(none.is_empty());
}

/// The first replica fails last; replicas before a failed one are not stopped.
#[test]
fn the_first_call_that_fails_is_named() {
    let (stopped, ended) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let problem = || SceneProblem::new("task", "", "fails");
    let wait_for = |number: &AtomicUsize| {
        while number.load(Ordering::Relaxed) == 0 {
            std::thread::yield_now();
        }
    };
    let make = |index: usize, is_stopped: &dyn Fn() -> bool| match index {
        0 => {
            wait_for(&stopped);
            assert!(!is_stopped());
            ended.fetch_add(1, Ordering::Relaxed);
            Ok(Some(()))
        }
        1 => {
            wait_for(&ended);
            Err(problem())
        }
        _ => {
            stopped.fetch_add(1, Ordering::Relaxed);
            Err(problem())
        }
    };
    let (index, error) = pool::on_threads(3, 9, make).unwrap_err();
    assert_eq!((index, error), (1, problem()));
}

#[test]
fn a_replica_that_explodes_is_named() {
    let scene = heated(2.0, "time_step_ns: 0.02, allow_unstable_step: true,");
    for number in [1, 2, 3] {
        let ensemble =
            Ensemble::from_seeds(&scene, vec![11, 12, 13, 14], &RandomPart::ALL).unwrap();
        let failed = ensemble.on_threads(threads(number)).run(|r| r.index);
        let error = failed.unwrap_err().to_string();
        assert!(error.starts_with("replica 0 (seed 11): "), "{error}");
    }
}

#[test]
fn a_replica_that_is_refused_is_named() {
    let scene = heated(2.0, "time_step_ns: 0.02,");
    let refused = Ensemble::new(&scene, 2).unwrap().run(|r| r.index);
    let Err(EnsembleError::Replica { index, seed, error }) = refused else {
        panic!("the time step is above the limit");
    };
    assert_eq!((index, seed), (0, 1));
    assert!(matches!(error, crate::RunError::Refused(_)), "{error}");
}
