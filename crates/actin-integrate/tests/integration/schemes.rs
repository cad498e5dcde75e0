use actin_integrate::{
    Composition, Drag, FOREST_RUTH, PEFRL, POSITION_VERLET, SUZUKI, Stage, VEFRL, VELOCITY_VERLET,
    advance,
};
use actin_mechanics::Split;

struct OneDegree {
    q: f64,
    p: f64,
    force: fn(f64) -> f64,
    drifts: u64,
    current: Option<f64>,
    evaluations: u64,
}

impl OneDegree {
    fn new(q: f64, p: f64, force: fn(f64) -> f64) -> Self {
        Self {
            q,
            p,
            force,
            drifts: 0,
            current: None,
            evaluations: 0,
        }
    }

    fn pendulum() -> Self {
        Self::new(1.2, 0.3, |q| -q.sin())
    }
}

impl Split for OneDegree {
    fn drift(&mut self, h: f64) {
        self.drifts += 1;
        self.current = None;
        self.q += h * self.p;
    }

    fn kick(&mut self, h: f64, _rotation: f64) {
        let evaluations = &mut self.evaluations;
        let force = *self.current.get_or_insert_with(|| {
            *evaluations += 1;
            (self.force)(self.q)
        });
        self.p += h * force;
    }

    fn damp(&mut self, translational: f64, _rotational: f64) {
        self.p *= translational;
    }

    fn force_evaluations(&self) -> u64 {
        self.evaluations
    }
}

/// Matrix of one step of the oscillator `q'' = -q`.
fn matrix(scheme: &Composition, omega_h: f64) -> [[f64; 2]; 2] {
    let column = |q, p| {
        let mut oscillator = OneDegree::new(q, p, |q| -q);
        advance(&mut oscillator, scheme, omega_h, 1, &Drag::NONE);
        [oscillator.q, oscillator.p]
    };
    let (a, b) = (column(1.0, 0.0), column(0.0, 1.0));
    [[a[0], b[0]], [a[1], b[1]]]
}

