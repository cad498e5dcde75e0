//! Paths in the documentation exist.

use super::files;
use std::path::Path;

const FOLDERS: [&str; 5] = ["crates/", "docs/", "scenarios/", "xtask/", "tests/"];

pub(super) fn findings(root: &Path) -> Result<Vec<String>, String> {
    let mut all = Vec::new();
    for (file, text) in files(root, "md")? {
        let name = file
            .strip_prefix(root)
            .unwrap_or(&file)
            .display()
            .to_string();
        for path in text.split('`').skip(1).step_by(2) {
            let named = FOLDERS.iter().any(|folder| path.starts_with(folder));
            let plain = !path.contains(['*', ' ', '<', '{', '\n']);
            if named && plain && !root.join(path).exists() {
                all.push(format!("{name}: names {path}, which does not exist"));
            }
        }
    }
    Ok(all)
}
