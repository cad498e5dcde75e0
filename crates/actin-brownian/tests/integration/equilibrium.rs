use crate::common;
use actin_brownian::{Brownian, Relaxation, StepLimits};
use actin_cosserat::{EnergyGradient, Rigidities, RodMaterial, StraightRod};
use actin_mechanics::{PointLoad, State, System, Vector3};
use common::{FRICTION, advance, free_rod, friction_of, layout_of, rigidities, tip};

/// Mean energies of shear and bending elements of a free rod over `kT`, per component of strain, in
/// steps of `ratio` times the fastest relaxation.
fn energies_per_strain(kt: f64, ratio: f64, steps: u64) -> [f64; 2] {
    // Bending of a short rod relaxes within tens of steps.
    const SEGMENTS: usize = 4;
    let (mut system, mut stepper, rod) = free_rod(SEGMENTS, 40.0, (kt, 5), |_, _| Vec::new());
    let layout = layout_of(system.state(), &rod);
    let relaxation = Relaxation::new(&system, layout, &friction_of(&rod));
    let h = ratio / relaxation.unwrap().highest_rate();
    let warm = 1000;
    advance(&mut system, &mut stepper, (0, warm), h, |_| ());
    let mut sums = [0.0; 2];
    let mut energies = [0.0; 2 * SEGMENTS - 1];
    advance(
        &mut system,
        &mut stepper,
        (warm, warm + steps),
        h,
        |system| {
            system.interactions()[0].write_energies(system.state(), &mut energies);
            let (shear, bending) = energies.split_at(SEGMENTS);
            sums[0] += shear.iter().sum::<f64>() / (3 * SEGMENTS) as f64;
            sums[1] += bending.iter().sum::<f64>() / (3 * (SEGMENTS - 1)) as f64;
        },
    );
    println!(
        "{ratio} times: {} iterations, h = {h}",
        stepper.iterations()
    );
    sums.map(|sum| sum / (kt * steps as f64))
}

/// Each strain component of a free rod has the energy kT/2, at steps of a hundred and of three
/// thousand times the fastest relaxation.
#[test]
fn strains_have_the_equipartition_energy_at_long_steps() {
    for (kt, ratio, steps) in [(0.0411, 100.0, 100_000), (4.11, 3e3, 30_000)] {
        let shares = energies_per_strain(kt, ratio, steps);
        for share in shares {
            assert!((share / 0.5 - 1.0).abs() < 0.01, "kT = {kt}: {shares:?}");
        }
    }
}

/// A rod spins by 2 rad (root mean square) in a step, in a tenth of the steps by more than half a
/// turn. The mean cosine of the spin is `exp(-kT h/(zeta L))`.
#[test]
fn rods_spin_by_more_than_half_a_turn_in_a_step() {
    const SEGMENTS: usize = 8;
    let (kt, length, h, steps) = (4.11, 160.0, 12_000.0, 6000);
    let (mut system, mut stepper, rod) = free_rod(SEGMENTS, length, (kt, 6), |_, _| Vec::new());
    let frame = rod.frames().start + SEGMENTS / 2;
    let (mut energy, mut cosine) = (0.0, 0.0);
    let mut before = system.state().frames.orientation.get(frame);
    advance(&mut system, &mut stepper, (0, steps), h, |system| {
        let state = system.state();
        energy += system.interactions()[0].energy(state);
        let now = state.frames.orientation.get(frame);
        let turn = before.inverse() * now;
        cosine += (2.0 * turn.k.atan2(turn.w)).cos();
        before = now;
    });
    let share = energy / (steps as f64 * 0.5 * kt * (6 * SEGMENTS - 3) as f64);
    let expected = (-kt * h / (FRICTION[2] * length)).exp();
    let cosine = cosine / steps as f64;
    // Standard errors are 0.4 % and 0.01; twist within the rod adds 0.003 to the exponent.
    assert!((share - 1.0).abs() < 0.02, "{share}");
    assert!((cosine - expected).abs() < 0.05, "{cosine}");
}

/// Nearly all steps are halved, and the energy stays near 1.5 kT per element.
#[test]
fn steps_that_do_not_converge_are_halved() {
    let kt = 4.11;
    let (mut system, stepper, _) = free_rod(8, 160.0, (kt, 5), |_, _| Vec::new());
    let most = 3;
    let limits = StepLimits {
        iterations: most,
        ..StepLimits::default()
    };
    let mut stepper = stepper.with_limits(limits);
    let mut energy = 0.0;
    let steps = 500;
    advance(&mut system, &mut stepper, (0, steps), 2e4, |system| {
        energy += system.interactions()[0].energy(system.state());
    });
    assert!(
        stepper.iterations() > 2 * most as u64 * steps,
        "no step was halved"
    );
    let share = energy / (steps as f64 * 1.5 * kt * 15.0);
    assert!((0.8..1.2).contains(&share), "{share}");
}

/// The mean cosine of a rod in a field is the Langevin function `coth a - 1/a` with `a = F L/kT`.
/// The friction is anisotropic and rotates with the rod: friction of the start of a step (Ito
/// noise) would cause a drift.
#[test]
fn a_rod_in_a_field_has_the_distribution_of_langevin() {
    let (length, kt, a) = (20.0, 4.11, 1.5);
    let mut state = State::default();
    let rod = StraightRod::uniform(1, length).push(&mut state).unwrap();
    let soft = Rigidities {
        shear: Vector3::repeat(300.0),
        ..rigidities()
    };
    let law = EnergyGradient::new(rod.clone(), RodMaterial::new(soft).unwrap());
    let ends = vec![(tip(&rod), 1.0), (rod.points().start, -1.0)];
    let control = state.add_control(1.0);
    let load = PointLoad::new(&state, ends, Vector3::x() * (a * kt / length), control).unwrap();
    let mut friction = friction_of(&rod);
    for dashpot in &mut friction.dashpots {
        dashpot.friction.z = 0.1 * dashpot.friction.x;
    }
    let layout = layout_of(&state, &rod);
    let mut system = System::new(state, vec![Box::new(law), Box::new(load)]);
    let mut stepper = Brownian::new(&system, layout, friction, (kt, 9)).unwrap();
    // The rotational relaxation time is about zeta L^3/(24 kT) = 230 ns.
    let (h, steps) = (2.0, 600_000);
    let (mut sum, mut square) = (0.0, 0.0);
    advance(&mut system, &mut stepper, (0, steps), h, |system| {
        let q = system.state().frames.orientation.get(0);
        let cosine = (q * Vector3::z()).x;
        sum += cosine;
        square += cosine * cosine;
    });
    let (mean, square) = (sum / steps as f64, square / steps as f64);
    let langevin = 1.0 / f64::tanh(a) - 1.0 / a;
    let of_square = 1.0 - 2.0 * langevin / a;
    println!("{mean} against {langevin}, squares {square} against {of_square}");
    // 1.2e6 ns give about 2400 independent samples, with standard errors of 0.011 and 0.0055.
    assert!((mean - langevin).abs() < 3.0 * 0.011);
    assert!((square - of_square).abs() < 3.0 * 0.0055);
}
