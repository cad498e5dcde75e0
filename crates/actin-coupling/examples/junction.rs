//! Extension of a junction between a monomer and the start of a rod.

use actin_coupling::{
    AttachedMonomer, CrossSection, Frame, Inertia, Interaction, Junction, JunctionParts,
    JunctionSide, JunctionWeight, Loads, Point, Rigidities, RodMaterial, State, StraightRod,
    UnitQuaternion, Vector3, push_junction_frames,
};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // One monomer 2 nm before the start of a rod along z, on its axis. Bodies are in filament
    // order.
    let (mut state, along_z) = (State::default(), UnitQuaternion::identity());
    let (position, mass) = (Vector3::z() * -2.0, 0.0697);
    let inertia = Inertia::from_moments([0.2, 0.15, 0.15])?;
    let monomer = AttachedMonomer {
        point: state.points.push(Point { position, mass }),
        frame: state.frames.push(Frame {
            orientation: along_z,
            inertia,
        }),
    };
    let frames = push_junction_frames(&mut state, along_z, &[2.0], &CrossSection::actin())?;
    let rod = StraightRod::uniform(4, 10.0).push(&mut state)?;
    let parts = JunctionParts {
        side: JunctionSide::MonomersFirst,
        weight: JunctionWeight::Shared,
        monomers: &[monomer],
        frames,
        rod: &rod,
        material: RodMaterial::new(Rigidities::table4())?,
    };
    let junction = Junction::new(&state, parts)?;

    // Extension by 0.001 nm over 2 nm; the rigidity is S3 = 3.4e4 pN.
    state
        .points
        .position
        .add(monomer.point, Vector3::z() * -1e-3);
    let mut loads = Loads::zeros(&state);
    junction.add_loads(&state, &mut loads);
    let force = loads.force.get(monomer.point).z;
    println!("force: {force:.6} pN; S3 strain = 17 pN");
    assert!((force - 17.0).abs() < 1e-9);
    Ok(())
}
