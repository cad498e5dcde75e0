//! Heat bath: exact distributions, temperature, and reproducibility.
//!
//! Tolerances are 4.5 standard errors, which one of 1.5e5 seeds exceeds; seeds are fixed.

use crate::common;
use actin_integrate::{
    Bath, Composition, Drag, PEFRL, POSITION_VERLET, Run, VEFRL, VELOCITY_VERLET, advance,
    advance_in,
};
use actin_mechanics::testing::{push_frame, push_point};

use actin_mechanics::testing::Loading;
use actin_mechanics::{Loads, Slider, State, System, UnitQuaternion, Vector3, Vectors};
use common::{chain, distance, springs, three_tops};

const KT: f64 = 4.0;
/// Tolerance in standard errors.
const ERRORS: f64 = 4.5;

fn bath(translational: f64, rotational: f64, kt: f64, seed: u64) -> Bath {
    Bath::new(Drag::new(translational, rotational).unwrap(), kt, seed).unwrap()
}

/// Free points of mass 0.07 and free tops of moments (0.2, 0.2, 0.1) with equal initial motion.
fn crowd(count: usize) -> System {
    let mut state = State::default();
    for i in 0..count {
        push_point(&mut state, Vector3::zeros(), 0.07);
        push_frame(&mut state, UnitQuaternion::identity(), [0.2, 0.2, 0.1]);
        state.points.velocity.set(i, Vector3::new(9.0, -5.0, 0.0));
        let l = Vector3::new(0.0, 0.0, 0.8);
        state.frames.angular_momentum.set(i, l);
    }
    System::new(state, Vec::new())
}

fn assert_mean(what: &str, mean: f64, expected: f64, variance: f64, n: usize) {
    let error = (variance / n as f64).sqrt();
    assert!(
        (mean - expected).abs() <= ERRORS * error,
        "{what}: {mean} is not {expected} +- {error}"
    );
}

/// Checks mean, variance and covariance with `start` of `now`.
fn assert_law(what: &str, start: &[f64], now: &[f64], [mean, variance, covariance]: [f64; 3]) {
    let n = now.len();
    let average = |f: &dyn Fn(usize) -> f64| (0..n).map(f).sum::<f64>() / n as f64;
    assert_mean(what, average(&|i| now[i]), mean, variance, n);
    let square = average(&|i| (now[i] - mean).powi(2));
    let fourth = 2.0 * variance * variance;
    assert_mean(what, square, variance, fourth, n);
    let middle = average(&|i| start[i]);
    let spread = average(&|i| (start[i] - middle).powi(2));
    let product = average(&|i| (start[i] - middle) * (now[i] - mean));
    let of_product = spread * variance + covariance * covariance;
    assert_mean(what, product, covariance, of_product, n);
}

/// Decaying mean, growing variance with the limit kT/m or kT I, and decaying correlation.
#[test]
fn free_motion_has_its_law_at_any_step() {
    let (gamma_t, gamma_r) = (2.0, 1.0);
    for scheme in [POSITION_VERLET, PEFRL] {
        for (h, steps) in [(0.02, 25), (2.5, 1)] {
            let bath = bath(gamma_t, gamma_r, KT, 17);
            let mut system = crowd(8000);
            let t = h * steps as f64;
            let mut before = system.state().clone();
            // Two legs: from equal motion, and onwards.
            for leg in 1..=2 {
                advance_in(&mut system, &scheme, h, steps, &bath, (leg - 1) * steps);
                let now = system.state();
                let law = |gamma: f64, start: f64, warm: f64| {
                    let passed = t * leg as f64;
                    let earlier = 1.0 - (-2.0 * gamma * (passed - t)).exp();
                    let share = 1.0 - (-2.0 * gamma * passed).exp();
                    let mean = start * (-gamma * passed).exp();
                    [mean, warm * share, warm * earlier * (-gamma * t).exp()]
                };
                let (v, w) = (&now.points.velocity, &before.points.velocity);
                assert_law("v_x", &w.x, &v.x, law(gamma_t, 9.0, KT / 0.07));
                assert_law("v_z", &w.z, &v.z, law(gamma_t, 0.0, KT / 0.07));
                let (v, w) = (
                    &now.frames.angular_momentum,
                    &before.frames.angular_momentum,
                );
                assert_law("l_3", &w.z, &v.z, law(gamma_r, 0.8, KT * 0.1));
                // Transverse components precess about the axis.
                let [mean, variance, _] = law(gamma_r, 0.0, KT * 0.2);
                let nothing = vec![0.0; v.x.len()];
                assert_law("l_1", &nothing, &v.x, [mean, variance, 0.0]);
                before = now.clone();
            }
        }
    }
}

