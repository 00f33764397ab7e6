//! siphons
