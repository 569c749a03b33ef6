//! The solver's options as flags, made from the library's own table.
//!
//! An option added to [`OPTIONS`] is a flag of every command that flattens [`SolverOptions`],
//! with its range, default and text, and nothing is to be written here.

use clap::builder::{PossibleValuesParser, TypedValueParser, ValueParser};
use clap::parser::ValueSource;
use clap::{Arg, ArgMatches, Args, Command, FromArgMatches};
use roundel::Options;
use roundel::search::{OPTIONS, OptionInfo, OptionKind, OptionValue, PRESETS};

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
        let command = command.arg(preset());
        OPTIONS
            .iter()
            .fold(command, |command, info| command.arg(flag(info)))
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
        for info in OPTIONS {
            let is_given = matches.value_source(info.name) == Some(ValueSource::CommandLine);
            if let Some(value) = matches.get_one::<OptionValue>(info.name)
                && is_given
            {
                self.given.push((info.name, value.clone()));
            }
        }
        Ok(())
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

fn flag(info: &'static OptionInfo) -> Arg {
    let flag = Arg::new(info.name)
        .long(info.name.replace('_', "-"))
        .default_value(info.default)
        .help_heading("Solver options");
    match info.kind {
        // clap lists the words itself.
        OptionKind::Text => flag
            .value_name("WORD")
            .help(info.text)
            .value_parser(words(info)),
        OptionKind::Integer | OptionKind::Real => flag
            .value_name("NUMBER")
            .help(format!("{}, in {}", info.text, info.range))
            .value_parser(move |text: &str| number(info, text))
            .allow_negative_numbers(true),
    }
}

fn words(info: &OptionInfo) -> ValueParser {
    PossibleValuesParser::new(info.range.split('|'))
        .map(OptionValue::Text)
        .into()
}

/// Reads a number of the option's kind and in its range.
fn number(info: &OptionInfo, text: &str) -> Result<OptionValue, String> {
    let value = match info.kind {
        OptionKind::Integer => text.parse().map(OptionValue::Integer).ok(),
        _ => text.parse().map(OptionValue::Real).ok(),
    };
    let value = value.ok_or("not a number of this kind")?;
    match Options::default().set(info.name, &value) {
        Ok(()) => Ok(value),
        Err(_) => Err(format!("outside {}", info.range)),
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
                _ => number(info, info.default).unwrap(),
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
