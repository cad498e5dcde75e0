//! Pictures of the stability limits and of the energy below them.

use super::stability::{self, INTEGRATORS, MODELS, SHARES, energy_error, free};
use actin_draw::{Chart, Colour, Series};
use std::path::Path;

/// A colour for each integrator or model.
const COLOURS: [Colour; 5] = [
    Colour([30, 70, 180]),
    Colour([190, 25, 35]),
    Colour([235, 140, 20]),
    Colour([40, 150, 70]),
    Colour([120, 60, 150]),
];

fn series(label: &str, colour: Colour, points: Vec<(f64, f64)>, dots: bool) -> Series {
    Series {
        label: Some(label.to_owned()),
        colour,
        points,
        dots,
    }
}

/// Draws `extremes-limits.svg`: limits of `omega h` as measured against those of the methods.
pub(super) fn limits(out: &Path) -> Result<(), String> {
    let diagonal = vec![(1.4, 1.4), (3.6, 3.6)];
    let mut all = vec![series("equal", Colour([160, 160, 160]), diagonal, false)];
    for ((model, sections), colour) in MODELS.into_iter().zip(COLOURS) {
        let mut system = free(sections).map_err(|outcome| outcome.words())?;
        let point = |(_, integrator): (&str, actin_sim::Integrator)| {
            let limits = stability::limits(&mut system, integrator);
            let predicted = integrator.composition().stability_limit();
            (predicted, predicted * limits.measured / limits.predicted)
        };
        all.push(series(model, colour, INTEGRATORS.map(point).to_vec(), true));
    }
    let chart = Chart {
        title: "Where small motion begins to grow",
        x_label: "limit of the method, omega h",
        y_label: "measured limit, omega h",
        series: all,
        equal_axes: false,
    };
    chart.draw(&out.join("extremes-limits.svg"))
}

/// Draws `extremes-energy.svg`: fluctuation of the energy against the step, for the mixed filament.
pub(super) fn energy(out: &Path) -> Result<(), String> {
    let (model, sections) = MODELS[2];
    let mut system = free(sections).map_err(|outcome| outcome.words())?;
    let mut all = Vec::new();
    for ((name, integrator), colour) in INTEGRATORS.into_iter().zip(COLOURS) {
        let point = |share: f64| {
            let error = energy_error(&mut system, integrator, share);
            (share.log10(), error.max(1e-16).log10())
        };
        all.push(series(name, colour, SHARES.map(point).to_vec(), false));
    }
    let title = format!("Energy of a {model} filament over 1000 steps of small motion");
    let chart = Chart {
        title: &title,
        x_label: "log10 of the step over the stability limit",
        y_label: "log10 of the largest relative deviation",
        series: all,
        equal_axes: false,
    };
    chart.draw(&out.join("extremes-energy.svg"))
}
