//! `kin workspace`: the files it writes, read back.

use kin_cli::{Done, Exit};
use std::fs;
use std::path::{Path, PathBuf};

/// The maps of a robot.
struct Maps {
    folder: PathBuf,
    robot: &'static str,
    /// Points along a side.
    cells: usize,
    /// By slice (xz, yz, xy), row from below, and column.
    share: Vec<f64>,
    /// Manipulability, or a mechanism's distance from actuator singularities.
    measure: Vec<f64>,
    /// By slice, metres.
    centres: [[f64; 3]; 3],
    /// Between points, metres.
    step: f64,
}

impl Maps {
    fn of(robot: &'static str, options: &[&str]) -> Maps {
        let folder =
            Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("maps{}", options.concat()));
        let done = run(robot, &folder, options);
        assert_eq!(done.exit, Exit::Success, "{}", done.stderr);
        let file = |name: &str| folder.join(format!("{robot}_{name}"));
        let (shape, share) = read_npy(&file("reachability.npy"));
        let measure = ["manipulability.npy", "actuator_singularity.npy"];
        let measure = measure.map(file).into_iter().find(|path| path.exists());
        let (same, measure) = read_npy(&measure.unwrap());
        assert_eq!(shape, same);
        assert_eq!((shape[0], shape[1]), (3, shape[2]));
        let text = fs::read_to_string(file("workspace.json")).unwrap();
        let json: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!(json["cells"], shape[1]);
        Maps {
            centres: std::array::from_fn(|slice| {
                let centre = &json["slices"][slice]["centre"];
                std::array::from_fn(|i| centre[i].as_f64().unwrap())
            }),
            step: json["cell_size"].as_f64().unwrap(),
            cells: shape[1],
            folder,
            robot,
            share,
            measure,
        }
    }

    fn at(&self, values: &[f64], slice: usize, row: usize, column: usize) -> f64 {
        values[(slice * self.cells + row) * self.cells + column]
    }

    /// From the middle of a slice, metres.
    fn place(&self, row: usize, column: usize) -> [f64; 2] {
        let middle = (self.cells as f64 - 1.0) / 2.0;
        [column, row].map(|i| (i as f64 - middle) * self.step)
    }

    /// A point in base coordinates, metres.
    fn point(&self, slice: usize, row: usize, column: usize) -> [f64; 3] {
        let [across, up] = [[0, 2], [1, 2], [0, 1]][slice];
        let [x, y] = self.place(row, column);
        let mut point = self.centres[slice];
        point[across] += x;
        point[up] += y;
        point
    }

    fn all(&self) -> impl Iterator<Item = (usize, usize)> + use<> {
        let cells = self.cells;
        (0..cells).flat_map(move |row| (0..cells).map(move |column| (row, column)))
    }
}

fn run(robot: &str, folder: &Path, options: &[&str]) -> Done {
    let file = format!("../robots/{robot}.yaml");
    let out = folder.to_str().unwrap();
    let command = ["kin", "workspace", &file, "--out", out];
    kin_cli::run(command.iter().chain(options))
}

/// As the format's documentation describes it.
fn read_npy(path: &Path) -> (Vec<usize>, Vec<f64>) {
    let bytes = fs::read(path).unwrap();
    assert_eq!(bytes[..8], *b"\x93NUMPY\x01\x00");
    let length = usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    let start = 10 + length;
    assert_eq!(start % 64, 0);
    let header = std::str::from_utf8(&bytes[10..start]).unwrap();
    assert!(header.ends_with('\n') && header.contains("'descr': '<f8'"));
    assert!(header.contains("'fortran_order': False"));
    let shape = header.split_once("'shape': (").unwrap().1;
    let shape = shape.split_once(')').unwrap().0;
    let shape = shape
        .split(',')
        .map(str::trim)
        .filter(|extent| !extent.is_empty());
    let shape: Vec<usize> = shape.map(|extent| extent.parse().unwrap()).collect();
    let values: Vec<f64> = (bytes[start..].chunks(8))
        .map(|chunk| f64::from_le_bytes(chunk.try_into().unwrap()))
        .collect();
    assert_eq!(values.len(), shape.iter().product::<usize>());
    (shape, values)
}

