//! The direction of dependencies between the crates of this workspace, a table of `docs/architecture.md`.

use cargo_metadata::{DependencyKind, MetadataCommand};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Direct and indirect dependencies by crate. Rows may only use crates of earlier rows.
fn allowed(page: &str) -> BTreeMap<&str, BTreeSet<&str>> {
    let lines = page.lines();
    let table = lines.skip_while(|line| *line != "| crate | depends on |");
    let rows = table.skip(2);
    let cells = rows.map_while(|row| row.trim_matches(['|', ' ']).split_once(" | "));
    let mut all = BTreeMap::<&str, BTreeSet<&str>>::new();
    for (crates, direct) in cells {
        let known = |name| all.get(name).into_iter().flatten().copied().chain([name]);
        let reached: BTreeSet<&str> = direct.split(", ").flat_map(known).collect();
        all.extend(crates.split(", ").map(|name| (name, reached.clone())));
    }
    all
}

fn short(name: &str) -> &str {
    name.trim_start_matches("actin-")
}

pub(super) fn findings(root: &Path) -> Result<Vec<String>, String> {
    let page = super::read(&root.join("docs/architecture.md"))?;
    let allowed = allowed(&page);
    let metadata = MetadataCommand::new()
        .manifest_path(root.join("Cargo.toml"))
        .no_deps()
        .exec()
        .map_err(|error| error.to_string())?;
    let mut all = Vec::new();
    for package in &metadata.packages {
        let name = short(&package.name);
        let Some(allowed) = allowed.get(name) else {
            all.push(format!(
                "docs/architecture.md: list the dependencies of {name}"
            ));
            continue;
        };
        let normal = package.dependencies.iter();
        let ours = normal
            .filter(|d| d.kind == DependencyKind::Normal && d.path.is_some())
            .filter(|d| !allowed.contains(short(&d.name)));
        all.extend(ours.map(|d| format!("{name} must not depend on {}", d.name)));
    }
    Ok(all)
}
