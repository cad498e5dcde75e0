//! Squared displacement of a point.

use super::{Checked, RecordTimes, StoredPositions, View, chain};
use crate::End;
use crate::scene::Point;
use actin_mechanics::Vector3;

const SAME: f64 = 1e-6;

pub(super) fn columns(filament: usize, of: Point, lag_ns: Option<f64>) -> Vec<String> {
    let of = match of {
        Point::Tip => "tip",
        Point::Centre => "centre",
    };
    let over = lag_ns.map_or_else(String::new, |lag| format!("_over_{lag}ns"));
    vec![format!("squared_displacement[{filament}]_{of}{over}_nm2")]
}

/// Squared displacement of a point since the first record or over a lag.
pub(super) fn value(
    view: &View<'_>,
    (filament, of): (usize, Point),
    lag_ns: Option<f64>,
    past: &mut StoredPositions,
) -> f64 {
    let here = match of {
        Point::Tip => view.assembly.tip_of(filament, view.state, End::End),
        Point::Centre => chain::centre(&chain::edges(view, filament)),
    };
    let Some(lag) = lag_ns else {
        let first = *past.first.get_or_insert(here.into());
        return (here - Vector3::from(first)).norm_squared();
    };
    let now = view.at.value();
    let (earliest, latest) = (now - lag * (1.0 + SAME), now - lag * (1.0 - SAME));
    while past.recent.front().is_some_and(|(t, _)| *t < earliest) {
        past.recent.pop_front();
    }
    let then = past.recent.front().filter(|(t, _)| *t <= latest);
    let square = then.map(|(_, then)| (here - Vector3::from(*then)).norm_squared());
    past.recent.push_back((now, here.into()));
    square.unwrap_or(f64::NAN)
}

/// A lag must be a multiple of the record interval.
pub(super) fn check(lag_ns: Option<f64>, times: Option<&RecordTimes>) -> Checked {
    let (Some(lag), Some(times)) = (lag_ns, times) else {
        return Ok(());
    };
    let every = times.every_ns;
    let records = (lag / every).round();
    if records >= 1.0 && (lag - records * every).abs() <= SAME * lag {
        return Ok(());
    }
    let rule = format!("must be a multiple of the time between records, {every:?}");
    Err(("lag_ns", lag, rule))
}
