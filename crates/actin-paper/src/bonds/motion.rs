//! Time step and energy drift: a free filament at room temperature, warmed by a heat bath and then
//! left alone.

use super::Effort;
use super::heat::Filament;
use super::page::Listing;
use super::study::bar;
use super::tables::spread;
use super::variant::{Variant, compared};
use crate::measure::steps_in;
use actin_integrate::{Drag, PEFRL, advance};
use rayon::prelude::*;
use std::time::Instant;

/// Motion that is recorded (ns).
const RECORDED_NS: f64 = 20.0;
/// Time steps as shares of the stability limit at rest.
const SHARES: [f64; 2] = [0.5, 0.25];
/// Replicas, each of other noise and another sampling.
const REPLICAS: u64 = 16;
/// Length (nm).
const LENGTH_NM: f64 = 55.0;

/// What is compared: the shortest length matters in motion, so weighted bonds have others as well.
fn variants() -> Vec<Variant> {
    let mut variants = compared();
    variants.extend([0.0, 0.3].map(|shortest| Variant::weighted(12, shortest)));
    variants
}

/// One filament left alone.
struct Drift {
    /// Largest frequency at rest (rad/ns).
    frequency: f64,
    /// Time step (ns).
    step: f64,
    /// Energy gained (kT for each degree of freedom and ns).
    gained: f64,
    /// Time for 1 ns (s).
    seconds: f64,
}

fn drift(variant: &Variant, share: f64, replica: u64, duration: f64) -> Result<Drift, String> {
    let mut filament = Filament::new(variant, LENGTH_NM, replica)?;
    let step = filament.warm_up(&PEFRL, share)?;
    let system = &mut filament.assembly.system;
    let before = system.total_energy();
    let clock = Instant::now();
    advance(system, &PEFRL, step, steps_in(duration, step), &Drag::NONE);
    let seconds = clock.elapsed().as_secs_f64() / duration;
    let gained = (system.total_energy() - before) / (filament.kt * filament.dofs * duration);
    let frequency = filament.frequency;
    Ok(Drift {
        frequency,
        step,
        gained,
        seconds,
    })
}

/// Frequencies, time steps and drifts of all variants.
pub(super) fn table(effort: Effort) -> Result<Listing, String> {
    let duration = RECORDED_NS / f64::from(effort.fraction);
    let variants = variants();
    let bar = bar(variants.len() * SHARES.len() * usize::try_from(REPLICAS).unwrap_or(0));
    let mut rows = Vec::new();
    for variant in &variants {
        for share in SHARES {
            let all: Vec<Drift> = (0..REPLICAS)
                .into_par_iter()
                .map(|replica| {
                    let drift = drift(variant, share, replica, duration);
                    bar.inc(1);
                    drift
                })
                .collect::<Result<_, _>>()?;
            rows.push(row(variant, share, &all));
        }
    }
    bar.finish_and_clear();
    Ok(Listing {
        header: vec![
            "bonds, shortest",
            "largest frequency (rad/ns)",
            "share of the limit",
            "step (ps)",
            "gained (kT per degree of freedom and ns)",
            "standard error",
            "cost (ms per ns)",
        ],
        rows,
    })
}

/// One row of the table: a variant at one share of the largest step, over its replicas.
fn row(variant: &Variant, share: f64, all: &[Drift]) -> Vec<String> {
    let over = |of: fn(&Drift) -> f64| spread(all.iter().map(of));
    let (gained, sd) = over(|d| d.gained);
    let least = all.iter().map(|d| d.seconds).fold(f64::INFINITY, f64::min);
    vec![
        format!(
            "{}, {:.1} nm",
            variant.bonds(),
            variant.monomers.min_bond_nm
        ),
        format!("{:.0}", over(|d| d.frequency).0),
        format!("{share}"),
        format!("{:.2}", 1e3 * over(|d| d.step).0),
        format!("{gained:+.1e}"),
        format!("{:.0e}", sd / (REPLICAS as f64).sqrt()),
        format!("{:.1}", 1e3 * least),
    ]
}
