//! Texts of figures and tables in `data/pictures.ron`, with values for the names in braces.

use crate::palette;
use serde::Deserialize;
use std::fmt::Display;
use std::sync::LazyLock;

#[derive(Debug, Deserialize)]
struct Texts {
    titles: Vec<(String, String)>,
    settings: Vec<(String, String)>,
    charts: Vec<ChartText>,
    views: Vec<(String, String)>,
}

#[derive(Debug, Deserialize)]
pub(super) struct ChartText {
    name: String,
    pub title: String,
    pub x: String,
    pub y: String,
    pub caption: String,
    /// For projections of filaments.
    #[serde(default)]
    pub view: Option<Projection>,
}

#[derive(Clone, Copy, Debug, Deserialize)]
pub(super) struct Projection {
    /// Coordinates to the right and upwards.
    axes: [usize; 2],
    /// Scales both axes independently.
    #[serde(default)]
    pub stretches: bool,
}

impl Projection {
    pub(super) fn of(&self, place: &[f64; 3]) -> (f64, f64) {
        let [right, up] = self.axes;
        (place[right], place[up])
    }
}

/// Names in braces with their values.
pub(super) type Values<'a> = &'a [(&'a str, &'a dyn Display)];

static TEXTS: LazyLock<Texts> = LazyLock::new(|| {
    actin_sim::read_ron(include_str!("../../data/pictures.ron"), "Texts")
        .expect("`data/pictures.ron` is well formed")
});

/// Title of an artefact.
pub(super) fn title(id: &str) -> Result<&'static str, String> {
    Ok(named(&TEXTS.titles, id)?)
}

pub(super) fn settings(name: &str, values: Values<'_>) -> Result<String, String> {
    fill(named(&TEXTS.settings, name)?, values)
}

pub(super) fn view(name: &str) -> Result<String, String> {
    named(&TEXTS.views, name).cloned()
}

fn named<'a>(texts: &'a [(String, String)], name: &str) -> Result<&'a String, String> {
    let found = texts.iter().find(|(own, _)| own == name);
    Ok(&found.ok_or_else(|| missing(name))?.1)
}

fn missing(name: &str) -> String {
    format!("`data/pictures.ron` has no text `{name}`")
}

impl ChartText {
    /// Texts of a chart, with the values.
    pub(super) fn new(name: &str, values: Values<'_>) -> Result<Self, String> {
        let found = TEXTS.charts.iter().find(|chart| chart.name == name);
        let found = found.ok_or_else(|| missing(name))?;
        Ok(Self {
            name: name.to_owned(),
            title: fill(&found.title, values)?,
            x: fill(&found.x, values)?,
            y: fill(&found.y, values)?,
            caption: fill(&found.caption, values)?,
            view: found.view,
        })
    }
}

fn fill(text: &str, values: Values<'_>) -> Result<String, String> {
    let mut text = text.replace("{ends}", palette::chosen().ends());
    for (name, value) in values {
        text = text.replace(&format!("{{{name}}}"), &value.to_string());
    }
    match text.split_once('{') {
        None => Ok(text),
        Some((_, name)) => Err(format!("no value for `{{{name}` in `data/pictures.ron`")),
    }
}
