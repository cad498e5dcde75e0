//! The direction of dependencies between the crates of this workspace.

use cargo_metadata::{DependencyKind, MetadataCommand};
use std::path::Path;

/// Each crate with the crates of the workspace that it may depend on.
const ALLOWED: [(&str, &[&str]); 21] = [
    ("actin-mechanics", &[]),
    ("actin-ellipsoid", &["actin-mechanics"]),
    ("actin-cosserat", &["actin-mechanics"]),
    ("actin-coupling", &["actin-mechanics", "actin-cosserat"]),
    ("actin-integrate", &["actin-mechanics"]),
    ("actin-equilibrium", &["actin-mechanics"]),
    // Time steps use the run loop of other integrators and the stiffness of statics.
    (
        "actin-brownian",
        &["actin-mechanics", "actin-integrate", "actin-equilibrium"],
    ),
    ("actin-fit", &[]),
    ("actin-draw", &[]),
    (
        "actin-scene",
        &[
            "actin-mechanics",
            "actin-cosserat",
            "actin-ellipsoid",
            "actin-coupling",
        ],
    ),
    (
        "actin-assembly",
        &[
            "actin-mechanics",
            "actin-scene",
            "actin-ellipsoid",
            "actin-cosserat",
            "actin-coupling",
            "actin-integrate",
            "actin-brownian",
        ],
    ),
    (
        "actin-sim",
        &[
            "actin-mechanics",
            "actin-assembly",
            "actin-scene",
            "actin-ellipsoid",
            "actin-cosserat",
            "actin-coupling",
            "actin-integrate",
            "actin-equilibrium",
            "actin-brownian",
        ],
    ),
    (
        "actin-paper",
        &[
            "actin-mechanics",
            "actin-cosserat",
            "actin-integrate",
            "actin-equilibrium",
            "actin-fit",
            "actin-sim",
            "actin-draw",
            "actin-view",
        ],
    ),
    ("actin-export", &["actin-sim"]),
    ("actin-rundir", &["actin-sim", "actin-export"]),
    ("actin-view", &["actin-sim", "actin-rundir", "actin-draw"]),
    ("actin-sweep", &["actin-sim", "actin-rundir"]),
    (
        "actin-cli",
        &["actin-sim", "actin-rundir", "actin-sweep", "actin-view"],
    ),
    (
        "actin-python",
        &[
            "actin-mechanics",
            "actin-cosserat",
            "actin-coupling",
            "actin-brownian",
            "actin-integrate",
            "actin-equilibrium",
            "actin-export",
            "actin-fit",
            "actin-sim",
            "actin-rundir",
            "actin-sweep",
            "actin-view",
        ],
    ),
    ("xtask", &[]),
    // Laws and their fits for the origin of committed numbers, scenes for the reference of their keys.
    (
        "actin-studies",
        &[
            "actin-cosserat",
            "actin-draw",
            "actin-fit",
            "actin-integrate",
            "actin-mechanics",
            "actin-paper",
            "actin-rundir",
            "actin-sim",
            "actin-sweep",
            "actin-view",
        ],
    ),
];

pub(super) fn findings(root: &Path) -> Result<Vec<String>, String> {
    let manifest = root.join("Cargo.toml");
    let metadata = MetadataCommand::new()
        .manifest_path(manifest)
        .no_deps()
        .exec()
        .map_err(|error| error.to_string())?;
    let mut all = Vec::new();
    for package in &metadata.packages {
        let name = package.name.as_str();
        let Some((_, allowed)) = ALLOWED.iter().find(|(known, _)| *known == name) else {
            all.push(format!(
                "{name}: list its allowed dependencies in tidy/dependencies.rs"
            ));
            continue;
        };
        let normal = package.dependencies.iter();
        let ours = normal
            .filter(|d| d.kind == DependencyKind::Normal && d.path.is_some())
            .filter(|d| !allowed.contains(&d.name.as_str()));
        all.extend(ours.map(|d| format!("{name} must not depend on {}", d.name)));
    }
    Ok(all)
}
