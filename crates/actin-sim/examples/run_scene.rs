//! Builds a scene, solves it and prints its results.

use actin_sim::{Clamp, End, Equilibrium, Filament, Load, Scene, Section, SimError, Solve};

fn main() -> Result<(), SimError> {
    // 40 nm of monomers on a wall, then 120 nm of rod, under a transverse tip force of 0.1 pN.
    // `Scene::from_path` reads a scene from a file.
    let filament = Filament::new(vec![
        Section::ellipsoids(0.0, 40.0),
        Section::rod(40.0, 160.0, None),
    ]);
    let solution = Scene::new(filament, Equilibrium::default())
        .clamp(Clamp::new(End::Start))
        .load(Load::end_force(End::End, [0.1, 0.0, 0.0]))
        .solve()?;

    // Beam with the published B1 = 3.9e4 pN nm^2. Filaments are softer at small curvature.
    let beam = 0.1 * 160.0_f64.powi(3) / (3.0 * 3.9e4);
    let moved = solution.tip_displacement_nm().x;
    println!("tip moved {moved:.3} nm; F L^3 / 3 B = {beam:.3} nm");
    assert!(moved > 1.2 * beam && moved < 1.5 * beam);

    let wall = solution.end_reaction(End::Start).expect("a clamped end");
    println!("force of the wall {:.3} pN", wall.force_pn.x);
    // All numbers of `summary.json`; notes say what to distrust.
    let summary = solution.summary();
    println!(
        "{} monomers, {} segments, {} notes",
        summary.counts.monomers,
        summary.counts.segments,
        summary.notes.len()
    );
    Ok(())
}
