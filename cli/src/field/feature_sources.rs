//! What makes an edge a feature, as a list of the command line: `angle:40,materials,seams`.

use roundel::soup::io::Attribute;

/// The sources of features.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FeatureSources {
    /// The angle by which the surface turns at a sharp edge, in degrees.
    pub angle: Option<f64>,
    /// The attributes of the file in which the faces of a feature differ.
    pub attributes: Vec<Attribute>,
}

impl FeatureSources {
    /// Reads a list of angles and names, separated by commas.
    pub fn parse(text: &str) -> Result<Self, String> {
        let mut sources = FeatureSources::default();
        for word in text.split(',') {
            if let Some(attribute) = Attribute::by_name(word) {
                if sources.attributes.contains(&attribute) {
                    return Err(format!("{word} is given twice"));
                }
                sources.attributes.push(attribute);
                continue;
            }
            let angle = angle(word.strip_prefix("angle:").unwrap_or(word))?;
            if sources.angle.replace(angle).is_some() {
                return Err("the angle is given twice".into());
            }
        }
        Ok(sources)
    }
}

fn angle(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| {
        let names = Attribute::ALL.map(Attribute::name).join(", ");
        format!("'{text}' is not a number, and none of {names}")
    })?;
    match value > 0.0 && value <= 180.0 {
        true => Ok(value),
        false => Err("the angle must be above 0 and at most 180 degrees".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::{Attribute, FeatureSources};

    #[test]
    fn features_are_of_an_angle_and_of_names() {
        let parse = FeatureSources::parse;
        for text in ["180", "angle:180"] {
            assert_eq!(parse(text).unwrap().angle, Some(180.0));
        }
        let all = parse("seams,angle:40,materials").unwrap();
        let attributes = vec![Attribute::Seams, Attribute::Materials];
        let angle = Some(40.0);
        assert_eq!(all, FeatureSources { angle, attributes });
        for attribute in Attribute::ALL {
            let only = parse(attribute.name()).unwrap();
            assert_eq!((only.angle, only.attributes), (None, vec![attribute]));
        }
        for text in [
            "",
            "0",
            "-40",
            "181",
            "nan",
            "sharp",
            "40,",
            "40,50",
            "angle:",
            "seams,seams",
        ] {
            assert!(parse(text).is_err(), "{text}");
        }
    }
}
