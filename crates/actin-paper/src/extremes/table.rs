//! The whole table: every number in turn.

use super::row::Row;
use super::{
    Tell, certificates, compression, contrast, directories, drag, drift, fields, forces, guards,
    lengths, origin, sizes, stability, straight, turns,
};
use rayon::prelude::*;
use std::time::Instant;

/// What the rows have in common, and what computes them.
type Group<'a> = (&'static str, &'a (dyn Fn() -> Vec<Row> + Sync));

/// The whole table, in the order in which it is printed; `long` with the rows that take minutes.
pub(super) fn table(long: bool, tell: Tell<'_>) -> Vec<Row> {
    // Alone on the machine: their times and their memory are told.
    let sizes = timed(&("sizes", &|| of_sizes(long)), tell);
    let groups: [Group<'_>; 19] = [
        ("time steps", &|| stability::rows(&stability::INTEGRATORS)),
        ("energy below the limit", &|| {
            stability::below(&stability::INTEGRATORS)
        }),
        ("time steps of scenes", &|| {
            stability::asked_for(&stability::INTEGRATORS)
        }),
        ("stiffness contrast", &contrast::rows),
        ("twist", &|| turns::twist(true)),
        ("turns of a segment", &turns::one_segment),
        ("turns that slip", &turns::slipping),
        ("straight rods", &straight::rows),
        ("segments", &lengths::segments),
        ("bonds", &lengths::bonds),
        ("forces", &forces::rows),
        ("neutral modes", &certificates::rows),
        ("compression", &compression::rows),
        ("sizes, as above", &|| sizes.clone()),
        ("drag", &drag::rows),
        ("undamped motion", &|| {
            drift::rows(if long { 10_000_000 } else { 100_000 })
        }),
        ("origin", &origin::rows),
        ("fields and guards", &|| {
            [fields::rows(), guards::rows()].concat()
        }),
        ("directories", &directories::rows),
    ];
    let rows = groups.par_iter().with_max_len(1).map(|g| timed(g, tell));
    rows.collect::<Vec<_>>().concat()
}

/// The rows of a group; tells how long they took.
fn timed((name, rows): &Group<'_>, tell: Tell<'_>) -> Vec<Row> {
    let clock = Instant::now();
    let rows = rows();
    tell(format_args!(
        "{name}: {:.1} s",
        clock.elapsed().as_secs_f64()
    ));
    rows
}

/// Numbers of bodies and of stages.
fn of_sizes(long: bool) -> Vec<Row> {
    let (bodies, stages) = if long {
        (1_000_000, 100_000)
    } else {
        (1_000, 1_000)
    };
    [
        sizes::smallest(),
        sizes::largest(bodies),
        sizes::stages(stages),
    ]
    .concat()
}
