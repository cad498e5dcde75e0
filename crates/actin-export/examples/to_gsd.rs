//! Runs a scene and exports its states to GSD.

use actin_export::rundir::{FinishedRun, RunDirectory};
use actin_export::sim::{Assembly, Plan, Scene, SimError};
use actin_export::{Format, export};

const SCENE: &str = "Scene(
    filament: Filament(sections: [Ellipsoids(from_nm: 0.0, to_nm: 20.0), Rod(from_nm: 20.0, to_nm: 60.0)]),
    clamps: [Clamp(end: Start)],
    loads: [EndForce(end: End, force_pn: (-1.0, 0.0, 0.0))],
    task: Equilibrium(),
)";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = Scene::from_ron(SCENE).map_err(SimError::from)?;
    let assembly = Assembly::build(&scene)?;
    let plan = Plan::new(&assembly)?;
    let (trajectory, outcome) = plan.run()?;
    let folder = std::env::temp_dir().join(format!("actin-export-{}", std::process::id()));
    let directory = RunDirectory::create(folder.join("bent"), false)?;
    directory.write(&plan, &trajectory, &outcome)?;

    let run = FinishedRun::open(directory.path())?;
    let files = export(&run, Format::Gsd, &folder.join("bent.gsd"), false)?;
    println!("{} records in {}", run.count(), files[0].display());
    let size = std::fs::metadata(&files[0])?.len();
    // Two records of 13 particles with 44 bytes each, and the fixed data.
    assert!(size > 1000 && size < 10_000, "{size}");
    std::fs::remove_dir_all(folder)?;
    Ok(())
}
