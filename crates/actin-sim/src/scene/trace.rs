//! Points of a shape that stand in a file of their own: found beside the scene, and put into its text.

use super::outline::{Outline, line_and_column};
use super::{SceneError, SceneProblem, SceneText};
use std::path::Path;

impl SceneText {
    /// Puts the points of every `Points(file: ...)` into the text in the place of the file, whose path is
    /// relative to `folder`: lines stay as they are numbered.
    ///
    /// # Errors
    /// A file that cannot be read, or a row in it that is no point, at the key that names the file.
    pub fn read_points(&mut self, folder: &Path) -> Result<(), SceneError> {
        let mut done = 0;
        loop {
            let outline = Outline::of(self.text());
            let is_file = |i: &usize| {
                let path = outline.path(*i);
                outline.nodes[*i].start >= done && path.ends_with(".shape.file")
            };
            let Some(node) = (0..outline.nodes.len()).find(is_file) else {
                return Ok(());
            };
            let (start, value) = (outline.nodes[node].start, outline.nodes[node].value.clone());
            let path = outline.path(node);
            done = value.end;
            // What is no string, RON refuses.
            let Ok(Some(file)) = ron::from_str::<Option<String>>(&self.text()[value.clone()])
                .or_else(|_| ron::from_str(&self.text()[value.clone()]).map(Some))
            else {
                continue;
            };
            let refused = |rule: String| {
                let problem = SceneProblem::new(&path, format!("{file:?}"), rule);
                self.placed(SceneError::new(
                    line_and_column(self.text(), start),
                    &problem.to_string(),
                ))
            };
            let points = points(&folder.join(&file)).map_err(refused)?;
            let written: Vec<String> = points
                .iter()
                .map(|[x, y, z]| format!("({x:?}, {y:?}, {z:?})"))
                .collect();
            let inserted = format!("nm: [{}]", written.join(", "));
            done = start + inserted.len();
            self.replace(start..value.end, &inserted);
        }
    }
}

/// The points of a file.
pub(super) fn points(path: &Path) -> Result<Vec<[f64; 3]>, String> {
    let text = std::fs::read_to_string(path).map_err(|error| format!("cannot be read: {error}"))?;
    let mut points = Vec::new();
    for (i, line) in text.trim_start_matches('\u{feff}').lines().enumerate() {
        if line.trim().is_empty() {
            continue;
        }
        let numbers: Result<Vec<f64>, _> = line.split(',').map(|n| n.trim().parse()).collect();
        match numbers.ok().and_then(|numbers| numbers.try_into().ok()) {
            Some(point) => points.push(point),
            // Headings.
            None if i == 0 => {}
            None => {
                return Err(format!(
                    "line {}: must be three numbers x, y, z (nm)",
                    i + 1
                ));
            }
        }
    }
    Ok(points)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Shape;

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
        text.read_points(folder.path()).map(|()| text)
    }

    /// Headings, blank lines and spaces are skipped; what is read is a scene by itself, with the points.
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

    /// Each mistake stands at the key of the file; a text alone has no folder to look in.
    #[test]
    fn files_without_points_are_refused() {
        let told = |csv| read(csv).map(|_| ()).unwrap_err().to_string();
        let place = "4:23: filament.shape.file = \"trace.csv\": ";
        let rule = "line 2: must be three numbers x, y, z (nm)";
        assert_eq!(told("0,0,0\n1,2\n"), format!("{place}{rule}"));
        let mut text = SceneText::new(SCENE);
        let missing = text.read_points(Path::new("/nowhere")).unwrap_err();
        assert!(
            missing
                .to_string()
                .starts_with(&format!("{place}cannot be read: ")),
            "{missing}"
        );
        let alone = crate::Scene::from_ron(SCENE).unwrap_err().to_string();
        assert!(alone.starts_with(&format!("{place}is not read")), "{alone}");
        // Later lines are still where they were.
        let short = read("0,0,0\n0,0,10\n").unwrap().scene().unwrap_err();
        assert_eq!((short.line, short.column), (4, 23), "{short}");
    }
}
