//! What the rows say of themselves, and that the library's table is what they say.

use super::{print, statics, study};
use actin_sim::advice::table;

fn study(name: &str, settings: &[&str]) -> study::Study {
    let mut study = study::studies(&[name.to_owned()], false).remove(0);
    study.settings.retain(|(_, setting, _)| {
        setting == "all monomers" || settings.contains(&setting.as_str())
    });
    assert_eq!(study.settings.len(), settings.len() + 1);
    study
}

/// The reference is its own: a comparison that mixed up azimuths or settings would show. Every number
/// is finite, and the front holds the reference, which nothing beats in accuracy.
#[test]
fn the_reference_has_no_error() {
    let mut study = study("twist", &["none/Constant", "middle-37/Fitted"]);
    study.samplings = 2;
    let rows = statics::rows(&study).unwrap();
    let reference = &rows[0];
    let errors = [
        reference.error_displacement,
        reference.error_energy,
        reference.error_torque,
        reference.error_local,
    ];
    assert_eq!(errors, [Some(0.0); 4]);
    assert_eq!(reference.cost_motion, Some(1.0));
    assert!(reference.on_front);
    for row in &rows {
        assert!(row.numbers().iter().all(|v| v.is_finite()), "{row:?}");
        assert_eq!(row.doubtful, 0, "{row:?}");
    }
    assert!(rows[1..].iter().all(|row| row.error_torque > Some(0.0)));
}

/// The table that `actin check` speaks from is what the command measures: one cheap row again. Both are
/// rounded to 1e-4, and equilibria are found to 1e-7 pN.
#[test]
fn the_committed_table_is_what_is_measured() {
    let name = "none/Fitted";
    let study = study("cantilever-160", &[name]);
    let rows = statics::rows(&study).unwrap();
    let [again] = &print::advice(&rows)[..] else {
        panic!("one row besides the reference");
    };
    let known = table::measured().into_iter();
    let same = |row: &table::Measured| row.scene == again.scene && row.monomers_nm.is_empty();
    let committed: Vec<_> = known
        .filter(|row| {
            same(row)
                && row.law == again.law
                && row.segment_nm.to_bits() == again.segment_nm.to_bits()
        })
        .collect();
    assert_eq!(committed.len(), 1);
    assert_eq!(committed[0].azimuths, again.azimuths);
    for (a, b) in [
        (committed[0].displacement, again.displacement),
        (committed[0].energy, again.energy),
        (committed[0].torque, again.torque),
        (committed[0].local, again.local),
        (committed[0].scatter, again.scatter),
    ] {
        assert!(
            (a.unwrap() - b.unwrap()).abs() < 1.01e-4,
            "{:?} {again:?}",
            committed[0]
        );
    }
}
