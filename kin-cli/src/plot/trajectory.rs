//! The joints along a path: a panel for each, with all branches, the limits, and what an arm on
//! the path takes.

use super::canvas::{Area, Drawn, FAINT, INK, LINK, Picture, TYPEFACE, hue, label};
use super::path::{Curve, Path};
use kin_codegen::spec::one_line;
use kin_runtime::JointLimit;
use kinematics::Robot;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// Pixels: of a panel, of the title, of the legend.
const PANEL: (u32, u32) = (600, 232);
const TITLE: u32 = 40;
const LEGEND: u32 = 34;
/// Beyond limits.
const BEYOND: RGBColor = RGBColor(179, 38, 30);

/// The picture.
pub struct Trajectory<'a> {
    pub robot: &'a Robot,
    pub path: &'a Path,
}

/// A panel.
struct Panel<'a> {
    title: String,
    /// What y is, with its unit.
    axis: String,
    /// From the values of a configuration to y.
    curves: Vec<(usize, &'a Curve)>,
    taken: Vec<Option<f64>>,
    of: Option<(usize, f64)>,
    limits: Option<[f64; 2]>,
}

impl Picture for Trajectory<'_> {
    fn size(&self) -> (u32, u32) {
        let rows = (self.robot.joints() as u32 + 1).div_ceil(2);
        (2 * PANEL.0, rows * PANEL.1 + TITLE + LEGEND)
    }

    fn draw<B: DrawingBackend>(&self, area: &Area<B>) -> Drawn<B> {
        let (_, height) = self.size();
        let (head, rest) = area.split_vertically(TITLE);
        let (panels, legend) = rest.split_vertically(height - TITLE - LEGEND);
        let style = (TYPEFACE, 19).into_font().color(&INK);
        let style = style.pos(Pos::new(HPos::Left, VPos::Center));
        let title = format!(
            "{}: joints along a line of {}",
            one_line(self.robot.name()),
            one_line(self.robot.tip())
        );
        head.draw_text(&title, &style, (20, TITLE as i32 / 2 + 2))?;
        let all = self.panels();
        let places = panels.split_evenly((all.len().div_ceil(2), 2));
        for (place, panel) in places.iter().zip(&all) {
            self.panel(place, panel)?;
        }
        self.legend(&legend)
    }
}

