//! The line of a scene that contains a mistake, underlined.

use actin_sim::{SceneError, SceneText};
use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};

const WIDTH: usize = 120;

/// Returns the line of a mistake, underlined, with a suggested spelling.
///
/// For a mistake in an override, returns the suggestion only. The text begins with a line feed unless it is empty.
pub(crate) fn of(text: &SceneText, mistake: &SceneError) -> String {
    let meant = mistake
        .suggestion
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
