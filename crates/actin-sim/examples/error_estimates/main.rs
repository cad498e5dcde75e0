//! Estimated errors beside true ones: scenes of the trade study and others in several resolutions, each against the
//! same filament with every monomer resolved; then resolutions that are chosen for a wanted error, beside the fewest
//! monomers that meet it, found by search; and what the segments of rods leave, of one length and graded.
//!
//! `cargo run --release -p actin-sim --example error_estimates [name of a case]`
//!
//! Errors in per cent of the value with every monomer. Times are over that of the equilibrium of all monomers. The
//! column `time` is that of the estimate; of a resolution that is chosen, of choosing it and of its equilibrium. The
//! column `alone` is that of its equilibrium without choosing: what those pay who keep the chosen sections. Each is the
//! least of at least three runs, and of as many as take 20 ms.

mod cases;
mod lengths;
mod search;

use actin_sim::adapt::{Chosen, RodStretch, estimate};
use actin_sim::{Adaptive, Assembly, Plan, Quantity, RodLaw, Scene, Section, Want};
use cases::{Case, cases};
use search::fewest;
use std::time::Instant;

/// Runs of which the fastest is timed: at least so many,
const FEWEST_RUNS: u32 = 3;
/// and until so much time has passed (s).
const LEAST_TIME_S: f64 = 0.02;

/// A case of seven minutes, run by its name alone.
const BY_NAME: &str = "height, buckled, 1600 nm";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let wanted = std::env::args().nth(1);
    let (mut searched, mut lengths) = (Vec::new(), Vec::new());
    println!(
        "Times over that of all monomers; time: of the estimate, or of choosing and the equilibrium;"
    );
    println!("alone: of the equilibrium of the chosen sections.\n");
    println!(
        "| case | resolution | true | estimated | law | segments | junctions | walls | sites | time | alone |"
    );
    println!("|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|");
    for case in cases()?.into_iter().filter(|c| match &wanted {
        Some(wanted) => wanted == c.name,
        None => c.name != BY_NAME,
    }) {
        let length = case.length_nm();
        let (fine, seconds) = timed(|| solved(&case.scene))?;
        let truth = case.value(&fine);
        for law in [RodLaw::Homogenised, RodLaw::Fitted, RodLaw::Constant] {
            compare(&case, (&law, &[]), length, (truth, seconds))?;
        }
        for stretches in &case.stretches {
            compare(
                &case,
                (&RodLaw::Homogenised, stretches),
                length,
                (truth, seconds),
            )?;
        }
        for error in [0.05, 0.02, 0.01] {
            let chosen = choose(&case, (error, None), length, (truth, seconds))?;
            searched.push(compared(&case, error, &chosen, truth)?);
        }
        for most in [26, 104] {
            choose(&case, (0.001, Some(most)), length, (truth, seconds))?;
        }
        lengths.extend(lengths::rows(&case)?);
    }
    print_tables(&searched, &lengths);
    Ok(())
}

/// Monomers beside the fewest, and segments.
fn print_tables(searched: &[String], lengths: &[String]) {
    println!("\n| case | wanted | chosen, monomers | fewest by search |");
    println!("|---|---:|---:|---|");
    for row in searched {
        println!("{row}");
    }
    println!("\n| case | segments | number | true | estimated |");
    println!("|---|---|---:|---:|---:|");
    for row in lengths {
        println!("{row}");
    }
}

/// One row: the monomers that were chosen for an error, and the fewest with which a filament meets it.
fn compared(
    case: &Case,
    error: f64,
    chosen: &Chosen,
    truth: f64,
) -> Result<String, Box<dyn std::error::Error>> {
    let best = fewest(case, error, truth)?;
    let best = best.map_or_else(
        || "none but all".to_owned(),
        |found| format!("{}: {}", found.monomers, words(&found.stretches)),
    );
    Ok(format!(
        "| {} | {} % | {} | {best} |",
        case.name,
        100.0 * error,
        chosen.monomers
    ))
}

/// One row: a resolution, its true and its estimated error.
fn compare(
    case: &Case,
    (law, stretches): (&RodLaw, &[[f64; 2]]),
    length: f64,
    (truth, seconds): (f64, f64),
) -> Result<(), Box<dyn std::error::Error>> {
    let mut scene = case.scene.clone();
    scene.filament.sections = sections(length, stretches).into();
    scene.filament.rod.law = law.clone();
    let assembly = solved(&scene)?;
    let (found, took) = timed(|| Ok(estimate(&assembly, assembly.system.state(), case.quantity)?))?;
    let took = took / seconds;
    let percent = |part: f64| format!("{:.2}", 100.0 * part / truth);
    println!(
        "| {} | {}, `{law:?}` | {} | {} | {} | {} | {} | {} | {} | {took:.2} | |",
        case.name,
        words(stretches),
        percent(truth - found.value),
        percent(found.error),
        percent(found.law),
        percent(found.segments),
        percent(found.junctions),
        percent(found.walls),
        percent(found.sites),
    );
    Ok(())
}

