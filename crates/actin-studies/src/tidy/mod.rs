//! Invariants of `docs/architecture.md` that neither the compiler nor lints check.

#[cfg(test)]
mod book;
#[cfg(test)]
mod circles;
#[cfg(test)]
mod commands;
#[cfg(test)]
mod dependencies;
#[cfg(test)]
mod paths;
#[cfg(test)]
mod prose;
#[cfg(test)]
mod sizes;
#[cfg(test)]
mod words;

use std::fs;
use std::path::{Path, PathBuf};

pub(crate) fn files(root: &Path, extension: &str) -> Result<Vec<(PathBuf, String)>, String> {
    let mut found = Vec::new();
    let mut folders = vec![root.to_path_buf()];
    while let Some(folder) = folders.pop() {
        let entries = fs::read_dir(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
        for entry in entries {
            let path = entry.map_err(|e| e.to_string())?.path();
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            if path.is_dir() {
                if name != "target" && !name.starts_with('.') {
                    folders.push(path);
                }
            } else if path.extension().is_some_and(|e| e == extension) {
                found.push((path.clone(), read(&path)?));
            }
        }
    }
    found.sort();
    Ok(found)
}

fn read(path: &Path) -> Result<String, String> {
    fs::read_to_string(path).map_err(|e| format!("{}: {e}", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns all violations, one line each.
    ///
    /// # Errors
    /// If a file cannot be read.
    fn findings(root: &Path) -> Result<Vec<String>, String> {
        let sources = files(root, "rs")?;
        let mut all = dependencies::findings(root)?;
        all.extend(circles::findings(root)?);
        all.extend(paths::findings(root)?);
        all.extend(book::findings(root)?);
        all.extend(commands::findings(root)?);
        all.extend(crate::docs::findings(root)?);
        let mut texts = sources.clone();
        let is_written = |path: &Path| {
            let mut parts = path.iter();
            !parts.any(|part| part == "tables" || part == "measured")
                && !path.ends_with("CHANGELOG.md")
        };
        texts.extend(
            files(root, "md")?
                .into_iter()
                .filter(|(path, _)| is_written(path)),
        );
        all.extend(prose::findings(root, &texts));
        for (path, text) in &sources {
            let name = path
                .strip_prefix(root)
                .unwrap_or(path)
                .display()
                .to_string();
            all.extend(sizes::findings(&name, text));
            all.extend(words::findings(&name, text));
        }
        Ok(all)
    }

    #[test]
    fn the_workspace_is_tidy() {
        let root = actin_paper::workspace_root();
        let findings = findings(&root).expect("the workspace can be read");
        assert!(findings.is_empty(), "{}", findings.join("\n"));
    }
}
