//! Figure of a trade: error versus run time.

use crate::draw::{Colour, OKABE_ITO, Scatter, ScatterPoint};
use actin_sim::trade::{Candidate, Trade};
use std::path::Path;

/// Plots error versus run time to an SVG file, with logarithmic axes.
///
/// Each point is the largest error of a candidate. One line connects the Pareto front, another marks the target
/// error. Candidates with zero or unknown error have no point.
///
/// # Errors
/// If the file cannot be written.
pub fn draw_trade(trade: &Trade, path: &Path) -> Result<(), String> {
    let has_result = |candidate: &&Candidate| {
        candidate.failure.is_none()
            && candidate.worst_error() > 0.0
            && candidate.worst_error().is_finite()
    };
    let mut shown: Vec<&Candidate> = trade.candidates.iter().filter(has_result).collect();
    shown.sort_by(|a, b| a.wall_s.total_cmp(&b.wall_s));
    let mut least = f64::INFINITY;
    let points = shown.into_iter().map(|candidate| {
        let error = candidate.worst_error();
        let on_front = error < least;
        least = least.min(error);
        let is_rod = candidate.counts.monomers == 0;
        let is_whole = candidate.counts.segments == 0;
        let kind = if is_whole {
            0
        } else if is_rod {
            1
        } else {
            2
        };
        ScatterPoint {
            place: (candidate.wall_s, error),
            colour: Colour(OKABE_ITO[kind]),
            name: candidate.name.clone(),
            on_front,
        }
    });
    let wanted = format!("wanted: {} %", 100.0 * trade.options.error);
    Scatter {
        title: "Error against time",
        x_label: "time (s)",
        y_label: "largest relative error",
        points: points.collect(),
        level: Some((trade.options.error, &wanted)),
        list_title: "candidates; * Pareto front",
    }
    .draw(path)
}
