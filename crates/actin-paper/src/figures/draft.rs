//! Rows, pictures and tables of a running experiment.

use super::expected::{self, Bound, MeasuredRow};
use super::progress::Progress;
use super::texts::{self, ChartText, Values};
use crate::statistics::largest;
use actin_draw::report::{Artefact, Origin, Picture, Row, View, write_csv};
use actin_draw::{Chart, Series};
use actin_view::{Attitude, Pose, ViewState, states};
use rayon::prelude::*;
use std::path::Path;

#[derive(Debug)]
pub(super) struct Draft<'a> {
    pub id: &'static str,
    /// Output folder.
    pub out: &'a Path,
    /// Fewer resolutions and samplings, equilibria only.
    pub quick: bool,
    pub progress: &'a Progress,
    /// Description of scenes, stop rule and seeds.
    pub settings: String,
    pub rows: Vec<MeasuredRow>,
    pub pictures: Vec<Picture>,
    pub views: Vec<View>,
}

pub(super) type Column<R> = (&'static str, fn(&R) -> String);

impl<'a> Draft<'a> {
    pub(super) fn new(
        id: &'static str,
        out: &'a Path,
        quick: bool,
        progress: &'a Progress,
    ) -> Self {
        Self {
            id,
            out,
            quick,
            progress,
            settings: String::new(),
            rows: Vec::new(),
            pictures: Vec::new(),
            views: Vec::new(),
        }
    }

    /// Solves all cases in parallel. Results are in the order of the cases; the first error ends the artefact.
    pub(super) fn solve<C: Sync, R: Send>(
        &self,
        cases: &[C],
        solve: impl Fn(&C) -> Result<R, String> + Sync,
    ) -> Result<Vec<R>, String> {
        self.attempt(cases, solve).into_iter().collect()
    }

    /// Evaluates all cases in parallel. Results are in the order of the cases.
    pub(super) fn attempt<C: Sync, R: Send>(
        &self,
        cases: &[C],
        solve: impl Fn(&C) -> R + Sync,
    ) -> Vec<R> {
        self.progress.expect(cases.len());
        cases
            .par_iter()
            .with_max_len(1)
            .map(|case| {
                let result = solve(case);
                self.progress.done();
                result
            })
            .collect()
    }

    pub(super) fn row(
        &mut self,
        quantity: impl Into<String>,
        unit: &'static str,
        ours: f64,
        note: impl Into<String>,
    ) {
        self.scattered(quantity, unit, (ours, 0.0), note);
    }

    /// Adds a row with the standard deviation of a single sample.
    pub(super) fn scattered(
        &mut self,
        quantity: impl Into<String>,
        unit: &'static str,
        (ours, sd): (f64, f64),
        note: impl Into<String>,
    ) {
        let row = Row::measured(self.id, quantity, unit, ours, note);
        self.rows.push(MeasuredRow { row, sd });
    }

    pub(super) fn compared(&mut self, row: Row) {
        self.rows.push(MeasuredRow { row, sd: 0.0 });
    }

    /// Adds a verbal statement of the paper as a number with a bound.
    pub(super) fn claim(
        &mut self,
        quantity: &str,
        ours: f64,
        bound: Bound,
        statement: impl Into<String>,
    ) {
        let row = expected::claim(self.id, quantity, "", ours, bound, statement);
        self.compared(row);
    }

    pub(super) fn value(&self, quantity: &str) -> Option<f64> {
        let mut all = self.rows.iter();
        let found = all.find(|measured| measured.row.quantity == quantity)?;
        Some(found.row.ours)
    }

    /// Sets the description of scenes, stop rule and seeds.
    pub(super) fn describe(&mut self, name: &str, values: Values<'_>) -> Result<(), String> {
        self.settings = texts::settings(name, values)?;
        Ok(())
    }

    /// Draws series with the texts of a chart.
    pub(super) fn plot(
        &mut self,
        file: impl Into<String>,
        texts: &ChartText,
        series: Vec<Series>,
    ) -> Result<(), String> {
        let chart = Chart {
            title: &texts.title,
            x_label: &texts.x,
            y_label: &texts.y,
            series,
            equal_axes: texts.view.is_some_and(|view| !view.stretches),
        };
        let file = file.into();
        chart.draw(&self.out.join(&file))?;
        let caption = texts.caption.clone();
        self.pictures.push(Picture { file, caption });
        Ok(())
    }

    /// Writes states for the viewer. Each has a group, a name, a share of rod and a pose.
    pub(super) fn view(
        &mut self,
        id: &str,
        text: &str,
        shown: impl IntoIterator<Item = (String, String, f64, Pose)>,
    ) -> Result<(), String> {
        let shown = shown
            .into_iter()
            .map(|(group, name, share, pose)| ViewState {
                group,
                name,
                share,
                pose,
            });
        let shown: Vec<ViewState> = shown.collect();
        let attitude = match id {
            "fig1" => Attitude::VERTICAL,
            _ => Attitude::HORIZONTAL,
        };
        let view = states::write(id, attitude, &shown, texts::view(text)?, self.out)?;
        self.views.push(view);
        Ok(())
    }

    pub(super) fn table<'r, R: 'r>(
        &self,
        file: &str,
        results: impl IntoIterator<Item = &'r R>,
        columns: &[Column<R>],
    ) -> Result<(), String> {
        let header: Vec<&str> = columns.iter().map(|(name, _)| *name).collect();
        let lines = results.into_iter();
        let lines = lines.map(|r| columns.iter().map(|(_, cell)| cell(r)).collect());
        write_csv(self.out, file, &header, lines)
    }

    pub(super) fn list(&self) -> Result<(), String> {
        let rows = expected::judged(self.id, self.rows.clone());
        self.table(&format!("{}.csv", self.id), &rows, &ROWS)
    }

    /// Writes a table with one line per point of each curve. The names of the curve come first.
    pub(super) fn curves<const N: usize>(
        &self,
        file: &str,
        header: &[&str],
        curves: impl IntoIterator<Item = (Vec<String>, Vec<[f64; N]>)>,
    ) -> Result<(), String> {
        let lines = curves.into_iter().flat_map(|(names, points)| {
            let line = move |point: [f64; N]| [names.clone(), point.map(number).into()].concat();
            points.into_iter().map(line)
        });
        write_csv(self.out, file, header, lines)
    }

    pub(super) fn finish(self, wall_s: f64) -> Result<Artefact, String> {
        Ok(Artefact {
            id: self.id,
            title: texts::title(self.id)?,
            settings: self.settings,
            rows: expected::judged(self.id, self.rows),
            pictures: self.pictures,
            views: self.views,
            wall_s,
        })
    }
}

const ROWS: [Column<Row>; 8] = [
    ("quantity", |row| row.quantity.clone()),
    ("unit", |row| row.unit.to_owned()),
    ("paper", |row| text(row.paper.map(number))),
    ("ours", |row| number(row.ours)),
    ("tolerance", |row| text(row.tolerance.map(number))),
    ("pass", |row| text(row.pass)),
    ("note", |row| row.note.clone()),
    ("origin", |row| text(row.origin.map(Origin::name))),
];

/// Cell of a value that may be missing.
pub(super) fn text(value: Option<impl ToString>) -> String {
    value.map_or(String::new(), |value| value.to_string())
}

pub(super) fn number(x: f64) -> String {
    format!("{x:.9e}")
}

pub(super) fn residuals(all: impl Iterator<Item = [f64; 2]>) -> String {
    let all: Vec<[f64; 2]> = all.collect();
    let [force, torque] = [0, 1].map(|k| largest(all.iter().map(|r| r[k])));
    format!("every force is below {force:.1e} pN and every torque below {torque:.1e} pN nm")
}