impl Trajectory<'_> {
    fn panels(&self) -> Vec<Panel<'_>> {
        let (robot, path) = (self.robot, self.path);
        let names = robot.joint_names();
        let mut panels = Vec::new();
        for (i, (name, limit)) in names.iter().zip(robot.limits()).enumerate() {
            let (unit, scale) = match limit.is_revolute() {
                true => ("°", 1.0_f64.to_degrees()),
                false => ("mm", 1000.0),
            };
            let curves = path.curves.iter().enumerate();
            let curves =
                curves.flat_map(|(branch, pieces)| pieces.iter().map(move |it| (branch, it)));
            let taken = path.taken.iter().map(|q| q.as_ref().map(|q| scale * q[i]));
            panels.push(Panel {
                title: one_line(name),
                axis: format!("in {unit}"),
                curves: curves.collect(),
                taken: taken.collect(),
                of: Some((i, scale)),
                limits: bounds(*limit).map(|ends| ends.map(|x| scale * x)),
            });
        }
        panels.push(Panel {
            title: "least singular value of the Jacobian".into(),
            axis: "metres, radians".into(),
            curves: Vec::new(),
            taken: path.least.clone(),
            of: None,
            limits: None,
        });
        panels
    }

    fn panel<B: DrawingBackend>(&self, area: &Area<B>, panel: &Panel) -> Drawn<B> {
        let scale = if self.path.is_length {
            1000.0
        } else {
            1.0_f64.to_degrees()
        };
        let way: Vec<f64> = self.path.way.iter().map(|x| scale * x).collect();
        let end = way.last().copied().unwrap_or(1.0).max(1e-9);
        let [low, high] = panel.range();
        let mut chart = ChartBuilder::on(area)
            .caption(&panel.title, (TYPEFACE, 15).into_font().color(&INK))
            .margin_right(18)
            .margin_left(8)
            .x_label_area_size(38)
            .y_label_area_size(64)
            .build_cartesian_2d(0.0..end, low..high)?;
        let digits = usize::from(high - low < 20.0) + 2 * usize::from(high - low < 1.0);
        let of_way = if self.path.is_length {
            "along the path in mm"
        } else {
            "along the path in °"
        };
        chart
            .configure_mesh()
            .y_labels(6)
            .x_labels(8)
            .x_desc(of_way)
            .y_desc(&panel.axis)
            .light_line_style(WHITE)
            .bold_line_style(FAINT)
            .axis_style(INK)
            .label_style((TYPEFACE, 13).into_font().color(&INK))
            .axis_desc_style((TYPEFACE, 13).into_font().color(&INK))
            .x_label_formatter(&|x| label(*x, 0))
            .y_label_formatter(&|y| label(*y, digits))
            .draw()?;
        for limit in panel
            .limits
            .iter()
            .flatten()
            .filter(|x| (low..=high).contains(*x))
        {
            let beyond = if *limit > 0.5 * (low + high) {
                high
            } else {
                low
            };
            let region = [(0.0, *limit), (end, beyond)];
            chart.draw_series([Rectangle::new(region, BEYOND.mix(0.07).filled())])?;
            let line = [(0.0, *limit), (end, *limit)];
            chart.draw_series(DashedLineSeries::new(line, 7, 5, BEYOND.stroke_width(1)))?;
        }
        if let Some((joint, to)) = panel.of {
            for (branch, curve) in &panel.curves {
                let points = curve.iter().map(|(k, q)| (way[*k], to * q[joint]));
                let style = hue(*branch).stroke_width(2);
                chart.draw_series(LineSeries::new(points, style))?;
            }
        }
        for piece in pieces(&panel.taken, &self.path.jumps()) {
            let points = piece.iter().map(|&(k, y)| (way[k], y));
            chart.draw_series(LineSeries::new(points, LINK.stroke_width(3)))?;
        }
        Ok(())
    }

    fn legend<B: DrawingBackend>(&self, area: &Area<B>) -> Drawn<B> {
        let style = (TYPEFACE, 14).into_font().color(&INK);
        let style = style.pos(Pos::new(HPos::Left, VPos::Center));
        let middle = LEGEND as i32 / 2 - 2;
        let mut x = 72;
        let curves = self.path.curves.iter().enumerate();
        let used = curves.filter(|(_, pieces)| !pieces.is_empty());
        let branches = used.map(|(branch, _)| (format!("branch {branch}"), hue(branch), 2));
        let all = [
            ("taken".to_owned(), LINK, 3),
            ("limit".to_owned(), BEYOND, 1),
        ];
        for (text, colour, width) in all.into_iter().chain(branches) {
            let line = vec![(x, middle), (x + 26, middle)];
            area.draw(&PathElement::new(line, colour.stroke_width(width)))?;
            area.draw_text(&text, &style, (x + 32, middle))?;
            x += 44 + 8 * text.len() as i32;
        }
        Ok(())
    }
}

impl Panel<'_> {
    /// What is shown of y: all values, and limits that are not far from them.
    fn range(&self) -> [f64; 2] {
        let to = self.of.unwrap_or((0, 1.0));
        let curves = self.curves.iter().flat_map(|(_, curve)| curve.iter());
        let values = curves.map(|(_, q)| to.1 * q[to.0]);
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

/// Values without gaps, and without the jumps.
fn pieces(values: &[Option<f64>], jumps: &[usize]) -> Vec<Vec<(usize, f64)>> {
    let mut pieces: Vec<Vec<(usize, f64)>> = vec![Vec::new()];
    for (k, value) in values.iter().enumerate() {
        if value.is_none() || jumps.contains(&k) {
            pieces.push(Vec::new());
        }
        if let (Some(y), Some(piece)) = (value, pieces.last_mut()) {
            piece.push((k, *y));
        }
    }
    pieces.retain(|piece| !piece.is_empty());
    pieces
}