/// A symmetric method has equal diagonal elements and determinant 1. It is stable if the
/// off-diagonal elements differ in sign; the limit is the first zero of either.
fn stability_limit(scheme: &Composition) -> f64 {
    let stable = |x: f64| {
        let m = matrix(scheme, x);
        m[0][1] * m[1][0] < 0.0
    };
    let steps = 50_000;
    let first_unstable = (1..steps)
        .map(|k| 5.0 * f64::from(k) / f64::from(steps))
        .find(|x| !stable(*x))
        .expect("explicit methods have a limit below 5");
    let (mut low, mut high) = (first_unstable - 1e-4, first_unstable);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if stable(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

#[test]
fn stability_limits_are_as_stated() {
    for scheme in Composition::all() {
        let limit = stability_limit(scheme);
        println!("{scheme}: {limit:.8}");
        // Limits are given to five decimals.
        assert!(
            (limit - scheme.stability_limit()).abs() < 6e-6,
            "{scheme}: {limit}"
        );
    }
}

#[test]
fn stability_limits_are_the_published_ones() {
    for (scheme, published) in [(POSITION_VERLET, 2.00), (PEFRL, 2.99), (VEFRL, 3.47)] {
        assert!((scheme.stability_limit() - published).abs() < 0.005);
    }
}

/// Position and momentum at `t = 10`.
fn pendulum_at_10(scheme: &Composition, steps: u32) -> [f64; 2] {
    let mut pendulum = OneDegree::pendulum();
    let h = 10.0 / f64::from(steps);
    advance(&mut pendulum, scheme, h, steps.into(), &Drag::NONE);
    [pendulum.q, pendulum.p]
}

/// Error of (q, p) relative to PEFRL with a step of 5e-4, whose error is below 1e-14.
fn pendulum_error(scheme: &Composition, steps: u32) -> f64 {
    let reference = pendulum_at_10(&PEFRL, 20_000);
    let end = pendulum_at_10(scheme, steps);
    (end[0] - reference[0]).hypot(end[1] - reference[1])
}

#[test]
fn pendulum_errors_are_the_known_ones() {
    let known = [
        (PEFRL, [3.112e-7, 1.944e-8, 1.215e-9]),
        (VEFRL, [1.533e-7, 9.548e-9, 5.963e-10]),
    ];
    for (scheme, errors) in known {
        for (steps, expected) in [100, 200, 400].into_iter().zip(errors) {
            let error = pendulum_error(&scheme, steps);
            println!("{scheme} {steps}: {error:.4e}");
            // Half a unit of the fourth digit, and rounding errors of 400 steps.
            assert!((error - expected).abs() < 1e-3 * expected, "{error:e}");
        }
    }
}

#[test]
fn orders_on_the_pendulum() {
    for scheme in Composition::all() {
        let (coarse, fine) = (pendulum_error(scheme, 200), pendulum_error(scheme, 400));
        let order = (coarse / fine).log2();
        println!("{scheme}: order {order:.4}");
        assert!((order - f64::from(scheme.order())).abs() < 0.05, "{scheme}");
    }
}

/// From (1, 0) with h = 1: position Verlet drifts to 1, kicks to -1, drifts to 1/2; velocity Verlet
/// kicks to -1/2, drifts to 1/2, kicks to -3/4.
#[test]
fn one_step_by_hand() {
    for (scheme, expected) in [
        (POSITION_VERLET, (0.5, -1.0)),
        (VELOCITY_VERLET, (0.5, -0.75)),
    ] {
        let mut oscillator = OneDegree::new(1.0, 0.0, |q| -q);
        advance(&mut oscillator, &scheme, 1.0, 1, &Drag::NONE);
        assert_eq!((oscillator.q, oscillator.p), expected);
    }
}

#[test]
fn work_per_step() {
    let expected = [
        (POSITION_VERLET, 1, 1),
        (VELOCITY_VERLET, 1, 1),
        (PEFRL, 4, 4),
        (VEFRL, 4, 4),
        (FOREST_RUTH, 3, 3),
        (SUZUKI, 5, 5),
    ];
    for (scheme, evaluations, drifts) in expected {
        let kick_first = u64::from(scheme.first() == Stage::Kick);
        assert_eq!(scheme.force_evaluations_per_step(), evaluations);
        let mut pendulum = OneDegree::pendulum();
        advance(&mut pendulum, &scheme, 0.01, 1000, &Drag::NONE);
        assert_eq!(
            pendulum.evaluations,
            1000 * evaluations as u64 + kick_first,
            "{scheme}"
        );
        assert_eq!(pendulum.drifts, 1000 * drifts + 1 - kick_first, "{scheme}");

        let mut damped = OneDegree::pendulum();
        let drag = Drag::new(0.1, 0.1).unwrap();
        advance(&mut damped, &scheme, 0.01, 1000, &drag);
        assert_eq!(damped.evaluations, pendulum.evaluations, "{scheme}");
    }
}

#[test]
fn no_steps_do_nothing() {
    let mut pendulum = OneDegree::pendulum();
    advance(&mut pendulum, &VEFRL, 0.1, 0, &Drag::new(1.0, 1.0).unwrap());
    assert_eq!((pendulum.q, pendulum.p), (1.2, 0.3));
    assert_eq!(pendulum.evaluations, 0);
}

/// Pendulum with a drift that is symmetric but not a flow (an oscillator solved by position
/// Verlet).
struct SymmetricDrift(OneDegree);

impl Split for SymmetricDrift {
    fn drift(&mut self, h: f64) {
        self.0.current = None;
        self.0.q += 0.5 * h * self.0.p;
        self.0.p -= h * self.0.q;
        self.0.q += 0.5 * h * self.0.p;
    }

    fn kick(&mut self, h: f64, rotation: f64) {
        self.0.kick(h, rotation);
    }

    fn damp(&mut self, translational: f64, rotational: f64) {
        self.0.damp(translational, rotational);
    }

    fn force_evaluations(&self) -> u64 {
        self.0.force_evaluations()
    }
}

/// Tables of order 4 have order 2 for a symmetric drift. Five separate Verlet steps with the
/// weights of Suzuki keep order 4.
#[test]
fn suzuki_weights_keep_the_order_for_symmetric_drifts() {
    let reference = pendulum_at_10(&PEFRL, 20_000);
    let order = |step: fn(&mut SymmetricDrift, f64)| {
        let error = |steps: u32| {
            let mut split = SymmetricDrift(OneDegree::new(1.2, 0.3, |q| q - q.sin()));
            (0..steps).for_each(|_| step(&mut split, 10.0 / f64::from(steps)));
            (split.0.q - reference[0]).hypot(split.0.p - reference[1])
        };
        (error(400) / error(800)).log2()
    };
    let by_table = order(|s, h| advance(s, &PEFRL, h, 1, &Drag::NONE));
    let by_weights = order(|s, h| {
        let outer = SUZUKI.coefficients()[1];
        for w in [outer, outer, 1.0 - 4.0 * outer, outer, outer] {
            advance(s, &POSITION_VERLET, w * h, 1, &Drag::NONE);
        }
    });
    println!("symmetric drift: PEFRL {by_table:.3}, five Verlets {by_weights:.3}");
    assert!((by_table - 2.0).abs() < 0.05);
    assert!((by_weights - 4.0).abs() < 0.05);
}
