//! Options as flags, made from the library's own tables.
//!
//! An option added to [`OPTIONS`] is a flag of every command that flattens [`SolverOptions`], and one
//! added to [`QUAD_OPTIONS`] a flag of `roundel quad`, with range, default and text. Nothing is to be
//! written here.

use clap::builder::{PossibleValuesParser, TypedValueParser, ValueParser};
use clap::parser::ValueSource;
use clap::{Arg, ArgAction, ArgMatches, Args, Command, FromArgMatches};
use roundel::Options;
use roundel::quad::{QUAD_OPTIONS, QuadOptions};
use roundel::search::{OPTIONS, OptionInfo, OptionKind, OptionValue, PRESETS, UNSET};
use roundel::soup::{REPAIR_OPTIONS, RepairOptions};

/// Options of the solver, from flags named as the options are, `-` for `_`.
#[derive(Debug, Clone, Default)]
pub struct SolverOptions {
    /// Set before all else.
    preset: Option<String>,
    /// What the command line says; what it does not is the default, which is not here.
    given: Vec<(&'static str, OptionValue)>,
}

impl SolverOptions {
    /// `options` with what the command line says put over them.
    pub fn over(&self, mut options: Options) -> roundel::Result<Options> {
        if let Some(name) = &self.preset {
            options.set_preset(name)?;
        }
        for (name, value) in &self.given {
            options.set(name, value)?;
        }
        Ok(options)
    }
}

impl Args for SolverOptions {
    fn augment_args(command: Command) -> Command {
        SOLVER.flags(command.arg(preset()))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for SolverOptions {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let mut options = SolverOptions::default();
        options.update_from_arg_matches(matches)?;
        Ok(options)
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        self.preset = matches.get_one::<String>(PRESET).cloned();
        self.given = SOLVER.given(matches);
        Ok(())
    }
}

/// Options of one table, from flags named as the options are, `-` for `_`.
macro_rules! flags {
    ($(#[$doc:meta])* $flags:ident, $options:ty, $table:ident) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Default)]
        pub struct $flags {
            given: Vec<(&'static str, OptionValue)>,
        }

        impl $flags {
            /// `options` with what the command line says put over them.
            pub fn over(&self, mut options: $options) -> roundel::Result<$options> {
                for (name, value) in &self.given {
                    options.set(name, value)?;
                }
                Ok(options)
            }
        }

        impl Args for $flags {
            fn augment_args(command: Command) -> Command {
                $table.flags(command)
            }

            fn augment_args_for_update(command: Command) -> Command {
                Self::augment_args(command)
            }
        }

        impl FromArgMatches for $flags {
            fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
                let given = $table.given(matches);
                Ok($flags { given })
            }

            fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
                self.given = $table.given(matches);
                Ok(())
            }
        }
    };
}

flags! {
    /// Options of `roundel quad` beside its sizes, its guidance and the strategy of its field, which have
    /// flags of their own.
    QuadFlags, QuadOptions, QUADS
}

flags! {
    /// Options of the repair of what a file holds.
    RepairFlags, RepairOptions, REPAIRS
}

/// A table of options whose flags are made here.
struct Table {
    options: &'static [OptionInfo],
    /// Those that have flags of their own.
    elsewhere: &'static [&'static str],
    heading: &'static str,
    /// Whether a 0 or 1 that is 1 by default is turned off by a flag without a value.
    has_switches: bool,
    /// Whether an option takes a value.
    accepts: fn(&str, &OptionValue) -> bool,
}

const SOLVER: Table = Table {
    options: OPTIONS,
    elsewhere: &[],
    heading: "Solver options",
    has_switches: false,
    accepts: |name, value| Options::default().set(name, value).is_ok(),
};

const QUADS: Table = Table {
    options: QUAD_OPTIONS,
    elsewhere: &["quads", "edge_length", "field_strategy"],
    heading: "Quad options",
    has_switches: true,
    accepts: |name, value| QuadOptions::default().set(name, value).is_ok(),
};

const REPAIRS: Table = Table {
    options: REPAIR_OPTIONS,
    elsewhere: &[],
    heading: "Repair",
    has_switches: false,
    accepts: |name, value| RepairOptions::default().set(name, value).is_ok(),
};

impl Table {
    fn here(&self) -> impl Iterator<Item = &'static OptionInfo> {
        let here = |info: &&OptionInfo| !self.elsewhere.contains(&info.name);
        self.options.iter().filter(here)
    }

