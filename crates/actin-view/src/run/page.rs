//! HTML page of a run, with the scripts `js/player.js` and `js/curves.js`.

use super::Run;
use crate::{Attitude, BODIES, Palette};
use actin_draw::page::{SOLIDS, SPACE, STYLE, in_script};
use actin_sim::{Status, Summary};
use maud::{DOCTYPE, Markup, PreEscaped, html};

const CURVES: &str = include_str!("../js/curves.js");
const PLAYER: &str = include_str!("../js/player.js");
const OWN_STYLE: &str = include_str!("page.css");
/// Content of the meta tag that identifies pages of this program.
pub(super) const GENERATOR: &str = "actin view";

/// SVG paths of the button icons, in a square of 16.
const PLAY: &str = "M3 1l11 7-11 7z";
const PAUSE: &str = "M3 1h4v14H3zM9 1h4v14H9z";
const BACK: &str = "M12 2v12L5 8zM3 2h2v12H3z";
const FORTH: &str = "M4 2v12l7-6zM11 2h2v12h-2z";

impl Run {
    /// Returns a self-contained HTML page.
    pub fn page(&self, palette: Palette) -> String {
        let mut data = self.data();
        data["attitude"] = serde_json::json!(Attitude::HORIZONTAL);
        let scripts = [SOLIDS, SPACE, BODIES, CURVES, PLAYER];
        let page = html! {
            (DOCTYPE)
            html lang="en" {
                head {
                    meta charset="utf-8";
                    meta name="generator" content=(GENERATOR);
                    meta name="viewport" content="width=device-width, initial-scale=1";
                    title { (self.title()) }
                    style { (PreEscaped(STYLE)) (PreEscaped(OWN_STYLE)) }
                }
                body {
                    header { h1 { (self.title()) } (self.chips()) }
                    (self.warnings())
                    main {
                        (stage())
                        aside id="curves" class="curves" aria-label="Curves" {}
                    }
                    (self.facts())
                    footer { (self.origin()) }
                    noscript { p { "The view needs JavaScript." } }
                    script type="application/json" id="palette" { (in_script(&palette.json())) }
                    script type="application/json" id="run" { (in_script(&data.to_string())) }
                    @for script in scripts { script { (PreEscaped(script)) } }
                }
            }
        };
        page.into_string()
    }

    fn title(&self) -> String {
        let named = self.assembly.scene.title.trim();
        if !named.is_empty() {
            return named.to_owned();
        }
        if self.is_initial() {
            return "Initial shape".to_owned();
        }
        let folder = self.path.file_name().unwrap_or(self.path.as_os_str());
        folder.to_string_lossy().into_owned()
    }

    fn chips(&self) -> Markup {
        let counts = self.assembly.counts();
        let many = |count: usize, what: &str| match count {
            0 => None,
            1 => Some(format!("1 {what}")),
            _ => Some(format!("{count} {what}s")),
        };
        let counted = [
            many(self.assembly.filaments.len(), "filament")
                .filter(|_| self.assembly.filaments.len() > 1),
            many(counts.monomers, "monomer"),
            many(counts.segments, "segment"),
            many(self.assembly.linkers.len(), "linker"),
            many(self.records, "record"),
        ];
        html! {
            ul class="chips" {
                @if !self.is_initial() { (ending(self.summary.as_ref())) }
                @for words in counted.into_iter().flatten() { li { (words) } }
            }
        }
    }

    fn warnings(&self) -> Markup {
        let of_run = self.summary.iter().flat_map(|summary| &summary.warnings);
        let of_run = of_run.map(ToString::to_string);
        let all: Vec<String> = self.remarks.iter().cloned().chain(of_run).collect();
        html! {
            @if !all.is_empty() {
                div class="remarks" role="note" { @for remark in &all { p { (remark) } } }
            }
        }
    }

    fn facts(&self) -> Markup {
        let Some(summary) = &self.summary else {
            return Markup::default();
        };
        html! {
            div class="facts" {
                section { h2 { "End state" } (list(&results(summary))) }
                section { h2 { "Computation" } (list(&made(summary))) }
                (notes(summary))
            }
        }
    }

    fn origin(&self) -> Markup {
        html! {
            p class="keys" {
                "Drag to turn, " kbd { "Shift" } " and drag to move, wheel or two fingers to zoom, arrow keys, "
                kbd { "0" } " to reset, " kbd { "x" } " " kbd { "y" } " " kbd { "z" } " to look along an axis, "
                kbd { "Space" } " to play, " kbd { "," } " and " kbd { "." } " for single records. The projection is \
                 orthographic. A click on a body follows it. Linkers are labelled with their tension, negative in compression."
            }
            p {
                "Created by " code { "actin view " (self.path.display()) } ", version " (env!("CARGO_PKG_VERSION")) "."
            }
        }
    }
}