/// Held and driven bodies have no noise. A slider has kT/2 in its free direction with its total
/// mass.
#[test]
fn held_bodies_stay_cold_and_sliding_ones_move_as_one() {
    let mut state = State::default();
    for mass in [0.1, 0.2, 0.05] {
        push_point(&mut state, Vector3::zeros(), mass);
    }
    (0..3).for_each(|i| state.points.hold(i));
    let driven = Vector3::new(0.0, 3.0, 0.0);
    state.points.velocity.set(2, driven);
    state.sliders.push(Slider {
        points: vec![0, 1],
        directions: vec![Vector3::z()],
        mass: 0.3,
    });
    let mut system = System::new(state, Vec::new());
    let bath = bath(1.0, 1.0, KT, 5);
    let samples = 20_000;
    let mut energy = 0.0;
    for step in 0..samples {
        // Correlations of samples are exp(-2 g h) = 2e-9.
        advance_in(&mut system, &PEFRL, 10.0, 1, &bath, step);
        let v = &system.state().points.velocity;
        assert_eq!((v.get(0), v.get(2)), (v.get(1), driven));
        assert_eq!((v.x[0], v.y[0]), (0.0, 0.0));
        energy += 0.3 * v.z[0].powi(2);
    }
    let mean = energy / samples as f64;
    assert_mean("slider", mean, KT, 2.0 * KT * KT, 20_000);
}

/// The total momentum of a free chain has 3 kT/2, since internal forces cancel and the noise of
/// bodies is independent.
#[test]
fn a_free_chain_moves_as_one_body() {
    let mut state = State::default();
    for mass in [1.0, 0.2, 3.0, 0.5, 2.0, 1.0] {
        let position = Vector3::zeros();
        push_point(&mut state, position, mass);
    }
    let springs = springs(&state, 4.0, 0.0);
    let mut system = System::new(state, vec![Box::new(springs)]);
    let bath = bath(5.0, 5.0, 1e-3, 31);
    let samples = 10_000;
    let mut sum = 0.0;
    for sample in 0..samples {
        // Correlations of samples are exp(-2 g t) = 5e-5.
        advance_in(&mut system, &PEFRL, 0.2, 5, &bath, 5 * sample);
        let points = &system.state().points;
        let mass: f64 = points.inverse_mass().iter().map(|m| 1.0 / m).sum();
        let momentum = system.state().momentum();
        sum += momentum.norm_squared() / (1e-3 * mass);
    }
    let mean = sum / (3 * samples) as f64;
    println!("whole chain: {mean:.4} kT");
    assert_mean("whole", mean, 1.0, 2.0, 30_000);
}

