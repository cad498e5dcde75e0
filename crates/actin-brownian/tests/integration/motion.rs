use crate::common;
use actin_brownian::{Flow, Relaxation};
use actin_cosserat::{End, RodClamp, RodLayout, StraightRod};
use actin_mechanics::{State, System, UnitQuaternion, Vector3, rotation};
use common::{FRICTION, advance, free_rod, friction_of, law, layout_of, rigidities, tip};

fn pose(system: &System, rod: &RodLayout) -> (Vector3, Vector3, UnitQuaternion) {
    let x = &system.state().points.position;
    let (start, end) = (x.get(0), x.get(tip(rod)));
    let middle: Vector3 = x.iter().sum::<Vector3>() / x.len() as f64;
    let frame = system.state().frames.orientation.get(rod.segments() / 2);
    (middle, (end - start).normalize(), frame)
}

/// Mean squares of the motion of a free rod over a lag of 5 ns: along, across (per axis), about its
/// axis, and end over end (per axis).
fn mean_squares(segments: usize, thermal_energy: f64) -> [f64; 4] {
    let noise = (thermal_energy, 3);
    let (mut system, mut stepper, rod) = free_rod(segments, LENGTH, noise, |_, _| Vec::new());
    let mut sums = [0.0; 4];
    for sample in 0..SAMPLES {
        let (place, axis, frame) = pose(&system, &rod);
        let steps = (sample * LAG, (sample + 1) * LAG);
        advance(&mut system, &mut stepper, steps, 1.0, |_| ());
        let (later, turned, later_frame) = pose(&system, &rod);
        let moved = later - place;
        let along = moved.dot(&axis);
        let about = (frame.inverse() * later_frame).scaled_axis().z;
        sums[0] += along * along;
        sums[1] += 0.5 * (moved.norm_squared() - along * along);
        sums[2] += about * about;
        sums[3] += 0.5 * turned.cross(&axis).norm_squared();
    }
    sums.map(|sum| sum / SAMPLES as f64)
}

/// Length of the rod (nm), lag (ns) and number of samples.
const LENGTH: f64 = 60.0;
const LAG: u64 = 5;
const SAMPLES: u64 = 20_000;

/// The mean squares are `2 kT t / Z` with the total friction `Z`. Standard errors are 1 %, and 0.7
/// % for means of two axes.
#[test]
fn a_rod_diffuses_with_its_friction() {
    let kt = 4.11;
    let [along, across, about, tilt] = FRICTION;
    let whole = [
        along * LENGTH,
        across * LENGTH,
        about * LENGTH,
        across * LENGTH.powi(3) / 12.0 + tilt * LENGTH,
    ];
    for segments in [1, 6] {
        let squares = mean_squares(segments, kt).into_iter().zip(whole);
        let ratios: Vec<f64> = squares
            .map(|(square, z)| square / (2.0 * kt * LAG as f64 / z))
            .collect();
        // Bending and twist of six segments add to the rotations.
        let compared = if segments == 1 { 4 } else { 2 };
        for ratio in &ratios[..compared] {
            assert!((ratio - 1.0).abs() < 0.03, "{ratios:?}");
        }
    }
}

#[derive(Clone, Copy, Debug)]
enum Hold {
    Free,
    Pinned,
    Clamped,
}

impl Hold {
    fn roots(self) -> [f64; 5] {
        match self {
            Self::Free => [4.730_041, 7.853_205, 10.995_608, 14.137_165, 17.278_760],
            Self::Pinned => [1.0, 2.0, 3.0, 4.0, 5.0].map(|n| n * std::f64::consts::PI),
            Self::Clamped => [1.875_104, 4.694_091, 7.854_757, 10.995_541, 14.137_168],
        }
    }
}

