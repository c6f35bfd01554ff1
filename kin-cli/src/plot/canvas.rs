//! Pictures as SVG and PNG.

use plotters::chart::MeshStyle;
use plotters::coord::Shift;
use plotters::coord::ranged1d::Ranged;
use plotters::drawing::DrawingAreaErrorKind;
use plotters::prelude::{BitMapBackend, DrawingArea, DrawingBackend, IntoDrawingArea, SVGBackend};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{
    Color, FontDesc, FontStyle, RGBColor, ShapeStyle, TextStyle, WHITE, register_font,
};
use std::io;

/// What a drawing may fail of.
pub type Drawn<B> = Result<(), DrawingAreaErrorKind<<B as DrawingBackend>::ErrorType>>;
/// Where one draws.
pub type Area<B> = DrawingArea<B, Shift>;

/// Places on an area are integers; there are so many to a pixel, as high and as wide, so that
/// curves have no stairs and letters stand where they belong. A dot of a PNG is two of them high
/// and wide, and so half a pixel, for screens and printers that show it.
const FINE: u32 = 4;
/// The typeface: the one of whoever looks at an SVG, and Noto Sans, which comes along, in a PNG.
const TYPEFACE: &str = "sans-serif";
/// Axes and text.
pub const INK: RGBColor = RGBColor(38, 44, 52);
/// Lines that stand back.
pub const FAINT: RGBColor = RGBColor(226, 229, 234);
/// Links, and whatever stands on colours.
pub const LINK: RGBColor = RGBColor(20, 22, 26);

/// A length of so many pixels on an area.
pub const fn px(pixels: u32) -> u32 {
    pixels * FINE
}

/// A line or an outline that is so many pixels wide.
pub fn line(colour: impl Color, pixels: u32) -> ShapeStyle {
    colour.stroke_width(px(pixels))
}

/// Letters so many pixels high.
pub fn font(pixels: u32) -> TextStyle<'static> {
    FontDesc::from((TYPEFACE, px(pixels))).color(&INK)
}

/// The same behind a place, at its height.
pub fn font_behind(pixels: u32) -> TextStyle<'static> {
    font(pixels).pos(Pos::new(HPos::Left, VPos::Center))
}

/// A mesh that stands back, and axes with their numbers and words.
pub fn plain<'a, 'b, X: Ranged, Y: Ranged, B: DrawingBackend>(
    mut mesh: MeshStyle<'a, 'b, X, Y, B>,
) -> MeshStyle<'a, 'b, X, Y, B> {
    mesh.light_line_style(WHITE)
        .bold_line_style(line(FAINT, 1))
        .axis_style(line(INK, 1))
        .set_all_tick_mark_size(px(4))
        .label_style(font(13))
        .axis_desc_style(font(13));
    mesh
}

/// Something that can be drawn.
pub trait Picture {
    /// Width and height, pixels.
    fn size(&self) -> (u32, u32);
    /// Draws it on an area of this size in [`px`].
    fn draw<B: DrawingBackend>(&self, area: &Area<B>) -> Drawn<B>;
}

/// As vectors.
pub fn svg(picture: &impl Picture) -> io::Result<Vec<u8>> {
    let mut text = String::new();
    let (width, height) = picture.size();
    on(
        picture,
        SVGBackend::with_string(&mut text, (px(width), px(height))),
    )?;
    let fine = format!("width=\"{}\" height=\"{}\"", px(width), px(height));
    let shown = format!("width=\"{width}\" height=\"{height}\"");
    Ok(text.replacen(&fine, &shown, 1).into_bytes())
}

/// As pixels.
pub fn png(picture: &impl Picture) -> io::Result<Vec<u8>> {
    let (width, height) = picture.size();
    let (width, height) = (px(width) as usize, px(height) as usize);
    let mut fine = vec![255; width * height * 3];
    let size = (width as u32, height as u32);
    on(picture, BitMapBackend::with_buffer(&mut fine, size))?;
    let dots = dots(&fine, width);
    let mut bytes = Vec::new();
    let size = (width / 2, height / 2);
    let mut encoder = png::Encoder::new(&mut bytes, size.0 as u32, size.1 as u32);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Balanced);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&dots)?;
    writer.finish()?;
    Ok(bytes)
}

/// The means of squares of two by two in rows of `width`.
fn dots(fine: &[u8], width: usize) -> Vec<u8> {
    let mut dots = Vec::with_capacity(fine.len() / 4);
    for rows in fine.chunks_exact(6 * width) {
        let (upper, lower) = rows.split_at(3 * width);
        for column in 0..width / 2 {
            for place in 6 * column..6 * column + 3 {
                let sum = u16::from(upper[place])
                    + u16::from(upper[place + 3])
                    + u16::from(lower[place])
                    + u16::from(lower[place + 3]);
                dots.push((sum / 4) as u8);
            }
        }
    }
    dots
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dot_is_the_mean_of_its_square() {
        let fine: Vec<u8> = (0..2 * 4 * 3).map(|k| k as u8).collect();
        // Squares of columns 0, 1 and 2, 3: rows are 12 apart, neighbours 3.
        assert_eq!(dots(&fine, 4), [7, 8, 9, 13, 14, 15]);
    }
}