    fn is_switch(&self, info: &OptionInfo) -> bool {
        self.has_switches && info.range == "[0, 1]" && info.default == "1"
    }

    fn flags(&self, command: Command) -> Command {
        self.here().fold(command, |command, info| {
            command.arg(match self.is_switch(info) {
                true => switch(info).help_heading(self.heading),
                false => flag(info, self.accepts).help_heading(self.heading),
            })
        })
    }

    /// What the command line says.
    fn given(&self, matches: &ArgMatches) -> Vec<(&'static str, OptionValue)> {
        let is_given =
            |info: &&OptionInfo| matches.value_source(info.name) == Some(ValueSource::CommandLine);
        let value = |info: &OptionInfo| match self.is_switch(info) {
            true => Some(OptionValue::Integer(0)),
            false => matches.get_one::<OptionValue>(info.name).cloned(),
        };
        let given = self.here().filter(is_given);
        given
            .filter_map(|info| Some((info.name, value(info)?)))
            .collect()
    }
}

/// The flag of presets, which is the name of no option.
const PRESET: &str = "preset";

fn preset() -> Arg {
    let names = PRESETS.iter().map(|preset| preset.name);
    Arg::new(PRESET)
        .long(PRESET)
        .value_name("NAME")
        .help("A set of options by name; flags for single options come before it")
        .help_heading("Solver options")
        .value_parser(PossibleValuesParser::new(names))
}

/// `--no-NAME` for an option that is 1 otherwise.
fn switch(info: &'static OptionInfo) -> Arg {
    Arg::new(info.name)
        .long(format!("no-{}", info.name.replace('_', "-")))
        .help(format!("Turn off {}: {}", info.name, info.text))
        .action(ArgAction::SetTrue)
}

fn flag(info: &'static OptionInfo, accepts: fn(&str, &OptionValue) -> bool) -> Arg {
    let flag = Arg::new(info.name).long(info.name.replace('_', "-"));
    let flag = match info.default {
        UNSET => flag,
        default => flag.default_value(default),
    };
    match info.kind {
        // clap lists the words itself.
        OptionKind::Text => flag
            .value_name("WORD")
            .help(info.text)
            .value_parser(words(info)),
        OptionKind::Integer | OptionKind::Real => flag
            .value_name("NUMBER")
            .help(format!("{}, in {}", info.text, info.range))
            .value_parser(move |text: &str| number(info, text, accepts))
            .allow_negative_numbers(true),
    }
}

fn words(info: &OptionInfo) -> ValueParser {
    PossibleValuesParser::new(info.range.split('|'))
        .map(OptionValue::Text)
        .into()
}

/// Reads a number of the option's kind and in its range.
fn number(
    info: &OptionInfo,
    text: &str,
    accepts: fn(&str, &OptionValue) -> bool,
) -> Result<OptionValue, String> {
    let value = match info.kind {
        OptionKind::Integer => text.parse().map(OptionValue::Integer).ok(),
        _ => text.parse().map(OptionValue::Real).ok(),
    };
    let value = value.ok_or("not a number of this kind")?;
    match accepts(info.name, &value) {
        true => Ok(value),
        false => Err(format!("outside {}", info.range)),
    }
}

#[cfg(test)]
mod tests {
    use roundel::Strategy;

    use super::*;

    fn command() -> Command {
        SolverOptions::augment_args(Command::new("test"))
    }

    fn parse(arguments: &[&str]) -> Result<SolverOptions, clap::Error> {
        let line = ["test"].iter().chain(arguments);
        SolverOptions::from_arg_matches(&command().try_get_matches_from(line)?)
    }

