//! Runs a scene into a directory and reads its states.

use actin_rundir::sim::{Assembly, Plan, Scene, SimError};
use actin_rundir::{Checkpoints, FinishedRun, RunDirectory};
use std::sync::Arc;
use std::time::Duration;

const SCENE: &str = "Scene(
    filament: Filament(sections: [Ellipsoids(from_nm: 0.0, to_nm: 12.0), Rod(from_nm: 12.0, to_nm: 42.0)]),
    clamps: [Clamp(end: Start)],
    loads: [EndForce(end: End, force_pn: (-1.0, 0.0, 0.0))],
    task: Dynamics(duration_ns: 0.3, record_every_ns: 0.1),
)";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = Scene::from_ron(SCENE).map_err(SimError::from)?;
    let assembly = Assembly::build(&scene)?;
    let plan = Plan::new(&assembly)?;
    let folder = std::env::temp_dir().join(format!("actin-rundir-{}", std::process::id()));
    let directory = RunDirectory::create(&folder, false)?;

    // A killed run is continued with `Checkpoints::resume`.
    let minute = Duration::from_mins(1);
    let interrupted = Arc::default();
    let warn = |error: &_| eprintln!("{error}");
    let mut records = Checkpoints::new(&directory, &plan, minute, interrupted, warn);
    directory.write_scene(plan.scene())?;
    let outcome = plan.run_into(&mut records)?;
    let summary = directory.write(&plan, &records, &outcome)?;
    directory.remove_checkpoint()?;

    let run = FinishedRun::open(&folder)?;
    let last = run.states()?.last().expect("four records")?;
    let tip_nm = run.assembly().tip_nm(&last, actin_rundir::sim::End::End);
    println!("tip after {} ns: {tip_nm}", last.time);
    assert!((summary.tip_nm[0] - tip_nm.x).abs() < 1e-12);
    assert_eq!((run.count(), directory.has_checkpoint()), (4, false));
    std::fs::remove_dir_all(folder)?;
    Ok(())
}
