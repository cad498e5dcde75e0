//! A scene is run from Rust and written to a directory; its summary is read back.

use actin_sim::{Assembly, Plan, RunDirectory, Scene, SimError};

fn main() -> Result<(), SimError> {
    // 40 nm of monomers on a wall, 120 nm of rod behind them, and 0.1 pN across the tip.
    let scene = Scene::from_ron(
        "Scene(
            filament: Filament(sections: [
                Ellipsoids(from_nm: 0.0, to_nm: 40.0),
                Rod(from_nm: 40.0, to_nm: 160.0),
            ]),
            clamps: [Clamp(end: Start)],
            loads: [EndForce(end: End, force_pn: (0.1, 0.0, 0.0))],
            task: Equilibrium(),
        )",
    )?;
    let assembly = Assembly::build(&scene)?;
    let plan = Plan::new(&assembly)?;
    let (trajectory, outcome) = plan.run()?;

    let folder = std::env::temp_dir().join(format!("actin-run-{}", std::process::id()));
    let directory = RunDirectory::create(&folder, false)?;
    directory.write(&plan, &trajectory, &outcome)?;
    let summary = directory.summary()?;

    // A beam of the published B1 = 3.9e4 pN nm^2; filaments that are bent this little are softer.
    let rod = 0.1 * 160.0_f64.powi(3) / (3.0 * 3.9e4);
    let [moved, ..] = summary.tip_displacement_nm;
    println!(
        "{:?}: tip moved {moved:.3} nm; F L^3 / 3 B = {rod:.3} nm",
        summary.status
    );
    println!(
        "{} monomers, {} segments",
        summary.counts.monomers, summary.counts.segments
    );
    assert!(moved > 1.2 * rod && moved < 1.5 * rod);
    std::fs::remove_dir_all(folder).expect("the run has written it");
    Ok(())
}
