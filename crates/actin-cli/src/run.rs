//! `actin run`: a scene to its end, and everything it gave into a run directory.

use crate::RunArguments;
use crate::failure::{Failure, Opened};
use crate::progress::Progress;
use crate::signals;
use actin_sim::{
    Checkpoints, Estimate, Kept, RunDirectory, RunDirectoryError, RunError, RunLock, RunReport,
    RunStatus, StabilitySummary, Summary, Trajectory,
};
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Instant;

/// Runs a scene, or what is left of it, into its directory.
pub(crate) fn run(arguments: &RunArguments) -> Result<(), Failure> {
    let path = &arguments.scene;
    let mut opened = Opened::open(path)?;
    let estimate =
        actin_sim::estimate(&opened.assembly).map_err(|problem| opened.refuse(&problem))?;
    for note in estimate
        .iter()
        .flat_map(|e| e.notes(&opened.assembly.scene.task))
    {
        println!("note: {note}");
    }
    let by_default = || Path::new("runs").join(path.file_stem().unwrap_or_default());
    let out = arguments.out.clone().unwrap_or_else(by_default);
    let directory = RunDirectory::existing(&out);
    let mut checkpoints = checkpoints(arguments, &mut opened, estimate.as_ref(), &directory)?;
    // Before the lock: where nothing will be written, none is needed.
    if arguments.resume && is_finished(&opened, &directory)? {
        return Ok(());
    }
    // Held to the end of the run.
    let _lock = claim(arguments, &out)?;
    let kept = match begin(arguments, &opened, &directory, &mut checkpoints)? {
        Beginning::New => None,
        Beginning::Kept(kept) => Some(*kept),
        Beginning::Finished => return Ok(()),
    };
    let (trajectory, report) = advance(&mut opened, kept, &mut checkpoints, &directory)?;
    if report.interrupted {
        return Err(left(
            arguments,
            &opened,
            &directory,
            &checkpoints,
            (&trajectory, &report),
        ));
    }
    let summary = directory
        .write(&opened.assembly, &trajectory, &report)
        .map_err(|error| hint(&out, error))?;
    directory.remove_checkpoint()?;
    print(&summary, &out);
    Ok(())
}

/// Makes or opens the run directory; what keeps other runs out of it.
fn claim(arguments: &RunArguments, out: &Path) -> Result<Option<RunLock>, Failure> {
    if !arguments.resume {
        let claimed = RunDirectory::create_locked(out, arguments.overwrite);
        let (_, lock) = claimed.map_err(|error| hint(out, error))?;
        return Ok(Some(lock));
    }
    // Where there is no directory there is nothing to resume, and nobody to keep out.
    Ok(out.is_dir().then(|| RunLock::take(out)).transpose()?)
}

/// What there is to begin with.
enum Beginning {
    /// A new run.
    New,
    /// One that was kept.
    Kept(Box<Kept>),
    /// One that is finished, which has been said.
    Finished,
}

fn begin(
    arguments: &RunArguments,
    opened: &Opened,
    directory: &RunDirectory,
    checkpoints: &mut Checkpoints,
) -> Result<Beginning, Failure> {
    if !arguments.resume {
        directory.write_scene(&opened.assembly.scene)?;
        return Ok(Beginning::New);
    }
    // Again, now that nobody else writes.
    if is_finished(opened, directory)? {
        return Ok(Beginning::Finished);
    }
    Ok(Beginning::Kept(Box::new(checkpoints.resume()?)))
}

fn checkpoints(
    arguments: &RunArguments,
    opened: &mut Opened,
    estimate: Option<&Estimate>,
    directory: &RunDirectory,
) -> Result<Checkpoints, Failure> {
    let interrupted = signals::interruption()
        .map_err(|error| Failure::Input(format!("signals cannot be listened to: {error}")))?;
    Ok(Checkpoints::new(
        directory,
        &mut opened.assembly,
        estimate,
        arguments.checkpoint_every,
        interrupted,
        |error| eprintln!("warning: no checkpoint: {error}; the run goes on"),
    ))
}

