//! Printed report of a finished run.

use actin_sim::{Note, StabilitySummary, Status, Summary};
use std::path::Path;

/// Largest number of further filaments with a printed tip displacement.
const MOST_TIPS: usize = 8;

/// Prints the report of a run, without the notes in `known`, which were printed before it.
pub(crate) fn print(summary: &Summary, known: &[Note], out: &Path) {
    let work = &summary.work;
    let stability = summary.stability.as_ref().map(stability_in_words);
    match (&stability, summary.time_step_ns) {
        (Some(stability), None) => println!(
            "equilibrium after {} Newton iterations and {} evaluations of the loads, {:.3} s: \
             {stability}",
            work.newton_iterations, work.force_evaluations, summary.wall_s
        ),
        _ => println!(
            "{} after {:.1} ns: {} steps, {} force evaluations, {:.1} s",
            in_words(summary.status),
            summary.time_ns.unwrap_or_default(),
            work.steps,
            work.force_evaluations,
            summary.wall_s
        ),
    }
    print_tips(summary);
    println!(
        "energy {:.6} pN nm (elastic {:.6}); residual {:.1e} pN, {:.1e} pN nm",
        summary.energy_pn_nm.total,
        summary.energy_pn_nm.elastic,
        summary.residual.force_pn,
        summary.residual.torque_pn_nm
    );
    print_remarks(summary, known);
    let ending = match (&stability, summary.time_step_ns) {
        (Some(stability), None) => format!("{stability}; "),
        (Some(stability), Some(_)) => format!("at rest, {stability}; "),
        (None, _) => String::new(),
    };
    println!("{ending}written to {}", out.display());
}

pub(crate) fn print_remarks(summary: &Summary, known: &[Note]) {
    if let Some(states) = &summary.states {
        println!("{states}");
    }
    for note in summary.coded_notes() {
        if !known.contains(&note) {
            println!("{note}");
        }
    }
    print_pushes(summary);
}

fn print_pushes(summary: &Summary) {
    for push in &summary.pushes {
        println!(
            "pushed off a saddle of {:.3} pN nm with {} negative eigenvalue(s) at {:.2} ns, by {:.1e} nm \
             and {:.1e} rad at most",
            push.energy_pn_nm,
            push.negative_eigenvalues,
            push.time_ns,
            push.displacement_nm,
            push.turn_rad
        );
    }
}

/// Prints the tip displacements of the first filaments.
fn print_tips(summary: &Summary) {
    let [x, y, z] = summary.tip_displacement_nm;
    println!("tip displacement ({x:.4}, {y:.4}, {z:.4}) nm");
    let others = summary.filaments.iter().enumerate().skip(1);
    for (i, filament) in others.take(MOST_TIPS) {
        let [x, y, z] = filament.tip_displacement_nm;
        println!("  of filament {i} ({x:.4}, {y:.4}, {z:.4}) nm");
    }
    let rest = summary.filaments.len().saturating_sub(1 + MOST_TIPS);
    if rest > 0 {
        println!("  and of {rest} more filaments in summary.json");
    }
}

pub(crate) fn in_words(status: Status) -> &'static str {
    match status {
        Status::Converged => "stop rule met",
        Status::Completed => "end time reached",
        Status::Failed => "failed",
        Status::Interrupted => "interrupted",
    }
}

fn stability_in_words(stability: &StabilitySummary) -> String {
    match (
        stability.negative_eigenvalues,
        stability.unresolved_eigenvalues,
    ) {
        (0, 0) => "stable".into(),
        (0, 1) => "stable up to 1 neutral mode".into(),
        (0, modes) => format!("stable up to {modes} neutral modes"),
        (negative, _) => format!("a SADDLE, with {negative} negative eigenvalue(s)"),
    }
}