/// One row: the resolution that is chosen for an error, and what it is off by.
fn choose(
    case: &Case,
    (error, monomers): (f64, Option<usize>),
    length: f64,
    (truth, seconds): (f64, f64),
) -> Result<Chosen, Box<dyn std::error::Error>> {
    let want = match case.quantity {
        Quantity::Tip => Want::Tip { error },
        Quantity::Height => Want::Height { error },
        Quantity::EndForce => Want::EndForce { error },
        Quantity::EndCouple => Want::EndCouple { error },
        Quantity::Energy => Want::Energy { error },
        Quantity::LinkerForce { linker } => Want::LinkerForce { linker, error },
        Quantity::Curvature { at_nm } => Want::Curvature { at_nm, error },
    };
    let mut scene = case.scene.clone();
    scene.filament.sections = Adaptive {
        length_nm: length,
        want,
        monomers,
    }
    .into();
    let (assembly, choosing) = timed(|| Ok(Assembly::build(&scene)?))?;
    let chosen = assembly.chosen.clone().ok_or("nothing was chosen")?;
    let (assembly, alone) = timed(|| solved(&assembly.scene))?;
    let off = 100.0 * (truth - case.value(&assembly)) / truth;
    let estimated = chosen.estimate.map_or(0.0, |e| 100.0 * e.error / truth);
    let stretches = chosen.monomers_nm.iter();
    let share = stretches.fold(0.0, |sum, [from, to]| sum + to - from);
    let limit = monomers.map_or_else(String::new, |most| format!(", {most} monomers"));
    println!(
        "| {} | **{} %{limit}**: {}, {:.0} % monomers, {}, {} tried | {off:.2} | {estimated:.2} | | | | | | {:.2} | {:.2} |",
        case.name,
        100.0 * error,
        words(&chosen.monomers_nm),
        100.0 * share / length,
        segments(&chosen),
        chosen.tried.len(),
        (choosing + alone) / seconds,
        alone / seconds,
    );
    Ok(chosen)
}

/// How long segments were chosen to be, and how many where they differ.
fn segments(chosen: &Chosen) -> String {
    let lengths = chosen.graded.iter().map(RodStretch::segment_nm);
    match lengths.reduce(f64::min) {
        None => format!("segments of {:.0} nm", chosen.segment_nm),
        Some(shortest) => {
            let count: usize = chosen.graded.iter().map(|rod| rod.segments).sum();
            let longest = chosen.segment_nm;
            format!("{count} segments of {shortest:.1} to {longest:.1} nm")
        }
    }
}

/// What is done, and the least time that it takes (s).
fn timed<T>(
    mut run: impl FnMut() -> Result<T, Box<dyn std::error::Error>>,
) -> Result<(T, f64), Box<dyn std::error::Error>> {
    let (mut least, mut sum, mut runs) = (f64::INFINITY, 0.0, 0);
    loop {
        let start = Instant::now();
        let done = run()?;
        let took = start.elapsed().as_secs_f64();
        (least, sum, runs) = (least.min(took), sum + took, runs + 1);
        if runs >= FEWEST_RUNS && sum >= LEAST_TIME_S {
            return Ok((done, least));
        }
    }
}

fn solved(scene: &Scene) -> Result<Assembly, Box<dyn std::error::Error>> {
    let mut assembly = Assembly::build(scene)?;
    let (trajectory, _) = Plan::new(&assembly)?.run()?;
    let last = trajectory.records.last().ok_or("no record")?;
    *assembly.system.state_mut() = last.state.clone();
    Ok(assembly)
}

/// Monomers in these stretches, the rest rods of 10 nm segments.
fn sections(length: f64, stretches: &[[f64; 2]]) -> Vec<Section> {
    let mut all = Vec::new();
    let mut at = 0.0;
    for &[from_nm, to_nm] in stretches.iter().chain(&[[length, length]]) {
        if from_nm > at {
            all.push(Section::rod(at, from_nm, None));
        }
        if to_nm > from_nm {
            all.push(Section::Ellipsoids {
                from_nm,
                to_nm,
                altered: None,
            });
        }
        at = to_nm;
    }
    all
}

fn words(stretches: &[[f64; 2]]) -> String {
    let one = |[from, to]: &[f64; 2]| format!("{from:.0} to {to:.0} nm");
    match stretches {
        [] => "rod".to_owned(),
        all => all.iter().map(one).collect::<Vec<_>>().join(", "),
    }
}
