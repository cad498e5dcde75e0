//! What our own filaments of monomers show of twist, for Figure 9: the numbers of Tables 3 and 5.

use super::ensemble::{Ensemble, Kind, core};
use crate::figures::Run;
use crate::fit::TwistData;
use crate::published::{Entry, Table, entries};

/// Twisting rigidity and change of length at the curvatures that the paper calls reliable: the mean
/// over samplings of drawn bonds, then the mean filament.
pub(in crate::figures) fn monomers(run: Run<'_>) -> Result<[TwistData; 2], String> {
    let ensemble = core(run)?;
    let drawn = format!("our monomers, mean of {} samplings", ensemble.seeds);
    Ok([
        of(ensemble, Kind::DEFAULT, drawn)?,
        of(
            ensemble,
            Kind::MEAN,
            "our monomers, mean filament".to_owned(),
        )?,
    ])
}

fn of(ensemble: &Ensemble, kind: Kind, source: String) -> Result<TwistData, String> {
    let column = |table| -> Result<Vec<(f64, f64)>, String> {
        let all = entries(table)?.into_iter();
        let reliable = all.filter(Entry::is_reliable);
        let points = reliable.map(|e| (e.curvature, ensemble.sample(kind, &e, table).mean));
        Ok(points.collect())
    };
    Ok(TwistData::new(
        source,
        column(Table::Rigidity)?,
        column(Table::LengthChange)?,
    ))
}
