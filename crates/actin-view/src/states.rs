//! Files of states for comparison in a report, displayed by `js/states.js`.
//!
//! Colours are not stored; the page applies its palette.

use crate::Attitude;
use crate::pose::{Bonds, Pose};
use actin_draw::report::{View, save};
use serde::Serialize;
use std::path::Path;

/// A state of a file.
#[derive(Clone, Debug, Serialize)]
pub struct ViewState {
    /// Group of states that are compared with each other.
    pub group: String,
    /// Name within the group.
    pub name: String,
    /// Fraction of rod, which determines the colour.
    pub share: f64,
    #[serde(flatten)]
    /// Visible bodies.
    pub pose: Pose,
}

#[derive(Serialize)]
struct File {
    attitude: Attitude,
    /// Sets of bonds, to which states refer by index.
    bonds: Vec<Bonds>,
    states: Vec<ViewState>,
}

/// Writes the states of artefact `id` to the output folder.
///
/// # Errors
/// If `states` is empty, a number is not finite, or the file cannot be written.
pub fn write(
    id: &str,
    attitude: Attitude,
    states: &[ViewState],
    caption: String,
    out: &Path,
) -> Result<View, String> {
    let file = format!("{id}_view.json");
    if states.is_empty() {
        return Err(format!("{file}: no states to show"));
    }
    // Numbers that are not finite are written as null.
    let is_finite =
        |s: &&ViewState| serde_json::to_string(&s.pose).is_ok_and(|text| !text.contains("null"));
    if let Some(bad) = states.iter().find(|s| !is_finite(s)) {
        return Err(format!("{file}: {} {} is not finite", bad.group, bad.name));
    }
    let (mut bonds, mut states) = (Vec::new(), states.to_vec());
    for state in &mut states {
        state.pose.share_bonds(&mut bonds);
    }
    let view = File {
        attitude,
        bonds,
        states,
    };
    let text = serde_json::to_string(&view).map_err(|e| format!("{file}: {e}"))?;
    save(out, &file, &text)?;
    Ok(View { file, caption })
}

#[cfg(test)]
mod tests {
    use super::*;
    use actin_sim::mechanics::Vector3;
    use actin_sim::{Assembly, BodyKind, Scene};

    fn text(scene: &str) -> String {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios");
        let path = Path::new(path).join(scene);
        std::fs::read_to_string(path).unwrap()
    }

    fn assembled(text: &str) -> Assembly {
        Assembly::build(&Scene::from_ron(text).unwrap()).unwrap()
    }

    fn built(scene: &str) -> Assembly {
        assembled(&text(scene))
    }

    fn mixed() -> Assembly {
        built("figure-5/linkers.ron")
    }

    fn shown(assembly: &Assembly) -> ViewState {
        ViewState {
            group: "a".into(),
            name: "b".into(),
            share: 0.5,
            pose: Pose::new(assembly, assembly.system.state()),
        }
    }

    fn monomers(pose: &Pose) -> Vec<[f64; 7]> {
        let strands = pose.strands.iter();
        strands.flat_map(|s| s.monomers.clone()).collect()
    }

    #[test]
    fn a_pose_holds_the_bodies_of_the_assembly() {
        for assembly in [mixed(), built("crosslinked.ron")] {
            let pose = shown(&assembly).pose;
            let counts = assembly.counts();
            let monomers = monomers(&pose);
            assert_eq!(monomers.len(), counts.monomers);
            let segments: usize = pose.rods.iter().map(|rod| rod.frames.len()).sum();
            assert_eq!(segments, counts.segments);
            let mut rods = pose.rods.iter();
            assert!(rods.all(|r| r.nodes.len() == r.frames.len() + 1));
            assert_eq!(pose.junctions.len(), assembly.junction_bonds().len());
            assert_eq!(pose.linkers.len(), assembly.linkers.len());
            assert_eq!(pose.clamps.len(), assembly.clamps.len());
            let lines: Vec<usize> = pose.lines.iter().map(Vec::len).collect();
            let spans = assembly.filaments.iter().map(|f| f.points.len());
            assert!(lines.into_iter().eq(spans));
            let state = assembly.system.state();
            let is_monomer = |i: &usize| assembly.points[*i].kind == BodyKind::Monomer;
            let places = (0..assembly.points.len()).filter(is_monomer);
            for (i, [x, y, z, w, ..]) in places.zip(&monomers) {
                let place = Vector3::new(*x, *y, *z);
                // Rounding of three components by half a step.
                assert!((place - state.points.position.get(i)).norm() < 0.9e-2);
                let frame = assembly.points[i].frame.unwrap();
                assert!((state.frames.orientation.get(frame).w - w).abs() < 1e-4);
            }
            // An initially straight filament lies on its own axis.
            for (line, filament) in pose.lines.iter().zip(&assembly.filaments) {
                let off_axis = |p: &[f64; 3]| {
                    let place = filament.to_filament_frame(Vector3::from(*p));
                    place.x.hypot(place.y)
                };
                assert!(line.iter().all(|p| off_axis(p) < 1e-2));
            }
        }
    }

