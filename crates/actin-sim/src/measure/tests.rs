//! Closed forms that the protocols must find.
