//! An image, and its PNG file.

use std::path::Path;

use roundel::{Error, Result};

/// Pixels, row by row from the top: red, green, blue.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Image {
    width: usize,
    height: usize,
    pixels: Vec<u8>,
}

impl Image {
    pub(super) fn new(width: usize, height: usize, pixels: Vec<u8>) -> Image {
        debug_assert_eq!(pixels.len(), 3 * width * height);
        Image {
            width,
            height,
            pixels,
        }
    }

    /// Width in pixels.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Height in pixels.
    pub fn height(&self) -> usize {
        self.height
    }

    /// Three bytes (red, green, blue; sRGB) for each pixel, row by row from the top.
    pub fn pixels(&self) -> &[u8] {
        &self.pixels
    }

    /// The contents of a PNG file: eight bits a channel, no date, the same bytes every time.
    ///
    /// # Errors
    /// [`Error::Overflow`] for an image that PNG cannot hold.
    pub fn to_png(&self) -> Result<Vec<u8>> {
        let failed = |reason: png::EncodingError| Error::Overflow {
            what: format!("a picture of {} x {}: {reason}", self.width, self.height),
            index: None,
        };
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.width as u32, self.height as u32);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::High);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        let mut writer = encoder.write_header().map_err(failed)?;
        writer.write_image_data(&self.pixels).map_err(failed)?;
        writer.finish().map_err(failed)?;
        Ok(bytes)
    }

    /// Writes the image to a PNG file.
    ///
    /// # Errors
    /// [`Error::Io`] for a file that cannot be written, and those of [`Image::to_png`].
    pub fn write_png(&self, path: impl AsRef<Path>) -> Result<()> {
        let path = path.as_ref();
        std::fs::write(path, self.to_png()?).map_err(|reason| Error::Io {
            message: format!("{}: {reason}", path.display()),
        })
    }
}
