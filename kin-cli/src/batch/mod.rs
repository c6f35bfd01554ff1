//! Many rows at once, from tables to tables, on all cores.
//!
//! A [`Task`] is what is computed of rows: [`Forward`] and [`Inverse`] kinematics. A [`Job`] runs
//! one over a file: portions of rows through all cores, answers in the order of the rows, so much
//! memory as some portions take. What is interrupted goes on where it was.
//!
//! ```
//! use kin_cli::batch::{Forward, Job, Task, Written};
//! use kin_cli::table::Format;
//! use std::ops::ControlFlow;
//! let folder = std::env::temp_dir().join("kin-batch-example");
//! std::fs::create_dir_all(&folder)?;
//! let (input, output) = (folder.join("joints.csv"), folder.join("poses.csv"));
//! std::fs::write(&input, "shoulder,elbow,wrist,lift\n0.4,0.9,-0.2,0.1\n")?;
//!
//! let robot = kinematics::Robot::from_yaml("../robots/scara.yaml")?;
//! let task = Forward::new(&input, &robot, Written::Quaternion)?;
//! let mut reader = Format::Csv.open(&input)?;
//! let columns = task.find(&input, reader.header())?;
//! reader.select(&columns)?;
//! let encoder = Format::Csv.encoder(task.columns());
//! let job = Job {
//!     input: &input, reader, task: &task, encoder, output: output.clone(),
//!     batch: 1000, is_strict: true, robot: "scara".into(),
//! };
//! assert_eq!(job.run(&mut |_| ControlFlow::Continue(()))?.answers, 1);
//! assert!(std::fs::read_to_string(&output)?.starts_with("x,y,z,qx,qy,qz,qw\n"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod folder;
mod forward;
mod inverse;
mod job;
mod journal;
mod partial;
mod pipeline;
mod place;
mod pose;
mod task;

pub use folder::{Pair, Share, pairs};
pub use forward::{Forward, RADIANS, beyond, columns};
pub use inverse::{Inverse, Kept};
pub use job::{Job, Report, forget_all};
pub use pose::{PoseColumns, Written};
pub use task::{Tally, Task};
