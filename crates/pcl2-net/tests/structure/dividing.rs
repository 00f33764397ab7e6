//! dividing
