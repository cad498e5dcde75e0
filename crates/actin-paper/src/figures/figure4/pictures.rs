//! The panels of Figure 4: side view, end view, energy against time; and what equilibria are like
//! against the length of rod.

use super::case::{ROD_SEGMENTS, Resolved, Result4};
use super::variant::Variant;
use crate::palette;
use actin_draw::report::{Picture, View};
use actin_draw::{Chart, Colour, Series};
use actin_view::{Attitude, Shown, states};
use std::path::Path;

/// Draws all panels.
pub(super) fn draw(results: &[Result4], out: &Path) -> Result<Vec<Picture>, String> {
    let mut pictures = Vec::new();
    for (variant, mean, name) in [
        (Variant::SHARED, Some(Variant::MEAN), "2_pN_shared"),
        (Variant::FULL, None, "2_pN_full"),
        (Variant::WEAK, Some(Variant::WEAK_MEAN), "0.5_pN_shared"),
        (Variant::STIFF, Some(Variant::STIFF_MEAN), "preceding_paper"),
    ] {
        let panels = Panels::of(results, variant, mean);
        pictures.extend(panels.draw(&format!("fig4_{name}"), out)?);
    }
    pictures.extend(against_resolution(results, out)?);
    Ok(pictures)
}

/// Refined rods and further seeds are numbers, not lines.
fn is_drawn(resolved: Resolved) -> bool {
    matches!(
        resolved,
        Resolved::Mixed(_) | Resolved::Rod(ROD_SEGMENTS) | Resolved::Ellipsoids(0)
    )
}

/// The drawn states for the viewer.
pub(super) fn view_in_space(results: &[Result4], out: &Path) -> Result<View, String> {
    let mut drawn: Vec<&Result4> = results
        .iter()
        .filter(|r| is_drawn(r.case.resolved))
        .collect();
    drawn.sort_by(|a, b| a.case.rod_share().total_cmp(&b.case.rod_share()));
    let shown: Vec<Shown> = drawn
        .into_iter()
        .map(|r| Shown {
            group: r.case.variant.words(),
            name: r.case.name(),
            share: r.case.rod_share(),
            pose: r.pose.clone(),
        })
        .collect();
    let caption = "Where the damped motions came to rest, in space: monomers with their own \
        semi-axes and orientations, the rod with a stripe along its first axis. The force acts at \
        the tip.";
    states::write("fig4", Attitude::LYING, &shown, caption.into(), out)
}

const X_LABEL: &str = "x (nm); the force pulls towards -x";

/// One variant at all resolutions, beside the mean filament.
struct Panels<'a> {
    what: String,
    /// From monomers to rod.
    drawn: Vec<&'a Result4>,
    /// Monomers with weighted bonds.
    mean: Option<&'a Result4>,
}

/// Name of the mean filament in legends.
const MEAN: &str = "mean filament";

impl<'a> Panels<'a> {
    fn of(results: &'a [Result4], variant: Variant, mean: Option<Variant>) -> Self {
        let of_variant = |variant| {
            let all = results.iter().filter(move |r| r.case.variant == variant);
            all.filter(|r| is_drawn(r.case.resolved))
        };
        let mut drawn: Vec<&Result4> = of_variant(variant).collect();
        drawn.sort_by(|a, b| a.case.rod_share().total_cmp(&b.case.rod_share()));
        let mean = mean.and_then(|mean| {
            of_variant(mean).find(|r| matches!(r.case.resolved, Resolved::Ellipsoids(_)))
        });
        Self {
            what: variant.words(),
            drawn,
            mean,
        }
    }

    fn draw(&self, name: &str, out: &Path) -> Result<Vec<Picture>, String> {
        let titles =
            ["Side view", "End view", "Energy"].map(|view| format!("{view}, {}", self.what));
        let z_label = "z along the unloaded filament (nm)";
        let charts = [
            self.view(&titles[0], z_label, |p| (p[2], p[0])),
            self.view(&titles[1], "y (nm)", |p| (p[1], p[0])),
            self.energies(&titles[2]),
        ];
        let shown = ["side", "end", "energy"]
            .into_iter()
            .zip(charts)
            .zip(self.captions());
        let moved = self.drawn[0].moved;
        let shown = shown.filter(|((panel, _), _)| *panel != "energy" || moved);
        shown
            .map(|((panel, chart), caption)| {
                let file = format!("{name}_{panel}.svg");
                chart.draw(&out.join(&file))?;
                Ok(Picture { file, caption })
            })
            .collect()
    }

    /// What is seen on side view, end view and energy.
    fn captions(&self) -> [String; 3] {
        let mean = match self.mean {
            Some(_) => " Dashed: monomers alone with weighted bonds, the mean filament.",
            None => "",
        };
        [
            format!(
                "Equilibria under {}. Lines: nodes of the rod, and the centre line of the monomers; \
                 dots: monomer centres. {}{mean}",
                self.what,
                palette::chosen().ends()
            ),
            format!("The same states seen along the unloaded filament.{mean}"),
            format!("Elastic and kinetic energy while the damped motion comes to rest.{mean}"),
        ]
    }

