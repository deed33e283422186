//! The machines of the catalogue.
