//! Paths of a parallel mechanism.

use super::figure::Figure;
use super::path::{Curves, Joint, Path, Subject};
use super::table::{self, Table, configurations, or_joints};
use crate::batch::PoseColumns;
use crate::table::{Fault, Header};
use kin_codegen::mechanism::{Aim, CompiledMechanism, Placed};
use kin_codegen::spec::one_line;
use kin_runtime::{Mechanism, Pose, Target};

/// Steps from home to where a path begins.
const APPROACH: usize = 100;

/// A mechanism, and all that is asked of it.
pub struct Platform<'a> {
    compiled: &'a CompiledMechanism,
    generic: Mechanism,
    pub subject: Subject,
}

impl<'a> Platform<'a> {
    pub fn new(compiled: &'a CompiledMechanism) -> Self {
        let mechanism = &compiled.mechanism;
        let legs = mechanism.legs.iter();
        let joints = legs.flat_map(|leg| {
            let joints = leg.model.joints.iter().zip(leg.model.limits());
            joints.enumerate().map(|(j, (joint, limit))| Joint {
                name: one_line(&joint.name),
                limit,
                is_shown: leg.actuated.contains(&j),
            })
        });
        Self {
            subject: Subject {
                name: one_line(&mechanism.name),
                tip: one_line(&mechanism.platform),
                joints: joints.collect(),
                measure: ["distance from actuator singularities", "relative"],
            },
            generic: mechanism.generic(),
            compiled,
        }
    }

    /// It at the ends of a path, and where its platform goes.
    pub fn figures(&self, path: &Path) -> (Vec<Figure>, Vec<[f64; 3]>) {
        let taken = || path.taken.iter().flatten();
        let ends = taken().next().into_iter().chain(taken().last());
        let ends = ends.map(|q| Figure::mechanism(&self.compiled.mechanism, q));
        let way = taken().map(|q| self.pose(q).translation);
        (ends.collect(), way.collect())
    }

    /// The names of the actuated joints.
    pub fn actuated(&self) -> Vec<String> {
        let legs = self.compiled.mechanism.legs.iter();
        legs.flat_map(|leg| leg.actuated_names()).collect()
    }

    fn pose(&self, q: &[f64]) -> Pose {
        self.generic.poses(q)[0]
    }

    fn begun(&self, axis: String) -> Path {
        Path {
            axis,
            way: Vec::new(),
            curves: Curves::new(self.subject.joints.iter().map(|joint| joint.limit)),
            taken: Vec::new(),
            measure: Vec::new(),
        }
    }

    /// Adds a point at which the mechanism is, or is not.
    fn push(&self, path: &mut Path, way: f64, q: Option<Vec<f64>>, placed: &[Placed]) {
        let point = path.way.len();
        path.way.push(way);
        for (chain, [first, _]) in self.compiled.mechanism.ranges().into_iter().enumerate() {
            let all = placed.iter().flat_map(|placed| &placed.solutions[chain]);
            let all: Vec<Vec<f64>> = all.cloned().collect();
            path.curves.push_all(point, first, &all);
        }
        let measure = q.as_ref().map(|q| self.generic.actuator_singularity(q));
        path.measure.push(measure);
        path.taken.push(q);
    }

    /// While the actuated joints go from one set of values to another, evenly, having come there
    /// from home. None if the mechanism cannot be driven from home to `from`.
    pub fn driven(&self, from: &[f64], to: &[f64], steps: usize) -> Option<Path> {
        let drive = |share: f64, from: &[f64], to: &[f64]| -> Vec<f64> {
            let both = from.iter().zip(to);
            both.map(|(a, b)| a + share * (b - a)).collect()
        };
        let mut q = vec![0.0; self.generic.joints()];
        let home = vec![0.0; from.len()];
        for k in 1..=APPROACH {
            let values = drive(k as f64 / APPROACH as f64, &home, from);
            q = self.generic.fk_near(&values, &q)?;
        }
        let only = match self.generic.actuated() {
            [joint] => Some(&self.subject.joints[*joint]),
            _ => None,
        };
        let (axis, [begin, end]) = match only {
            Some(joint) if joint.limit.is_revolute() => (
                format!("{} in °", joint.name),
                [from[0], to[0]].map(f64::to_degrees),
            ),
            Some(joint) => (
                format!("{} in mm", joint.name),
                [1000.0 * from[0], 1000.0 * to[0]],
            ),
            None => ("along the drive in %".into(), [0.0, 100.0]),
        };
        let mut path = self.begun(axis);
        for k in 0..=steps {
            let share = k as f64 / steps as f64;
            let found = self.generic.fk_near(&drive(share, from, to), &q);
            if let Some(found) = &found {
                q.clone_from(found);
            }
            let placed = found.as_ref().map(|q| self.placed(q)).unwrap_or_default();
            self.push(&mut path, begin + share * (end - begin), found, &placed);
        }
        Some(path)
    }

