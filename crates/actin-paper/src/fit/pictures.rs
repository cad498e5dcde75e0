//! Figure 9: B3 and the change of length against twist, data and curves.

use super::column::Column;
use super::data::TwistData;
use super::twist::TwistFits;
use crate::palette;
use actin_cosserat::{PolynomialStretch, TanhTwist};
use actin_draw::{Chart, Series};
use std::path::Path;

/// A law beside its data, as it is printed, written and drawn.
pub(super) struct LawCurve<'a> {
    /// Begin of file names.
    pub name: &'static str,
    pub title: &'static str,
    pub x_label: &'static str,
    pub y_label: &'static str,
    pub data: &'a Column,
    pub law: Box<dyn Fn(f64) -> f64 + 'a>,
}

/// Lines of the published parameters, of the same form refitted, and of a smaller form.
const PUBLISHED: usize = 0;
const SAME_FORM: usize = 1;
const SMALLEST: usize = 3;
/// Our own filaments: samplings, and the mean filament.
const DRAWN: usize = 2;
const MEAN: usize = 4;
/// Points of a curve.
const CURVE: i32 = 300;

/// Numbers to be drawn beside what is fitted.
pub(crate) struct Beside<'a> {
    pub data: &'a TwistData,
    /// Whether they are drawn as dots instead of a line.
    pub dots: bool,
}

/// One of the two pictures: its curves, and the column that it shows, in the unit of its axis.
struct Panel {
    chart: Chart<'static>,
    file: &'static str,
    what: &'static str,
    column: fn(&TwistData) -> &Column,
    scale: f64,
}

/// Writes `figure-9a.svg` and `figure-9b.svg`; returns their names and captions.
pub(crate) fn draw(
    data: &TwistData,
    fits: &TwistFits,
    beside: &[Beside<'_>],
    out: &Path,
) -> Result<Vec<(String, String)>, String> {
    let panels = [
        Panel {
            chart: rigidity(data, fits),
            file: "figure-9a.svg",
            what: "Secant twisting rigidity",
            column: |data| &data.rigidity,
            scale: 1e-3,
        },
        Panel {
            chart: length(data, fits),
            file: "figure-9b.svg",
            what: "Relative change of length",
            column: |data| &data.length,
            scale: 100.0,
        },
    ];
    let pictures = panels.into_iter();
    pictures
        .map(|panel| panel.draw(data, beside, out))
        .collect()
}

impl Panel {
    /// Draws the data and what stands beside them over the curves; returns file and caption.
    fn draw(
        mut self,
        data: &TwistData,
        beside: &[Beside<'_>],
        out: &Path,
    ) -> Result<(String, String), String> {
        let (label, more) = if beside.is_empty() {
            ("data", "")
        } else {
            (
                "paper",
                " Our own monomers, measured in this run, are not fitted.",
            )
        };
        let given = dots((self.column)(data), label, self.scale);
        let others = beside.iter().map(|other| Series {
            colour: palette::line(if other.dots { DRAWN } else { MEAN }),
            dots: other.dots,
            ..dots((self.column)(other.data), &other.data.source, self.scale)
        });
        self.chart.series.push(given);
        self.chart.series.extend(others);
        self.chart.draw(&out.join(self.file))?;
        let (what, source) = (self.what, &data.source);
        let caption = format!("{what} against twist, with three fits. Data: {source}.{more}");
        Ok((self.file.to_owned(), caption))
    }
}

fn rigidity(data: &TwistData, fits: &TwistFits) -> Chart<'static> {
    let (tanh, sided) = (fits.tanh_law(&fits.tanh.fit), fits.sided.0);
    let published = TanhTwist::published();
    let range = data.rigidity.range();
    Chart {
        title: "Twisting rigidity against twist",
        x_label: "twist (rad/nm); positive: over-twist",
        y_label: "B3 (1000 pN nm^2)",
        series: vec![
            curve("published parameters", PUBLISHED, range, |k| {
                1e-3 * published.secant(k)
            }),
            curve("the same form, refitted", SAME_FORM, range, |k| {
                1e-3 * tanh.secant(k)
            }),
            curve("saturating to either side", SMALLEST, range, |k| {
                1e-3 * sided.secant(k)
            }),
        ],
        equal_axes: false,
    }
}

fn length(data: &TwistData, fits: &TwistFits) -> Chart<'static> {
    let (polynomial, rooted) = (fits.polynomial_law(&fits.polynomial), fits.rooted.law);
    let published = PolynomialStretch::published();
    let range = data.length.range();
    Chart {
        title: "Change of length against twist",
        x_label: "twist (rad/nm); positive: over-twist",
        y_label: "dL / L (%)",
        series: vec![
            curve("published polynomial", PUBLISHED, range, |k| {
                100.0 * published.extension(k)
            }),
            curve("refitted polynomial", SAME_FORM, range, |k| {
                100.0 * polynomial.extension(k)
            }),
            curve("two slopes", SMALLEST, range, |k| 100.0 * rooted.jet(k)[0]),
        ],
        equal_axes: false,
    }
}

fn curve(label: &str, line: usize, range: f64, law: impl Fn(f64) -> f64) -> Series {
    let points = (-CURVE..=CURVE).map(|i| {
        let k = range * f64::from(i) / f64::from(CURVE);
        (k, law(k))
    });
    Series {
        label: Some(label.to_owned()),
        colour: palette::line(line),
        points: points.collect(),
        dots: false,
    }
}

fn dots(column: &Column, label: &str, scale: f64) -> Series {
    Series {
        label: Some(label.to_owned()),
        colour: palette::DATA,
        points: column.pairs().map(|(k, v)| (k, v * scale)).collect(),
        dots: true,
    }
}

/// Draws a law beside its data, over the range of the data.
pub(super) fn curve_with_data(curve: &LawCurve<'_>, out: &Path) -> Result<(), String> {
    let ends = curve
        .data
        .x
        .iter()
        .fold([0.0_f64; 2], |ends, x| [ends[0].min(*x), ends[1].max(*x)]);
    let points = (0..=CURVE).map(|i| {
        let x = ends[0] + (ends[1] - ends[0]) * f64::from(i) / f64::from(CURVE);
        (x, (curve.law)(x))
    });
    let law = Series {
        label: Some("law".to_owned()),
        colour: palette::line(SMALLEST),
        points: points.collect(),
        dots: false,
    };
    let chart = Chart {
        title: curve.title,
        x_label: curve.x_label,
        y_label: curve.y_label,
        series: vec![law, dots(curve.data, "data", 1.0)],
        equal_axes: false,
    };
    chart.draw(&out.join(format!("{}.svg", curve.name)))
}
