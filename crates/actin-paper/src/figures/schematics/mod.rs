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

use actin_draw::report::{Artefact, Picture, Row, save};
use actin_draw::scene3d::Sheet;
use actin_view::{Attitude, Pose, Shown, states};
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
    let shown: Vec<Shown> = solved.iter().map(shown).collect();
    let attitude = if id == "fig1" {
        Attitude::STANDING
    } else {
        Attitude::LYING
    };
    let view = states::write(id, attitude, &shown, VIEW.into(), out)?;
    Ok(Artefact {
        id,
        title,
        settings: solved::settings(solved),
        rows,
        pictures: vec![Picture { file, caption }],
        views: vec![view],
        wall_s: started.elapsed().as_secs_f64(),
    })
}

const VIEW: &str = "The same equilibria, to be turned.";

/// A solved scene under the name of its file.
fn shown(solved: &Solved) -> Shown {
    let counts = solved.assembly.counts();
    let rods = counts.segments as f64;
    Shown {
        group: "all".into(),
        name: solved.name.rsplit('/').next().unwrap_or(solved.name).into(),
        // Monomers are 2.7 nm apart, segments 10 nm long or less: of what there is more.
        share: rods / (rods + counts.monomers as f64),
        pose: Pose::of(&solved.assembly, solved.assembly.system.state()),
    }
}
