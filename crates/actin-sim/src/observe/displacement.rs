//! Squared displacement of a point.

use super::{Checked, Observe, RecordTimes, StoredPositions, View, chain};
use crate::scene::Point;
use crate::{Assembly, End};
use actin_mechanics::Vector3;

const SAME: f64 = 1e-6;

/// Squared displacement of a point since the first record or over a lag.
#[derive(Debug)]
pub(super) struct SquaredDisplacement {
    pub(super) filament: usize,
    pub(super) of: Point,
    pub(super) lag_ns: Option<f64>,
}

impl SquaredDisplacement {
    fn place(&self, view: &View<'_>) -> Vector3 {
        match self.of {
            Point::Tip => view.assembly.tip_of(self.filament, view.state, End::End),
            Point::Centre => chain::centre(view.ribbon(self.filament)),
        }
    }
}

impl Observe for SquaredDisplacement {
    fn columns(&self) -> Vec<String> {
        let of = match self.of {
            Point::Tip => "tip",
            Point::Centre => "centre",
        };
        let over = self.lag_ns.map(|lag| format!("_over_{lag}ns"));
        let over = over.unwrap_or_default();
        vec![format!(
            "squared_displacement[{}]_{of}{over}_nm2",
            self.filament
        )]
    }

    fn observe(&self, view: &View<'_>, past: &mut StoredPositions, row: &mut Vec<f64>) {
        let here = self.place(view);
        let Some(lag) = self.lag_ns else {
            let first = *past.first.get_or_insert(here.into());
            row.push((here - Vector3::from(first)).norm_squared());
            return;
        };
        let now = view.at.value();
        let (earliest, latest) = (now - lag * (1.0 + SAME), now - lag * (1.0 - SAME));
        while past.recent.front().is_some_and(|(t, _)| *t < earliest) {
            past.recent.pop_front();
        }
        let then = past.recent.front().filter(|(t, _)| *t <= latest);
        let square = then.map(|(_, then)| (here - Vector3::from(*then)).norm_squared());
        row.push(square.unwrap_or(f64::NAN));
        past.recent.push_back((now, here.into()));
    }

    /// A lag must be a multiple of the record interval.
    fn check(&self, _assembly: &Assembly, times: Option<&RecordTimes>) -> Checked {
        let (Some(lag), Some(times)) = (self.lag_ns, times) else {
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
}
