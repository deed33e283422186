//! The help of commands: the options of a command itself, and those that commands share once, as topics of `vibro help`.
//!
//! A command has some fifty options that say which system, where it starts and how a figure looks. They are hidden from the help of
//! each command, and stand in `vibro help system`, `vibro help figure` and `vibro help store`. Completions and manual pages have all of them.

use crate::unit_table::UnitKind;
use clap::builder::{Resettable, StyledStr};
use clap::{Arg, Command};
use vibroimpact_study::Quantity;
use vibroimpact_study::machine::CATALOGUE;

/// The headings of the options of systems, which begin so.
const SYSTEM: [&str; 4] = ["System", "Excitation", "Start", "Machine"];
/// Those of figures and of all commands, and those of stores.
const FIGURE: [&str; 2] = ["Figure", "General"];
const STORE: [&str; 1] = ["Store"];
/// The width of a line of the summary.
const WIDTH: usize = 98;

/// Whether an option stands under one of these headings. `Starts` of a command are its own.
fn under(arg: &Arg, headings: &[&str]) -> bool {
    let heading = arg.get_help_heading().unwrap_or_default();
    headings.iter().any(|name| heading == *name || heading.strip_prefix(name).is_some_and(|rest| rest.starts_with(' ')))
}

/// The commands with the shared options hidden from their help, and with one line for each other option in their summary.
pub(crate) fn shown(command: Command) -> Command {
    let names: Vec<String> = command.get_subcommands().map(|sub| sub.get_name().to_owned()).collect();
    let command = command.mut_args(hidden_if_shared);
    names.into_iter().fold(command, |command, name| command.mut_subcommand(name, own))
}

fn hidden_if_shared(arg: Arg) -> Arg {
    let shared = [&SYSTEM[..], &FIGURE, &STORE].iter().any(|headings| under(&arg, headings));
    if shared { arg.hide_short_help(true).hide_long_help(true) } else { arg }
}

/// A command as its help shows it.
fn own(command: Command) -> Command {
    let has = |headings: &[&str]| command.get_arguments().any(|arg| under(arg, headings));
    let topics = [("system", has(&SYSTEM)), ("figure", has(&FIGURE)), ("store", has(&STORE))];
    let more: Vec<String> =
        topics.iter().filter(|(_, has)| *has).map(|(topic, _)| format!("`vibro help {topic}`")).collect();
    let command = command.mut_args(|arg| brief(hidden_if_shared(arg)));
    if more.is_empty() {
        return command;
    }
    let examples = command.get_after_help().map(StyledStr::to_string).unwrap_or_default();
    let first = examples.match_indices("\n  vibro ").nth(1).map_or(examples.as_str(), |(end, _)| &examples[..end]);
    let with = |examples: &str| format!("More options: {}\n\n{examples}", more.join(", "));
    let (brief, whole) = (with(first), with(&examples));
    command.after_help(brief).after_long_help(whole)
}

/// An option whose summary is the first clause of its help; the whole stands in `--help`.
fn brief(arg: Arg) -> Arg {
    let Some(help) = arg.get_help().map(StyledStr::to_string) else { return arg };
    let long = arg.get_long_help().map_or_else(|| help.clone(), StyledStr::to_string);
    // what stands before the help: two margins, the name and the value
    let values: usize = arg.get_value_names().unwrap_or_default().iter().map(|name| name.len() + 3).sum();
    let room = WIDTH.saturating_sub(12 + arg.get_long().map_or(0, str::len) + values);
    let end = ["; ", ": ", ". ", " (", ", "].iter().filter_map(|mark| help.find(mark).filter(|end| *end > 12)).min();
    let clause = match end {
        Some(end) if help.len() > room.min(56) => help[..end].to_owned(),
        _ => help,
    };
    arg.help(clause).long_help(long)
}

/// The topics of `vibro help` beside the commands.
const TOPICS: [(&str, &str); 6] = [
    ("system", "the options that say which system and where it starts"),
    ("figure", "the options of figures, and those of all commands"),
    ("store", "the options of studies in stores"),
    ("units", "the units that may follow a number"),
    ("quantities", "the quantities of a motion"),
    ("machines", "machines of several coordinates, and the catalogue"),
];

/// The text of a topic; `None` if there is no such topic.
pub(crate) fn topic(name: &str, command: &Command) -> Option<String> {
    Some(match name {
        "system" => options(command, &SYSTEM, "Which system, and where it starts"),
        "figure" => options(command, &FIGURE, "How figures look, and options of all commands"),
        "store" => options(command, &STORE, "Studies in stores"),
        "units" => units(),
        "quantities" => quantities(),
        "machines" => machines(),
        _ => return None,
    })
}

/// The names of the topics with what they are.
pub(crate) fn topics() -> String {
    TOPICS.iter().map(|(name, what)| format!("  vibro help {name:<10}  {what}\n")).collect()
}

