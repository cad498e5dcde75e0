//! The scenes on which speed was traded for accuracy, every monomer resolved.

use crate::Scene;

const TEXTS: [(&str, &str); 8] = [
    ("cantilever-160", include_str!("scenes/cantilever-160.ron")),
    (
        "cantilever-1600",
        include_str!("scenes/cantilever-1600.ron"),
    ),
    ("linkers-planar", include_str!("scenes/linkers-planar.ron")),
    ("linkers-round", include_str!("scenes/linkers-round.ron")),
    ("twist", include_str!("scenes/twist.ron")),
    ("mid-linker", include_str!("scenes/mid-linker.ron")),
    ("buckling-over", include_str!("scenes/buckling-over.ron")),
    ("buckling-under", include_str!("scenes/buckling-under.ron")),
];

/// What the measured displacement and the local field of a scene are, in words.
pub fn observed(name: &str) -> (&'static str, &'static str) {
    match name {
        "cantilever-160" | "cantilever-1600" => ("tip", "curvature at the wall"),
        "linkers-planar" | "linkers-round" => ("centre line", "curvature at the linker"),
        "twist" => ("far end", "twist in the middle"),
        "mid-linker" => ("centre line", "twist at the linker"),
        _ => ("height", "curvature in the middle"),
    }
}

/// Each scene with its name, by which the table of measurements knows it.
///
/// # Panics
/// Never: the scenes are part of the crate, and a test reads them all.
pub fn all() -> Vec<(&'static str, Scene)> {
    let read = |(name, text)| (name, Scene::from_ron(text).expect("a test reads it"));
    TEXTS.map(read).into()
}

#[cfg(test)]
mod tests {
    use super::all;
    use crate::Assembly;

    /// Lengths of held filaments lie on the lattice, so that no resolution is compared at another
    /// length: a tip would differ by three times the relative difference of length. Free filaments
    /// on linkers differ by up to 1.2 nm beyond the outermost linker, where nothing acts.
    #[test]
    fn lengths_are_those_of_the_lattice() {
        for (name, scene) in all().into_iter().filter(|(_, s)| !s.clamps.is_empty()) {
            let written = scene.filament.sections[0].span_nm().1;
            let resolved = Assembly::build(&scene).unwrap().length_nm();
            assert!((resolved - written).abs() < 1e-9, "{name}: {resolved:?}");
        }
    }
}
