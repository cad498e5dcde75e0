//! Filaments of 60 nm of every kind, held and free, for the tests of this module.

use crate::{Assembly, Scene};

pub(super) const SECTIONS: [&str; 4] = [
    "Rod(from_nm: 0.0, to_nm: 60.0)",
    "Ellipsoids(from_nm: 0.0, to_nm: 60.0)",
    "Ellipsoids(from_nm: 0.0, to_nm: 30.0), Rod(from_nm: 30.0, to_nm: 60.0)",
    "Rod(from_nm: 0.0, to_nm: 20.0), Ellipsoids(from_nm: 20.0, to_nm: 40.0),
     Rod(from_nm: 40.0, to_nm: 60.0)",
];
pub(super) const CLAMPS: [&str; 3] = [
    "",
    "Clamp(end: Start)",
    "Clamp(end: Start), Clamp(end: End)",
];

pub(super) fn build(sections: &str, clamps: &str) -> Assembly {
    let text = format!(
        "Scene(
            filament: Filament(sections: [{sections}]),
            clamps: [{clamps}],
            task: Equilibrium(),
        )"
    );
    Assembly::build(&Scene::from_ron(&text).unwrap()).unwrap()
}
