//! Place and duration of the cells of monomers.

use super::scene;
use actin_sim::follow::{Cell, Criterion, FilamentState, Follower, ResolutionRequest};
use actin_sim::{RefinementCriterion, Scene, Solution, Solve};

#[derive(Debug)]
struct Restless;

impl Criterion for Restless {
    fn request(&self, cell: &Cell<'_>) -> ResolutionRequest {
        if cell.is_monomers {
            ResolutionRequest::Rod
        } else {
            ResolutionRequest::Monomers
        }
    }
}

#[test]
fn cells_stay_for_the_least_time() {
    let scene = scene(
        72.0,
        0.6,
        "task: Dynamics(duration_ns: 3.0, time_step_ns: 0.0025)",
    );
    let follower = Follower::new(&scene).unwrap();
    let run = follower.with_criterion(Box::new(Restless)).run().unwrap();
    let times: Vec<f64> = run.switches().map(|s| s.time_ns).collect();
    // Checks are 0.25 ns apart: 0.6 ns have passed at the third.
    let gaps: Vec<f64> = times.windows(2).map(|t| t[1] - t[0]).collect();
    assert!(gaps.len() >= 2, "{times:?}");
    assert!(gaps.iter().all(|gap| (gap - 0.75).abs() < 1e-9), "{gaps:?}");
}

/// Loads and energies of the four cells of a cantilever agree with a slender rod. Between two
/// thresholds a cell does not change.
#[test]
fn criteria_read_loads_and_energies_of_cells() {
    let text = "Scene(
        filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 144.0, segments: 48)], rod: RodModel(law: Constant)),
        clamps: [Clamp(end: Start)],
        loads: [EndForce(end: End, force_pn: (0.5, 0.0, 0.0))],
        task: Equilibrium(),
    )";
    let Solution {
        assembly,
        trajectory,
        ..
    } = Scene::from_ron(text).unwrap().solve().unwrap();
    let state = &trajectory.records.last().unwrap().state;
    let boundaries_nm = [0.0, 36.0, 72.0, 108.0, 144.0];
    let filament = FilamentState::new((&assembly, state), &boundaries_nm);
    let cells: Vec<Cell<'_>> = filament.cells(&[false; 4]).collect();
    let bend = assembly.scene.filament.rod.material.rigidities().bend.y;
    for cell in &cells {
        let [from, to] = cell.span_nm.map(|s_nm| 0.5 * (144.0 - s_nm));
        let load = cell.mean_load();
        // Cross-sections rotate by up to 0.06 within a cell; deflections shorten the lever arms by
        // less than 1 %.
        assert!((load.force_pn.norm() - 0.5).abs() < 1e-3, "{load:?}");
        let couple = load.couple_pn_nm.norm() / (0.5 * (from + to));
        assert!((couple - 1.0).abs() < 0.01, "{couple}");
        // The shear energy is below 2 % of the bending energy in the last cell.
        let of_bending = (from * from + from * to + to * to) / (6.0 * bend);
        let energy = cell.energy_per_length_pn() / of_bending;
        assert!((energy - 1.0).abs() < 0.05, "{energy}");
    }
    for (criterion, expected) in criteria(bend) {
        let wishes = [0, 1, 2, 3].map(|i| criterion.request(&cells[i]));
        assert_eq!(wishes, expected, "{criterion:?}");
    }
}

/// Criteria with thresholds at bending moments of 20 and 55 pN nm for a bending rigidity `bend` (pN
/// nm^2), and the requests for four cells with 63, 45, 27 and 9 pN nm under 0.5 pN.
fn criteria(bend: f64) -> [(RefinementCriterion, [ResolutionRequest; 4]); 5] {
    let (monomers, stay, rod) = (
        ResolutionRequest::Monomers,
        ResolutionRequest::Stay,
        ResolutionRequest::Rod,
    );
    let force = RefinementCriterion::Force {
        above_pn: 0.6,
        below_pn: 0.4,
    };
    let couple = RefinementCriterion::Couple {
        above_pn_nm: 55.0,
        below_pn_nm: 20.0,
    };
    let energy = RefinementCriterion::Energy {
        above_pn: 0.5 * 55.0 * 55.0 / bend,
        below_pn: 0.5 * 20.0 * 20.0 / bend,
    };
    let largest = RefinementCriterion::LargestEnergy {
        above: 0.9,
        below: 0.3,
    };
    let curvature = RefinementCriterion::Curvature {
        above_per_nm: 55.0 / bend,
        below_per_nm: 20.0 / bend,
    };
    [
        (force, [stay; 4]),
        (couple, [monomers, stay, stay, rod]),
        (energy, [monomers, stay, stay, rod]),
        (largest, [monomers, stay, rod, rod]),
        (curvature, [monomers, stay, stay, rod]),
    ]
}

