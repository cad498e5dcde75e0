//! Everything that a rod law is fitted to, measured on the monomers and written as CSV.
//!
//! `cargo run --release -p actin-paper --example measure_rod_law -- FOLDER [SAMPLINGS] [KIND...]`
//!
//! Kinds: bend, tip, twist, stretch, turn, shear, pulled-twist, helix, pulled-bend; all by default.
//! Columns carry their units; `mean`, `sd` and `se` are over samplings of the bonds and azimuths,
//! `n` counts values, `doubtful` those whose equilibrium is not certified as stable.

use actin_paper::measure::{
    Curve, Evidence, MeasureError, SampleStatistics, Specimen, bend_by_couples, bend_by_tip_force,
    bend_twisted, bend_under_tension, free_turn_under_tension, over_samplings,
    over_samplings_and_azimuths, sampled_by, shear_by_force, stretch_by_force, twist,
    twist_under_tension,
};
use actin_sim::Monomers;
use std::error::Error;
use std::fmt::Write as _;
use std::path::PathBuf;

const KINDS: [&str; 9] = [
    "bend",
    "tip",
    "twist",
    "stretch",
    "turn",
    "shear",
    "pulled-twist",
    "helix",
    "pulled-bend",
];
/// Azimuths at which transverse loads act (deg).
const AZIMUTHS: [f64; 4] = [0.0, 90.0, 180.0, 270.0];

type Outcome = Result<(), Box<dyn Error>>;

fn main() -> Outcome {
    let mut arguments = std::env::args().skip(1);
    let folder = PathBuf::from(arguments.next().ok_or("which folder?")?);
    let samplings = arguments.next().map_or(Ok(8), |n| n.parse())?;
    let mut kinds: Vec<String> = arguments.collect();
    if kinds.is_empty() {
        kinds = KINDS.map(String::from).to_vec();
    }
    std::fs::create_dir_all(&folder)?;
    let seeds: Vec<u64> = (0..samplings).collect();
    for kind in kinds {
        let start = std::time::Instant::now();
        let table = measure(&kind, &seeds)?;
        std::fs::write(folder.join(format!("{kind}.csv")), table.text)?;
        let (n, seconds) = (table.rows, start.elapsed().as_secs_f64());
        println!(
            "{kind}: {n} rows in {seconds:.0} s; {} not reached",
            table.unreached
        );
    }
    Ok(())
}

fn measure(kind: &str, seeds: &[u64]) -> Result<Table, Box<dyn Error>> {
    Ok(match kind {
        "bend" => bend(seeds)?,
        "tip" => tip(seeds)?,
        "twist" => twisted(seeds)?,
        "stretch" => stretch(seeds)?,
        "turn" => turn(seeds)?,
        "shear" => shear(seeds)?,
        "pulled-twist" => pulled_twist(seeds)?,
        "helix" => helix(seeds)?,
        "pulled-bend" => pulled_bend(seeds)?,
        other => return Err(format!("{other}: none of {KINDS:?}").into()),
    })
}

/// Rows of a CSV file.
struct Table {
    text: String,
    rows: usize,
    unreached: usize,
}

impl Table {
    fn new(columns: &str) -> Self {
        let text = format!("{columns},n,doubtful\n");
        Self {
            text,
            rows: 0,
            unreached: 0,
        }
    }

    /// One row for each value of `prescribed`: `fixed`, the value, and mean, sd and se of each of
    /// `columns`.
    fn add<P>(
        &mut self,
        fixed: &[f64],
        curves: &[Curve<P>],
        prescribed: impl Fn(&P) -> f64,
        columns: &[&dyn Fn(&P) -> f64],
        evidence: impl Fn(&P) -> Evidence,
    ) {
        let doubt = |p: &P| f64::from(u8::from(!evidence(p).is_stable()));
        let doubts = sampled_by(curves, &prescribed, doubt);
        let columns: Vec<Vec<(f64, SampleStatistics)>> = columns
            .iter()
            .map(|column| sampled_by(curves, &prescribed, column))
            .collect();
        for (row, (value, doubt)) in doubts.iter().enumerate() {
            for x in fixed.iter().chain([value]) {
                let _ = write!(self.text, "{x:.8e},");
            }
            for column in &columns {
                let s = column[row].1;
                let _ = write!(
                    self.text,
                    "{:.8e},{:.4e},{:.4e},",
                    s.mean, s.deviation, s.error
                );
            }
            let doubtful = doubt.mean * doubt.count as f64;
            let _ = writeln!(self.text, "{},{doubtful:.0}", doubt.count);
            self.rows += 1;
        }
        for missing in curves.iter().flat_map(|curve| &curve.unreached) {
            eprintln!("{fixed:?}, {}: {}", missing.value, missing.reason);
            self.unreached += 1;
        }
    }
}

