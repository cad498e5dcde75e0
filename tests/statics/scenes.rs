//! All scenes of the repository: good ones build, bad ones give their error messages.

use actin_sim::{Assembly, Estimate, Scene, SceneError, SceneProblem};
use std::fs;
use std::path::{Path, PathBuf};

fn scenarios() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios")
}

fn scenes(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path());
    let mut all: Vec<PathBuf> = entries
        .flat_map(|path| match path.is_dir() {
            true if path.ends_with("bad") => Vec::new(),
            true => scenes(&path),
            false => vec![path],
        })
        .filter(|path| path.extension().is_some_and(|extension| extension == "ron"))
        .filter(|path| !path.to_string_lossy().ends_with("-sweep.ron"))
        .collect();
    all.sort();
    all
}

fn check(text: &str) -> Result<(Assembly, Option<Estimate>), SceneError> {
    let scene = Scene::from_ron(text)?;
    let build = || -> Result<_, SceneProblem> {
        let assembly = Assembly::build(&scene)?;
        let estimate = actin_sim::Plan::new(&assembly)?.estimate().copied();
        Ok((assembly, estimate))
    };
    build().map_err(|problem| SceneError::locate(&problem, text))
}

#[test]
fn good_scenes_read_build_and_have_a_stable_step() {
    let all = scenes(&scenarios());
    assert!(all.len() >= 10, "{all:?}");
    for path in all {
        let (assembly, estimate) = check(&fs::read_to_string(&path).unwrap())
            .unwrap_or_else(|error| panic!("{}:{error}", path.display()));
        if let Some(estimate) = estimate {
            assert!(estimate.time_step_ns <= estimate.stability_limit_ns);
        }
        let again = Scene::from_ron(&assembly.scene.to_ron()).unwrap();
        assert_eq!(again, assembly.scene, "{}", path.display());
    }
}

/// Each bad scene starts with its message: position, key, value and rule. Positions count the
/// comment line; text after dots depends on the machine.
#[test]
fn bad_scenes_give_their_messages() {
    let folder = scenarios().join("bad");
    let all = scenes(&folder);
    assert!(all.len() >= 200, "{}", all.len());
    for path in all {
        let text = fs::read_to_string(&path).unwrap();
        let first = text.lines().next().unwrap();
        let expected = first.strip_prefix("// expect: ").unwrap();
        let found = check(&text).err().map(|error| error.to_string());
        let found = found.unwrap_or_default();
        match expected.strip_suffix("...") {
            Some(start) => assert!(found.starts_with(start), "{}: {found}", path.display()),
            None => assert_eq!(found, expected, "{}", path.display()),
        }
    }
}
