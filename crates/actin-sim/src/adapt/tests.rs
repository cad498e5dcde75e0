//! Derivatives of wanted numbers against differences of equilibria.
//!
//! The theorem: a rod whose rigidity in one direction is larger by a share `e` is strained by `-e` times its strain
//! there under the same loads, and stores `e / 2` times what its load does along that strain more at the same strains.
//! The sum over segments is the derivative of the number by `e`. A plausible bug, an energy without its own part or a
//! linker with the force on the wrong body, is off by a half or has the wrong sign.

use super::adjoint::Adjoint;
use super::equilibrium;
use super::section_loads::{SectionLoads, elastic_energy, segments};
use crate::scene::{Quantity, RodLaw, Scene};
use actin_ellipsoid::SixVector;
use actin_mechanics::Vector3;

/// Rigidities against bending (twice), twist (pN nm^2), shear (twice) and stretch (pN); soft in shear, so that it counts.
const RIGIDITIES: [f64; 6] = [3.9e4, 3.0e4, 1.3e4, 2e2, 3e2, 2e3];
/// Change of a rigidity.
const SHARE: f64 = 1e-3;
/// Segments of the rod. Where loads jump, sums over them are known to the order of their length.
const SEGMENTS: usize = 320;
/// Of the sum of the sizes of what segments contribute.
const TOLERANCE: f64 = 0.01;

/// Pulled aside at its end, held there and halfway by linkers, two of its own places joined.
const HELD_BY_LINKERS: &str = "clamps: [Clamp(end: Start)],
    loads: [EndForce(end: End, force_pn: (-1.0, 0.3, 0.5)), Couple(end: End, couple_pn_nm: (0.0, 5.0, 20.0))],
    linkers: [
        Linker(at_nm: 150.0, radius_nm: 2.0, azimuth_deg: 30.0, displaced_nm: (20.0, 5.0, 0.0), stiffness_pn_per_nm: 0.1),
        Linker(at_nm: 80.0, displaced_nm: (-10.0, 0.0, 4.0), stiffness_pn_per_nm: 0.2, rest_length_nm: 15.0),
        Linker(at_nm: 30.0, to: Site(at_nm: 130.0, radius_nm: 3.0), stiffness_pn_per_nm: 0.05, rest_length_nm: 90.0),
    ],
    task: Equilibrium()";
/// Held at both ends, one of which is moved and turned, and pulled aside between them.
const CLAMPED: &str = "clamps: [Clamp(end: Start), Clamp(end: End)],
    linkers: [Linker(at_nm: 70.0, radius_nm: 2.0, displaced_nm: (0.0, 20.0, 0.0), stiffness_pn_per_nm: 0.5)],
    path: [Stage(set: [
        Shift(end: End, shift_nm: (8.0, 0.0, -2.0)), Turn(end: End, turn_deg: (5.0, 0.0, 40.0)),
    ])],
    task: Equilibrium()";

/// The rod with one rigidity times a factor.
fn scene(rest: &str, direction: usize, factor: f64) -> Scene {
    let mut r = RIGIDITIES;
    r[direction] *= factor;
    Scene::from_ron(&format!(
        "Scene(
            filament: Filament(
                sections: [Rod(from_nm: 0.0, to_nm: 160.0, segments: {SEGMENTS})],
                rod: RodModel(law: Constant, material: Rigidities(
                    bend_pn_nm2: ({:?}, {:?}, {:?}), shear_pn: ({:?}, {:?}, {:?}),
                )),
            ),
            {rest}
        )",
        r[0], r[1], r[2], r[3], r[4], r[5]
    ))
    .unwrap_or_else(|error| panic!("{error}"))
}

/// Derivatives of a number by the share of each rigidity: by the adjoint, the sum of its sizes, and by differences.
fn derivatives(rest: &str, quantity: Quantity) -> Vec<(f64, f64, f64)> {
    let (assembly, state) = equilibrium(&scene(rest, 0, 1.0)).unwrap();
    let adjoint = Adjoint::of(quantity, &assembly, &state).unwrap();
    let loads = SectionLoads::of(&assembly, &state);
    let all = segments(&assembly, &state, &assembly.sections[0]);
    let by_rigidity = |direction: usize| {
        let of_segment = all.iter().map(|segment| {
            let mut defect = SixVector::zeros();
            defect[direction] = -segment.strain[direction];
            let stored = -0.5 * defect.dot(&loads.at(segment.s_nm));
            segment.length_nm * adjoint.change(segment.s_nm, &defect, stored)
        });
        let of_segment: Vec<f64> = of_segment.collect();
        let solved = [1.0 - SHARE, 1.0 + SHARE].map(|factor| {
            let (assembly, state) = equilibrium(&scene(rest, direction, factor)).unwrap();
            Adjoint::value_of(quantity, &assembly, &state)
        });
        (
            of_segment.iter().sum(),
            of_segment.iter().map(|part| part.abs()).sum(),
            (solved[1] - solved[0]) / (2.0 * SHARE),
        )
    };
    (0..6).map(by_rigidity).collect()
}

#[test]
fn numbers_change_with_rigidities_as_their_derivatives_say() {
    let force = |linker: usize| Quantity::LinkerForce { linker };
    let cases = [
        (HELD_BY_LINKERS, Quantity::Energy),
        (HELD_BY_LINKERS, force(0)),
        (HELD_BY_LINKERS, force(1)),
        (HELD_BY_LINKERS, force(2)),
        (HELD_BY_LINKERS, Quantity::Tip),
        (HELD_BY_LINKERS, Quantity::Curvature { at_nm: 100.0 }),
        (CLAMPED, Quantity::Curvature { at_nm: 110.0 }),
        (CLAMPED, Quantity::Energy),
        (CLAMPED, force(0)),
        (CLAMPED, Quantity::EndForce),
        (CLAMPED, Quantity::EndCouple),
    ];
    for (rest, quantity) in cases {
        let rows = derivatives(rest, quantity);
        // Directions of which the number hardly knows are judged by the largest.
        let most = rows.iter().map(|row| row.1).fold(0.0, f64::max);
        for (adjoint, size, difference) in &rows {
            let allowed = TOLERANCE * size.max(0.1 * most);
            assert!(
                (adjoint - difference).abs() < allowed,
                "{quantity:?}: {rows:?}"
            );
        }
    }
}

/// What a law stores per length in uniform strain is what its segments and nodes store together; between walls by which
/// strain is uniform.
#[test]
fn a_twisted_rod_stores_what_its_law_says() {
    let rest = "clamps: [Clamp(end: Start), Clamp(end: End)],
        path: [Stage(set: [Turn(end: End, turn_deg: (0.0, 0.0, 60.0)), Shift(end: End, shift_nm: (0.0, 0.0, -0.2))])],
        task: Equilibrium()";
    for law in [RodLaw::Constant, RodLaw::Fitted] {
        let text =
            "Scene(filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 160.0)]), ".to_owned();
        let mut scene = Scene::from_ron(&(text + rest + ")")).unwrap();
        scene.filament.rod.law = law;
        let (assembly, state) = equilibrium(&scene).unwrap();
        let (material, law) = &assembly.rods[0].law;
        let (twist, stretch) = (60.0_f64.to_radians() / 160.0, -0.2 / 160.0);
        let (sigma, kappa) = (Vector3::z() * stretch, Vector3::z() * twist);
        let stored = 160.0 * law.uniform_energy(material, sigma, kappa);
        let energy = elastic_energy(&assembly, &state);
        assert!((energy - stored).abs() < 1e-6 * energy, "{energy} {stored}");
    }
}
