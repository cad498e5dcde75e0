//! Filaments and states for the tests of pictures.

use actin_sim::mechanics::{State, Xorshift, perturb};
use actin_sim::{Assembly, Scene};
use vtkio::model::{DataSet, Piece, PolyDataPiece, Vtk};

/// Monomers at a clamped start, followed by a rod.
const MIXED: &str = "Scene(
    filament: Filament(
        sections: [Ellipsoids(from_nm: 0.0, to_nm: 12.0), Rod(from_nm: 12.0, to_nm: 42.0)],
        monomers: Monomers(anchors: Independent),
    ),
    clamps: [Clamp(end: Start)],
    task: Dynamics(duration_ns: 1.0),
)";

pub(super) fn mixed() -> Assembly {
    Assembly::build(&Scene::from_ron(MIXED).unwrap()).unwrap()
}

/// Builds the filament of [`mixed`] and a second one with other monomers.
pub(super) fn pair() -> Assembly {
    let mut scene = Scene::from_ron(MIXED).unwrap();
    let mut other = scene.filament.clone();
    other.at_nm = [9.0, 0.0, 2.0];
    other.monomers.semi_axes_nm = [2.0, 2.0, 2.0];
    scene.other_filaments.push(other);
    Assembly::build(&scene).unwrap()
}

/// Random state near rest.
pub(super) fn state(assembly: &Assembly) -> State {
    let mut state = assembly.rest.clone();
    perturb(&mut state, &mut Xorshift::new(7), 0.1, 0.05);
    state
}

/// Parses a picture with vtkio, which is independent of the writer.
pub(super) fn parsed(picture: &[u8]) -> Box<PolyDataPiece> {
    let DataSet::PolyData { mut pieces, .. } = Vtk::parse_xml(picture).unwrap().data else {
        panic!("not PolyData");
    };
    let Piece::Inline(piece) = pieces.remove(0) else {
        panic!("not inline");
    };
    piece
}
