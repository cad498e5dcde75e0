//! Closed forms for rods, monomers and mixed filaments under the protocols.

use super::sweep::far_end_shift;
use super::*;
use actin_sim::{End, Filament, ForceLaw, Hold, Monomers, RodLaw, RodModel, Scene, Section, Solve};
use std::f64::consts::PI;

/// Rise and distance from the axis (nm), turn (rad) of the default monomers.
fn helix() -> (f64, f64, f64) {
    let m = Monomers::default();
    (m.rise_nm, m.radius_nm, m.turn_deg.to_radians())
}

fn rod(length_nm: f64, segments: usize) -> Specimen {
    Specimen::rod(
        length_nm,
        Some(segments),
        RodModel::with_law(RodLaw::Constant),
    )
}

/// A filament with this number of rises and 160 bonds per interface.
fn monomers(rises: f64, seed: u64) -> Specimen {
    let monomers = Monomers::with_sampled_bonds(160, seed);
    Specimen::ellipsoids(rises * monomers.rise_nm, monomers)
}

/// Checks that the relative differences of the secants from `expected` are within `tolerance`.
fn assert_all(secants: impl IntoIterator<Item = f64>, expected: f64, tolerance: f64) {
    let mut count = 0;
    for secant in secants {
        let error = (secant / expected - 1.0).abs();
        assert!(error <= tolerance, "{secant} for {expected}: {error:.2e}");
        count += 1;
    }
    assert!(count > 0, "the curve has no points");
}

/// Strains of a rod under end couples and axial force are uniform, so that the secants equal the
/// rigidities of the material at every load and segment length.
#[test]
fn a_rod_has_the_rigidities_of_its_material() {
    let rod = rod(75.0, 7);
    let b3 = twist(&rod, &[-200.0, -10.0, 10.0, 200.0]).unwrap();
    // Newton's tolerance is 1e-7 pN and pN nm; couples exceed 30 pN nm and forces 1 pN.
    assert_all(b3.points.iter().map(|p| p.rigidity_pn_nm2), 1.3e4, 1e-7);
    assert!(
        b3.points
            .iter()
            .all(|p| p.relative_length_change.abs() < 1e-9)
    );
    let s3 = stretch_by_force(&rod, &[-10.0, 1.0, 300.0]).unwrap();
    assert_all(s3.points.iter().map(|p| p.rigidity_pn), 3.4e4, 1e-6);
    let s3 = stretch_by_shift(&rod, &[-0.001, 0.01]).unwrap();
    assert_all(s3.points.iter().map(|p| p.rigidity_pn), 3.4e4, 1e-6);
    for azimuth in [0.0, 77.0] {
        let b1 = bend_by_couples(&rod, &[-0.01, 0.001, 0.02], azimuth).unwrap();
        assert_all(b1.points.iter().map(|p| p.rigidity_pn_nm2), 3.9e4, 1e-7);
        assert!(b1.points.iter().all(|p| p.cross_couple_pn_nm < 1e-6));
    }
    for point in &b3.points {
        assert!(point.evidence.is_stable());
    }
}

/// The elastica recovers the rigidity of a cantilever where the error of linear theory is 10 %.
#[test]
fn the_elastica_of_a_tip_force_gives_back_the_rigidity() {
    let curve = bend_by_tip_force(&rod(160.0, 64), &[0.02, 2.0], 30.0).unwrap();
    let (small, large) = (&curve.points[0], &curve.points[1]);
    // The discretisation error is 0.2 % for 16 segments, a sixteenth of that for 64; shear adds 3 B
    // / S1 L^2 = 2.9e-4.
    let tolerance = 1e-3;
    assert_all([small.elastica_rigidity_pn_nm2], 3.9e4, tolerance);
    assert_all([large.elastica_rigidity_pn_nm2], 3.9e4, tolerance);
    assert!(large.linear_rigidity_pn_nm2 > 1.1 * 3.9e4);
}

/// Guided Timoshenko beam: `d / L = F (L^2 / 12 B + 1 / S1)`, with a small `S1`.
#[test]
fn a_rod_that_is_soft_in_shear_shows_its_shearing_rigidity() {
    let model = RodModel {
        material: actin_sim::Material::Rigidities {
            shear_pn: [50.0, 50.0, 3.4e4],
            bend_pn_nm2: [3.9e4, 3.9e4, 1.3e4],
        },
        ..RodModel::with_law(RodLaw::Constant)
    };
    let curve = shear_by_force(&Specimen::rod(80.0, Some(64), model), &[0.01], 20.0).unwrap();
    let point = &curve.points[0];
    // Bending is 40 % of the displacement; its discretisation error is 2 (h / L)^2 = 5e-4.
    let bending = point.force_pn * curve.length_nm.powi(2) / (12.0 * 3.9e4);
    assert_all([point.force_pn / (point.shear - bending)], 50.0, 1e-3);
    assert!(point.apparent_rigidity_pn < 0.8 * 50.0);
}