    #[test]
    fn linked_filaments_keep_their_sites_and_bonds_apart() {
        let assembly = built("crosslinked.ron");
        let mut pose = shown(&assembly).pose;
        assert!(pose.anchors.is_empty() && pose.linkers.len() == 4);
        // Sites on neighbouring filaments are 8.4 nm apart.
        for [ax, ay, az, bx, by, bz] in &pose.linkers {
            let gap = Vector3::new(bx - ax, by - ay, bz - az).norm();
            assert!((gap - 8.4).abs() < 0.02, "{gap}");
        }
        let sets = |pose: &mut Pose| -> Vec<usize> {
            pose.share_bonds(&mut Vec::new());
            pose.strands.iter().map(|s| s.bonds).collect()
        };
        assert_eq!(sets(&mut pose), [0; 5]);
        let drawn = "monomers: Monomers(anchors: Independent), sections: [";
        let drawn = assembled(&text("crosslinked.ron").replace("sections: [", drawn));
        assert_eq!(sets(&mut shown(&drawn).pose), [0, 1, 1, 2, 2]);
        let anchored = shown(&mixed()).pose;
        assert_eq!(anchored.anchors.len(), anchored.linkers.len());
    }

    /// The displayed bonds are bonds of the model: in the initial state their lengths are the rest lengths.
    #[test]
    fn displayed_bonds_are_bonds_of_the_model() {
        let assembly = mixed();
        let mut pose = shown(&assembly).pose;
        let mut sets = Vec::new();
        pose.share_bonds(&mut sets);
        let strand = &pose.strands[0];
        let to_lab = |k: usize, anchor: &[i16]| {
            let [x, y, z, w, i, j, l] = strand.monomers[k];
            let arm = Vector3::from_iterator(anchor.iter().map(|a| f64::from(*a) * 1e-2));
            let axis = Vector3::new(i, j, l);
            let aside = 2.0 * axis.cross(&arm);
            Vector3::new(x, y, z) + arm + w * aside + axis.cross(&aside)
        };
        let section = assembly
            .sections
            .iter()
            .position(actin_sim::SectionSpan::is_ellipsoids);
        let model = assembly.bonds_of(section.unwrap()).unwrap();
        let mut seen = 0;
        for pair in model.pairs() {
            let index = strand.first + i64::try_from(pair.lower).unwrap();
            let both = sets[strand.bonds].at_monomer(index).unwrap();
            let drawn = both[pair.upper - pair.lower - 1].chunks(6);
            for (drawn, bond) in drawn.zip(model.bonds_of(pair)) {
                let ends = [(pair.lower, &drawn[..3]), (pair.upper, &drawn[3..])];
                let [lower, upper] = ends.map(|(k, anchor)| to_lab(k, anchor));
                // Rounding of two centres, two anchors and two quaternions at 2.7 nm.
                let length = (upper - lower).norm();
                assert!((length - bond.rest_length).abs() < 0.04, "{pair:?}");
                seen += 1;
            }
        }
        assert_eq!(seen, 8 * model.pairs().len());
    }

    #[test]
    fn a_file_of_states_is_finite_and_small() {
        let folder = tempfile::tempdir().unwrap();
        let shown = shown(&mixed());
        let states = [shown.clone()];
        let view = write(
            "a",
            Attitude::HORIZONTAL,
            &states,
            "c".into(),
            folder.path(),
        )
        .unwrap();
        let text = std::fs::read_to_string(folder.path().join(&view.file)).unwrap();
        let value: serde_json::Value = serde_json::from_str(&text).unwrap();
        let strand = &value["states"][0]["strands"][0];
        let monomers = strand["monomers"].as_array().unwrap();
        assert_eq!(monomers.len(), shown.pose.strands[0].monomers.len());
        assert!(!text.contains("null"));
        // A body takes 7 numbers and 3 for its centre line, of at most 8 characters. A monomer takes 16 bonds of 6
        // numbers of at most 5 characters, and their keys.
        let bodies = shown.pose.lines[0].len();
        let all = value["states"][0]["strands"].as_array().unwrap().iter();
        let all: usize = all.map(|s| s["monomers"].as_array().unwrap().len()).sum();
        assert!(text.len() < 100 * bodies + 500 * all + 1000);
        // A second state with the same monomers adds no bonds.
        let states = [shown.clone(), shown.clone()];
        let view = write(
            "b",
            Attitude::HORIZONTAL,
            &states,
            "c".into(),
            folder.path(),
        )
        .unwrap();
        let twice = std::fs::read_to_string(folder.path().join(&view.file)).unwrap();
        assert!(twice.len() - text.len() < 100 * bodies + 1000);
        let mut bad = shown;
        bad.pose.strands[0].monomers[0][0] = f64::NAN;
        let refused = write("a", Attitude::HORIZONTAL, &[bad], "c".into(), folder.path());
        assert!(refused.unwrap_err().contains("not finite"));
        assert!(write("a", Attitude::HORIZONTAL, &[], "c".into(), folder.path()).is_err());
    }
}
