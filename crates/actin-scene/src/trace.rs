//! Files of scenes: points of shapes, runs of initial states.

use super::SceneProblem;
use super::tree::{Kind, SceneValue};
use std::path::Path;

/// Replaces every `Points(file: ...)` by the points of the file, and the directory of `start` by its absolute
/// path. Paths are relative to `folder`.
///
/// # Errors
/// A file that cannot be read, or an invalid row.
pub(super) fn resolve_paths(scene: &mut SceneValue, folder: &Path) -> Result<(), SceneProblem> {
    for value in scene.children_mut() {
        match value.key() {
            Some("filament") => read_filament(value, "filament", folder)?,
            Some("filaments") => {
                for (i, filament) in value.children_mut().iter_mut().enumerate() {
                    read_filament(filament, &format!("filaments[{i}]"), folder)?;
                }
            }
            Some("start") => resolve_start(value, folder),
            _ => {}
        }
    }
    Ok(())
}

fn resolve_start(start: &mut SceneValue, folder: &Path) {
    for value in start.children_mut() {
        if let (Some("directory"), Kind::Text(directory)) = (value.key.as_deref(), &mut value.kind)
        {
            // Fails for empty paths only, which are no run.
            if let Ok(path) = std::path::absolute(folder.join(&*directory)) {
                *directory = path.display().to_string();
            }
        }
    }
}

fn read_filament(filament: &mut SceneValue, key: &str, folder: &Path) -> Result<(), SceneProblem> {
    let mut keys = filament.children_mut().iter_mut();
    let Some(shape) = keys.find(|value| value.key() == Some("shape")) else {
        return Ok(());
    };
    let Kind::Group(_, values) = &mut shape.kind else {
        return Ok(());
    };
    // An empty list counts as absent.
    values.retain(|value| !(value.key() == Some("nm") && value.kind == Kind::List(Vec::new())));
    for value in values {
        let Kind::Text(file) = &value.kind else {
            continue;
        };
        if value.key() != Some("file") {
            continue;
        }
        let points = points(&folder.join(file)).map_err(|rule| {
            SceneProblem::new(format!("{key}.shape.file"), format!("{file:?}"), rule)
        })?;
        let point = |point: [f64; 3]| {
            let numbers = point.map(|x| SceneValue::from(Kind::Number(x)));
            SceneValue::from(Kind::Group(None, numbers.into()))
        };
        let place = value.place.clone();
        *value =
            SceneValue::from(Kind::List(points.into_iter().map(point).collect())).with_key("nm");
        value.move_to(&place);
    }
    Ok(())
}

fn points(path: &Path) -> Result<Vec<[f64; 3]>, String> {
    let text = std::fs::read_to_string(path).map_err(|error| format!("cannot be read: {error}"))?;
    let rows = text.trim_start_matches('\u{feff}').lines().zip(1..);
    let mut rows = rows.filter(|(line, _)| !line.trim().is_empty()).peekable();
    rows.next_if(|(line, _)| is_heading(line));
    rows.map(|(line, number)| point(line).ok_or_else(|| refusal(line, number)))
        .collect()
}

fn point(line: &str) -> Option<[f64; 3]> {
    let numbers = line.split(',').map(|number| number.trim().parse().ok());
    let numbers: Vec<f64> = numbers.collect::<Option<_>>()?;
    numbers.try_into().ok()
}

fn is_heading(line: &str) -> bool {
    let mut words = line.split(|c: char| c.is_whitespace() || c == ',' || c == ';');
    words.all(|word| word.parse::<f64>().is_err())
}

fn refusal(line: &str, number: usize) -> String {
    let separator = match line.trim() {
        line if line.contains(';') => ", not by semicolons",
        line if line.contains('\t') => ", not by tabs",
        line if line.contains(' ') && !line.contains(',') => ", not by spaces",
        _ => "",
    };
    format!(
        "line {number}: must be three numbers x, y, z (nm) with decimal points, separated by commas{separator}"
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{SceneError, SceneText, Shape};

    const SCENE: &str = "Scene(
    filament: Filament(
        sections: [Rod(from_nm: 0.0, to_nm: 40.0)],
        shape: Points(file: \"trace.csv\"), roll_deg: 5.0,
    ),
    task: Dynamics(duration_ns: 1.0),
)";

    fn read(csv: &str) -> Result<SceneText, SceneError> {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("trace.csv"), csv).unwrap();
        let mut text = SceneText::new(SCENE);
        text.resolve_paths(folder.path()).map(|()| text)
    }

    #[test]
    fn points_come_from_their_file() {
        let text = read("x_nm,y_nm,z_nm\n0, 0, 0\n\n0,5.5,20\n1e0,0,41\n").unwrap();
        let scene = text.scene().unwrap();
        let nm = vec![[0.0, 0.0, 0.0], [0.0, 5.5, 20.0], [1.0, 0.0, 41.0]];
        let expected = Shape::Points { nm, file: None };
        assert_eq!(scene.filament.shape, Some(expected));
        assert!((scene.filament.roll_deg - 5.0).abs() < 1e-15);
        assert_eq!(crate::Scene::from_ron(&scene.to_ron()), Ok(scene));
    }

    #[test]
    fn files_without_points_are_refused() {
        let message = |csv| read(csv).map(|_| ()).unwrap_err().to_string();
        let place = "4:23: filament.shape.file = \"trace.csv\": ";
        let rule = "must be three numbers x, y, z (nm) with decimal points, separated by commas";
        for (csv, line, more) in [
            ("0,0,0\n1,2\n", 2, ""),
            ("0,0,O\n0,0,41\n", 1, ""),
            ("x,y,z\n0,0\n", 2, ""),
            ("0;0;0\n0;0;41\n", 1, ", not by semicolons"),
            ("0,5;0,0;0,0\n", 1, ", not by semicolons"),
            ("x y z\n0 0 0\n", 2, ", not by spaces"),
            ("0\t0\t0\n", 1, ", not by tabs"),
        ] {
            assert_eq!(message(csv), format!("{place}line {line}: {rule}{more}"));
        }
        let mut text = SceneText::new(SCENE);
        let missing = text.resolve_paths(Path::new("/nowhere")).unwrap_err();
        assert!(
            missing
                .to_string()
                .starts_with(&format!("{place}cannot be read: ")),
            "{missing}"
        );
        let alone = crate::Scene::from_ron(SCENE).unwrap_err().to_string();
        assert!(
            alone.starts_with(&format!("{place}cannot be read without")),
            "{alone}"
        );
        let short = read("0,0,0\n0,0,10\n").unwrap().scene().unwrap_err();
        assert_eq!((short.line, short.column), (4, 23), "{short}");
    }
}