    #[test]
    fn every_option_is_a_flag_with_its_default_range_and_text() {
        let command = command();
        for info in OPTIONS {
            let flag = command
                .get_arguments()
                .find(|a| a.get_id() == info.name)
                .unwrap_or_else(|| panic!("no flag for {}", info.name));
            assert_eq!(flag.get_long(), Some(&*info.name.replace('_', "-")));
            assert_eq!(flag.get_default_values(), [info.default], "{}", info.name);
            let help = flag.get_help().map(ToString::to_string).unwrap_or_default();
            assert!(help.contains(info.text), "{help}");
            match info.kind {
                OptionKind::Text => {
                    let words = flag.get_possible_values();
                    let words: Vec<_> = words.iter().map(|w| w.get_name()).collect();
                    assert_eq!(words.join("|"), info.range);
                }
                _ => assert!(help.contains(info.range), "{help}"),
            }
        }
    }

    #[test]
    fn the_defaults_that_the_help_tells_are_the_librarys() {
        let mut options = Options::default();
        for info in OPTIONS {
            let value = match info.kind {
                OptionKind::Text => OptionValue::Text(info.default.into()),
                _ => number(info, info.default, SOLVER.accepts).unwrap(),
            };
            options.set(info.name, &value).unwrap();
        }
        assert_eq!(options, Options::default());
    }

    #[test]
    fn a_flag_sets_its_option_and_no_other() {
        let base = Options {
            threads: 7,
            ..Options::default()
        };
        let none = parse(&[]).unwrap().over(base.clone()).unwrap();
        assert_eq!(none, base);
        let flags = ["--time-limit", "2.5", "--strategy", "direct"];
        let two = parse(&flags).unwrap().over(base.clone()).unwrap();
        let expected = Options {
            time_limit: 2.5,
            strategy: Strategy::Direct,
            ..base
        };
        assert_eq!(two, expected);
    }

    #[test]
    fn every_option_of_quads_is_a_flag_of_its_command() {
        let command = crate::quad::Arguments::augment_args(Command::new("quad"));
        for info in QUAD_OPTIONS {
            let mut flags = command.get_arguments();
            let flag = flags.find(|a| a.get_id() == info.name);
            assert!(flag.is_some(), "no flag for {}", info.name);
        }
    }

    #[test]
    fn every_option_of_repair_is_a_flag_of_each_command_that_reads_a_mesh() {
        let commands = [
            crate::quad::Arguments::augment_args(Command::new("quad")),
            crate::parametrize::Arguments::augment_args(Command::new("parametrize")),
            crate::field::Arguments::augment_args(Command::new("field")),
            crate::repair::Arguments::augment_args(Command::new("repair")),
        ];
        for command in commands {
            for info in REPAIR_OPTIONS {
                let mut flags = command.get_arguments();
                let flag = flags.find(|a| a.get_id() == info.name);
                assert!(flag.is_some(), "no flag for {}", info.name);
            }
        }
    }

    #[test]
    fn a_switch_turns_its_option_off_and_no_other() {
        let line = ["quad", "--no-smooth"];
        let command = QuadFlags::augment_args(Command::new("quad"));
        let matches = command.try_get_matches_from(line).unwrap();
        let flags = QuadFlags::from_arg_matches(&matches).unwrap();
        let expected = QuadOptions {
            smooth: None,
            ..QuadOptions::default()
        };
        assert_eq!(flags.over(QuadOptions::default()).unwrap(), expected);
    }

    #[test]
    fn flags_come_before_the_preset_wherever_they_stand() {
        for preset in PRESETS {
            let flags = ["--cg-iterations", "7", "--preset", preset.name];
            let options = parse(&flags).unwrap().over(Options::default()).unwrap();
            let mut expected = Options::default();
            expected.set_preset(preset.name).unwrap();
            assert_ne!(expected.cg_iterations, 7);
            expected.cg_iterations = 7;
            assert_eq!(options, expected);
        }
    }

    #[test]
    fn values_out_of_range_or_of_another_kind_are_usage_errors_that_name_the_flag() {
        for line in [
            ["--threads", "-1"],
            ["--threads", "1025"],
            ["--threads", "1.5"],
            ["--time-limit", "-1"],
            ["--time-limit", "nan"],
            ["--time-limit", "soon"],
            ["--strategy", "guess"],
            ["--preset", "luck"],
        ] {
            let error = parse(&line).unwrap_err();
            assert_eq!(error.exit_code(), 2, "{line:?}");
            assert!(error.to_string().contains(line[0]), "{error}");
        }
    }
}
