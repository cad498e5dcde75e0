//! Runs a scene and writes it as GSD.

use actin_export::Format;
use actin_export::sim::{Scene, SimError, Solution, Solve};
use std::fs::File;

const SCENE: &str = "Scene(
    filament: Filament(sections: [Ellipsoids(from_nm: 0.0, to_nm: 20.0), Rod(from_nm: 20.0, to_nm: 60.0)]),
    clamps: [Clamp(end: Start)],
    loads: [EndForce(end: End, force_pn: (-1.0, 0.0, 0.0))],
    task: Equilibrium(),
)";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = Scene::from_ron(SCENE).map_err(SimError::from)?;
    let Solution {
        assembly,
        trajectory,
        ..
    } = scene.solve()?;

    let path = std::env::temp_dir().join(format!("actin-export-{}.gsd", std::process::id()));
    Format::Gsd.write(&assembly, &trajectory, "bent", &mut File::create(&path)?)?;
    let size = std::fs::metadata(&path)?.len();
    println!("{} records in {}", trajectory.records.len(), path.display());
    // 13 particles with 44 bytes in each record, and the fixed data.
    assert!(size > 1000 && size < 10_000, "{size}");
    std::fs::remove_file(path)?;
    Ok(())
}
