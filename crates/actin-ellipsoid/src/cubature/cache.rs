//! Cache of quadratures.

use super::{Cubature, CubatureError, numbers, table};
use crate::{EllipsoidParameters, InterfaceKind};
use std::collections::HashMap;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// Kind, number of points, and bits of the geometric parameters.
type Key = (InterfaceKind, usize, [u64; 8]);

type CubatureResult = Result<Arc<Cubature>, CubatureError>;

/// Entries are filled by the first caller while others wait.
static FOUND: Mutex<Option<HashMap<Key, Arc<OnceLock<CubatureResult>>>>> = Mutex::new(None);

pub(super) fn get(parameters: &EllipsoidParameters, kind: InterfaceKind) -> CubatureResult {
    let numbers = numbers(parameters, kind);
    let key = (
        kind,
        parameters.interface(kind).bonds,
        numbers.map(f64::to_bits),
    );
    let place = {
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