/// Velocities have exactly kT. The temperature of positions has the error of the scheme: 1/(1 - (b
/// omega h)^2/4) for velocity Verlet and 1 - (b omega h)^2/4 for position Verlet.
#[test]
fn oscillator_has_the_temperature_of_its_scheme() {
    for (scheme, theta) in [
        (POSITION_VERLET, 0.5),
        (POSITION_VERLET, 1.5),
        (VELOCITY_VERLET, 0.5),
        (VELOCITY_VERLET, 1.5),
        (PEFRL, 1.5),
        (PEFRL, 2.5),
    ] {
        // The drag rate equals the frequency and rescales the conservative step.
        let rescaled = theta * Drag::new(1.0, 0.0).unwrap().time_rescaling(theta).0;
        let expected = scheme.configurational_temperature(rescaled);
        let quarter = 0.25 * rescaled * rescaled;
        if scheme == POSITION_VERLET {
            assert!((expected - (1.0 - quarter)).abs() < 1e-14);
        } else if scheme == VELOCITY_VERLET {
            assert!((expected * (1.0 - quarter) - 1.0).abs() < 1e-14);
        }
        let means = oscillator_temperatures(&scheme, theta);
        for (what, mean, expected) in [
            ("kinetic", means[0], 1.0),
            ("potential", means[1], expected),
        ] {
            println!("{scheme}, omega h {theta}: {what} {mean:.4}, expected {expected:.4}");
            let variance = 2.0 * expected * expected;
            assert_mean(what, mean, expected, variance, 40 * 900);
        }
    }
}

/// Means of `m v^2/kT` and `k x^2/kT` over 40 samples of 900 oscillators at `omega h = theta`.
fn oscillator_temperatures(scheme: &Composition, theta: f64) -> [f64; 2] {
    let (mass, stiffness): (f64, f64) = (0.07, 30.0);
    let state = crowd(300).state().clone();
    let add = move |state: &State, loads: &mut Loads| {
        let places = state.points.position.iter().enumerate();
        places.for_each(|(i, x)| loads.force.add(i, -stiffness * x));
    };
    let term = "traps";
    let mut system = System::new(state, vec![Box::new(Loading { term, add })]);
    let h = theta * (mass / stiffness).sqrt();
    // Positions decorrelate within a few oscillations due to strong damping.
    let bath = bath((stiffness / mass).sqrt(), 1.0, KT, 23);
    // Samples at least ten radians apart are independent.
    let apart = if theta < 1.0 { 20 } else { 7 };
    advance_in(&mut system, scheme, h, 3 * apart, &bath, 0);
    let mut means = [0.0; 2];
    for sample in 3..43 {
        advance_in(&mut system, scheme, h, apart, &bath, apart * sample);
        let points = &system.state().points;
        let square = |v: &Vectors| v.iter().map(|v| v.norm_squared()).sum::<f64>() / 900.0;
        means[0] += mass * square(&points.velocity) / (40.0 * KT);
        means[1] += stiffness * square(&points.position) / (40.0 * KT);
    }
    means
}

