//! Maps as pictures.

use super::map::{Map, Sampling, Slice};
use crate::plot::canvas::{
    Area, Drawn, INK, Picture, font, font_behind, label, line, plain, px, viridis,
};
use crate::plot::figure::{Figure, Weight};
use plotters::prelude::*;
use std::ops::Range;

/// Pixels: of a panel with its axes, of a colour bar with its numbers, of a title.
const PANEL: (u32, u32) = (400, 376);
const BAR: u32 = 96;
const TITLE: u32 = 34;
/// Colours told apart; neighbours of one colour are drawn as one.
const SHADES: f64 = 32.0;

/// What is drawn on a map beside its values.
pub struct Robot {
    /// Its name, as it may be shown.
    pub name: String,
    /// It at home.
    pub figure: Figure,
}

/// Values of a map.
#[derive(Clone, Copy)]
enum Layer {
    Share,
    Measure,
}

/// One slice: the share of orientations reached; or all of them side by side, below them the
/// measure of how well the robot moves.
pub struct Maps<'a> {
    pub sampling: &'a Sampling<'a>,
    pub map: &'a Map,
    pub robot: &'a Robot,
    /// Of one slice, or of all.
    pub only: Option<usize>,
}

impl Picture for Maps<'_> {
    fn size(&self) -> (u32, u32) {
        let (columns, rows) = if self.only.is_some() { (1, 1) } else { (3, 2) };
        (columns * PANEL.0 + BAR, rows * (PANEL.1 + TITLE))
    }

    fn draw<B: DrawingBackend>(&self, area: &Area<B>) -> Drawn<B> {
        let rows = match self.only {
            Some(_) => vec![Layer::Share],
            None => vec![Layer::Share, Layer::Measure],
        };
        let slices = match self.only {
            Some(slice) => vec![slice],
            None => vec![0, 1, 2],
        };
        let strips = area.split_evenly((rows.len(), 1));
        for (strip, layer) in strips.iter().zip(rows) {
            let (head, rest) = strip.split_vertically(px(TITLE));
            let place = (px(18) as i32, px(TITLE / 2 + 3) as i32);
            head.draw_text(&self.title(layer), &font_behind(17), place)?;
            let (panels, bar) = rest.split_horizontally(px(PANEL.0) * slices.len() as u32);
            let panels = panels.split_evenly((1, slices.len()));
            for (panel, &slice) in panels.iter().zip(&slices) {
                self.panel(panel, slice, layer)?;
            }
            self.bar(&bar, layer)?;
        }
        Ok(())
    }
}