type Facts = Vec<(&'static str, String)>;

fn results(summary: &Summary) -> Facts {
    let (energy, residual) = (&summary.energy_pn_nm, &summary.residual);
    let (force, torque) = (residual.force_pn, residual.torque_pn_nm);
    let mut all = vec![
        (
            "Tip displacement",
            format!("{} nm", vector(summary.tip_displacement_nm)),
        ),
        (
            "Potential energy",
            format!("{} pN nm", number(energy.potential)),
        ),
        (
            "Kinetic energy",
            format!("{} pN nm", number(energy.kinetic)),
        ),
        ("Residual", format!("{force:.1e} pN, {torque:.1e} pN nm")),
    ];
    let reactions = [
        ("Reaction force at the start", summary.end_reactions.start),
        ("Reaction force at the end", summary.end_reactions.end),
    ];
    let held = reactions
        .into_iter()
        .filter_map(|(name, r)| Some((name, r?)));
    all.extend(held.map(|(name, r)| (name, format!("{} pN", vector(r.force_pn)))));
    let farthest = number(summary.shape.largest_distance_nm);
    all.push(("Largest distance from the axis", format!("{farthest} nm")));
    all
}

fn made(summary: &Summary) -> Facts {
    let work = &summary.work;
    let mut all = vec![
        ("Time steps", work.steps.to_string()),
        ("Newton iterations", work.newton_iterations.to_string()),
        ("Evaluations of loads", work.force_evaluations.to_string()),
        ("Run time", format!("{:.2} s", summary.wall_s)),
        ("Version", summary.version.clone()),
        ("Seed", summary.seed.to_string()),
    ];
    all.retain(|(_, value)| value != "0");
    all
}

fn sign(path: &str, class: &str) -> Markup {
    html! { svg class=(class) viewBox="0 0 16 16" aria-hidden="true" { path d=(path) {} } }
}

fn stage() -> Markup {
    html! {
        section class="stage" {
            figure class="viewer" {
                div class="controls" {
                    select id="paint" aria-label="Colours" { option value="kind" { "by kind" } }
                    span class="spring" {}
                    span class="group" {
                        @for axis in ["x", "y", "z"] {
                            button type="button" id=(format!("along-{axis}")) aria-label=(format!("Look along {axis}")) { (axis) }
                        }
                    }
                    span class="group" {
                        button type="button" id="picture" aria-label="Save a picture" { "PNG" }
                        button type="button" id="film" aria-label="Save the playback as a film" aria-pressed="false" { "Film" }
                    }
                    span class="group" {
                        button type="button" id="smaller" aria-label="Smaller" { "−" }
                        button type="button" id="larger" aria-label="Larger" { "+" }
                        button type="button" id="reset" { "Reset" }
                    }
                }
                canvas id="space" tabindex="0" role="img" aria-label="Three-dimensional view, turned with the arrow keys" {}
                div id="tip" role="status" hidden {}
            }
            (transport())
            div class="below" {
                div id="bar" hidden { i {} div { span {} span {} span {} } }
                ul id="legend" class="legend" {}
                span id="followed" {}
                span id="record" {}
            }
        }
    }
}

fn transport() -> Markup {
    html! {
        div class="transport" {
            button type="button" id="play" aria-label="Play" aria-pressed="false" { (sign(PLAY, "go")) (sign(PAUSE, "pause")) }
            button type="button" id="back" aria-label="One record back" { (sign(BACK, "")) }
            button type="button" id="forth" aria-label="One record on" { (sign(FORTH, "")) }
            input type="range" id="slider" min="0" value="0" step="1" aria-label="Record";
            select id="speed" aria-label="Speed" {
                @for (value, name) in [("0.25", "¼×"), ("0.5", "½×"), ("1", "1×"), ("2", "2×"), ("4", "4×")] {
                    option value=(value) selected[value == "1"] { (name) }
                }
            }
            output id="clock" {}
        }
    }
}

fn ending(summary: Option<&Summary>) -> Markup {
    let Some(summary) = summary else {
        return html! { li class="bad" { "not ended" } };
    };
    let (words, class) = match summary.status {
        Status::Converged => ("converged", "good"),
        Status::Completed => ("completed", "good"),
        Status::Interrupted => ("interrupted", "bad"),
        Status::Failed => ("failed", "bad"),
    };
    html! {
        li class=(class) { (words) }
        @if let Some(stability) = &summary.stability {
            @if stability.stable { li class="good" { "stable" } }
            @else if stability.negative_eigenvalues > 0 { li class="bad" { "saddle" } }
            @else { li { "stability not resolved" } }
        }
    }
}

fn list(entries: &[(&str, String)]) -> Markup {
    html! { dl { @for (name, value) in entries { dt { (name) } dd { (value) } } } }
}

fn notes(summary: &Summary) -> Markup {
    let others = summary.states.iter().map(|states| {
        format!("{states}. Other states are in other_states.npz; this page shows the result.")
    });
    let notes = summary.coded_notes().into_iter();
    let notes = notes
        .filter(|note| note.code.is_none())
        .map(|note| note.message);
    let all: Vec<String> = notes.chain(others).collect();
    html! {
        @if !all.is_empty() {
            section { h2 { "Notes of the run" } @for note in &all { p class="soft" { (note) } } }
        }
    }
}

fn number(x: f64) -> String {
    actin_draw::page::significant(x)
}

fn vector(v: [f64; 3]) -> String {
    let [x, y, z] = v.map(number);
    format!("({x}, {y}, {z})")
}