#[test]
fn without_requests_there_are_no_monomers() {
    let scene = scene(
        144.0,
        1.0,
        "clamps: [Clamp(end: Start)],
         loads: [EndForce(end: End, force_pn: (-1.0, 0.0, 0.0))],
         task: Dynamics(duration_ns: 1.0),",
    );
    let run = Follower::new(&scene).unwrap().run().unwrap();
    assert_eq!(run.stretches.len(), 1);
    let counts = run.stretches[0].stretch.assembly.counts();
    assert_eq!((counts.monomers, counts.bonds, counts.junctions), (0, 0, 0));
}

#[test]
fn a_window_follows_a_linker_that_steps() {
    check_window(
        "Dynamics(duration_ns: 6.0, record_every_ns: 0.1,
            drag: (translational_per_ns: 5.0, rotational_per_ns: 5.0))",
    );
    check_window(
        "Brownian(duration_ms: 6e-6, record_every_ns: 0.1, temperature_k: 298.0,
            interfaces: QuasiHarmonic(sampled_ns: 20.0))",
    );
}

fn check_window(task: &str) {
    let text = format!(
        "Scene(
        filament: Filament(
            sections: Following(
                length_nm: 180.0,
                monomers_where: [Linker(linker: 0, within_nm: 5.0, beyond_nm: 15.0)],
                least_ns: 0.2,
            ),
            rod: RodModel(law: Homogenised),
        ),
        clamps: [Clamp(end: Start)],
        linkers: [Linker(
            at_nm: 20.0, displaced_nm: (0.0, 0.0, 10.0), stiffness_pn_per_nm: 0.1, rest_length_nm: 10.0,
            kinetics: Kinetics(seed: 3, steps: Stepping(rate_per_ns: 3.0, step_nm: 11.0, stall_pn: 50.0)),
        )],
        task: {task},
    )"
    );
    let scene = Scene::from_ron(&text).unwrap_or_else(|error| panic!("{error}"));
    let run = Follower::new(&scene).unwrap().run();
    let run = run.unwrap_or_else(|error| panic!("{error}"));
    assert!(run.stretches.len() >= 3);
    for ran in &run.stretches {
        let assembly = &ran.stretch.assembly;
        let record = &ran.trajectory.records[0];
        let (_, s_nm) = assembly.switched(0, &record.state).unwrap();
        let mut sections = assembly.sections.iter().filter(|s| s.is_ellipsoids());
        assert!(
            sections.any(|s| s.from_nm - 15.0 <= s_nm && s_nm <= s.to_nm + 15.0),
            "{s_nm}"
        );
        assert!(assembly.counts().monomers < 65);
    }
    let first = run.switches().next().unwrap().time_ns;
    assert!(first < 6.0);
}

#[test]
fn held_ends_stay_where_they_were_built() {
    let scene = scene(
        108.0,
        0.25,
        "clamps: [Clamp(end: Start)],
         loads: [EndForce(end: End, force_pn: (-6.0, 0.0, 0.0))],
         task: Dynamics(duration_ns: 6.0, time_step_ns: 0.00125, record_every_ns: 0.125),",
    );
    let follower = Follower::new(&scene).unwrap();
    let run = follower.with_criterion(Box::new(Restless)).run().unwrap();
    assert!(run.stretches.len() > 20);
    for ran in &run.stretches {
        let (assembly, state) = (&ran.stretch.assembly, &ran.trajectory.records[0].state);
        for i in (0..assembly.points.len()).filter(|&i| !state.points.is_free(i)) {
            let built = assembly.rest.points.position.get(i);
            assert_eq!(state.points.position.get(i), built);
            assert!(state.points.velocity.get(i).norm() < 1e-300);
        }
        for i in (0..assembly.frames.len()).filter(|&i| !state.frames.is_free(i)) {
            let built = assembly.rest.frames.orientation.get(i);
            assert_eq!(state.frames.orientation.get(i), built);
        }
    }
}