impl Maps<'_> {
    fn title(&self, layer: Layer) -> String {
        let limits = match self.sampling.limited {
            true => "within limits",
            false => "regardless of limits",
        };
        let [_, measure] = self.sampling.robot.measure();
        match layer {
            Layer::Share => format!(
                "{}: {}, {limits}",
                self.robot.name,
                match self.sampling.orientations.len() {
                    1 => "reached in one orientation".to_owned(),
                    count => format!("share of {count} orientations reached"),
                }
            ),
            Layer::Measure => format!("{}: {measure}, mean", self.robot.name),
        }
    }

    /// The values of a slice between 0 and 1, NaN out of reach.
    fn values(&self, slice: usize, layer: Layer) -> Vec<f64> {
        let share = self.map.slice(&self.map.share, slice);
        let shown = match layer {
            Layer::Share => share,
            Layer::Measure => self.map.slice(&self.map.measure, slice),
        };
        let greatest = self.greatest(layer);
        let value = |(value, share): (&f64, &f64)| match *share > 0.0 {
            true => value / greatest,
            false => f64::NAN,
        };
        shown.iter().zip(share).map(value).collect()
    }

    fn greatest(&self, layer: Layer) -> f64 {
        match layer {
            Layer::Share => 1.0,
            Layer::Measure => (self.map.measure.iter().copied()).fold(f64::MIN_POSITIVE, f64::max),
        }
    }

    /// What of the slices is shown, in metres from their centres: as much of all, so that they
    /// have one scale.
    fn window(&self, slice: &Slice) -> [Range<f64>; 2] {
        let half = 0.5 * self.sampling.step * self.map.cells as f64;
        [slice.across, slice.up].map(|axis| slice.centre[axis] - half..slice.centre[axis] + half)
    }

    fn panel<B: DrawingBackend>(&self, area: &Area<B>, number: usize, layer: Layer) -> Drawn<B> {
        let slice = &self.sampling.slices[number];
        let [across, up] = self.window(slice);
        let step = self.sampling.step;
        let mut chart = ChartBuilder::on(area)
            .margin_right(px(12))
            .margin_top(px(2))
            .margin_bottom(px(4))
            .x_label_area_size(px(44))
            .y_label_area_size(px(62))
            .build_cartesian_2d(across.clone(), up.clone())?;
        let names = ["x", "y", "z"];
        let axis = |axis: usize| format!("{} in m", names[axis]);
        let [x_axis, y_axis] = [axis(slice.across), axis(slice.up)];
        let digits = usize::from(step * self.map.cells as f64 <= 6.0)
            + usize::from(step * self.map.cells as f64 <= 0.6);
        let number_of = |x: &f64| label(*x, digits);
        plain(chart.configure_mesh())
            .x_labels(7)
            .y_labels(7)
            .x_desc(x_axis)
            .y_desc(y_axis)
            .axis_desc_style(font(14))
            .x_label_formatter(&number_of)
            .y_label_formatter(&number_of)
            .draw()?;
        let values = self.values(number, layer);
        let corner = [across.start, up.start];
        let cells = self.map.cells;
        for row in 0..cells {
            let low = corner[1] + row as f64 * step;
            for (columns, shade) in runs(&values[row * cells..(row + 1) * cells]) {
                let ends = [columns.start, columns.end].map(|i| corner[0] + i as f64 * step);
                let cell = [(ends[0], low), (ends[1], low + step)];
                let colour = viridis(shade / SHADES).filled();
                chart.draw_series([Rectangle::new(cell, colour)])?;
            }
        }
        let axes = [slice.across, slice.up];
        self.robot.figure.draw(&mut chart, axes, Weight::Outline)
    }

    /// The colours and their numbers.
    fn bar<B: DrawingBackend>(&self, area: &Area<B>, layer: Layer) -> Drawn<B> {
        let (_, height) = area.dim_in_pixel();
        let [left, right, text] = [4, 20, 26].map(|x| px(x) as i32);
        let (top, bottom) = (px(6) as i32, height as i32 - px(50) as i32);
        let greatest = self.greatest(layer);
        let steps = 128;
        let place = |share: f64| bottom - (share * f64::from(bottom - top)).round() as i32;
        for k in 0..steps {
            let [low, high] = [k, k + 1].map(|k| f64::from(k) / f64::from(steps));
            let colour = viridis(low).filled();
            area.draw(&Rectangle::new(
                [(left, place(high)), (right, place(low))],
                colour,
            ))?;
        }
        area.draw(&Rectangle::new(
            [(left, top), (right, bottom)],
            line(INK, 1),
        ))?;
        for k in 0..=4 {
            let share = f64::from(k) / 4.0;
            let number = match layer {
                Layer::Share => format!("{:.0} %", 100.0 * share),
                Layer::Measure => number(share * greatest),
            };
            area.draw_text(&number, &font_behind(13), (text, place(share)))?;
        }
        Ok(())
    }
}

/// With three digits that say something.
fn number(x: f64) -> String {
    match x.abs() {
        0.0 => "0".into(),
        ..1e-3 | 1e4.. => format!("{x:.2e}"),
        size => format!("{x:.*}", (2 - size.log10().floor() as i32).max(0) as usize),
    }
}

/// Neighbours of one shade, and the shade; nothing where nothing is in reach.
fn runs(values: &[f64]) -> Vec<(Range<usize>, f64)> {
    let shade = |value: &f64| (value * SHADES).round();
    let mut runs: Vec<(Range<usize>, f64)> = Vec::new();
    for (column, value) in values
        .iter()
        .enumerate()
        .filter(|(_, value)| !value.is_nan())
    {
        match runs.last_mut() {
            Some((columns, last)) if columns.end == column && *last == shade(value) => {
                columns.end += 1;
            }
            _ => runs.push((column..column + 1, shade(value))),
        }
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_of_one_shade_are_one() {
        let found = runs(&[f64::NAN, 0.5, 0.5, 1.0, f64::NAN, 1.0]);
        assert_eq!(found, [(1..3, 16.0), (3..4, 32.0), (5..6, 32.0)]);
    }

    #[test]
    fn numbers_have_three_digits() {
        let shown = [0.0, 0.05, 0.1234, 1.0, 56.78, 1e-5].map(number);
        assert_eq!(shown, ["0", "0.0500", "0.123", "1.00", "56.8", "1.00e-5"]);
    }
}
