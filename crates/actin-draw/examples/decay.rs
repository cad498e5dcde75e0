//! Plots a measured and an expected curve as SVG.
//!
//! `cargo run -p actin-draw --example decay -- decay.svg`

use actin_draw::{Chart, Colour, Mark, Ramp, Series};
use std::path::PathBuf;

fn main() -> Result<(), String> {
    let path = std::env::args().nth(1).unwrap_or("decay.svg".into());
    let times = || (0..=60).map(|k| 0.1 * f64::from(k));
    let expected = Series {
        label: Some("exp(-t)".into()),
        colour: Ramp::VIRIDIS.at(1.0),
        points: times().map(|t| (t, (-t).exp())).collect(),
        mark: Mark::Dashes,
    };
    let measured = Series {
        label: Some("measured".into()),
        colour: Colour([20, 20, 20]),
        points: times()
            .step_by(5)
            .map(|t| (t, (-t).exp() + 0.01 * (7.0 * t).sin()))
            .collect(),
        mark: Mark::Dots,
    };
    let chart = Chart {
        title: "A decay",
        x_label: "time (ns)",
        y_label: "amplitude",
        series: vec![expected, measured],
        equal_axes: false,
    };
    chart.draw(&PathBuf::from(&path))?;
    println!("written: {path}");
    Ok(())
}
