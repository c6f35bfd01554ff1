//! A straight line of a tip.

use kin_runtime::Pose;

/// A way between two poses.
pub struct Line {
    from: Pose,
    shift: [f64; 3],
    /// Metres.
    pub length: f64,
    axis: [f64; 3],
    /// Radians.
    pub angle: f64,
}

impl Line {
    pub fn new(from: &Pose, to: &Pose) -> Self {
        let turned = Pose {
            translation: [0.0; 3],
            ..*to
        } * Pose {
            translation: [0.0; 3],
            ..*from
        }
        .inverse();
        let turn = turned.log().angular;
        let norm = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let angle = norm(turn);
        let shift: [f64; 3] = std::array::from_fn(|i| to.translation[i] - from.translation[i]);
        Line {
            from: *from,
            shift,
            length: norm(shift),
            axis: if angle > 0.0 {
                turn.map(|x| x / angle)
            } else {
                [0.0, 0.0, 1.0]
            },
            angle,
        }
    }

    pub fn at(&self, share: f64) -> Pose {
        let turn = Pose::from_axis_angle(self.axis, share * self.angle, [0.0; 3]);
        let rotation = (turn
            * Pose {
                translation: [0.0; 3],
                ..self.from
            })
        .rotation;
        Pose {
            rotation,
            translation: std::array::from_fn(|i| self.from.translation[i] + share * self.shift[i]),
        }
    }
}
