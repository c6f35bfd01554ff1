//! Pictures as SVG and PNG.

use plotters::coord::Shift;
use plotters::drawing::DrawingAreaErrorKind;
use plotters::prelude::{BitMapBackend, DrawingArea, DrawingBackend, IntoDrawingArea, SVGBackend};
use plotters::style::{FontStyle, RGBColor, WHITE, register_font};
use std::io;

/// What a drawing may fail of.
pub type Drawn<B> = Result<(), DrawingAreaErrorKind<<B as DrawingBackend>::ErrorType>>;
/// Where one draws.
pub type Area<B> = DrawingArea<B, Shift>;

/// The typeface: the one of whoever looks at an SVG, and Noto Sans, which comes along, in a PNG.
pub const TYPEFACE: &str = "sans-serif";
/// Axes and text.
pub const INK: RGBColor = RGBColor(38, 44, 52);
/// Lines that stand back.
pub const FAINT: RGBColor = RGBColor(226, 229, 234);
/// Links, and whatever stands on colours.
pub const LINK: RGBColor = RGBColor(20, 22, 26);

/// Something that can be drawn.
pub trait Picture {
    /// Width and height, pixels.
    fn size(&self) -> (u32, u32);
    /// Draws it on an area of this size.
    fn draw<B: DrawingBackend>(&self, area: &Area<B>) -> Drawn<B>;
}

/// As vectors.
pub fn svg(picture: &impl Picture) -> io::Result<Vec<u8>> {
    let mut text = String::new();
    on(picture, SVGBackend::with_string(&mut text, picture.size()))?;
    Ok(text.into_bytes())
}

/// As pixels, with a palette where 256 colours are enough.
pub fn png(picture: &impl Picture) -> io::Result<Vec<u8>> {
    let (width, height) = picture.size();
    let mut pixels = vec![255; width as usize * height as usize * 3];
    on(
        picture,
        BitMapBackend::with_buffer(&mut pixels, (width, height)),
    )?;
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::High);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&pixels)?;
    writer.finish()?;
    Ok(bytes)
}

fn on<B: DrawingBackend>(picture: &impl Picture, backend: B) -> io::Result<()> {
    if register_font(TYPEFACE, FontStyle::Normal, notosans::REGULAR_TTF).is_err() {
        return Err(io::Error::other("the typeface cannot be read"));
    }
    let area = backend.into_drawing_area();
    let drawn = area
        .fill(&WHITE)
        .and_then(|()| picture.draw(&area))
        .and_then(|()| area.present());
    drawn.map_err(|error| io::Error::other(error.to_string()))
}

/// A number beside an axis: no zero has a sign.
pub fn label(x: f64, digits: usize) -> String {
    let scale = 10_f64.powi(digits as i32);
    format!("{:.digits$}", (x * scale).round() / scale + 0.0)
}

/// Colours from the least to the greatest value, 0 to 1: anchors of Viridis (S. van der Walt,
/// N. Smith, 2015), which is read alike in grey and by all eyes.
pub fn viridis(value: f64) -> RGBColor {
    const ANCHORS: [[u8; 3]; 5] = [
        [68, 1, 84],
        [59, 82, 139],
        [33, 145, 140],
        [94, 201, 98],
        [253, 231, 37],
    ];
    let place = value.clamp(0.0, 1.0) * (ANCHORS.len() - 1) as f64;
    let from = (place as usize).min(ANCHORS.len() - 2);
    let share = place - from as f64;
    let channel = |i: usize| {
        let [a, b] = [ANCHORS[from], ANCHORS[from + 1]].map(|colour| f64::from(colour[i]));
        (a + share * (b - a)).round() as u8
    };
    RGBColor(channel(0), channel(1), channel(2))
}

/// The colours of curves that are to be told apart (Wong, Nature Methods 8, 2011).
pub fn hue(number: usize) -> RGBColor {
    const HUES: [RGBColor; 8] = [
        RGBColor(0, 114, 178),
        RGBColor(230, 159, 0),
        RGBColor(0, 158, 115),
        RGBColor(213, 94, 0),
        RGBColor(204, 121, 167),
        RGBColor(86, 180, 233),
        RGBColor(120, 94, 240),
        RGBColor(110, 110, 110),
    ];
    HUES[number % HUES.len()]
}
