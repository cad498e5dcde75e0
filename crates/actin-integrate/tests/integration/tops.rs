use crate::common;
use actin_integrate::{Composition, Drag, VEFRL, advance, largest_frequency, stable_step};
use actin_mechanics::System;
use common::{distance, spinning_tops, vibrating_tops};

/// The truncation error is 1e-3 at this step; asymmetric tables or drifts would not return to the
/// start.
#[test]
fn time_reversal() {
    for scheme in Composition::all() {
        let mut system = spinning_tops();
        let start = system.state().clone();
        advance(&mut system, scheme, 0.05, 200, &Drag::NONE);
        assert!(distance(system.state(), &start) > 1.0);
        advance(&mut system, scheme, -0.05, 200, &Drag::NONE);
        let missed = distance(system.state(), &start);
        // Rounding errors of 1e-16 in each of 4000 stages, amplified by diverging trajectories.
        assert!(missed < 1e-11, "{scheme}: {missed:e}");
    }
}

#[test]
fn momenta_stay_to_round_off() {
    for scheme in Composition::all() {
        let mut system = spinning_tops();
        let (p, l) = (system.state().momentum(), system.state().angular_momentum());
        advance(&mut system, scheme, 0.1, 10_000, &Drag::NONE);
        let (p_end, l_end) = (system.state().momentum(), system.state().angular_momentum());
        let (dp, dl) = ((p_end - p).norm(), (l_end - l).norm());
        // Random walk of 1e5 rounding errors of 1e-16, growing with the distance travelled.
        assert!(dp < 1e-12 && dl < 1e-10, "{scheme}: {dp:e}, {dl:e}");
    }
}

/// Mean and largest relative deviation of the energy in ten intervals of 1e4 steps.
fn energy_record(system: &mut System, scheme: &Composition, h: f64) -> Vec<(f64, f64)> {
    let start = system.total_energy();
    (0..10)
        .map(|_| {
            let deviations: Vec<f64> = (0..1000)
                .map(|_| {
                    advance(system, scheme, h, 10, &Drag::NONE);
                    system.total_energy() / start - 1.0
                })
                .collect();
            let mean = deviations.iter().sum::<f64>() / 1000.0;
            let largest = deviations.iter().fold(0.0, |m: f64, d| m.max(d.abs()));
            (mean, largest)
        })
        .collect()
}

/// Largest deviations in the first and last three intervals at `share` of the stability limit, and
/// the change of the mean.
fn energy_trend(scheme: &Composition, share: f64, seed: u64) -> [f64; 3] {
    let mut system = vibrating_tops(seed);
    let frequency = largest_frequency(&system).unwrap();
    let h = stable_step(scheme, frequency, share).unwrap();
    let record = energy_record(&mut system, scheme, h);
    let largest = |part: &[(f64, f64)]| part.iter().fold(0.0, |m: f64, r| m.max(r.1));
    let mean = |part: &[(f64, f64)]| part.iter().map(|r| r.0).sum::<f64>() / 3.0;
    let (early, late) = (&record[..3], &record[7..]);
    let trend = [largest(early), largest(late), mean(late) - mean(early)];
    println!("{scheme} at {share}, seed {seed}: early, late, drift {trend:?}");
    trend
}

/// The mean energy has no drift at half the stability limit (VEFRL: 0.4, see the next test).
#[test]
fn energy_is_bounded_without_a_trend() {
    for scheme in Composition::all() {
        let share = if *scheme == VEFRL { 0.4 } else { 0.5 };
        for seed in 1..=2 {
            let [early, late, drift] = energy_trend(scheme, share, seed);
            // The error depends on the fluctuating energy of the fastest modes. In eight starts the
            // ratio reached 1.47 and the drift 0.06 of the fluctuation.
            assert!(late < 2.0 * early, "{scheme}: {early:e} became {late:e}");
            assert!(drift.abs() < 0.15 * early, "{scheme}: {drift:e}");
        }
    }
}

/// Known limitation: at half its limit the energy of VEFRL diffuses, by up to 3e-3 in eight starts.
#[test]
fn vefrl_at_half_its_limit_diffuses_slowly() {
    for seed in 1..=2 {
        let [_, late, drift] = energy_trend(&VEFRL, 0.5, seed);
        assert!(drift.abs() < 1e-2 && late < 2e-2, "{drift:e}, {late:e}");
    }
}