fn filament(rises: f64) -> Specimen {
    let monomers = Monomers::default();
    Specimen::ellipsoids(rises * monomers.rise_nm, monomers)
}

/// All samplings at all azimuths.
fn around<P: Send>(
    specimen: &Specimen,
    seeds: &[u64],
    measure: impl Fn(&Specimen, f64) -> Result<Curve<P>, MeasureError> + Sync,
) -> Result<Vec<Curve<P>>, MeasureError> {
    over_samplings_and_azimuths(specimen, seeds, &AZIMUTHS, measure)
}

fn bend(seeds: &[u64]) -> Result<Table, MeasureError> {
    let curvatures = [
        1e-4, 3e-4, 6e-4, 1e-3, 1.5e-3, 2e-3, 3e-3, 4e-3, 5e-3, 6.5e-3, 8e-3, 1e-2, 1.25e-2,
        1.5e-2, 1.75e-2, 2e-2, 2.5e-2, 3e-2,
    ];
    let mut table =
        Table::new("rises,curvature_rad_per_nm,rigidity_pn_nm2_mean,sd,se,cross_pn_nm_mean,sd,se");
    for rises in [27.0, 55.0] {
        let curves = around(&filament(rises), seeds, |s, a| {
            bend_by_couples(s, &curvatures, a)
        })?;
        table.add(
            &[rises],
            &curves,
            |p| p.curvature_rad_per_nm,
            &[&|p| p.rigidity_pn_nm2, &|p| p.cross_couple_pn_nm],
            |p| p.evidence,
        );
    }
    Ok(table)
}

fn tip(seeds: &[u64]) -> Result<Table, MeasureError> {
    let forces = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 3.0, 5.0];
    let specimen = Specimen::ellipsoids(160.0, Monomers::default());
    let curves = around(&specimen, seeds, |s, a| bend_by_tip_force(s, &forces, a))?;
    let mut table = Table::new("length_nm,force_pn,deflection_nm_mean,sd,se");
    table.add(
        &[curves[0].length_nm],
        &curves,
        |p| p.force_pn,
        &[&|p| p.deflection_nm],
        |p| p.evidence,
    );
    Ok(table)
}

fn twisted(seeds: &[u64]) -> Result<Table, MeasureError> {
    let mut table = Table::new(
        "rises,turn_deg,curvature_rad_per_nm,sd,se,rigidity_pn_nm2_mean,sd,se,length_change_mean,sd,se",
    );
    for rises in [27.0, 55.0] {
        let degrees = (1..=26).map(|i| 10.0 * f64::from(i) * rises / 27.0);
        let turns: Vec<f64> = degrees.flat_map(|turn| [-turn, turn]).collect();
        let curves = over_samplings(&filament(rises), seeds, |s| twist(s, &turns))?;
        table.add(
            &[rises],
            &curves,
            |p| p.turn_deg,
            &[&|p| p.curvature_rad_per_nm, &|p| p.rigidity_pn_nm2, &|p| {
                p.relative_length_change
            }],
            |p| p.evidence,
        );
    }
    Ok(table)
}

fn stretch(seeds: &[u64]) -> Result<Table, MeasureError> {
    let mut forces = vec![0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0, 200.0, 350.0, 500.0];
    forces.extend([
        -0.1, -0.3, -1.0, -3.0, -10.0, -20.0, -30.0, -50.0, -75.0, -100.0, -150.0, -200.0,
    ]);
    let mut table = Table::new(
        "rises,force_pn,strain_mean,sd,se,rigidity_pn_mean,sd,se,couple_pn_nm_mean,sd,se",
    );
    for rises in [14.0, 27.0] {
        let curves = over_samplings(&filament(rises), seeds, |s| stretch_by_force(s, &forces))?;
        table.add(
            &[rises],
            &curves,
            |p| p.force_pn,
            &[&|p| p.strain, &|p| p.rigidity_pn, &|p| p.torque_pn_nm],
            |p| p.evidence,
        );
    }
    Ok(table)
}

