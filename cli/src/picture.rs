//! The options of a picture: its file, and from where it looks.

use std::path::PathBuf;

use roundel_pictures::View;

/// Options of commands that draw a picture.
#[derive(clap::Args)]
pub struct PictureFlags {
    /// Draw a picture to this PNG file
    #[arg(id = "picture", long = "picture", value_name = "OUT.png")]
    pub file: Option<PathBuf>,

    /// Width and height of the picture in pixels
    #[arg(id = "picture_size", long = "picture-size", value_name = "WIDTHxHEIGHT", default_value = "1600x1200", value_parser = size)]
    pub size: [usize; 2],

    /// The direction from which the picture looks at the mesh
    #[arg(id = "picture_from", long = "picture-from", value_name = "X,Y,Z", default_value = "0.55,0.42,0.8", value_parser = direction)]
    #[arg(allow_hyphen_values = true)]
    pub from: [f64; 3],

    /// The direction that points upwards in the picture
    #[arg(id = "picture_up", long = "picture-up", value_name = "X,Y,Z", default_value = "0,1,0", value_parser = direction)]
    #[arg(allow_hyphen_values = true)]
    pub up: [f64; 3],
}

impl PictureFlags {
    /// What the picture shows.
    pub fn view(&self) -> View {
        let [width, height] = self.size;
        View {
            width,
            height,
            from: self.from,
            up: self.up,
        }
    }
}

/// A size of a picture.
fn size(text: &str) -> Result<[usize; 2], String> {
    let (width, height) = text.split_once('x').ok_or("expected WIDTHxHEIGHT")?;
    let pixels = |text: &str| match text.parse() {
        Ok(pixels) if (1..=8_192).contains(&pixels) => Ok(pixels),
        _ => Err(format!("'{text}' is not a number of pixels from 1 to 8192")),
    };
    Ok([pixels(width)?, pixels(height)?])
}

/// A direction in space.
fn direction(text: &str) -> Result<[f64; 3], String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(str::parse).collect();
    let numbers = numbers.map_err(|_| "expected X,Y,Z")?;
    numbers
        .try_into()
        .map_err(|_| String::from("expected X,Y,Z"))
}

#[cfg(test)]
mod tests {
    use super::{direction, size};

    #[test]
    fn a_direction_of_view_is_three_numbers() {
        assert_eq!(direction("-1,0.5,2"), Ok([-1.0, 0.5, 2.0]));
        for text in ["", "1,2", "1,2,3,4", "1,2,z"] {
            assert!(direction(text).is_err(), "{text}");
        }
    }

    #[test]
    fn a_size_is_two_numbers_of_pixels() {
        assert_eq!(size("640x480"), Ok([640, 480]));
        for text in ["640", "640x", "0x480", "640x8193", "-1x2", "640x480x2"] {
            assert!(size(text).is_err(), "{text}");
        }
    }
}
