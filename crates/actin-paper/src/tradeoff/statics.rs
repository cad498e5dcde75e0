//! Equilibria: the rows of a study.

use super::observe::{Errors, Observed};
use super::pareto;
use super::row::Row;
use super::solve::{self, Attempt, MotionCost, Solved};
use super::study::{Factor, Study};
use actin_sim::advice::{FilamentSetting, table};
use std::io::{self, Write as _};

/// A time is taken again until this much has been spent on it (s), and so often at most.
const TIMING: (f64, usize) = (0.2, 5);

/// All rows of a study, the reference first.
pub(super) fn rows(study: &Study) -> Result<Vec<Row>, String> {
    let attempts = solve::all(study);
    let found: Result<Vec<Solved>, String> = attempts[0].iter().cloned().collect();
    let reference = &found?;
    let reference_cost = solve::motion_cost(study, &study.settings[0].2)?;
    let reference_time = time(study, &study.settings[0].2).ok_or("no time of the reference")?;
    let reference_motion = solve::motion_seconds_per_ns(study, &study.settings[0].2)?;
    let drawn_motion = solve::drawn_motion_seconds_per_ns(study)?;
    let drawn: Result<Vec<Solved>, String> = solve::drawn(study).into_iter().collect();
    let scatter = scatter(&drawn?);
    let mut rows = Vec::new();
    for ((factor, name, setting), attempts) in study.settings.iter().zip(&attempts) {
        let pairs = told_pairs(name, attempts, reference);
        let of_pairs = |compare: fn(&Observed, &Observed) -> Errors| -> Vec<Errors> {
            let observed = pairs.iter().map(|(s, r)| (&s.observed, &r.observed));
            observed.map(|(s, r)| compare(s, r)).collect()
        };
        let cost = solve::motion_cost(study, setting)?;
        let time_s = time(study, setting);
        let motion_s = solve::motion_seconds_per_ns(study, setting);
        let motion_s = motion_s.inspect_err(|error| tell_failure(name, error)).ok();
        let row = described(study, *factor, name, setting);
        let row = counted(row, &pairs, &cost);
        rows.push(Row {
            cost_motion: Some(cost.counted_per_ns / reference_cost.counted_per_ns),
            time_motion: motion_s.map(|time| time / reference_motion),
            drawn_over_time: motion_s.map(|time| drawn_motion / time),
            time_relative: time_s.map(|time| time / reference_time),
            time_s,
            failed: attempts.len() - pairs.len(),
            ..row.with_errors(
                Errors::combined(&of_pairs(Observed::errors), rms),
                Errors::combined(&of_pairs(Observed::biases), mean),
                scatter,
            )
        });
    }
    mark_front(&mut rows);
    Ok(rows)
}

/// Equilibria of a setting with those of the reference. Azimuths that have none are told, counted and left out.
fn told_pairs<'a>(
    name: &str,
    attempts: &'a [Attempt],
    reference: &'a [Solved],
) -> Vec<(&'a Solved, &'a Solved)> {
    for error in attempts.iter().filter_map(|attempt| attempt.as_ref().err()) {
        tell_failure(name, error);
    }
    attempts
        .iter()
        .zip(reference)
        .filter_map(|(attempt, reference)| Some((attempt.as_ref().ok()?, reference)))
        .collect()
}

/// Says why a setting has no equilibrium or no motion: of linkers that are pulled far apart some rods break without drag.
fn tell_failure(setting: &str, error: &str) {
    // Lines that are not read are lost.
    let _ = writeln!(io::stderr(), "{setting}: {error}");
}

fn described(study: &Study, factor: Factor, name: &str, setting: &FilamentSetting) -> Row {
    Row {
        scene: study.name.to_owned(),
        factor: factor.name().to_owned(),
        setting: name.to_owned(),
        monomers_nm: table::stretches(&setting.monomers),
        law: table::law_name(&setting.law).to_owned(),
        segment_nm: setting.segment_nm,
        bonds_per_interface: setting.bonds,
        weight: format!("{:?}", setting.weight),
        attached: setting.attached,
        rigid_segments: setting.rigid_segments,
        ..Row::default()
    }
}

fn counted(row: Row, pairs: &[(&Solved, &Solved)], cost: &MotionCost) -> Row {
    let over = |pick: fn(&Solved) -> f64| {
        let values: Vec<f64> = pairs.iter().map(|(solved, _)| pick(solved)).collect();
        (!values.is_empty()).then(|| mean(&values))
    };
    let evaluations = over(|s| s.evaluations as f64);
    let each = (cost.work.bonds + cost.work.elements) as f64;
    Row {
        azimuths: pairs.len(),
        bonds: cost.work.bonds,
        elements: cost.work.elements,
        dofs: cost.counts.dofs,
        force_evaluations: evaluations,
        element_evaluations: evaluations.map(|count| count * each),
        newton_steps: over(|s| s.newton_steps as f64),
        evaluations_per_ns: Some(cost.evaluations_per_ns),
        doubtful: pairs.iter().filter(|(s, _)| s.doubtful > 0).count(),
        ..row
    }
}

/// Least time of Newton's method at the first azimuth (s), alone on the machine as far as this
/// program can see to it.
fn time(study: &Study, setting: &FilamentSetting) -> Option<f64> {
    let (mut spent, mut least) = (0.0, f64::INFINITY);
    for _ in 0..TIMING.1 {
        let wall_s = solve::equilibrium(study, setting, 0).ok()?.wall_s;
        spent += wall_s;
        least = least.min(wall_s);
        if spent > TIMING.0 {
            break;
        }
    }
    Some(least)
}

/// Standard deviation over samplings relative to the mean: of one sampling against the mean state,
/// as errors are of one against another.
fn scatter(solved: &[Solved]) -> Errors {
    let n = solved.len();
    let pairs = (0..n).flat_map(|i| (i + 1..n).map(move |k| (i, k)));
    let apart: Vec<Errors> = pairs
        .map(|(i, k)| {
            let of = |i: usize| -> &Observed { &solved[i].observed };
            of(i).errors(of(k))
        })
        .collect();
    // Two draws are apart by the root of two standard deviations.
    Errors::combined(&apart, |values| rms(values) / std::f64::consts::SQRT_2)
}

fn mark_front(rows: &mut [Row]) {
    let points: Vec<(f64, f64)> = rows
        .iter()
        .map(|row| {
            let of = |value: Option<f64>| value.unwrap_or(f64::INFINITY);
            (of(row.time_motion), of(row.error_displacement))
        })
        .collect();
    for (row, on_front) in rows.iter_mut().zip(pareto::front(&points)) {
        row.on_front = on_front;
    }
}

pub(super) fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

pub(super) fn rms(values: &[f64]) -> f64 {
    mean(&values.iter().map(|v| v * v).collect::<Vec<_>>()).sqrt()
}
