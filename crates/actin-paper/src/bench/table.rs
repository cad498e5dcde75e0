//! The table for readers.

use super::Measured;
use super::cases::{Case, Work};
use crate::Tell;

/// Its head.
pub(super) fn head(tell: Tell<'_>) {
    tell(format_args!(
        "{:>13}  {:30} {:>10} {:>10} {:>10}  unit",
        "ours / target", "case", "best", "median", "target"
    ));
}

/// One case. Rates are in millions.
pub(super) fn row(case: &Case, measured: &Measured, tell: Tell<'_>) {
    let ratio = case
        .target
        .map_or("-".to_owned(), |t| format!("{:.2}", measured.best / t));
    let scaled = |value: f64| match case.work {
        Work::Motion(_) => format!("{:.1}", 1e-6 * value),
        Work::Equilibrium { .. } => format!("{value:.4}"),
        Work::Ensemble(_) => format!("{value:.2}"),
    };
    let million = match case.work {
        Work::Motion(_) => "1e6 ",
        Work::Equilibrium { .. } | Work::Ensemble(_) => "",
    };
    tell(format_args!(
        "{ratio:>13}  {:30} {:>10} {:>10} {:>10}  {million}{}; {}",
        case.name,
        scaled(measured.best),
        scaled(measured.median),
        case.target.map_or("-".to_owned(), scaled),
        case.unit(),
        measured.note
    ));
}