/// If both kinds of interfaces keep the distance of their centres, twist changes radius and length
/// together. Turn `t` and rise `z` per monomer satisfy the equation below for neighbours, and with
/// `2 t` and `2 z` for second neighbours. The result is `dz / dt = R^2 sin t / z = -0.2831 nm`.
///
/// ```text
/// 2 (1 - cos t) R dR + R^2 sin t dt + z dz = 0
/// ```
#[test]
fn small_twist_changes_the_length_as_for_inextensible_interfaces() {
    let (rise, radius, turn) = helix();
    let expected = radius.powi(2) * turn.sin() / rise;
    assert!((expected + 0.2831).abs() < 1e-4);
    for seed in 0..3 {
        let curve = twist(&monomers(109.0, seed), &[-1.0, 1.0]).unwrap();
        let [under, over] = [&curve.points[0], &curve.points[1]];
        let change = over.relative_length_change - under.relative_length_change;
        let slope = change / (over.curvature_rad_per_nm - under.curvature_rad_per_nm);
        // End effects and sampling: 0.002 at 27 rises, decreasing with length to 0.0002 here.
        assert!((slope - expected).abs() < 6e-4, "{slope}");
    }
}

/// Upper bound: springs of rigidity `S_perp` and `S_par` between centres, strained uniformly with
/// free radius and held turn. It is below the bound `2 S_par (2 z)` of two strands.
#[test]
fn stretching_stays_below_the_uniformly_strained_springs() {
    let m = Monomers::default();
    let (rise, radius, turn) = helix();
    let spring = |rigidity: f64, steps: f64| {
        let (across, along) = (2.0 * (1.0 - (steps * turn).cos()), (steps * rise).powi(2));
        let length = (radius.powi(2) * across + along).sqrt();
        (rigidity, across / length, along / length)
    };
    let (k1, a1, b1) = spring(m.lateral_rigidity_pn_per_nm, 1.0);
    let (k2, a2, b2) = spring(m.longitudinal_rigidity_pn_per_nm, 2.0);
    let uniform = (a1 * b2 - a2 * b1).powi(2) / (a1 * a1 / k2 + a2 * a2 / k1) / rise;
    let strands = 2.0 * m.longitudinal_rigidity_pn_per_nm * 2.0 * rise;
    assert!((uniform - 3.47e4).abs() < 50.0 && (strands - 3.67e4).abs() < 50.0);
    for seed in 0..2 {
        let by_force = stretch_by_force(&monomers(109.0, seed), &[100.0]).unwrap();
        let measured = by_force.points[0].rigidity_pn;
        // Rotations of monomers with sampled bonds, and the ends, reduce the rigidity by 2 to 3 %.
        assert!(
            measured < uniform && measured > 0.96 * uniform,
            "{measured}"
        );
        let by_shift = stretch_by_shift(&monomers(109.0, seed), &[by_force.points[0].strain]);
        assert_all([by_shift.unwrap().points[0].rigidity_pn], measured, 1e-6);
    }
}

/// Torques at the two ends balance without lateral forces. A mixed filament twists as much as its
/// parts in series.
#[test]
fn mixed_filaments_are_measured_like_any_other() {
    let monomers = Section::Ellipsoids {
        from_nm: 0.0,
        to_nm: 40.0,
        altered: None,
    };
    let mixed = Specimen::new(Filament {
        rod: RodModel::with_law(RodLaw::Constant),
        ..Filament::new(vec![monomers, Section::rod(40.0, 80.0, Some(4))])
    });
    let whole = Specimen::ellipsoids(80.0, Monomers::default());
    let turns = [40.0, 80.0];
    let curve = twist(&mixed, &turns).unwrap();
    let softer = twist(&whole, &turns).unwrap();
    for (point, monomers) in curve.points.iter().zip(&softer.points) {
        assert!((point.torque_pn_nm + point.near_torque_pn_nm).abs() < 1e-5);
        // The rigidity is larger than for monomers alone, whose secant grows with the twist, and
        // smaller than for the rod.
        assert!(point.rigidity_pn_nm2 > monomers.rigidity_pn_nm2);
        assert!(point.rigidity_pn_nm2 < 1.3e4);
        assert!(point.evidence.is_stable() && point.relative_length_change < 0.0);
    }
    let bent = bend_by_couples(&mixed, &[0.01], 0.0).unwrap();
    let couples = bent.points[0].couple_pn_nm + bent.points[0].near_couple_pn_nm;
    assert!(couples.abs() < 1e-5);
}

