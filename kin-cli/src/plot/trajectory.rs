//! The joints along a path: the robot at its ends, a panel for each joint with all branches, the
//! limits, and what is taken, and one for how far that is from singular.

use super::canvas::{Area, Drawn, LINK, Picture, font, font_behind, hue, label, line, plain, px};
use super::figure::{Figure, GHOST, Weight};
use super::path::{Path, Piece, Subject};
use kin_runtime::JointLimit;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use std::ops::Range;

/// Pixels: of a panel, of a view of the robot, of the title, of a line of the legend.
const PANEL: (u32, u32) = (600, 236);
const VIEW: (u32, u32) = (400, 380);
const TITLE: u32 = 44;
const LEGEND: u32 = 30;
/// What of a line of the legend may be used, pixels.
const LEGEND_WIDTH: (i32, i32) = (72, 1180);
/// Beyond limits.
const BEYOND: RGBColor = RGBColor(179, 38, 30);
/// Branches that have no numbers.
const OTHERS: RGBColor = RGBColor(86, 180, 233);
/// The path of the tip.
const WAY: RGBColor = RGBColor(0, 114, 178);

/// The picture.
pub struct Trajectory<'a> {
    pub subject: &'a Subject,
    pub path: &'a Path,
    /// Where the path begins, and where it ends.
    pub figures: Vec<Figure>,
    /// The origin of the tip at all points, base coordinates, metres.
    pub tip: Vec<[f64; 3]>,
}

/// A panel.
struct Panel<'a> {
    title: &'a str,
    /// What y is, with its unit.
    axis: String,
    curves: Vec<&'a Piece>,
    taken: Vec<Option<f64>>,
    /// The joint, and its unit in radians or metres; none of a measure, which is never below 0.
    of: Option<(usize, f64)>,
    limits: Option<[f64; 2]>,
}

impl Picture for Trajectory<'_> {
    fn size(&self) -> (u32, u32) {
        let rows = self.panels().len().div_ceil(2) as u32;
        let legend = LEGEND * (1 + self.entries().1);
        (2 * PANEL.0, TITLE + VIEW.1 + rows * PANEL.1 + legend)
    }

    fn draw<B: DrawingBackend>(&self, area: &Area<B>) -> Drawn<B> {
        let (head, rest) = area.split_vertically(px(TITLE));
        let title = format!(
            "{}: joints along a path of {}",
            self.subject.name, self.subject.tip
        );
        let middle = px(TITLE) as i32 / 2;
        head.draw_text(&title, &font_behind(19), (px(20) as i32, middle))?;
        let (mut x, y) = (2 * PANEL.0 as i32 - 240, TITLE as i32 / 2);
        for (text, colour, width) in [("begin", GHOST, 3), ("end", LINK, 3), ("path", WAY, 2)] {
            Entry::new((x, y), text, colour, width).draw(&head)?;
            x += 78;
        }
        let (views, rest) = rest.split_vertically(px(VIEW.1));
        self.views(&views)?;
        let all = self.panels();
        let rows = all.len().div_ceil(2);
        let (panels, legend) = rest.split_vertically(px(PANEL.1) * rows as u32);
        let places = panels.split_evenly((rows, 2));
        for (place, panel) in places.iter().zip(&all) {
            self.panel(place, panel)?;
        }
        self.legend(&legend)
    }
}

