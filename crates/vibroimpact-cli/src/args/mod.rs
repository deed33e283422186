//! Groups of arguments that several commands share. Arguments of one command are in the file of that command.

mod axes;
mod changed;
mod colour;
mod fields;
mod figure;
mod numbers;
mod of_machine;
mod output;
mod parameter_flag;
mod physical;
mod plane;
mod ranged;
mod ranged_system;
mod start;
mod store;
mod system;
mod unit_text;
mod vary;

pub(crate) use axes::AxesArgs;
pub(crate) use changed::SetArgs;
pub(crate) use colour::ColourArgs;
pub(crate) use fields::{FieldName, FieldsArgs, quantity};
pub(crate) use figure::{FigureArgs, Format};
pub(crate) use numbers::{number, whole, within};
pub(crate) use of_machine::{MachineArgs, MachineAxesArgs, StartOfMachineArgs};
pub(crate) use output::Globals;
pub(crate) use parameter_flag::{ParameterFlag, Varied, parameter, varied};
pub(crate) use physical::PhysicalArgs;
pub(crate) use plane::{Ends, Named, Over, Place, Value, VariedOver};
pub(crate) use ranged::Ranged;
pub(crate) use ranged_system::RangedSystemArgs;
pub(crate) use start::StartArgs;
pub(crate) use store::{Budget, BudgetArgs, Filling, StoreArgs, Tiles};
pub(crate) use system::{Convention, SystemArgs};
pub(crate) use vary::of_oscillator;
