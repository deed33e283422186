//! What a command says: JSON for programs, text for people, CSV for tables.

pub(crate) mod branch;
pub(crate) mod branch_text;
pub(crate) mod csv;
pub(crate) mod curve;
pub(crate) mod diagram;
pub(crate) mod json;
pub(crate) mod lyapunov;
pub(crate) mod orbit;
pub(crate) mod region;
pub(crate) mod stored;
pub(crate) mod text;