/// The scenes in `scenarios/rigidity` give the results of the protocols.
#[test]
fn scenes_give_what_the_protocols_give() {
    let run = |name: &str| {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios/rigidity/");
        let scene = Scene::from_path(format!("{folder}{name}.ron")).unwrap();
        let solution = scene.solve().unwrap();
        let assembly = &solution.assembly;
        (
            solution.end_reaction(End::End).unwrap(),
            far_end_shift(assembly, solution.state()).z,
            assembly.length_nm(),
        )
    };
    let specimen = Specimen::ellipsoids(73.94, Monomers::default());
    let (reaction, _, length) = run("twist");
    let b3 = reaction.torque_pn_nm[2] * length / (120.0 * PI / 180.0);
    let curve = twist(&specimen, &[40.0, 80.0, 120.0]).unwrap();
    // Both solve to 1e-7, for torques of 340 pN nm and a displacement of 0.2 nm.
    assert_all([b3], curve.points[2].rigidity_pn_nm2, 1e-8);
    let (_, shift, length) = run("stretch");
    let curve = stretch_by_force(&specimen, &[1.0, 10.0, 100.0]).unwrap();
    assert_all([100.0 * length / shift], curve.points[2].rigidity_pn, 1e-7);
    let (reaction, _, _) = run("bend");
    let specimen = Specimen::ellipsoids(150.6154, Monomers::default());
    let curve = bend_by_couples(&specimen, &[0.01], 0.0).unwrap();
    // The file rounds the turn of 86 deg to 1e-4 deg.
    assert_all(
        [reaction.torque_pn_nm[0] / 0.01],
        curve.points[0].rigidity_pn_nm2,
        1e-5,
    );
}

#[test]
fn values_and_models_that_cannot_be_measured_are_refused() {
    let rod = rod(40.0, 4);
    for bad in [0.0, f64::NAN, f64::INFINITY] {
        let refused = twist(&rod, &[10.0, bad]);
        assert!(
            matches!(
                refused,
                Err(MeasureError::Value {
                    name: "turn_deg",
                    ..
                })
            ),
            "{bad}"
        );
    }
    assert!(matches!(
        stretch_by_force(&rod, &[]),
        Err(MeasureError::Value { .. })
    ));
    let negative = Specimen::rod(-1.0, None, RodModel::default());
    assert!(matches!(
        twist(&negative, &[10.0]),
        Err(MeasureError::Refused(_))
    ));
    assert!(matches!(
        bend_by_couples(&negative, &[0.1], 0.0),
        Err(MeasureError::Refused(_))
    ));
    let held = Specimen {
        hold: Hold::NodeAndFrame,
        ..rod
    };
    assert!(twist(&held, &[10.0]).is_ok());
}

/// The balance law has no potential and thus no equilibrium of least energy.
#[test]
fn rods_without_a_potential_are_refused() {
    let model = RodModel {
        force_law: ForceLaw::PaperBalance,
        ..RodModel::with_law(RodLaw::Constant)
    };
    let refused = twist(&Specimen::rod(40.0, Some(4), model), &[10.0]);
    assert!(
        matches!(refused, Err(MeasureError::Refused(_))),
        "{refused:?}"
    );
}

/// A path that ends early keeps its points and lists the remaining values.
#[test]
fn values_that_are_not_reached_are_named() {
    let mut specimen = monomers(13.0, 0);
    specimen.solver.iterations = 1;
    specimen.solver.smallest_step = 0.5;
    let curve = twist(&specimen, &[90.0, 180.0]).unwrap();
    let missing: Vec<f64> = curve.unreached.iter().map(|u| u.value).collect();
    assert_eq!(missing, [90.0, 180.0]);
    assert!(curve.points.is_empty() && !curve.unreached[0].reason.is_empty());
}

/// Twelve quadrature bonds agree with 4096 sampled bonds per interface within 4 % in twist, 0.2 %
/// in stretch and 1 % in bending. The minimum bond length is 0.2 nm. Twist and bending are cubic
/// and sensitive to the moments of `1/L^2` and `1/L^3`.
#[test]
fn twelve_quadrature_bonds_equal_thousands_of_sampled_bonds() {
    let both = [Monomers::default(), Monomers::with_sampled_bonds(4096, 1)].map(|monomers| {
        let monomers = Monomers {
            min_bond_nm: 0.2,
            ..monomers
        };
        Specimen::ellipsoids(13.0 * monomers.rise_nm, monomers)
    });
    let b3 = |s: &Specimen| twist(s, &[-60.0, 60.0]).unwrap().points[0].rigidity_pn_nm2;
    let s3 = |s: &Specimen| stretch_by_force(s, &[50.0]).unwrap().points[0].rigidity_pn;
    let b1 = |s: &Specimen| bend_by_couples(s, &[1e-2], 0.0).unwrap().points[0].rigidity_pn_nm2;
    let measured = both.each_ref().map(|s| [b3(s), s3(s), b1(s)]);
    for (k, tolerance) in [0.04, 2e-3, 0.01].into_iter().enumerate() {
        let [weighted, drawn] = measured.map(|rigidities| rigidities[k]);
        println!("{k}: {weighted:.5e} weighted, {drawn:.5e} drawn");
        assert!((weighted / drawn - 1.0).abs() < tolerance, "{k}");
    }
}

/// Quadrature bonds have no samplings: a seed other than 0 is an error.
#[test]
fn weighted_bonds_have_no_samplings() {
    let monomers = Monomers::default();
    let specimen = Specimen::ellipsoids(9.0 * monomers.rise_nm, monomers);
    let measured = over_samplings_and_azimuths(&specimen, &[0, 1], &[0.0], |s, _| {
        stretch_by_force(s, &[10.0])
    });
    let message = measured.unwrap_err().to_string();
    assert!(
        message.contains("quadrature bonds are not sampled"),
        "{message}"
    );
}