impl Trajectory<'_> {
    /// The robot at the ends of the path, in three views of one scale.
    fn views<B: DrawingBackend>(&self, area: &Area<B>) -> Drawn<B> {
        let points = self.figures.iter().flat_map(Figure::points);
        let points: Vec<[f64; 3]> = points.chain(self.tip.iter().copied()).collect();
        let ends = [0, 1, 2].map(|axis: usize| {
            let all = points.iter().map(|point| point[axis]);
            all.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| {
                [low.min(x), high.max(x)]
            })
        });
        let widest = ends
            .iter()
            .map(|[low, high]| high - low)
            .fold(0.0, f64::max);
        let half = (0.58 * widest).max(1e-3);
        let window = |axis: usize| -> Range<f64> {
            let middle = match points.is_empty() {
                true => 0.0,
                false => 0.5 * (ends[axis][0] + ends[axis][1]),
            };
            middle - half..middle + half
        };
        let digits = (-(0.4 * half).log10().floor()).clamp(0.0, 6.0) as usize;
        let names = ["x", "y", "z"];
        let places = area.split_evenly((1, 3));
        for (place, [right, up]) in places.iter().zip([[0, 2], [1, 2], [0, 1]]) {
            let mut chart = ChartBuilder::on(place)
                .margin_right(px(12))
                .margin_left(px(8))
                .margin_bottom(px(4))
                .x_label_area_size(px(44))
                .y_label_area_size(px(54))
                .build_cartesian_2d(window(right), window(up))?;
            plain(chart.configure_mesh())
                .x_labels(5)
                .y_labels(5)
                .x_desc(format!("{} in m", names[right]))
                .y_desc(format!("{} in m", names[up]))
                .x_label_formatter(&|x| label(*x, digits))
                .y_label_formatter(&|x| label(*x, digits))
                .draw()?;
            if let [begin, end] = &self.figures[..] {
                begin.draw(&mut chart, [right, up], Weight::Ghost)?;
                end.draw(&mut chart, [right, up], Weight::Full)?;
            }
            let way = self.tip.iter().map(|point| (point[right], point[up]));
            chart.draw_series(LineSeries::new(way, line(WAY, 2)))?;
        }
        Ok(())
    }

    fn panels(&self) -> Vec<Panel<'_>> {
        let (subject, path) = (self.subject, self.path);
        let mut panels = Vec::new();
        for (i, joint) in subject
            .joints
            .iter()
            .enumerate()
            .filter(|(_, it)| it.is_shown)
        {
            let (unit, scale) = match joint.limit.is_revolute() {
                true => ("°", 1.0_f64.to_degrees()),
                false => ("mm", 1000.0),
            };
            let tells = |it: &&Piece| {
                let joints = it.points.first().map_or(0, |(_, q)| q.len());
                (it.first..it.first + joints).contains(&i)
            };
            let taken = path.taken.iter().map(|q| q.as_ref().map(|q| scale * q[i]));
            panels.push(Panel {
                title: &joint.name,
                axis: format!("in {unit}"),
                curves: path.curves.pieces.iter().filter(tells).collect(),
                taken: taken.collect(),
                of: Some((i, scale)),
                limits: bounds(joint.limit).map(|ends| ends.map(|x| scale * x)),
            });
        }
        let [title, unit] = subject.measure;
        panels.push(Panel {
            title,
            axis: unit.into(),
            curves: Vec::new(),
            taken: path.measure.clone(),
            of: None,
            limits: None,
        });
        panels
    }

    fn panel<B: DrawingBackend>(&self, area: &Area<B>, panel: &Panel) -> Drawn<B> {
        let way = &self.path.way;
        let (begin, end) = (way.first().copied(), way.last().copied());
        let (begin, end) = (begin.unwrap_or(0.0), end.unwrap_or(1.0));
        let (begin, end) = (begin.min(end), begin.max(end).max(begin + 1e-9));
        let [low, high] = panel.range();
        let mut chart = ChartBuilder::on(area)
            .caption(panel.title, font(15))
            .margin_top(px(6))
            .margin_right(px(18))
            .margin_left(px(8))
            .x_label_area_size(px(42))
            .y_label_area_size(px(64))
            .build_cartesian_2d(begin..end, low..high)?;
        let digits = usize::from(high - low < 20.0) + 2 * usize::from(high - low < 1.0);
        plain(chart.configure_mesh())
            .y_labels(6)
            .x_labels(8)
            .x_desc(&self.path.axis)
            .y_desc(&panel.axis)
            .x_label_formatter(&|x| label(*x, usize::from(end - begin < 8.0)))
            .y_label_formatter(&|y| label(*y, digits))
            .draw()?;
        for (limit, beyond) in panel
            .limits
            .iter()
            .flat_map(|[l, h]| [(*l, low), (*h, high)])
        {
            if !(low..=high).contains(&limit) {
                continue;
            }
            let region = [(begin, limit), (end, beyond)];
            chart.draw_series([Rectangle::new(region, BEYOND.mix(0.07).filled())])?;
            let ends = [(begin, limit), (end, limit)];
            let dashes = DashedLineSeries::new(ends, px(7), px(5), line(BEYOND, 1));
            chart.draw_series(dashes)?;
        }
        if let Some((joint, to)) = panel.of {
            for piece in &panel.curves {
                let points = piece.points.iter();
                let points = points.map(|(k, q)| (way[*k], to * q[joint - piece.first]));
                let style = line(piece.branch.map_or(OTHERS, hue), 2);
                curve(&mut chart, &points.collect::<Vec<_>>(), style)?;
            }
        }
        for piece in pieces(&panel.taken, &self.path.jumps()) {
            let points = piece.iter().map(|&(k, y)| (way[k], y));
            curve(&mut chart, &points.collect::<Vec<_>>(), line(LINK, 3))?;
        }
        Ok(())
    }

    /// What the legend has, with its place, pixels, and how many lines it is high.
    fn entries(&self) -> (Vec<Entry>, u32) {
        let curves = &self.path.curves;
        let branches = curves.branches().into_iter();
        let branches = branches.map(|branch| (format!("branch {branch}"), hue(branch), 2));
        let others = curves.pieces.iter().any(|piece| piece.branch.is_none());
        let others = others.then(|| ("all postures".to_owned(), OTHERS, 2));
        let shown = |panel: &Panel| {
            let [low, high] = panel.range();
            let limits = panel.limits.iter().flatten();
            limits.into_iter().any(|limit| (low..=high).contains(limit))
        };
        let limit = self.panels().iter().any(shown);
        let limit = limit.then(|| ("limit".to_owned(), BEYOND, 1));
        let taken = [("taken".to_owned(), LINK, 3)].into_iter();
        let all = taken.chain(limit).chain(others).chain(branches);
        let (mut x, mut row) = (LEGEND_WIDTH.0, 0);
        let mut entries = Vec::new();
        for (text, colour, width) in all {
            let advance = 52 + 8 * text.len() as i32;
            if x + advance > LEGEND_WIDTH.1 {
                (x, row) = (LEGEND_WIDTH.0, row + 1);
            }
            let at = (x, (LEGEND * row + LEGEND / 2) as i32);
            entries.push(Entry::new(at, &text, colour, width));
            x += advance;
        }
        (entries, row)
    }

    fn legend<B: DrawingBackend>(&self, area: &Area<B>) -> Drawn<B> {
        self.entries()
            .0
            .iter()
            .try_for_each(|entry| entry.draw(area))
    }
}

