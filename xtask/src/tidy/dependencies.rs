//! The direction of dependencies between the crates of this workspace.

use super::read;
use std::fs;
use std::path::Path;

/// Each crate and the crates of ours that it may depend on.
const ALLOWED: [(&str, &[&str]); 12] = [
    ("crates/actin-mechanics", &[]),
    ("crates/actin-ellipsoid", &["actin-mechanics"]),
    ("crates/actin-cosserat", &["actin-mechanics"]),
    (
        "crates/actin-coupling",
        &["actin-mechanics", "actin-cosserat"],
    ),
    ("crates/actin-integrate", &["actin-mechanics"]),
    ("crates/actin-equilibrium", &["actin-mechanics"]),
    ("crates/actin-fit", &[]),
    ("crates/actin-draw", &[]),
    (
        "crates/actin-sim",
        &[
            "actin-mechanics",
            "actin-ellipsoid",
            "actin-cosserat",
            "actin-coupling",
            "actin-integrate",
            "actin-equilibrium",
        ],
    ),
    (
        "crates/actin-paper",
        &[
            "actin-mechanics",
            "actin-cosserat",
            "actin-integrate",
            "actin-equilibrium",
            "actin-fit",
            "actin-sim",
            "actin-draw",
        ],
    ),
    ("crates/actin-cli", &["actin-sim"]),
    (
        "xtask",
        &[
            "actin-mechanics",
            "actin-sim",
            "actin-draw",
            "actin-paper",
            "actin-integrate",
        ],
    ),
];

/// Dependencies that point the wrong way, and crates that no rule speaks of.
pub(super) fn findings(root: &Path) -> Result<Vec<String>, String> {
    let mut all = Vec::new();
    for (folder, allowed) in ALLOWED {
        let manifest = read(&root.join(folder).join("Cargo.toml"))?;
        for dependency in own_dependencies(&manifest) {
            if !allowed.contains(&dependency.as_str()) {
                all.push(format!("{folder} must not depend on {dependency}"));
            }
        }
    }
    let crates = fs::read_dir(root.join("crates")).map_err(|e| e.to_string())?;
    for entry in crates.flatten() {
        let folder = format!("crates/{}", entry.file_name().to_string_lossy());
        if !ALLOWED.iter().any(|(known, _)| *known == folder) {
            all.push(format!("{folder}: say in tidy what it may depend on"));
        }
    }
    Ok(all)
}

/// Crates of this workspace under `[dependencies]` of a manifest.
fn own_dependencies(manifest: &str) -> Vec<String> {
    manifest
        .lines()
        .skip_while(|line| line.trim() != "[dependencies]")
        .skip(1)
        .take_while(|line| !line.starts_with('['))
        .filter_map(|line| line.split(['.', ' ', '=']).next())
        .filter(|name| name.starts_with("actin-"))
        .map(str::to_owned)
        .collect()
}
