//! Reads a scene, prints a mistake with its place, and writes the scene with every default.

use actin_scene::{Scene, SceneError};

const TEXT: &str = "Scene(
    filament: Filament(sections: [
        Ellipsoids(from_nm: 0.0, to_nm: 40.0),
        Rod(from_nm: 40.0, to_nm: 160.0),
    ]),
    clamps: [Clamp(end: Start)],
    loads: [EndForce(end: End, force_pn: (0.1, 0.0, 0.0))],
    task: Equilibrium(),
)";

fn main() -> Result<(), SceneError> {
    let scene = Scene::from_ron(TEXT)?;
    let sections = &scene.filament.sections;
    println!("{} sections", sections.len());
    assert_eq!(sections[1].span_nm(), (40.0, 160.0));

    let gap = TEXT.replace("Rod(from_nm: 40.0", "Rod(from_nm: 45.0");
    let error = Scene::from_ron(&gap).unwrap_err();
    println!("{error}");
    assert_eq!((error.line, error.column), (4, 13));

    let written = scene.to_ron();
    println!("{written}");
    assert_eq!(Scene::from_ron(&written)?, scene);
    Ok(())
}
