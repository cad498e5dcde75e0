//! The line of a scene in which a mistake is, underlined.
//!
//! By `annotate-snippets`, which draws the messages of cargo and brings no crate that clap and indicatif do not.
//! (miette has error types of its own and brings backtraces, ariadne brings colours of its own.)

use actin_sim::{SceneError, SceneText};
use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};

/// Columns of a line that are shown.
const WIDTH: usize = 120;

/// The line of a mistake, underlined, with what was probably meant; what was meant alone where an override is
/// to blame. Begins with a line feed unless it is empty.
pub(crate) fn of(text: &SceneText, mistake: &SceneError) -> String {
    let meant = mistake
        .meant
        .as_ref()
        .map(|meant| format!("did you mean {meant}?"));
    if mistake.set.is_some() {
        return meant.map_or_else(String::new, |meant| format!("; {meant}"));
    }
    let span = text.span(mistake);
    let line = AnnotationKind::Primary.span(span).label(meant);
    let snippet = Snippet::source(text.written()).annotation(line);
    let group = Group::with_level(Level::ERROR).element(snippet);
    let shown = Renderer::plain().term_width(WIDTH).render(&[group]);
    format!("\n{shown}")
}
