//! Branch-free elementary functions.
