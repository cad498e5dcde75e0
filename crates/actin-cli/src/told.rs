//! What is printed of a run that has ended.

use actin_sim::{StabilitySummary, Status, Summary, UnstableTwist};
use std::path::Path;

pub(crate) fn print(summary: &Summary, out: &Path) {
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
        "energy {:.6} pN nm, of it elastic {:.6}; residual {:.1e} pN, {:.1e} pN nm",
        summary.energy_pn_nm.total,
        summary.energy_pn_nm.elastic,
        summary.residual.force_pn,
        summary.residual.torque_pn_nm
    );
    if let Some(floor) = &summary.residual_floor {
        println!(
            "the tolerance is below round-off, which leaves some {:.1e} pN, {:.1e} pN nm of the residual",
            floor.force_pn, floor.torque_pn_nm
        );
    }
    print_remarks(summary);
    let ending = match (&stability, summary.time_step_ns) {
        (Some(stability), None) => format!("{stability}; "),
        (Some(stability), Some(_)) => format!("at rest, {stability}; "),
        (None, _) => String::new(),
    };
    println!("{ending}written to {}", out.display());
}

/// What to know beside the numbers, of a run that has failed as well.
pub(crate) fn print_remarks(summary: &Summary) {
    print_beyond(summary);
    print_other_states(summary);
    for unstable in &summary.unstable_twist {
        print_unstable_twist(unstable);
    }
    for note in &summary.notes {
        println!("note: {note}");
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
        let (quantity, value, range) = (&beyond.quantity, beyond.value, beyond.range);
        let place = format!("s = {:.1} nm{}", beyond.s_nm, of_filament(beyond.filament));
        let (unit, elements) = if beyond.is_strain() {
            ("", "segments")
        } else {
            (" rad/nm", "bending elements")
        };
        match beyond.fluctuations {
            None => println!(
                "beyond the data of its law: {quantity} {value:.4}{unit} at {place}, data reach \
                 {range:.4}"
            ),
            Some(often) => println!(
                "fluctuations beyond the data of a law: {quantity} in {} of the records and {} of \
                 all {elements}, at most {value:.4}{unit} at {place}, data reach {range:.4}",
                percent(often.share_of_records),
                percent(often.share_of_elements)
            ),
        }
    }
}

fn print_unstable_twist(unstable: &UnstableTwist) {
    let often = match unstable.share_of_records {
        1.0 => String::new(),
        share => format!(" in {} of the records", percent(share)),
    };
    let (what, sign) = if unstable.bound_pn < 0.0 {
        ("tension", -1.0)
    } else {
        ("compression", 1.0)
    };
    // To the digits shown, without the sign of a zero.
    let twist = (1e4 * unstable.twist_per_nm).round() / 1e4 + 0.0;
    println!(
        "twist is UNSTABLE{often}: {what} {:.2} pN at s = {:.1} nm{}, where the bound is {:.2} pN \
         (twist {twist:.4} rad/nm); a local instability: what follows depends on the number of segments",
        sign * unstable.compression_pn,
        unstable.s_nm,
        of_filament(unstable.filament),
        sign * unstable.bound_pn
    );
}

/// Which filament, where it is not the first.
fn of_filament(filament: usize) -> String {
    match filament {
        0 => String::new(),
        filament => format!(" of filament {filament}"),
    }
}

/// A share in per cent, to two digits.
fn percent(share: f64) -> String {
    match 100.0 * share {
        percent if percent >= 10.0 => format!("{percent:.0} %"),
        percent if percent >= 1.0 => format!("{percent:.1} %"),
        percent => format!("{percent:.1e} %"),
    }
}

fn print_other_states(summary: &Summary) {
    if let Some(states) = &summary.states {
        println!("{states}");
    } else if summary.saddles_left + summary.jumps > 0 {
        println!(
            "{} saddle(s) were left and {} sudden jump(s) made on the way: there are other stable states, \
             and this one may not be connected to the start; `states: 24` of the task looks for others",
            summary.saddles_left, summary.jumps
        );
    }
}

pub(crate) fn in_words(status: Status) -> &'static str {
    match status {
        Status::Converged => "stop rule met",
        Status::Completed => "time is up",
        Status::Failed => "broken off",
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