/// A line of one colour and what it is.
struct Entry {
    at: (i32, i32),
    text: String,
    colour: RGBColor,
    width: u32,
}

impl Entry {
    fn new(at: (i32, i32), text: &str, colour: RGBColor, width: u32) -> Self {
        Self {
            at,
            text: text.into(),
            colour,
            width,
        }
    }

    fn draw<B: DrawingBackend>(&self, area: &Area<B>) -> Drawn<B> {
        let [x, y] = [self.at.0, self.at.1].map(|pixels| px(pixels as u32) as i32);
        let [end, text] = [26, 32].map(|pixels| x + px(pixels) as i32);
        let sample = vec![(x, y), (end, y)];
        area.draw(&PathElement::new(sample, line(self.colour, self.width)))?;
        area.draw_text(&self.text, &font_behind(14), (text, y))
    }
}

impl Panel<'_> {
    /// What is shown of y: all values, and limits that are not far from them.
    fn range(&self) -> [f64; 2] {
        let (joint, to) = self.of.unwrap_or((0, 1.0));
        let curves = self.curves.iter();
        let values =
            curves.flat_map(|it| it.points.iter().map(move |(_, q)| to * q[joint - it.first]));
        let values = values.chain(self.taken.iter().copied().flatten());
        let mut ends = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], y| {
            [low.min(y), high.max(y)]
        });
        if ends[0] > ends[1] {
            ends = [0.0, 1.0];
        }
        if self.of.is_none() {
            ends[0] = 0.0;
        }
        let room = (0.08 * (ends[1] - ends[0]))
            .max(1e-3 * ends[1].abs())
            .max(1e-6);
        for limit in self.limits.iter().flatten() {
            let near = ends[0] - 4.0 * room..ends[1] + 4.0 * room;
            if near.contains(limit) {
                ends = [ends[0].min(*limit), ends[1].max(*limit)];
            }
        }
        let low = if self.of.is_none() {
            0.0
        } else {
            ends[0] - room
        };
        [low, ends[1] + room]
    }
}

