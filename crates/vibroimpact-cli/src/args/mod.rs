//! Groups of arguments that several commands share. Arguments of one command are in the file of that command.

mod axes;
mod fields;
mod numbers;
mod output;
mod plane;
mod ranged;
mod start;
mod store;
mod system;
mod vary;

pub(crate) use axes::AxesArgs;
pub(crate) use fields::FieldsArgs;
pub(crate) use numbers::{number, whole, within};
pub(crate) use output::Globals;
pub(crate) use plane::{Ends, Named, Over, Place};
pub(crate) use ranged::Ranged;
pub(crate) use start::StartArgs;
pub(crate) use store::{StoreArgs, Tiles};
pub(crate) use system::{Convention, MachineArgs, SystemArgs};
pub(crate) use vary::parameter;