/// The first five bending rates are `B (x_n/L)^4 / zeta_across` in both directions. Discretisation,
/// shear and tilt change the fifth by 0.6 %.
#[test]
fn bending_relaxes_as_that_of_slender_rods() {
    let length = 3000.0;
    for hold in [Hold::Free, Hold::Pinned, Hold::Clamped] {
        let mut state = State::default();
        let straight = StraightRod::uniform(100, length / 100.0);
        let rod = match hold {
            Hold::Clamped => straight.push_clamped(RodClamp::Wall, End::Start, &mut state),
            Hold::Free | Hold::Pinned => straight.push(&mut state),
        };
        let rod = rod.unwrap();
        if matches!(hold, Hold::Pinned) {
            state.points.hold(0);
            state.points.hold(tip(&rod));
        }
        let layout = layout_of(&state, &rod);
        let system = System::new(state, vec![law(&rod)]);
        let relaxation = Relaxation::new(&system, layout, &friction_of(&rod));
        let rates = relaxation.unwrap().lowest_rates(20);
        let theory = |root: f64| rigidities().bend.x * (root / length).powi(4) / FRICTION[1];
        for root in hold.roots() {
            let near = |rate: &&f64| (*rate / theory(root) - 1.0).abs() < 0.01;
            let found: Vec<&f64> = rates.iter().filter(near).collect();
            assert_eq!(found.len(), 2, "{root}: {rates:?}");
        }
    }
}

/// Tip after 200 ns of relaxation from a bent and twisted state.
fn relaxed(steps: u64) -> Vector3 {
    let (mut system, mut stepper, rod) = free_rod(16, 160.0, (0.0, 0), |_, _| Vec::new());
    let bent = |s: f64| {
        Vector3::new(0.01, 0.004, 0.002) * (std::f64::consts::PI * s / 160.0).sin().powi(2)
    };
    rod.bend(system.state_mut(), bent).unwrap();
    let h = 200.0 / steps as f64;
    advance(&mut system, &mut stepper, (0, steps), h, |_| ());
    let x = &system.state().points.position;
    x.get(tip(&rod)) - x.get(0)
}

/// Steps are hundreds of times the fastest relaxation. The initial state has few short waves, which
/// steps do not resolve.
#[test]
fn relaxation_is_of_second_order() {
    let reference = relaxed(3200);
    let errors: Vec<f64> = [50, 100, 200]
        .map(|steps| (relaxed(steps) - reference).norm())
        .to_vec();
    let orders: Vec<f64> = errors.windows(2).map(|e| (e[0] / e[1]).log2()).collect();
    println!("errors {errors:?}, orders {orders:?}");
    assert!(orders.iter().all(|order| (1.8..2.3).contains(order)));
}

/// A free rod moves with a uniform stream. In shear flow it rotates as a line of the fluid,
/// `cot phi = cot phi_0 + rate t`, without noise and with negligible noise.
#[test]
fn rods_follow_a_flow() {
    const STEPS: u64 = 200;
    let stream = Vector3::new(0.3, -0.2, 0.5);
    let rate = 0.02;
    let shear = Flow::shear(rate, Vector3::z(), Vector3::x());
    for (flow, noise) in [(Flow::stream(stream), 0.0), (shear, 0.0), (shear, 1e-12)] {
        let (mut system, stepper, rod) = free_rod(4, LENGTH, (noise, 1), |_, _| Vec::new());
        let mut stepper = stepper.in_flow(flow);
        // Initially nearly across the flow, in its plane.
        let tilt = rotation::exp(Vector3::y() * 1.4);
        let state = system.state_mut();
        for i in 0..state.points.len() {
            let place = tilt * state.points.position.get(i) - tilt * Vector3::z() * 0.5 * LENGTH;
            state.points.position.set(i, place);
        }
        for i in 0..state.frames.len() {
            let q = tilt * state.frames.orientation.get(i);
            state.frames.orientation.set(i, q);
        }
        let before = pose(&system, &rod);
        let h = 0.1;
        advance(&mut system, &mut stepper, (0, STEPS), h, |_| ());
        let after = pose(&system, &rod);
        let time = h * STEPS as f64;
        let drift = after.0 - before.0 - flow.velocity * time;
        assert!(drift.norm() < 1e-4, "{drift:?}");
        let cot = |axis: Vector3| axis.z / axis.x;
        let grown = cot(after.1) - cot(before.1);
        let expected = flow.gradient[(2, 0)] * time;
        assert!((grown - expected).abs() < 1e-3, "{grown}, {expected}");
    }
}
