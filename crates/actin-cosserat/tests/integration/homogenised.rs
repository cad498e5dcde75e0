//! Rods with a potential in uniform states, and unsupported combinations.

use crate::common;
use actin_cosserat::{
    EnergyGradient, Homogenised, PaperBalance, Rigidities, RodElements, RodError, RodMaterial,
    StraightRod, TwistLaw, Walls,
};
use actin_mechanics::testing::loads_of;
use actin_mechanics::{Interaction, State, Vector3, rotation};
use common::ALL_WALLS;

fn material() -> RodMaterial {
    RodMaterial::homogenised(Homogenised::mean_filament())
}

fn uniform(walls: Walls, kappa: Vector3, sigma: Vector3) -> (State, EnergyGradient) {
    let mut state = State::default();
    let rod = StraightRod {
        walls,
        ..StraightRod::uniform(10, 8.0)
    };
    let layout = rod.push(&mut state).unwrap();
    let chain = layout.bending_chain();
    let mut q = rotation::exp(Vector3::new(0.3, -0.2, 0.5));
    for (frame, distance) in chain.zip(layout.voronoi_lengths().iter().chain([&0.0])) {
        state.frames.orientation.set(frame, q);
        q *= rotation::exp(kappa * *distance);
    }
    let mut x = Vector3::new(1.0, 2.0, 3.0);
    for (k, i) in layout.points().enumerate() {
        state.points.position.set(i, x);
        if k < layout.segments() {
            let axes = state.frames.orientation.get(layout.frames().start + k);
            x += axes * (Vector3::z() + sigma) * 8.0;
        }
    }
    (state, EnergyGradient::new(layout, material()))
}

const UNIFORM: [[f64; 6]; 4] = [
    [0.0, 0.0, 0.011, 0.0, 0.0, -4e-3],
    [0.0, 0.0, -0.02, 0.0, 0.0, 2e-3],
    [3e-3, -4e-3, 5e-3, 0.004, 0.002, 1e-3],
    [-2e-3, 1e-3, -0.013, -0.003, 0.006, 3e-3],
];

#[test]
fn uniform_rods_have_the_energy_and_loads_of_the_potential() {
    let law = Homogenised::mean_filament();
    for walls in ALL_WALLS {
        for strain in UNIFORM {
            let energy = |strain: [f64; 6]| {
                let [k1, k2, k3, s1, s2, s3] = strain;
                let (kappa, sigma) = (Vector3::new(k1, k2, k3), Vector3::new(s1, s2, s3));
                let (state, rod) = uniform(walls, kappa, sigma);
                rod.energy(&state)
            };
            let expected = 80.0 * law.energy_density(&strain.into());
            let found = energy(strain);
            assert!(
                (found - expected).abs() < 1e-10 * expected.abs(),
                "{walls:?}"
            );
            let loads = 80.0 * law.loads(&strain.into());
            for k in 0..6 {
                let slope = actin_mechanics::testing::derivative(1e-6, |h| {
                    let mut moved = strain;
                    moved[k] += h;
                    energy(moved)
                });
                assert!(
                    (slope - loads[k]).abs() < 1e-7 * loads.amax(),
                    "{k}, {walls:?}"
                );
            }
        }
    }
}

#[test]
fn twisted_and_pulled_rods_are_balanced_inside() {
    let law = Homogenised::mean_filament();
    let walls = Walls {
        start: true,
        end: true,
    };
    for strain in &UNIFORM[..2] {
        let kappa = Vector3::z() * strain[2];
        let (state, rod) = uniform(walls, kappa, Vector3::z() * strain[5]);
        let (loads, expected) = (loads_of(&rod, &state), law.loads(&(*strain).into()));
        let (points, chain) = (rod.layout().points(), rod.layout().bending_chain());
        let last = points.end - 1;
        for i in points.clone() {
            let pull = loads.force.get(i).norm();
            let at_end = i == points.start || i == last;
            let expected = if at_end { expected[5].abs() } else { 0.0 };
            assert!((pull - expected).abs() < 1e-8, "node {i}: {pull}");
        }
        for i in chain.clone() {
            let end = f64::from(i8::from(i == chain.start) - i8::from(i + 1 == chain.end));
            let torque = loads.torque.get(i) - Vector3::z() * end * expected[2];
            assert!(torque.norm() < 1e-8, "frame {i}: {torque}");
        }
    }
}

#[test]
fn potentials_are_refused_where_unsupported() {
    let mut state = State::default();
    let layout = StraightRod::uniform(3, 10.0).push(&mut state).unwrap();
    let refused = RodElements::at_rest(&state, &layout, material()).unwrap_err();
    assert_eq!(refused, RodError::Potential("RodElements"));
    let refused = PaperBalance::new(layout, material()).unwrap_err();
    assert_eq!(refused, RodError::Potential("PaperBalance"));
    let refused = material().with_twist(TwistLaw::Constant(1e4)).unwrap_err();
    assert_eq!(refused.key, "twist");
    assert!(
        RodMaterial::new(Rigidities::table4())
            .unwrap()
            .potential()
            .is_none()
    );
}