/// Width, height and colours.
fn read_png(path: &Path) -> (usize, usize, Vec<[u8; 3]>) {
    let file = std::io::BufReader::new(fs::File::open(path).unwrap());
    let mut decoder = png::Decoder::new(file);
    decoder.set_transformations(png::Transformations::IDENTITY);
    let mut reader = decoder.read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    assert_eq!(info.color_type, png::ColorType::Rgb);
    let pixels = pixels.chunks_exact(3).map(|it| it.try_into().unwrap());
    (info.width as usize, info.height as usize, pixels.collect())
}

/// The annuli of the planar 3R arm: 0.1 m to 0.9 m in reach, 0.3 m to 0.7 m at
/// every turn.
#[test]
fn planar_annuli_are_on_the_map() {
    let maps = Maps::of("planar_3r", &["--samples", "36", "--cells", "41"]);
    let (mut dextrous, mut reachable) = (0, 0);
    for (row, column) in maps.all() {
        let [x, y] = maps.place(row, column);
        let radius = x.hypot(y);
        let share = maps.at(&maps.share, 2, row, column);
        if [0.1, 0.9].iter().all(|edge| (edge - radius).abs() > 0.005) {
            assert_eq!(share > 0.0, (0.1..0.9).contains(&radius), "{radius}");
        }
        if [0.3, 0.7].iter().all(|edge| (edge - radius).abs() > 0.005) {
            assert_eq!(share == 1.0, (0.3..0.7).contains(&radius), "{radius}");
        }
        reachable += usize::from(share > 0.0);
        dextrous += usize::from(share == 1.0);
    }
    let area = |count: usize| count as f64 * maps.step.powi(2);
    let expected = |inner: f64, outer: f64| std::f64::consts::PI * (outer.powi(2) - inner.powi(2));
    assert!((area(reachable) / expected(0.1, 0.9) - 1.0).abs() < 0.05);
    assert!((area(dextrous) / expected(0.3, 0.7) - 1.0).abs() < 0.05);
}

/// Arms whose first axis is vertical are alike in all directions.
#[test]
fn symmetric_arms_have_symmetric_maps() {
    let planar = Maps::of("planar_3r", &["--samples", "36", "--cells", "30"]);
    for (row, column) in planar.all() {
        let here = planar.at(&planar.share, 2, row, column);
        let turned = planar.at(&planar.share, 2, column, 29 - row);
        assert!((here - turned).abs() < 1e-12, "row {row}, column {column}");
    }
    // The tip is the wrist's centre, so that the orientation does not matter.
    let elbow = Maps::of("elbow", &["--samples", "6", "--cells", "30"]);
    for (row, column) in elbow.all() {
        let xz = elbow.at(&elbow.share, 0, row, column);
        assert!(xz == 0.0 || xz == 1.0);
        assert_eq!(xz, elbow.at(&elbow.share, 1, row, column));
        assert_eq!(xz, elbow.at(&elbow.share, 0, row, 29 - column));
    }
}

/// White where nothing is reached, and the last colour where everything is.
#[test]
fn pictures_show_the_numbers() {
    let maps = Maps::of("planar_3r", &["--samples", "8", "--cells", "21"]);
    let path = maps.folder.join(format!("{}_xy.png", maps.robot));
    let (width, height, pixels) = read_png(&path);
    // The square between the axes, of two dots to a pixel.
    let (left, top, side) = (2 * 62, 2 * 36, 2.0 * 326.0);
    let size = (left + 2 * (326 + 12 + 96), top + 2 * (326 + 48));
    assert_eq!((width, height), size);
    let (mut outside, mut everywhere) = (0, 0);
    for (row, column) in maps.all() {
        // Not where the arm is drawn.
        if row == 10 {
            continue;
        }
        let [right, down] = [column, 20 - row].map(|i| (i as f64 + 0.3) * side / 21.0);
        let pixel = pixels[(top + down as usize) * width + left + right as usize];
        let share = maps.at(&maps.share, 2, row, column);
        assert_eq!(share == 0.0, pixel.iter().all(|x| *x > 220), "{pixel:?}");
        assert_eq!(share == 1.0, pixel == [253, 231, 37], "{pixel:?}");
        outside += usize::from(share == 0.0);
        everywhere += usize::from(share == 1.0);
    }
    assert!(outside > 50 && everywhere > 50);
    let (width, height, _) = read_png(&maps.folder.join("planar_3r_workspace.png"));
    assert_eq!((width, height), (2 * (3 * 400 + 96), 2 * 2 * 410));
}

