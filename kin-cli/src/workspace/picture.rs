//! Maps as pictures.

use super::map::Map;
use std::io;

/// Pixels along a side of a cell.
const SCALE: usize = 4;
/// Pixels between slices.
const GAP: usize = 12;
/// The colour of what is out of reach, by its place in the palette.
const OUTSIDE: u8 = 0;
/// Colours from the least to the greatest value: anchors of Viridis (S. van der
/// Walt, N. Smith, 2015), which is read alike in grey and by all eyes.
const ANCHORS: [[u8; 3]; 5] = [
    [68, 1, 84],
    [59, 82, 139],
    [33, 145, 140],
    [94, 201, 98],
    [253, 231, 37],
];

/// One slice: the share of orientations reached.
pub fn slice(map: &Map, slice: usize) -> io::Result<Vec<u8>> {
    let side = map.cells * SCALE;
    let mut canvas = Canvas::new(side, side);
    canvas.draw(map, map.slice(&map.share, slice), 1.0, [0, 0]);
    canvas.encode()
}

/// All slices, side by side: above the share of orientations, below the
/// measure of how well it moves, relative to its greatest value.
pub fn all(map: &Map) -> io::Result<Vec<u8>> {
    let side = map.cells * SCALE;
    let mut canvas = Canvas::new(3 * side + 2 * GAP, 2 * side + GAP);
    let greatest = map
        .measure
        .iter()
        .copied()
        .fold(f64::MIN_POSITIVE, f64::max);
    for i in 0..3 {
        let left = i * (side + GAP);
        canvas.draw(map, map.slice(&map.share, i), 1.0, [left, 0]);
        let measure = map.slice(&map.measure, i);
        let shown: Vec<f64> = (measure.iter().zip(map.slice(&map.share, i)))
            .map(|(value, share)| {
                if *share > 0.0 {
                    value.max(1e-3 * greatest)
                } else {
                    0.0
                }
            })
            .collect();
        canvas.draw(map, &shown, greatest, [left, side + GAP]);
    }
    canvas.encode()
}

struct Canvas {
    width: usize,
    height: usize,
    pixels: Vec<u8>,
}

impl Canvas {
    fn new(width: usize, height: usize) -> Self {
        Self {
            width,
            height,
            pixels: vec![OUTSIDE; width * height],
        }
    }

    /// Draws values from 0, which is out of reach, to `greatest`. The first row
    /// is the lowest.
    fn draw(&mut self, map: &Map, values: &[f64], greatest: f64, [left, top]: [usize; 2]) {
        for y in 0..map.cells * SCALE {
            let row = map.cells - 1 - y / SCALE;
            for x in 0..map.cells * SCALE {
                let value = values[row * map.cells + x / SCALE] / greatest;
                self.pixels[(top + y) * self.width + left + x] = match value > 0.0 {
                    true => 1 + (value * 254.0).round() as u8,
                    false => OUTSIDE,
                };
            }
        }
    }

    fn encode(&self) -> io::Result<Vec<u8>> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.width as u32, self.height as u32);
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::High);
        encoder.set_palette(palette());
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&self.pixels)?;
        writer.finish()?;
        Ok(bytes)
    }
}

fn palette() -> Vec<u8> {
    let mut colours = vec![255, 255, 255];
    for i in 0..255 {
        let place = f64::from(i) / 254.0 * (ANCHORS.len() - 1) as f64;
        let from = (place as usize).min(ANCHORS.len() - 2);
        let share = place - from as f64;
        for channel in 0..3 {
            let [a, b] = [ANCHORS[from], ANCHORS[from + 1]].map(|c| f64::from(c[channel]));
            colours.push((a + share * (b - a)).round() as u8);
        }
    }
    colours
}
