//! Figures 8 and 10: a filament whose ends are turned against each other and pushed together.
//!
//! Every state is an equilibrium at the end of a path of turns and shifts, found and certified by
//! statics; one resolution is also moved there in time. A pull of 1e-3 pN at half the length
//! breaks the symmetry, so only what does not depend on its direction is compared.

mod balance;
mod case;
mod dynamics;
mod expected;
mod followed;
mod group;
mod lists;
mod outcome;
mod pictures;
mod plane;
mod resolved;
mod results;
mod rows;
mod starts;
mod tables;

use super::Run;
use super::progress::Progress;
use actin_draw::report::Artefact;
use actin_sim::Assembly;
use case::Case;
use dynamics::Motion;
use group::Figure;
use lists::Plan;
use outcome::Outcome;
use rayon::prelude::*;
use results::Results;
use std::time::Instant;

/// Figure 8: rods of constant rigidities.
pub(super) fn figure8(run: Run<'_>) -> Result<Artefact, String> {
    reproduce(&Plan::eight(run.quick), run)
}

/// Figure 10: rods with the published twist extensions.
pub(super) fn figure10(run: Run<'_>) -> Result<Artefact, String> {
    reproduce(&Plan::ten(run.quick), run)
}

/// One piece of work, and what comes out of it.
enum Job {
    Statics(Case),
    Dynamics(Case),
}

enum Done {
    Statics(Box<Outcome>),
    Dynamics(Box<Motion>),
}

/// Runs all cases, draws them and compares them.
fn reproduce(plan: &Plan, Run { out, progress, .. }: Run<'_>) -> Result<Artefact, String> {
    let started = Instant::now();
    let (results, motions) = compute(plan, progress);
    let mut rows = rows::rows(plan, &results);
    rows.extend(starts::rows(plan, &results));
    rows.extend(dynamics::rows(plan, &results, &motions));
    tables::write(plan, &results, out)?;
    let mut views = vec![pictures::view_in_space(plan, &results, out)?];
    if plan.moving && plan.figure == Figure::Ten {
        views.push(followed::view(out)?);
    }
    Ok(Artefact {
        id: plan.figure.id(),
        title: match plan.figure {
            Figure::Eight => "Twisted and pushed together: constant rigidities",
            Figure::Ten => "Twisted and pushed together: rods whose twist changes them",
        },
        settings: settings(plan, &results),
        rows,
        pictures: pictures::draw(plan, &results, out)?,
        views,
        wall_s: started.elapsed().as_secs_f64(),
    })
}

/// Runs the dynamics, which takes longest, and all equilibria.
fn compute(plan: &Plan, progress: &Progress) -> (Results, Vec<Motion>) {
    let moved = dynamics::cases(plan).into_iter().map(Job::Dynamics);
    let jobs: Vec<Job> = moved
        .chain(plan.cases().into_iter().map(Job::Statics))
        .collect();
    progress.expect(jobs.len());
    let done: Vec<Result<Done, String>> = jobs
        .par_iter()
        .with_max_len(1)
        .map(|job| {
            let done = match job {
                Job::Statics(case) => solve(case).map(|o| Done::Statics(Box::new(o))),
                Job::Dynamics(case) => dynamics::run(case).map(|m| Done::Dynamics(Box::new(m))),
            };
            progress.done();
            done
        })
        .collect();
    sort(done)
}

/// Finds the equilibrium of `case` along its path, or where loads without an energy come to rest.
///
/// # Errors
/// A scene that cannot be read or built, a path that ends early: in words, with the case.
fn solve(case: &Case) -> Result<Outcome, String> {
    if case.group.rods == group::Rods::PaperBalance {
        return balance::rest(case);
    }
    let fail = |error: &dyn std::fmt::Display| format!("{}: {error}", case.name());
    let mut assembly = Assembly::build(&case.scene()?).map_err(|e| fail(&e))?;
    outcome::outcome(case, &mut assembly)
}

fn sort(done: Vec<Result<Done, String>>) -> (Results, Vec<Motion>) {
    let mut results = Results {
        outcomes: Vec::with_capacity(done.len()),
        failures: Vec::new(),
    };
    let mut motions = Vec::new();
    for item in done {
        match item {
            Ok(Done::Statics(outcome)) => results.outcomes.push(*outcome),
            Ok(Done::Dynamics(motion)) => motions.push(*motion),
            Err(failure) => results.failures.push(failure),
        }
    }
    (results, motions)
}

/// How the cases were run, in words.
fn settings(plan: &Plan, results: &Results) -> String {
    let folder = match plan.figure {
        Figure::Eight => "figure-8",
        Figure::Ten => "figure-10",
    };
    format!(
        "Scene scenarios/{folder}/rod-140.ron and what follows from it: {} equilibria at the end \
         of paths, {} samplings of drawn bonds, seeds from 0, and the mean filament, which has none; \
         twist first unless named. Rods are 300 nm long; monomers alone 290 nm between the inner held ones, 300 nm where the clamp is Wall. A \
         pull of 1e-3 pN at half the length, towards a point 100 nm aside, breaks the symmetry.",
        results.outcomes.len(),
        plan.seeds,
    )
}
