//! Figures 1 to 3: what the models are, how they are joined, and what is done with them, each
//! drawn from an equilibrium of a scene under `scenarios/`.

mod examples;
mod filament;
mod imposed;
mod joint;
mod models;
mod solved;
mod style;

pub(super) use examples::reproduce as figure3;
pub(super) use joint::reproduce as figure2;
pub(super) use models::reproduce as figure1;

use super::report::{Artefact, Picture, Row, save};
use super::scene3d::Sheet;
use solved::Solved;
use std::path::Path;
use std::time::Instant;

/// Writes the picture of a figure and puts its artefact together.
fn artefact(
    (id, title): (&'static str, &'static str),
    solved: &[Solved],
    (sheet, caption): (&Sheet, String),
    rows: Vec<Row>,
    (out, started): (&Path, Instant),
) -> Result<Artefact, String> {
    let file = format!("{id}.svg");
    save(out, &file, &sheet.svg())?;
    Ok(Artefact {
        id,
        title,
        settings: solved::settings(solved),
        rows,
        pictures: vec![Picture { file, caption }],
        wall_s: started.elapsed().as_secs_f64(),
    })
}