/// The same as vectors, with what a reader needs, and with names that stay text.
#[test]
fn vectors_say_what_they_show() {
    let maps = Maps::of("planar_3r", &["--samples", "3", "--cells", "12"]);
    let svg = fs::read_to_string(maps.folder.join("planar_3r_workspace.svg")).unwrap();
    for text in [
        "planar_3r: share of 3 orientations reached, regardless of limits",
        "x in m",
        "z in m",
        "100 %",
        "absolute value of det J of the best branch, mean",
    ] {
        assert!(svg.contains(text), "{text}");
    }
}

/// |det J| of a SCARA is l1 l2 |s2|, and s2 follows from the distance.
#[test]
fn manipulability_is_that_of_the_posture() {
    let maps = Maps::of("scara", &["--samples", "4", "--cells", "31"]);
    let mut seen = 0;
    for (row, column) in maps.all() {
        let [x, y] = maps.place(row, column);
        if maps.at(&maps.share, 2, row, column) > 0.0 {
            let cosine = (x * x + y * y - 0.16 - 0.09) / 0.24;
            let expected = 0.12 * (1.0 - cosine * cosine).max(0.0).sqrt();
            let found = maps.at(&maps.measure, 2, row, column);
            assert!((found - expected).abs() < 1e-9, "{found} is not {expected}");
            seen += 1;
        }
    }
    assert!(seen > 200);
}

/// The first joint of a KR 6 turns by ±170°: some of what is behind it is out.
#[test]
fn limits_take_away() {
    let options = ["--samples", "6", "--cells", "15"];
    let free = Maps::of("kr6_r900", &options);
    let limited = Maps::of("kr6_r900", &[&options[..], &["--limits"]].concat());
    let pairs = || free.share.iter().zip(&limited.share);
    assert!(pairs().all(|(free, limited)| limited <= free));
    assert!(pairs().any(|(free, limited)| limited < free));
}

/// How far within reach of an arm the wrist of `robots/delta.yaml` is, metres;
/// negative if out of reach. From the loop itself: the rod is as long as the
/// distance from the elbow, (r + a cos t, 0, -a sin t) in the arm's plane, to the
/// wrist, which asks for a cosine and a sine of t with given weights.
fn delta_margin(point: [f64; 3], arm: usize) -> f64 {
    let (motor, upper, rod, wrist) = (0.132011139050208, 0.112, 0.232, 0.0331976404784035);
    let (sine, cosine) = (arm as f64 * std::f64::consts::TAU / 3.0).sin_cos();
    let x = cosine * point[0] + sine * point[1] + wrist - motor;
    let y = cosine * point[1] - sine * point[0];
    let squared = x * x + y * y + point[2] * point[2] + upper * upper - rod * rod;
    x.hypot(point[2]) - (squared / (2.0 * upper)).abs()
}

#[test]
fn delta_is_where_its_rods_allow() {
    let maps = Maps::of("delta", &["--cells", "41"]);
    let (mut inside, mut outside) = (0, 0);
    for slice in 0..3 {
        for (row, column) in maps.all() {
            let point = maps.point(slice, row, column);
            let margins = [0, 1, 2].map(|arm| delta_margin(point, arm));
            let margin = margins.into_iter().fold(f64::INFINITY, f64::min);
            let share = maps.at(&maps.share, slice, row, column);
            // On the edge, rounding decides.
            if margin.abs() > 1e-6 {
                assert_eq!(share, f64::from(u8::from(margin > 0.0)), "{point:?}");
            }
            inside += usize::from(margin > 0.0);
            outside += usize::from(margin < 0.0);
        }
    }
    assert!(inside > 500 && outside > 500, "{inside}, {outside}");
    // The platform's home is on the map, whose window is about what is in reach.
    let half = 20.0 * maps.step;
    let home = -0.0968671142;
    assert!((home - maps.centres[0][2]).abs() < half && maps.centres[0][2].abs() < 0.05);
    assert_eq!(maps.at(&maps.share, 2, 40, 40), 0.0);
}