/// Whether the run has ended and its checkpoint is gone, which is said.
fn is_finished(opened: &Opened, directory: &RunDirectory) -> Result<bool, Failure> {
    if directory.has_checkpoint() {
        return Ok(false);
    }
    let Some(status) = directory.ending(&opened.assembly)? else {
        return Ok(false);
    };
    let place = directory.path().display();
    println!(
        "{place} is finished ({}): nothing to resume",
        in_words(status)
    );
    Ok(true)
}

/// An error of the directory; where it keeps a checkpoint, what can be done with that.
fn hint(out: &Path, error: RunDirectoryError) -> Failure {
    let is_free = !matches!(
        error,
        RunDirectoryError::InUse { .. } | RunDirectoryError::ForeignLock { .. }
    );
    let failure = Failure::from(error);
    match failure {
        Failure::Input(message) if is_free && RunDirectory::existing(out).has_checkpoint() => {
            Failure::Input(format!(
                "{message}; it keeps a checkpoint, from which --resume goes on"
            ))
        }
        failure => failure,
    }
}

/// The run itself.
fn advance(
    opened: &mut Opened,
    kept: Option<Kept>,
    checkpoints: &mut Checkpoints,
    directory: &RunDirectory,
) -> Result<(Trajectory, RunReport), Failure> {
    let progress = Progress::new();
    let started = Instant::now();
    let mut first = None;
    let outcome = actin_sim::run_kept(&mut opened.assembly, kept, checkpoints, &mut |at| {
        let made = at.steps - *first.get_or_insert(at.steps);
        progress.show(&at, made as f64 / started.elapsed().as_secs_f64());
        ControlFlow::Continue(())
    });
    progress.finish();
    outcome.map_err(|error| broken(opened, directory, error))
}

/// Writes what an interrupted run has recorded, and says how to go on.
fn left(
    arguments: &RunArguments,
    opened: &Opened,
    directory: &RunDirectory,
    checkpoints: &Checkpoints,
    (trajectory, report): (&Trajectory, &RunReport),
) -> Failure {
    let place = directory.path().display();
    let mut message = if !checkpoints.last_failed() {
        format!("a checkpoint is in {place}")
    } else if directory.has_checkpoint() {
        format!("{place} keeps the last checkpoint that could be written")
    } else {
        format!("no checkpoint could be written to {place}")
    };
    if !trajectory.records.is_empty() {
        match directory.write(&opened.assembly, trajectory, report) {
            Ok(_) => message += ", with everything recorded so far",
            Err(error) => message = format!("{message}, but {error}"),
        }
    }
    if directory.has_checkpoint() {
        let scene = arguments.scene.display();
        message = format!("{message}; to go on: actin run {scene} --out {place} --resume");
    }
    Failure::Interrupted(message)
}

/// Keeps what a broken run has recorded, and says why it broke.
fn broken(opened: &Opened, directory: &RunDirectory, error: RunError) -> Failure {
    let (why, kept, trajectory, report) = match error {
        RunError::Refused(problem) => return opened.refuse(&problem),
        RunError::Ended {
            place,
            failure,
            trajectory,
            report,
        } => (format!("{place}{failure}"), GOOD, trajectory, report),
        RunError::Lost {
            problem,
            trajectory,
            report,
        } => {
            let kept = "the equilibria in which it is lost are";
            (opened.locate(&problem), kept, trajectory, report)
        }
        RunError::Failed {
            failure,
            body,
            trajectory,
            report,
        } => {
            let why = format!("{failure}; {} is {body}", failure.body);
            (why, GOOD, trajectory, report)
        }
    };
    if trajectory.records.is_empty() {
        return Failure::Numerical(why);
    }
    match directory.write(&opened.assembly, &trajectory, &report) {
        Ok(_) => Failure::Numerical(format!("{why}; {kept} in {}", directory.path().display())),
        Err(unwritten) => Failure::Numerical(format!("{why}; and {unwritten}")),
    }
}

/// What is kept of a run that broke off.
const GOOD: &str = "everything up to the last good state is";

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
            in_words(summary.status),
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

fn in_words(status: RunStatus) -> &'static str {
    match status {
        RunStatus::Converged => "stop rule met",
        RunStatus::Completed => "time is up",
        RunStatus::Failed => "broken off",
        RunStatus::Interrupted => "interrupted",
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
