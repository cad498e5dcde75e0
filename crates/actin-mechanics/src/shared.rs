//! Copy-on-write storage.

use std::ops::{Deref, DerefMut};
use std::sync::Arc;

/// Copy-on-write value: copies share it until one of them changes it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shared<T>(Arc<T>);

impl<T> Deref for Shared<T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.0
    }
}

impl<T: Clone> DerefMut for Shared<T> {
    fn deref_mut(&mut self) -> &mut T {
        Arc::make_mut(&mut self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_changed_copy_is_no_longer_shared() {
        let one = Shared(Arc::new(vec![1, 2]));
        let mut other = one.clone();
        assert!(Arc::ptr_eq(&one.0, &other.0));
        other.push(3);
        assert!(!Arc::ptr_eq(&one.0, &other.0));
        assert_eq!((one.len(), other.len()), (2, 3));
    }
}