/// The first arm lies in the plane y = 0, and the others mirror each other.
#[test]
fn delta_is_symmetric() {
    let maps = Maps::of("delta", &["--cells", "40"]);
    for (row, column) in maps.all() {
        for (slice, mirrored) in [(1, (row, 39 - column)), (2, (39 - row, column))] {
            let both = |values: &[f64]| {
                let there = maps.at(values, slice, mirrored.0, mirrored.1);
                (maps.at(values, slice, row, column), there)
            };
            let (here, there) = both(&maps.share);
            assert_eq!(here, there, "slice {slice}, row {row}, column {column}");
            let (here, there) = both(&maps.measure);
            assert!((here - there).abs() < 1e-9, "{here} is not {there}");
        }
    }
}

/// The legs of `robots/stewart.yaml` from the angles of their ends: how far the
/// worst is within its limits with the platform level, metres.
fn stewart_margin(point: [f64; 3]) -> f64 {
    let feet = [-12.0, 12.0, 108.0, 132.0, 228.0, 252.0_f64];
    let balls = [-40.0, 40.0, 80.0, 160.0, 200.0, 280.0_f64];
    let length = |foot: f64, ball: f64, at: [f64; 3]| {
        let (foot, ball) = (foot.to_radians(), ball.to_radians());
        let x = at[0] + 0.3 * ball.cos() - 0.5 * foot.cos();
        let y = at[1] + 0.3 * ball.sin() - 0.5 * foot.sin();
        x.hypot(y).hypot(at[2])
    };
    let legs = feet.into_iter().zip(balls);
    legs.map(|(foot, ball)| {
        let slide = length(foot, ball, point) - length(foot, ball, [0.0, 0.0, 0.6]);
        (slide + 0.15).min(0.3 - slide)
    })
    .fold(f64::INFINITY, f64::min)
}

#[test]
fn stewart_is_where_its_legs_allow() {
    let level = Maps::of("stewart", &["--cells", "41", "--limits", "--samples", "1"]);
    let tilted = Maps::of("stewart", &["--cells", "15", "--limits", "--samples", "12"]);
    // A turn by 30 degrees moves a ball joint by its chord at most.
    let chord = 2.0 * 0.3 * 15.0_f64.to_radians().sin();
    let (mut inside, mut outside, mut some) = (0, 0, 0);
    for slice in 0..3 {
        for (row, column) in level.all() {
            let margin = stewart_margin(level.point(slice, row, column));
            let share = level.at(&level.share, slice, row, column);
            if margin.abs() > 1e-6 {
                assert_eq!(share, f64::from(u8::from(margin > 0.0)), "margin {margin}");
            }
            inside += usize::from(margin > 0.0);
            outside += usize::from(margin < 0.0);
        }
        for (row, column) in tilted.all() {
            let margin = stewart_margin(tilted.point(slice, row, column));
            let share = tilted.at(&tilted.share, slice, row, column);
            // Level is one of the orientations.
            assert!(margin < 1e-6 || share > 0.0, "margin {margin}");
            assert!(margin > -1e-6 || share < 1.0, "margin {margin}");
            assert!(margin > -chord || share == 0.0, "margin {margin}");
            some += usize::from(share > 0.0 && share < 1.0);
        }
    }
    assert!(
        inside > 300 && outside > 300 && some > 20,
        "{inside}, {outside}, {some}"
    );
}

