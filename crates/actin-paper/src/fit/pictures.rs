//! Figure 9: B3 and the change of length against twist, data and curves.

use super::column::Column;
use super::groups::GroupFit;
use super::table::FitData;
use super::twist::TwistFits;
use crate::charts::line;
use crate::palette;
use crate::statistics::sample;
use actin_cosserat::{PolynomialStretch, TanhTwist};
use actin_draw::{Chart, Mark, Series};
use std::path::Path;

/// Colours of the published parameters, of the refitted form, and of a smaller form.
const PUBLISHED: usize = 0;
const SAME_FORM: usize = 1;
const SMALLEST: usize = 3;
/// Colours of sampled filaments and of the mean filament.
const DRAWN: usize = 2;
const MEAN: usize = 4;
const CURVE: i32 = 600;

/// Data that are drawn but not fitted.
pub(crate) struct UnfittedData<'a> {
    pub data: &'a FitData,
    /// Draws dots instead of a line.
    pub dots: bool,
}

/// Picture of a column and its laws. Values are scaled to the unit of the axis.
struct Panel<'a> {
    file: &'static str,
    title: &'static str,
    y_label: &'static str,
    column: fn(&FitData) -> &Column,
    scale: f64,
    laws: [(&'static str, &'a dyn Fn(f64) -> f64); 3],
}

/// Writes `figure-9a.svg` and `figure-9b.svg`; returns their names and captions.
pub(crate) fn draw(
    data: &FitData,
    fits: &TwistFits,
    beside: &[UnfittedData<'_>],
    out: &Path,
) -> Result<Vec<(String, String)>, String> {
    let tanh = fits.tanh_law(&fits.tanh.fit);
    let polynomial = fits.polynomial_law(&fits.polynomial);
    let [sided, rooted] = ["twist", "length"].map(|name| &fits.smallest.named(name).law);
    let (b3, xi) = (TanhTwist::published(), PolynomialStretch::published());
    let rigidity = Panel {
        file: "figure-9a.svg",
        title: "Twisting rigidity against twist",
        y_label: "B3 (1000 pN nm^2)",
        column: |data| &data.rigidity,
        scale: 1e-3,
        laws: [
            ("published parameters", &|k| b3.secant(k)),
            ("the same form, refitted", &|k| tanh.secant(k)),
            ("saturating form", sided),
        ],
    };
    let length = Panel {
        file: "figure-9b.svg",
        title: "Change of length against twist",
        y_label: "dL / L (%)",
        column: |data| &data.length,
        scale: 100.0,
        laws: [
            ("published polynomial", &|k| xi.extension(k)),
            ("refitted polynomial", &|k| polynomial.extension(k)),
            ("two slopes", rooted),
        ],
    };
    let panels = [rigidity, length].into_iter();
    panels.map(|panel| panel.draw(data, beside, out)).collect()
}

impl Panel<'_> {
    fn draw(
        &self,
        data: &FitData,
        beside: &[UnfittedData<'_>],
        out: &Path,
    ) -> Result<(String, String), String> {
        let range = (self.column)(data).range();
        let laws = self.laws.iter().zip([PUBLISHED, SAME_FORM, SMALLEST]);
        let laws = laws.map(|((label, law), colour)| {
            let points = curve([-range, range], |k| self.scale * law(k));
            line(*label, palette::line(colour), points)
        });
        let (label, more) = match beside {
            [] => ("data", ""),
            _ => (
                "paper",
                " Our own monomers, measured in this run, are not fitted.",
            ),
        };
        let given = dots((self.column)(data), label, self.scale);
        let others = beside.iter().map(|other| Series {
            colour: palette::line(if other.dots { DRAWN } else { MEAN }),
            mark: if other.dots { Mark::Dots } else { Mark::Line },
            ..dots((self.column)(other.data), &other.data.source, self.scale)
        });
        let chart = Chart {
            title: self.title,
            x_label: "twist (rad/nm); positive: over-twist",
            y_label: self.y_label,
            series: laws.chain([given]).chain(others).collect(),
            equal_axes: false,
        };
        chart.draw(&out.join(self.file))?;
        let (title, source) = (self.title, &data.source);
        let caption = format!("{title}, with three fits. Data: {source}.{more}");
        Ok((self.file.to_owned(), caption))
    }
}

/// Points of a law between two arguments.
fn curve([from, to]: [f64; 2], law: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
    let places = (0..=CURVE).map(|i| from + (to - from) * f64::from(i) / f64::from(CURVE));
    places.map(|x| (x, law(x))).collect()
}

fn dots(column: &Column, label: &str, scale: f64) -> Series {
    let points = column.pairs().map(|(k, v)| (k, v * scale));
    Series {
        mark: Mark::Dots,
        ..line(label, palette::DATA, points.collect())
    }
}

/// Draws a law and its data over the range of the data.
pub(super) fn curve_with_data(fit: &GroupFit, out: &Path) -> Result<(), String> {
    let range = sample(fit.column.x.iter().copied().chain([0.0]));
    let points = curve([range.low, range.high], &fit.law);
    let law = line("law", palette::line(SMALLEST), points);
    let chart = Chart {
        title: &fit.group.title,
        x_label: &fit.group.x,
        y_label: &fit.group.value,
        series: vec![law, dots(&fit.column, "data", 1.0)],
        equal_axes: false,
    };
    chart.draw(&out.join(format!("{}.svg", fit.group.name)))
}