fn turn(seeds: &[u64]) -> Result<Table, MeasureError> {
    let forces = [
        0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0, 200.0, 500.0, -0.1, -1.0, -10.0, -30.0,
    ];
    let mut table = Table::new("rises,force_pn,twist_rad_per_nm_mean,sd,se,strain_mean,sd,se");
    for rises in [27.0, 55.0] {
        let curves = over_samplings(&filament(rises), seeds, |s| {
            free_turn_under_tension(s, &forces)
        })?;
        table.add(
            &[rises],
            &curves,
            |p| p.force_pn,
            &[&|p| p.twist.curvature_rad_per_nm, &|p| {
                p.twist.relative_length_change
            }],
            |p| p.twist.evidence,
        );
    }
    Ok(table)
}

fn shear(seeds: &[u64]) -> Result<Table, MeasureError> {
    let forces = [1e-3, 3e-3, 1e-2, 3e-2, 0.1, 0.3, 1.0, 3.0];
    let mut table = Table::new("rises,length_nm,force_pn,shear_mean,sd,se");
    for rises in [11.0, 22.0, 27.0, 55.0, 110.0] {
        let curves = around(&filament(rises), seeds, |s, a| {
            shear_by_force(s, &forces, a)
        })?;
        table.add(
            &[rises, curves[0].length_nm],
            &curves,
            |p| p.force_pn,
            &[&|p| p.shear],
            |p| p.evidence,
        );
    }
    Ok(table)
}

fn pulled_twist(seeds: &[u64]) -> Result<Table, MeasureError> {
    let degrees = [10.0, 20.0, 40.0, 60.0, 80.0, 120.0, 160.0, 200.0];
    let turns: Vec<f64> = degrees.iter().flat_map(|&turn| [-turn, turn]).collect();
    let mut table = Table::new(
        "force_pn,turn_deg,curvature_rad_per_nm,sd,se,couple_pn_nm_mean,sd,se,strain_mean,sd,se",
    );
    for force in [-20.0, 0.0, 10.0, 50.0, 200.0] {
        let curves = over_samplings(&filament(27.0), seeds, |s| {
            twist_under_tension(s, force, &turns)
        })?;
        table.add(
            &[force],
            &curves,
            |p| p.twist.turn_deg,
            &[
                &|p| p.twist.curvature_rad_per_nm,
                &|p| p.twist.torque_pn_nm,
                &|p| p.twist.relative_length_change,
            ],
            |p| p.twist.evidence,
        );
    }
    Ok(table)
}

fn helix(seeds: &[u64]) -> Result<Table, MeasureError> {
    let mut table = Table::new(
        "twist_rad_per_nm,tilt_rad_per_nm,curvature_rad_per_nm_mean,sd,se,rigidity_pn_nm2_mean,sd,se,twisting_couple_pn_nm_mean,sd,se,helix_twist_rad_per_nm_mean,sd,se",
    );
    for twist in [-0.04, -0.02, -0.01, -0.005, 0.0, 0.005, 0.01, 0.02, 0.04] {
        let curves = around(&filament(27.0), seeds, |s, a| {
            bend_twisted(s, twist, &[1e-3, 3e-3, 1e-2], a)
        })?;
        table.add(
            &[twist],
            &curves,
            |p| p.tilt_rad_per_nm,
            &[
                &|p| p.curvature_rad_per_nm,
                &|p| p.rigidity_pn_nm2,
                &|p| p.twisting_couple_pn_nm,
                &|p| p.helix_twist_rad_per_nm,
            ],
            |p| p.evidence,
        );
    }
    Ok(table)
}

fn pulled_bend(seeds: &[u64]) -> Result<Table, MeasureError> {
    let mut table = Table::new(
        "force_pn,curvature_rad_per_nm,couple_pn_nm_mean,sd,se,rigidity_pn_nm2_mean,sd,se",
    );
    for force in [-10.0, 0.0, 1.0, 3.0, 10.0, 30.0, 100.0] {
        let curves = around(&filament(27.0), seeds, |s, a| {
            bend_under_tension(s, force, &[1e-3, 1e-2], a)
        })?;
        table.add(
            &[force],
            &curves,
            |p| p.curvature_rad_per_nm,
            &[&|p| p.couple_pn_nm, &|p| p.rigidity_pn_nm2],
            |p| p.evidence,
        );
    }
    Ok(table)
}
