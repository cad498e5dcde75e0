//! Structure of `report.html`, a self-contained page. Its texts are in `data/page.ron`.

#[cfg(test)]
pub(super) mod browser_tests;
mod misses;
mod summary;
mod texts;

pub(crate) use misses::unexplained;

use crate::palette;
use crate::workspace_root;
use actin_draw::page::Page;
use actin_draw::report::{Artefact, save};
use std::fs;
use std::path::Path;

const TITLE: &str = "Actin at two resolutions: reproduction of the figures and tables of the paper";

pub(super) fn write(artefacts: &[Artefact], out: &Path, quick: bool) -> Result<(), String> {
    let version = version();
    let mut page = Page::new(TITLE, &version);
    page.header(&summary::head(artefacts, quick, &version));
    for artefact in artefacts {
        page.artefact(artefact, &misses::of(artefact.rows.iter()), out)?;
    }
    page.section("words", "Summary", &summary::words(artefacts));
    let reading = summary::how_to_read(&mut page);
    page.section("reading", "Guide to this page", &reading);
    page.markdown("errata", "Errata of the paper", &errata()?);
    page.verdicts(&summary::verdicts(artefacts));
    page.data("palette", &palette::chosen().json());
    page.script(actin_view::BODIES);
    page.script(actin_view::STATES);
    save(out, "report.html", &page.finish())
}

/// Version of the code, with the commit of its sources if available.
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

fn errata() -> Result<String, String> {
    let path = workspace_root().join("docs/errata.md");
    fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_errata_are_shown() {
        let mut page = Page::new("", "");
        page.markdown("errata", "", &errata().unwrap());
        let page = page.finish();
        let lines = errata().unwrap();
        let rows = lines.lines().filter(|line| line.starts_with("| ")).count();
        // One line is the header.
        assert_eq!(page.matches("data-label=\"finding\"").count(), rows - 1);
    }
}
