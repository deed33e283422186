//! What a command says: JSON for programs, text for people, CSV for tables.

pub(crate) mod csv;
pub(crate) mod diagram;
pub(crate) mod json;
pub(crate) mod lyapunov;
pub(crate) mod text;
