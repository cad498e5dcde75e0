//! Points that were found are kept: one search per geometry and process.

use super::{Cubature, CubatureError, numbers, table};
use crate::{EllipsoidParameters, InterfaceKind};
use std::collections::HashMap;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// What the points of an interface depend on: kind and number of points, and the bits of the
/// numbers.
type Key = (InterfaceKind, usize, [u64; 8]);

/// What a search led to.
type Found = Result<Arc<Cubature>, CubatureError>;

/// A place for each geometry, filled by the first caller while others wait.
static FOUND: Mutex<Option<HashMap<Key, Arc<OnceLock<Found>>>>> = Mutex::new(None);

/// The points of an interface.
pub(super) fn get(parameters: &EllipsoidParameters, kind: InterfaceKind) -> Found {
    let numbers = numbers(parameters, kind);
    let key = (
        kind,
        kind.parameters(parameters).bonds,
        numbers.map(f64::to_bits),
    );
    let place = {
        // A search that panicked has left the map as it was.
        let mut found = FOUND.lock().unwrap_or_else(PoisonError::into_inner);
        let places = found.get_or_insert_with(HashMap::new);
        Arc::clone(places.entry(key).or_default())
    };
    let find = || {
        table::built_in(parameters, kind)
            .map_or_else(|| Cubature::find(parameters, kind), Ok)
            .map(Arc::new)
    };
    place.get_or_init(find).clone()
}
