//! Initial state of a scene.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Initial state of a run. Linkers, loads and stages begin as in the scene.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Start {
    /// Last state of a finished run with the same sections, for example to continue an equilibrium as a motion.
    /// `Dynamics` after `Dynamics` keeps the velocities. Clamped ends stay where that run left them, and stages
    /// move them from there. Filaments begin at the same places. Runs with linkers that bind, moved anchors or a sheared box
    /// are refused.
    Run {
        /// Directory of the run. The path is relative to the scene file, or to the working directory for a scene
        /// from standard input.
        directory: String,
    },
}

#[cfg(test)]
mod tests {
    use crate::SceneText;
    use std::path::Path;

    fn scene(filament: &str) -> SceneText {
        let text = format!(
            "Scene(filament: Filament({filament}), start: Run(directory: \"relaxed\"), task: Equilibrium())"
        );
        let mut text = SceneText::new(&text);
        text.resolve_paths(Path::new("/scenes")).unwrap();
        text
    }

    #[test]
    fn directories_are_relative_to_the_scene_file() {
        let scene = scene("sections: [Rod(from_nm: 0.0, to_nm: 40.0)]");
        let scene = scene.scene().unwrap();
        let expected = Path::new("/scenes/relaxed").display().to_string();
        let again = crate::Scene::from_ron(&scene.to_ron()).unwrap();
        assert_eq!(again, scene);
        let Some(super::Start::Run { directory }) = scene.start else {
            panic!("no start");
        };
        assert_eq!(directory, expected);
    }

    #[test]
    fn other_initial_states_are_refused() {
        let sections = "sections: [Rod(from_nm: 0.0, to_nm: 40.0)]";
        let imperfect = format!("{sections}, imperfection: (amplitude_nm: 0.1, seed: 1)");
        let error = scene(&imperfect).scene().unwrap_err().to_string();
        assert!(
            error.contains("start: replaces the imperfection"),
            "{error}"
        );
        let adaptive = "sections: Adaptive(length_nm: 100.0, want: Tip(error: 0.02))";
        let error = scene(adaptive).scene().unwrap_err().to_string();
        assert!(error.contains("start: needs the sections"), "{error}");
    }
}