    /// All postures at the pose of one.
    fn placed(&self, q: &[f64]) -> Vec<Placed> {
        let is_lead = |inverse: &kin_codegen::mechanism::Inverse| match inverse.aim {
            Aim::Lead(lead) => Some(lead),
            _ => None,
        };
        let lead = self.compiled.inverse.as_ref().and_then(is_lead);
        let target = self.generic.poses(q)[lead.unwrap_or(0)];
        self.compiled.solutions(&target)
    }

    /// What a table has: values of the actuated joints, or poses of the platform.
    ///
    /// # Errors
    ///
    /// The table has none of these, or too much.
    pub fn of_table(&self, table: Table) -> Result<Path, Fault> {
        let (path, actuated) = (table.path, self.actuated());
        let actuated: Vec<&str> = actuated.iter().map(String::as_str).collect();
        let header = table.reader.header();
        let places = match header {
            Header::Names(_) if actuated.iter().any(|name| table.has(name)) => {
                Some(crate::batch::columns(path, header, &actuated)?)
            }
            Header::Width(width) if *width == actuated.len() => {
                Some(crate::batch::columns(path, header, &actuated)?)
            }
            _ => None,
        };
        if let Some(places) = places {
            let rows = configurations(path, &table.columns(&places)?)?;
            return Ok(self.of_values(rows));
        }
        let Some(inverse) = &self.compiled.inverse else {
            let reason = "poses need inverse kinematics, which this mechanism has not";
            let remedy = format!("give it the actuated joints: {}", actuated.join(", "));
            return Err(Fault::whole(path, reason, remedy));
        };
        let target = match inverse.aim {
            Aim::Pose => Target::Pose,
            Aim::Translation | Aim::Lead(_) => Target::Position,
        };
        let poses = PoseColumns::find(path, header, target, &[])
            .map_err(|fault| or_joints(fault, &actuated))?;
        let columns = table.columns(&poses.selected)?;
        let mut path = self.begun(table::TARGETS.into());
        let mut seed = vec![0.0; self.generic.joints()];
        for row in 0..columns[0].len() {
            let pose = poses.pose(&columns, row).ok();
            let placed = pose.map(|pose| self.compiled.solutions(&pose));
            let placed = placed.unwrap_or_default();
            let q = self.nearest(&placed, &seed);
            if let Some(q) = &q {
                seed.clone_from(q);
            }
            self.push(&mut path, row as f64, q, &placed);
        }
        Ok(path)
    }

    /// The posture within limits whose joints are nearest, as
    /// [`Postures::nearest`](kin_runtime::Postures::nearest) has it.
    fn nearest(&self, placed: &[Placed], seed: &[f64]) -> Option<Vec<f64>> {
        let chain = |(solutions, [first, end]): (&Vec<Vec<f64>>, [usize; 2])| {
            let within = |q: &Vec<f64>| {
                let joints = self.subject.joints[first..end].iter().zip(q);
                let inside = joints
                    .zip(&seed[first..end])
                    .map(|((joint, &x), &seed)| joint.limit.nearest(x, seed));
                inside.collect::<Option<Vec<f64>>>()
            };
            let far = |q: &Vec<f64>| -> f64 {
                let apart = q.iter().zip(&seed[first..end]);
                apart.map(|(a, b)| (a - b) * (a - b)).sum()
            };
            let all = solutions.iter().filter_map(within);
            let all = all.map(|q| (far(&q), q));
            all.min_by(|a, b| a.0.total_cmp(&b.0))
        };
        let postures = placed.iter().filter_map(|placed| {
            let ranges = self.compiled.mechanism.ranges();
            let chains = placed.solutions.iter().zip(ranges).map(chain);
            let chains = chains.collect::<Option<Vec<_>>>()?;
            let far: f64 = chains.iter().map(|(far, _)| far).sum();
            Some((far, chains.into_iter().flat_map(|(_, q)| q).collect()))
        });
        let nearest = postures.min_by(|a: &(f64, Vec<f64>), b| a.0.total_cmp(&b.0));
        nearest.map(|(_, q)| q)
    }

    fn of_values(&self, rows: Vec<Option<Vec<f64>>>) -> Path {
        let mut path = self.begun(table::ROWS.into());
        let mut seed = vec![0.0; self.generic.joints()];
        for (row, values) in rows.into_iter().enumerate() {
            let q = values.and_then(|values| self.generic.fk_near(&values, &seed));
            if let Some(q) = &q {
                seed.clone_from(q);
            }
            let placed = q.as_ref().map(|q| self.placed(q)).unwrap_or_default();
            self.push(&mut path, row as f64, q, &placed);
        }
        path
    }
}
