//! What a command says to people. JSON, tables and figures are those of `vibroimpact-report`.

pub(crate) mod branch;
pub(crate) mod curve;
pub(crate) mod lyapunov;
pub(crate) mod orbit;
pub(crate) mod region;
pub(crate) mod stored;
pub(crate) mod text;