    /// Monomer centres as dots under the centre lines, projected by `project`.
    fn view<'t>(
        &self,
        title: &'t str,
        x_label: &'t str,
        project: fn(&[f64; 3]) -> (f64, f64),
    ) -> Chart<'t> {
        let dots = self.drawn.iter().map(|r| Series {
            label: None,
            colour: palette::resolution(r.case.rod_share()),
            points: r.monomers.iter().map(project).collect(),
            dots: true,
        });
        let lines = self.lines(true, |r| r.centre_line.iter().map(project).collect());
        Chart {
            title,
            x_label,
            y_label: X_LABEL,
            series: dots.chain(lines).collect(),
            equal_axes: true,
        }
    }

    fn energies<'t>(&self, title: &'t str) -> Chart<'t> {
        Chart {
            title,
            x_label: "time (ns)",
            y_label: "elastic and kinetic energy (pN nm)",
            series: self.lines(false, |r| r.energy.clone()),
            equal_axes: false,
        }
    }

    /// A line for each resolution, and above them dashes for the mean filament.
    fn lines(&self, equal_axes: bool, points: impl Fn(&Result4) -> Vec<(f64, f64)>) -> Vec<Series> {
        let line = |label: String, colour, r: &Result4| Series {
            label: Some(label),
            colour,
            points: points(r),
            dots: false,
        };
        let drawn = self.drawn.iter().map(|r| {
            let colour = palette::resolution(r.case.rod_share());
            line(r.case.name(), colour, r)
        });
        let mean = self.mean.map(|r| line(MEAN.into(), palette::DATA, r));
        let mean = mean.into_iter().flat_map(|line| line.dashed(equal_axes));
        drawn.chain(mean).collect()
    }
}

/// Length of the filament (nm).
const LENGTH_NM: f64 = 160.0;

/// Curves against the length of rod: whose mixed filaments, whose pure ones, and the colour.
fn curves() -> [(Variant, [Variant; 2], Colour); 4] {
    [
        (
            Variant::SHARED,
            [Variant::SHARED, Variant::SHARED],
            palette::line(0),
        ),
        (
            Variant::FULL,
            [Variant::SHARED, Variant::SHARED],
            palette::line(1),
        ),
        (
            Variant::AS_PRINTED,
            [Variant::SHARED, Variant::AS_PRINTED],
            palette::line(3),
        ),
        (
            Variant::MEAN,
            [Variant::MEAN, Variant::SHARED],
            palette::DATA,
        ),
    ]
}

/// Tips and elastic energies of equilibria under 2 pN against the length of rod.
fn against_resolution(results: &[Result4], out: &Path) -> Result<Vec<Picture>, String> {
    let x_label = "rod at the tip (nm)";
    let tip = "distance of the tip along the force (nm)";
    let energy = "elastic energy at equilibrium (pN nm)";
    let charts = [
        ("tips", tip, series(results, |r| r.tip_drop_nm)),
        ("energies", energy, series(results, Result4::elastic_pn_nm)),
    ];
    let drawn = charts.into_iter().map(|(name, y_label, series)| {
        let chart = Chart {
            title: "Equilibria under 2 pN against resolution",
            x_label,
            y_label,
            series,
            equal_axes: false,
        };
        let file = format!("fig4_{name}.svg");
        chart.draw(&out.join(&file))?;
        let caption = format!(
            "The {y_label} against the length of rod, monomers alone at 0 and rod alone at 160 nm; \
             drawn bonds of the first sampling, and the mean filament (black)."
        );
        Ok(Picture { file, caption })
    });
    drawn.collect()
}

/// A line with a dot at each resolution for every curve that was computed.
fn series(results: &[Result4], value: fn(&Result4) -> f64) -> Vec<Series> {
    let all = curves()
        .into_iter()
        .flat_map(|(mixed, [ellipsoids, rod], colour)| {
            let belongs = |r: &&Result4| {
                let of = match r.case.resolved {
                    Resolved::Mixed(_) => mixed,
                    Resolved::Ellipsoids(_) => ellipsoids,
                    Resolved::Rod(_) => rod,
                };
                r.case.variant == of && is_drawn(r.case.resolved)
            };
            let is_computed = results.iter().any(|r| r.case.variant == mixed);
            let chosen = results.iter().filter(belongs).filter(|_| is_computed);
            let mut points: Vec<(f64, f64)> = chosen
                .map(|r| (LENGTH_NM * r.case.rod_share(), value(r)))
                .collect();
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            let series = |label, dots| Series {
                label,
                colour,
                points: points.clone(),
                dots,
            };
            let line = series(is_computed.then(|| mixed.words()), false);
            // It lies upon the line of the junction as printed alone.
            let mut all = if mixed == Variant::AS_PRINTED {
                line.dashed(false)
            } else {
                vec![line]
            };
            all.push(series(None, true));
            all
        });
    all.collect()
}
