//! Equilibria of monomers, kept from run to run: one file for each case and filament, with all that they
//! depend on besides this program.

use super::case::Case;
use super::filament::Made;
use super::solve::{Found, solve};
use actin_draw::report::write_atomically;
use actin_sim::Monomers;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// Raised when results of the same parameters change.
const VERSION: u32 = 2;

/// A file.
#[derive(Deserialize, Serialize)]
struct Kept {
    key: String,
    outcome: Result<Found, String>,
}

/// What a filament of monomers does, from its file if that has the same key, and whether it came from there;
/// without a folder it is computed.
///
/// # Errors
/// A file that cannot be written. A filament without an equilibrium is an outcome, which is kept too.
pub(super) fn kept(
    folder: Option<&Path>,
    case: &Case,
    made: &Made,
) -> Result<(Result<Found, String>, bool), String> {
    let Some(folder) = folder else {
        return Ok((solve(case, made), false));
    };
    let monomers = Monomers::default();
    let key = format!("version {VERSION}, {case:?}, {made:?}, {monomers:?}");
    let path = folder.join(format!("{}-{}.json", case.file(), made.name()));
    let text = std::fs::read_to_string(&path).ok();
    let there = text.and_then(|text| serde_json::from_str::<Kept>(&text).ok());
    if let Some(there) = there.filter(|there| there.key == key) {
        return Ok((there.outcome, true));
    }
    let outcome = solve(case, made);
    let kept = Kept { key, outcome };
    let text = serde_json::to_string(&kept).map_err(|e| e.to_string())?;
    write_atomically(&path, &text)?;
    Ok((kept.outcome, false))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::load_cases::bound::Group;
    use crate::load_cases::case;

    /// The second time it comes from the file, to the last bit; of other loads it is computed.
    #[test]
    fn outcomes_come_back() {
        let folder = tempfile::tempdir().unwrap();
        let mut case = case::guided(Group::Beside, 9, 5.0);
        let made = Made::Mean { azimuth_deg: 0.0 };
        let (first, was_there) = kept(Some(folder.path()), &case, &made).unwrap();
        assert!(!was_there && first.as_ref().unwrap().values.len() == 2);
        let (again, was_there) = kept(Some(folder.path()), &case, &made).unwrap();
        assert!(was_there);
        assert_eq!(again, first);
        if let case::Kind::Guided { forces_pn, .. } = &mut case.kind {
            forces_pn.truncate(1);
        }
        let (other, was_there) = kept(Some(folder.path()), &case, &made).unwrap();
        assert!(!was_there);
        assert_eq!(other.unwrap().values, first.unwrap().values[..1]);
    }
}
