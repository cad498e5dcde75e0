//! `report.html`: one page without links to anything outside itself.
//!
//! Here is the order of the page. Its parts are in files of their own: the summary with its score and
//! findings, reasons for what was missed. The viewer is `viewer.js`.

#[cfg(test)]
mod browser;
mod findings;
mod reasons;
mod score;
mod summary;

pub(crate) use reasons::unexplained;

use crate::palette;
use crate::workspace_root;
use actin_draw::page::{Page, on_dark};
use actin_draw::report::{Artefact, save};
use std::fs;
use std::path::Path;

const VIEWER: &str = include_str!("viewer.js");
const TITLE: &str = "Actin at two resolutions: the paper's figures and tables, computed again";

/// Writes the page, with everything that it shows inside it.
pub(super) fn write(artefacts: &[Artefact], out: &Path, quick: bool) -> Result<(), String> {
    let version = version();
    let mut page = Page::new(TITLE, &version);
    for artefact in artefacts {
        page.artefact(artefact, &reasons::misses(artefact.rows.iter()), out)?;
    }
    let header = summary::html(&mut page, artefacts, quick, &version);
    page.header(&header);
    page.markdown("errata", "Errata of the paper", &errata()?);
    page.data("palette", &colours()?);
    page.script(VIEWER);
    save(out, "report.html", &page.finish())
}

/// Version of the code, and of its sources where they are under git.
fn version() -> String {
    let number = env!("CARGO_PKG_VERSION");
    let mut git = std::process::Command::new("git");
    git.args(["describe", "--always", "--dirty"]);
    let output = git.current_dir(workspace_root()).output();
    let commit = output.ok().filter(|o| o.status.success());
    let commit = commit.map(|o| String::from_utf8_lossy(&o.stdout).trim().to_owned());
    commit.map_or_else(
        || number.to_owned(),
        |commit| format!("{number}, sources {commit}"),
    )
}

/// The text of `docs/errata.md`.
fn errata() -> Result<String, String> {
    let path = workspace_root().join("docs/errata.md");
    fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))
}

/// The colours of the viewer on a light and on a dark page, as JSON.
fn colours() -> Result<String, String> {
    let palette = palette::chosen();
    let colours = |shade: fn([u8; 3]) -> [u8; 3]| {
        let stops: Vec<_> = palette.ramp().stops().iter().copied().map(shade).collect();
        serde_json::json!({ "stops": stops, "things": palette.things().map(shade) })
    };
    let colours = serde_json::json!({ "light": colours(|c| c), "dark": colours(on_dark) });
    serde_json::to_string(&colours).map_err(|e| e.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every row of the errata is on the page.
    #[test]
    fn all_errata_are_shown() {
        let mut page = Page::new("", "");
        page.markdown("errata", "", &errata().unwrap());
        let page = page.finish();
        let lines = errata().unwrap();
        let rows = lines.lines().filter(|line| line.starts_with("| ")).count();
        // The head is one of them.
        assert_eq!(page.matches("data-label=\"finding\"").count(), rows - 1);
    }
}