/// The options of all commands under some headings, each once, as the first command has it that has it.
fn options(command: &Command, headings: &[&str], title: &'static str) -> String {
    let mut command = command.clone();
    // gives each command the options of all commands
    command.build();
    let mut page = Command::new("vibro").about(title).disable_help_flag(true).help_template("{about}\n\n{all-args}");
    for arg in command.get_subcommands().flat_map(Command::get_arguments).filter(|arg| under(arg, headings)) {
        if page.get_arguments().all(|known| known.get_id() != arg.get_id()) {
            page = page.arg(alone(arg.clone()));
        }
    }
    format!("{}\n", page.render_long_help().to_string().trim_end())
}

/// An option without its relations to others, which may be absent.
fn alone(arg: Arg) -> Arg {
    arg.conflicts_with(Resettable::Reset)
        .overrides_with(Resettable::Reset)
        .requires(Resettable::Reset)
        .group(Resettable::Reset)
        .global(false)
        .required(false)
}

fn units() -> String {
    let mut text =
        "A number in physical units may be followed by its unit, with or without a blank: 1.5mm, \"2 %\", 900rpm.\n\
                    Without one it is in the first unit of its line.\n\n"
            .to_owned();
    for (kind, what) in UnitKind::ALL {
        let names: Vec<&str> =
            kind.units().iter().map(|(name, _)| if name.is_empty() { "(none)" } else { *name }).collect();
        text += &format!("  {what:<20} {}\n", names.join(", "));
    }
    text
}

fn quantities() -> String {
    let wide = Quantity::ALL.iter().map(|quantity| quantity.name().len()).max().unwrap_or(0);
    let lines =
        Quantity::ALL.iter().map(|of| format!("  {:<wide$}  {}\n", of.name().replace('_', "-"), of.description()));
    format!(
        "Quantities of a motion, for --fields, --colour, --quantity and --show. They are exact from the closed forms.\n\n{}\n\
         Those of the parts of a machine have a path: stop.NAME.impact-speed-max, q.NAME.displacement-rms. `vibro settle\n\
         --machine FILE --json` has all of them.\n",
        lines.collect::<String>()
    )
}

fn machines() -> String {
    let titles: Vec<(&str, String)> = CATALOGUE
        .iter()
        .map(|entry| (entry.name, entry.source().ok().and_then(|of| of.title).unwrap_or_default()))
        .collect();
    format!(
        "A machine has coordinates, a mass, damping and stiffness matrix, forces, stops and friction joints. --machine takes the name\n\
         of one of the catalogue, or a file:\n\n\
         \x20 [machine]\n\
         \x20 bodies = {{ frame = 1, head = 0.5 }}\n\
         \x20 link = [{{ between = [\"frame\", \"ground\"], stiffness = 1, damping = 0.1 }}, {{ between = [\"frame\", \"head\"], stiffness = 1 }}]\n\
         \x20 frequency = 1.2\n\
         \x20 force = [{{ at = \"frame\", sin = 1 }}]\n\
         \x20 stop = [{{ name = \"anvil\", at = \"head\", gap = 0.5, restitution = 0.6 }}]\n\n\
         Each number has a path, such as stop.anvil.gap: --set, --vary and --axis take it. `vibro machine show NAME` lists the paths\n\
         and what the file expands to, `vibro schema --machine` what may be in a file.\n\n{}",
        crate::report::machine::list(titles.iter().map(|(name, title)| (*name, title.as_str())))
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::commands::CommandLine;
    use clap::CommandFactory;

    fn command() -> Command {
        let mut command = shown(CommandLine::command()).term_width(100);
        command.build();
        command
    }

    /// One screen, with the options of the command itself.
    #[test]
    fn a_summary_has_at_most_forty_lines() {
        for sub in command().get_subcommands_mut() {
            let text = sub.render_help().to_string();
            assert!(text.lines().count() <= 40, "{} lines\n{text}", text.lines().count());
            assert!(!text.contains("--force-n <F>") && !text.contains("--greyscale"), "{text}");
        }
    }

    /// Each option of a command is in its help, or in a topic.
    #[test]
    fn no_option_is_lost() {
        let plain = CommandLine::command();
        let topics = ["system", "figure", "store"].map(|name| topic(name, &plain).unwrap()).concat();
        for sub in command().get_subcommands_mut() {
            let long = sub.render_long_help().to_string();
            for arg in sub.get_arguments().filter(|arg| !arg.is_hide_set()) {
                let Some(flag) = arg.get_long() else { continue };
                let named = |text: &str| text.split([' ', '\n', ',', ']']).any(|word| word == format!("--{flag}"));
                assert!(named(&long) || named(&topics), "{} --{flag}", sub.get_name());
            }
        }
        assert!(topic("mass", &plain).is_none());
        for (name, _) in TOPICS {
            let text = topic(name, &plain).unwrap();
            assert!(text.lines().all(|line| line.chars().count() <= 130) && text.lines().count() > 5, "{text}");
        }
    }

    /// A terminal of 100 columns shows each line of an example as one line.
    #[test]
    fn examples_are_not_wrapped() {
        for sub in command().get_subcommands() {
            let text = sub
                .get_after_long_help()
                .or_else(|| sub.get_after_help())
                .map(StyledStr::to_string)
                .unwrap_or_default();
            for line in text.lines() {
                assert!(line.chars().count() <= WIDTH, "{}: {line}", sub.get_name());
            }
        }
    }
}
