//! `actin run`: a scene to its end, and everything it gave into a run directory.

use crate::failure::{Failure, Opened};
use crate::progress::Progress;
use actin_sim::{RunDirectory, RunDirectoryError, RunError, RunStatus, StabilitySummary, Summary};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Runs the scene at `path` into `out`.
pub(crate) fn run(path: &Path, out: Option<PathBuf>, overwrite: bool) -> Result<(), Failure> {
    let mut opened = Opened::open(path)?;
    actin_sim::estimate(&opened.assembly).map_err(|problem| opened.refuse(&problem))?;
    let out = out.unwrap_or_else(|| Path::new("runs").join(path.file_stem().unwrap_or_default()));
    let unusable = |error: RunDirectoryError| match error {
        RunDirectoryError::NotFinite { .. } => Failure::Numerical(error.to_string()),
        _ => Failure::Input(error.to_string()),
    };
    let directory = RunDirectory::create(&out, overwrite).map_err(unusable)?;
    directory
        .write_scene(&opened.assembly.scene)
        .map_err(unusable)?;

    let progress = Progress::new();
    let started = Instant::now();
    let outcome = actin_sim::run(&mut opened.assembly, &mut |at| {
        progress.show(&at, at.steps as f64 / started.elapsed().as_secs_f64());
        ControlFlow::Continue(())
    });
    progress.finish();
    let (trajectory, report) = outcome.map_err(|error| broken(&opened, &directory, error))?;
    let summary = directory
        .write(&opened.assembly, &trajectory, &report)
        .map_err(unusable)?;
    print(&summary, &out);
    Ok(())
}

/// Keeps what a broken run has recorded, and says why it broke.
fn broken(opened: &Opened, directory: &RunDirectory, error: RunError) -> Failure {
    let (why, trajectory, report) = match error {
        RunError::Refused(problem) => return opened.refuse(&problem),
        RunError::Ended {
            place,
            failure,
            trajectory,
            report,
        } => (format!("{place}{failure}"), trajectory, report),
        RunError::Failed {
            failure,
            body,
            trajectory,
            report,
        } => {
            let why = format!("{failure}; {} is {body}", failure.body);
            (why, trajectory, report)
        }
    };
    if trajectory.records.is_empty() {
        return Failure::Numerical(why);
    }
    match directory.write(&opened.assembly, &trajectory, &report) {
        Ok(_) => Failure::Numerical(format!(
            "{why}; everything up to the last good state is in {}",
            directory.path().display()
        )),
        Err(unwritten) => Failure::Numerical(format!("{why}; and {unwritten}")),
    }
}

fn print(summary: &Summary, out: &Path) {
    let work = &summary.work;
    match &summary.stability {
        Some(stability) => println!(
            "equilibrium after {} Newton iterations and {} evaluations of the loads, {:.3} s: {}",
            work.newton_iterations,
            work.force_evaluations,
            summary.wall_s,
            stability_in_words(stability)
        ),
        None => println!(
            "{} after {:.1} ns: {} steps, {} force evaluations, {:.1} s",
            match summary.status {
                RunStatus::Converged => "stop rule met",
                RunStatus::Completed => "time is up",
                RunStatus::Failed => "broken off",
            },
            summary.time_ns,
            work.steps,
            work.force_evaluations,
            summary.wall_s
        ),
    }
    print_tips(summary);
    println!(
        "energy {:.6} pN nm, of it elastic {:.6}; residual {:.1e} pN, {:.1e} pN nm",
        summary.energy_pn_nm.total,
        summary.energy_pn_nm.elastic,
        summary.residual.force_pn,
        summary.residual.torque_pn_nm
    );
    print_beyond(summary);
    println!("written to {}", out.display());
}

fn print_tips(summary: &Summary) {
    let [x, y, z] = summary.tip_displacement_nm;
    println!("tip displacement ({x:.4}, {y:.4}, {z:.4}) nm");
    for (i, filament) in summary.filaments.iter().enumerate().skip(1) {
        let [x, y, z] = filament.tip_displacement_nm;
        println!("  of filament {i} ({x:.4}, {y:.4}, {z:.4}) nm");
    }
}

fn print_beyond(summary: &Summary) {
    for beyond in &summary.beyond_range {
        let of = match beyond.filament {
            0 => String::new(),
            filament => format!(" of filament {filament}"),
        };
        println!(
            "beyond the data of its law: {} {:.4} rad/nm at s = {:.1} nm{of}, data reach {:.4}",
            beyond.quantity, beyond.value_per_nm, beyond.s_nm, beyond.range_per_nm
        );
    }
}

fn stability_in_words(stability: &StabilitySummary) -> String {
    match (
        stability.negative_eigenvalues,
        stability.unresolved_eigenvalues,
    ) {
        (0, 0) => "stable".into(),
        (0, modes) => format!("stable but for {modes} neutral mode(s)"),
        (negative, _) => format!("a SADDLE, with {negative} negative eigenvalue(s)"),
    }
}
