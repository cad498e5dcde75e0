//! Runs a scene and prints its summary.

use actin_sim::{Assembly, Plan, Scene, SimError, Summary};

fn main() -> Result<(), SimError> {
    // 40 nm of monomers on a wall, then 120 nm of rod, under a transverse tip force of 0.1 pN.
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
    let last = trajectory
        .records
        .last()
        .expect("an equilibrium has a record");
    let summary = Summary::new(&assembly, last, &outcome);

    // Beam with the published B1 = 3.9e4 pN nm^2. Filaments are softer at small curvature.
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
    Ok(())
}
