//! Five bond samples at each of two forces, tabulated.

use actin_sweep::sim::SimError;
use actin_sweep::{Settings, Sweep, SweepDirectory, ValidatedSweep};

/// A monomer filament with sampled bonds and a transverse tip force.
const SCENE: &str = "Scene(
    filament: Filament(
        sections: [Ellipsoids(from_nm: 0.0, to_nm: 40.0)],
        monomers: Monomers(anchors: Independent),
    ),
    clamps: [Clamp(end: Start)],
    loads: [EndForce(end: End, force_pn: (1.0, 0.0, 0.0))],
    task: Equilibrium(),
)";

/// Five filaments at each of two forces.
const SWEEP: &str = "Sweep(
    scene: \"scene.ron\",
    vary: [List(key: \"loads[0].force_pn[0]\", values: [1.0, 2.0])],
    samples: Samples(number: 5),
    results: [\"tip_displacement_nm[0]\"],
)";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let sweep = Sweep::from_ron(SWEEP).map_err(SimError::from)?;
    let opened = ValidatedSweep::new(sweep, SCENE.into())?;
    let folder = std::env::temp_dir().join(format!("actin-sweep-{}", std::process::id()));
    let directory = SweepDirectory::create(&folder, &opened, false)?;
    let ended = directory.run_all(&opened, &Settings::default(), &|_| ())?;
    assert_eq!((ended.ended, ended.failed), (10, 0));
    let table = std::fs::read_to_string(folder.join("table.csv"))?;
    println!("{table}");
    let tip = |row: usize| -> f64 {
        let line = table.lines().nth(row).expect("a row for each point");
        let cell = line.split(',').nth(4).expect("the mean");
        cell.parse().expect("a number")
    };
    // The filament stiffens: twice the force gives less than twice the displacement.
    assert!(tip(2) > tip(1) && tip(2) < 2.0 * tip(1));
    std::fs::remove_dir_all(folder)?;
    Ok(())
}
