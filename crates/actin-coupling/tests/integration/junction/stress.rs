use super::{JunctionParts, all, filament};
use actin_cosserat::{EnergyGradient, Homogenised, RodMaterial, SegmentCurvature, SegmentLaw};
use actin_coupling::{Junction, JunctionSide};
use actin_mechanics::testing::assert_fluctuates;
use actin_mechanics::{State, Vector3};

/// Stretches the filament by 0.1 % along the axis.
fn stretch(state: &mut State) {
    for i in 0..state.points.len() {
        let x = state.points.position.get(i);
        let stretched = Vector3::new(x.x, x.y, 1.001 * x.z);
        state.points.position.set(i, stretched);
    }
}

#[test]
fn stress_has_the_covariance_of_the_stiffness() {
    for (side, weight, attached) in all() {
        let mut filament = filament(side, attached);
        let junction = filament.junction(side, weight);
        stretch(&mut filament.state);
        assert_fluctuates(&[&junction], &filament.state, 1e-12);
    }
}

/// Random stress of rod and junction, with half of the end segment counted once. The stretch gives
/// shear a geometric stiffness.
#[test]
fn stress_beside_an_extended_rod_has_the_covariance_of_the_stiffness() {
    let material = RodMaterial::homogenised(Homogenised::mean_filament_at_298_k());
    let law = SegmentLaw::from_material(&material, None).unwrap();
    for (side, weight, attached) in all() {
        let mut filament = filament(side, attached);
        let parts = JunctionParts {
            material,
            ..filament.parts(side, weight)
        };
        let junction = Junction::new(&filament.state, parts).unwrap();
        let joined = junction.joined_elements();
        let (start, end): (&[_], &[_]) = match side {
            JunctionSide::MonomersFirst => (&joined, &[]),
            JunctionSide::RodFirst => (&[], &joined),
        };
        let curvature = SegmentCurvature::new(&filament.rod, start, end);
        let rod = EnergyGradient::new(filament.rod.clone(), material);
        let rod = rod.with_extension(law, curvature);
        stretch(&mut filament.state);
        let junction = junction.with_extended_rod();
        assert_fluctuates(&[&rod, &junction], &filament.state, 1e-10);
    }
}