fn bounds(limit: JointLimit) -> Option<[f64; 2]> {
    let ends = [limit.lower(), limit.upper()];
    ends.iter().all(|x| x.is_finite()).then_some(ends)
}

/// Draws a curve; one of a single point is a dot. Where it turns back a wide line of pixels would
/// have a spike as long as the turn is sharp, and so it is drawn between such corners.
fn curve<B: DrawingBackend>(
    chart: &mut ChartContext<B, Cartesian2d<RangedCoordf64, RangedCoordf64>>,
    points: &[(f64, f64)],
    style: ShapeStyle,
) -> Drawn<B> {
    if let [point] = points {
        let dot = Circle::new(*point, style.stroke_width, style.filled());
        return chart.draw_series([dot]).map(drop);
    }
    let pixels = points.iter().map(|point| chart.backend_coord(point));
    for part in between_corners(&pixels.collect::<Vec<_>>()) {
        chart.draw_series([PathElement::new(&points[part], style)])?;
    }
    Ok(())
}

/// The parts of a curve between its corners of a right angle and sharper ones.
fn between_corners(pixels: &[(i32, i32)]) -> Vec<Range<usize>> {
    let mut parts = Vec::new();
    let (mut first, mut way) = (0, (0, 0));
    for k in 1..pixels.len() {
        let next = (pixels[k].0 - pixels[k - 1].0, pixels[k].1 - pixels[k - 1].1);
        if next == (0, 0) {
            continue;
        }
        if way != (0, 0) && way.0 * next.0 + way.1 * next.1 <= 0 {
            parts.push(first..k);
            first = k - 1;
        }
        way = next;
    }
    parts.push(first..pixels.len());
    parts
}

/// Values without gaps, and without the jumps.
fn pieces(values: &[Option<f64>], jumps: &[usize]) -> Vec<Vec<(usize, f64)>> {
    let mut pieces: Vec<Vec<(usize, f64)>> = vec![Vec::new()];
    for (k, value) in values.iter().enumerate() {
        if value.is_none() || jumps.binary_search(&k).is_ok() {
            pieces.push(Vec::new());
        }
        if let (Some(y), Some(piece)) = (value, pieces.last_mut()) {
            piece.push((k, *y));
        }
    }
    pieces.retain(|piece| !piece.is_empty());
    pieces
}

#[cfg(test)]
mod tests {
    use super::between_corners;

    #[test]
    fn a_curve_is_parted_where_it_turns_back() {
        let pixels = [(0, 0), (5, 1), (5, 1), (9, 2), (4, 2), (4, 9), (6, 20)];
        assert_eq!(between_corners(&pixels), [0..4, 3..5, 4..7]);
        assert_eq!(between_corners(&pixels[..4]), vec![0..4; 1]);
        assert_eq!(between_corners(&[]), vec![0..0; 1]);
    }
}