/// The hinge of the five-bar is where both pairs of its links, 0.1 m each,
/// reach from motors 0.12 m apart.
#[test]
fn linkages_are_mapped_or_refused() {
    let maps = Maps::of("five_bar", &["--cells", "41"]);
    let mut inside = 0;
    for (row, column) in maps.all() {
        let [x, y, _] = maps.point(2, row, column);
        let farthest = x.hypot(y).max((x - 0.12).hypot(y));
        let share = maps.at(&maps.share, 2, row, column);
        if (farthest - 0.2).abs() > 1e-6 {
            assert_eq!(share, f64::from(u8::from(farthest < 0.2)), "[{x}, {y}]");
        }
        inside += usize::from(farthest < 0.2);
    }
    assert!(inside > 200, "{inside}");
    let folder = Path::new("nowhere");
    // Its platform moves along a curve.
    assert_eq!(run("four_bar", folder, &[]).exit, Exit::Usage);
    let aimed = ["--target", "position"];
    assert_eq!(run("stewart", folder, &aimed).exit, Exit::Broken);
    assert_eq!(run("stewart", folder, &["--no-ik"]).exit, Exit::Usage);
}

#[test]
fn arms_without_closed_form_are_refused() {
    let singular = ["kin", "workspace", "../tests/ui/robots/singular.yaml"];
    assert_eq!(kin_cli::run(singular).exit, Exit::Refused);
    let broken = ["kin", "workspace", "../tests/ui/robots/broken.urdf"];
    assert_eq!(kin_cli::run(broken).exit, Exit::Broken);
    let none = run("scara", Path::new("nowhere"), &["--cells", "0"]);
    assert_eq!(none.exit, Exit::Usage);
    let turned = run("elbow", Path::new("nowhere"), &["--target", "orientation"]);
    assert_ne!(turned.exit, Exit::Success);
}

/// What is given beside a target is tried at several values: the wrist of a UR10e, whose shoulder turns
/// the map about its axis, and a joint of a Panda.
#[test]
fn joints_to_spare_are_tried_at_several_values() {
    let small = ["--cells", "21", "--samples", "6"];
    let position = [&["--target", "position"], &small[..]].concat();
    for (robot, options, full, far) in [
        ("ur10e", &position[..], [0.4, 0.9], 1.4),
        ("panda", &small[..], [0.3, 0.55], 1.1),
    ] {
        let maps = Maps::of(robot, options);
        let slices = (0..3).flat_map(|slice| maps.all().map(move |cell| (slice, cell)));
        for (slice, (row, column)) in slices {
            let distance = maps
                .place(row, column)
                .map(|x| x * x)
                .iter()
                .sum::<f64>()
                .sqrt();
            let share = maps.at(&maps.share, slice, row, column);
            let place = format!("{robot}: {slice} {row} {column}, {distance} m");
            // Near the first axis the offset of the shoulder is in the way.
            let is_full = (full[0]..full[1]).contains(&distance)
                && (slice == 2 || maps.place(row, column)[0].abs() > 0.3);
            assert!(share > 0.0 || !is_full, "{place}");
            assert!(share == 0.0 || distance < far, "{place}");
            assert_eq!(
                share > 0.0,
                maps.at(&maps.measure, slice, row, column) > 0.0,
                "{place}"
            );
        }
        let slice = |slice| maps.share.chunks(21 * 21).nth(slice).unwrap();
        assert!(robot != "ur10e" || slice(0) == slice(1));
    }
}

#[test]
fn a_map_needs_targets_that_the_joints_can_choose() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let said = |robot: &str, options: &[&str]| {
        let done = run(robot, folder, options);
        assert_eq!(done.exit, Exit::Usage);
        done.stderr.split_once(": ").unwrap().1.to_owned()
    };
    assert_eq!(
        said("../tests/robots/targets/five_joints", &[]),
        "of whole poses 5 joints reach few, and none of those that a map tries\n\
         help: choose `--target position_axis`\n"
    );
    // A tool that is kept level.
    assert_eq!(
        said("../tests/robots/coupled/palletizer", &[]),
        "of whole poses 4 joints reach few, and none of those that a map tries\n\
         help: choose a link in front of the last joints as the tip (`--tip`)\n"
    );
    assert_eq!(
        said("elbow", &["--target", "orientation"]),
        "targets are orientations of the tip, which have no place in a workspace\n\
         help: choose `--target pose` or `--target position`\n"
    );
}
