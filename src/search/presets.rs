//! Presets: named sets of options that belong together.

use super::{Options, Strategy};
use crate::error::{Error, Result};

/// The description of a preset.
#[derive(Debug, Clone, Copy)]
pub struct Preset {
    /// Its name.
    pub name: &'static str,
    /// Its purpose.
    pub text: &'static str,
    set: fn(&mut Options),
}

/// All presets.
pub const PRESETS: &[Preset] = &[
    Preset {
        name: "orientation_field",
        text: "the thesis' parameters for orientation fields: adaptive, Gauss-Seidel, then 50 conjugate-gradient iterations, then factorizations",
        set: orientation_field,
    },
    Preset {
        name: "parametrization",
        text: "the thesis' parameters for parametrizations: adaptive, 20 conjugate-gradient iterations, no Gauss-Seidel and no factorization in between",
        set: parametrization,
    },
];

fn orientation_field(options: &mut Options) {
    let thesis = Options::default();
    options.strategy = Strategy::Adaptive;
    options.exact_integers = 0;
    options.rounding_threshold = thesis.rounding_threshold;
    options.gauss_seidel_updates = thesis.gauss_seidel_updates;
    options.gauss_seidel_tolerance = thesis.gauss_seidel_tolerance;
    options.cg_iterations = thesis.cg_iterations;
    options.cg_tolerance = thesis.cg_tolerance;
    options.exact_steps = true;
}

fn parametrization(options: &mut Options) {
    orientation_field(options);
    options.gauss_seidel_updates = 0;
    options.cg_iterations = 20;
    options.exact_steps = false;
}

impl Options {
    /// The thesis' parameters for orientation fields (section 5.3): adaptive, by Gauss-Seidel
    /// (100,000 updates to 1e-3), then 50 conjugate-gradient iterations, then sparse Cholesky.
    pub fn orientation_field() -> Self {
        let mut options = Options::default();
        orientation_field(&mut options);
        options
    }

    /// The thesis' parameters for parametrizations (section 5.3): adaptive, no Gauss-Seidel, 20
    /// conjugate-gradient iterations, no factorization in between.
    pub fn parametrization() -> Self {
        let mut options = Options::default();
        parametrization(&mut options);
        options
    }

    /// Sets all options of the preset with this name. [`PRESETS`] lists the names. Other options, such as
    /// the time limit, stay.
    ///
    /// # Errors
    /// [`Error::OptionRange`] if there is no such preset.
    pub fn set_preset(&mut self, name: &str) -> Result<()> {
        let Some(preset) = PRESETS.iter().find(|p| p.name == name) else {
            return Err(Error::OptionRange {
                name: "preset",
                value: name.into(),
                range: "orientation_field|parametrization",
            });
        };
        (preset.set)(self);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_preset_is_set_by_its_name_whatever_was_set_before() {
        let error = Options::default().set_preset("luck").unwrap_err();
        for preset in PRESETS {
            assert!(error.to_string().contains(preset.name), "{error}");
            let mut plain = Options::default();
            plain.set_preset(preset.name).unwrap();
            assert_ne!(plain, Options::default());
            for other in PRESETS {
                let mut options = Options {
                    time_limit: 3.0,
                    ..Options::default()
                };
                options.set_preset(other.name).unwrap();
                options.set_preset(preset.name).unwrap();
                assert_eq!(options.time_limit, 3.0);
                options.time_limit = plain.time_limit;
                assert_eq!(options, plain, "{} after {}", preset.name, other.name);
            }
        }
    }
}