/// Drift `F/(m g)` and diffusion `kT/(m g)` at any step.
///
/// The variance from equal initial velocities is `2 kT/(m g) (t - c (1 - exp(-g t))/g)` with
/// `c = g h/sinh(g h)`. Without rescaling both are too large by `(g h/2) coth(g h/2)`, 1.66 and 15
/// for the last two.
#[test]
fn points_drift_and_diffuse_as_they_should_at_any_step() {
    let (mass, gamma, steps) = (0.07, 2.0, 60);
    for scheme in [POSITION_VERLET, PEFRL] {
        for g_h in [0.03, 0.3, 3.0, 30.0] {
            let h = g_h / gamma;
            let mut state = crowd(4000).state().clone();
            state.points.velocity = Vectors::zeros(4000);
            let add = |state: &State, loads: &mut Loads| {
                (0..state.points.len()).for_each(|i| loads.force.add(i, Vector3::x() * 3.0));
            };
            let pull = Loading { term: "pull", add };
            let mut system = System::new(state, vec![Box::new(pull)]);
            let bath = bath(gamma, 1.0, KT, 41);
            // Equilibration of the velocities.
            let warm = Run::from_duration(&PEFRL, h, 10.0 / gamma).unwrap().steps();
            advance_in(&mut system, &scheme, h, warm, &bath, 0);
            let start = system.state().points.position.clone();
            advance_in(&mut system, &scheme, h, steps, &bath, warm);
            let end = &system.state().points.position;
            let t = h * steps as f64;
            let law = |mean: f64| {
                let slower = g_h / g_h.sinh() * (1.0 - (-gamma * t).exp()) / gamma;
                [mean, 2.0 * KT / (mass * gamma) * (t - slower)]
            };
            let all = [(&start.x, &end.x), (&start.y, &end.y), (&start.z, &end.z)];
            let drift = 3.0 * t / (mass * gamma);
            for ((start, end), [mean, variance]) in
                all.into_iter().zip([law(drift), law(0.0), law(0.0)])
            {
                let way = || start.iter().zip(end).map(|(a, b)| b - a);
                let n = way().len();
                let average = way().sum::<f64>() / n as f64;
                let square = way().map(|d| (d - mean).powi(2)).sum::<f64>() / n as f64;
                println!(
                    "{scheme}, g h {g_h}: drift {average:.3} of {mean:.3}, <d^2> over theory {:.4}",
                    square / variance
                );
                assert_mean("drift", average, mean, variance, n);
                assert_mean("diffusion", square, variance, 2.0 * variance * variance, n);
            }
        }
    }
}

#[test]
fn error_of_the_temperature_is_of_the_order_of_the_scheme() {
    for scheme in Composition::all() {
        let error = |theta| (scheme.configurational_temperature(theta) - 1.0).abs();
        let order = (error(0.2) / error(0.1)).log2();
        println!(
            "{scheme}: error {:.2e} at 0.1, order {order:.3}",
            error(0.1)
        );
        assert!((order - f64::from(scheme.order())).abs() < 0.1, "{order}");
    }
}

#[test]
fn at_zero_temperature_a_bath_is_drag() {
    let cold = bath(0.3, 0.2, 0.0, 1);
    let (mut with_drag, mut in_bath) = (three_tops(), three_tops());
    advance(&mut with_drag, &PEFRL, 0.05, 100, cold.drag());
    advance_in(&mut in_bath, &PEFRL, 0.05, 100, &cold, 0);
    assert!(distance(with_drag.state(), in_bath.state()) < 1e-13);
}

/// Final state of a chain in a bath with observations in intervals, optionally interrupted at
/// `resume` and continued in a new system.
fn end_of_run(
    scheme: &'static Composition,
    seed: u64,
    observe_every: u64,
    resume: Option<u64>,
) -> State {
    let run = |steps| {
        Run::new(scheme, 0.05, steps)
            .unwrap()
            .with_bath(bath(0.3, 0.3, 1e-3, seed))
            .observing_every(observe_every)
            .unwrap()
    };
    let mut system = chain(6, 4.0, 1.0);
    if let Some(steps) = resume {
        run(steps).execute(&mut system, &mut []).unwrap();
        let state = system.state().clone();
        system = chain(6, 4.0, 1.0);
        *system.state_mut() = state;
        let rest = run(500 - steps).continuing_from(steps);
        rest.execute(&mut system, &mut []).unwrap();
    } else {
        run(500).execute(&mut system, &mut []).unwrap();
    }
    system.state().clone()
}

#[test]
fn runs_are_functions_of_the_seed_alone() {
    for scheme in [&POSITION_VERLET, &PEFRL, &VEFRL] {
        let reference = end_of_run(scheme, 1, 1000, None);
        assert!(reference.kinetic_energy() > 0.0);
        for every in [1, 7, 100] {
            assert_eq!(end_of_run(scheme, 1, every, None), reference);
        }
        for steps in [1, 123, 499] {
            assert_eq!(end_of_run(scheme, 1, 50, Some(steps)), reference);
        }
        assert!(distance(&end_of_run(scheme, 2, 1000, None), &reference) > 1e-3);
    }
}
