//! States of a run for the page's three-dimensional viewer: which there are, and their file.
//!
//! The viewer itself is `html/viewer.js`. Colours are not stored: the page has those of its
//! palette.

mod snapshot;

pub(super) use snapshot::Snapshot;

use super::report::{View, save};
use serde::Serialize;
use std::path::Path;

/// A state to be looked at.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Shown {
    /// States of one group are compared with one another.
    pub group: String,
    /// Name within the group.
    pub name: String,
    /// Share of rod, for the colour among the group.
    pub share: f64,
    #[serde(flatten)]
    pub snapshot: Snapshot,
}

/// From where a filament is seen first: towards the viewer, and what points upwards.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct Attitude {
    pub towards: [f64; 3],
    pub up: [f64; 3],
}

impl Attitude {
    /// Lab z to the right, lab x upwards, a little from above.
    pub(super) const LYING: Self = Self {
        towards: [0.35, 1.0, 0.15],
        up: [1.0, 0.0, 0.0],
    };
    /// Lab z upwards.
    pub(super) const STANDING: Self = Self {
        towards: [-0.35, -1.0, 0.25],
        up: [0.0, 0.0, 1.0],
    };
}

#[derive(Serialize)]
struct File<'a> {
    attitude: Attitude,
    states: &'a [Shown],
}

/// Writes the states of artefact `id` into the output folder.
///
/// # Errors
/// No states, a number that is not one, a file that cannot be written.
pub(super) fn write(
    id: &str,
    attitude: Attitude,
    states: &[Shown],
    caption: String,
    out: &Path,
) -> Result<View, String> {
    let file = format!("{id}_view.json");
    if states.is_empty() {
        return Err(format!("{file}: no states to show"));
    }
    if let Some(bad) = states.iter().find(|s| !s.snapshot.is_finite()) {
        return Err(format!("{file}: {} {} is not finite", bad.group, bad.name));
    }
    let view = File { attitude, states };
    let text = serde_json::to_string(&view).map_err(|e| format!("{file}: {e}"))?;
    save(out, &file, &text)?;
    Ok(View { file, caption })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::workspace_root;
    use actin_mechanics::Vector3;
    use actin_sim::{Assembly, BodyKind, Scene};

    fn mixed() -> Assembly {
        let path = workspace_root().join("scenarios/figure-5/linkers.ron");
        let text = std::fs::read_to_string(path).unwrap();
        Assembly::build(&Scene::from_ron(&text).unwrap()).unwrap()
    }

    fn shown(assembly: &Assembly) -> Shown {
        Shown {
            group: "a".into(),
            name: "b".into(),
            share: 0.5,
            snapshot: Snapshot::of(assembly, assembly.system.state()),
        }
    }

    /// Every body is there once, where it is. Symptoms of the plausible bugs: a rod one node
    /// short, monomers in the order of something else, a quaternion with its scalar last.
    #[test]
    fn a_snapshot_holds_the_bodies_of_the_assembly() {
        let assembly = mixed();
        let snapshot = shown(&assembly).snapshot;
        let counts = assembly.counts();
        assert_eq!(snapshot.monomers.len(), counts.monomers);
        let segments: usize = snapshot.rods.iter().map(|rod| rod.frames.len()).sum();
        assert_eq!(segments, counts.segments);
        assert!(
            snapshot
                .rods
                .iter()
                .all(|r| r.nodes.len() == r.frames.len() + 1)
        );
        assert_eq!(snapshot.junctions.len(), assembly.junction_bonds().len());
        assert_eq!(snapshot.linkers.len(), assembly.linkers.len());
        assert_eq!(snapshot.line.len(), assembly.points.len());
        let state = assembly.system.state();
        let is_monomer = |i: &usize| assembly.points[*i].kind == BodyKind::Monomer;
        let places = (0..assembly.points.len()).filter(is_monomer);
        for (i, [x, y, z, w, ..]) in places.zip(&snapshot.monomers) {
            let place = Vector3::new(*x, *y, *z);
            // Half a step of rounding in each of three components.
            assert!((place - state.points.position.get(i)).norm() < 0.9e-2);
            let frame = assembly.points[i].frame.unwrap();
            assert!((state.frames.orientation.get(frame).w - w).abs() < 1e-4);
        }
        // The centre line of what is built straight is the axis.
        let on_axis = |p: &[f64; 3]| p[0].hypot(p[1]) < 1e-2;
        assert!(snapshot.line.iter().all(on_axis));
    }

    /// The file reads back as JSON without a null, which is what a number that is none becomes.
    #[test]
    fn a_file_of_states_is_finite_and_small() {
        let folder = tempfile::tempdir().unwrap();
        let shown = shown(&mixed());
        let states = [shown.clone()];
        let view = write("a", Attitude::LYING, &states, "c".into(), folder.path()).unwrap();
        let text = std::fs::read_to_string(folder.path().join(&view.file)).unwrap();
        let value: serde_json::Value = serde_json::from_str(&text).unwrap();
        let monomers = value["states"][0]["monomers"].as_array().unwrap();
        assert_eq!(monomers.len(), shown.snapshot.monomers.len());
        assert!(!text.contains("null"));
        // A body takes 7 numbers, and 3 for its centre line, of at most 8 characters each.
        assert!(text.len() < 100 * shown.snapshot.line.len() + 1000);
        let mut bad = shown;
        bad.snapshot.monomers[0][0] = f64::NAN;
        let refused = write("a", Attitude::LYING, &[bad], "c".into(), folder.path());
        assert!(refused.unwrap_err().contains("not finite"));
        assert!(write("a", Attitude::LYING, &[], "c".into(), folder.path()).is_err());
    }
}
