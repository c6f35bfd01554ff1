//! What is serialized is documented, and read back to the last bit.

use kinematics::{Jacobian, JointLimit, Pose, Robot, Solution, Target, Twist, Wrench};
use serde_json::{Value, from_str, from_value, json, to_string, to_value};

kinematics::kinematics!("../robots/scara.yaml");

const Q: [f64; 4] = [0.3, -0.8, 0.2, 0.1];

#[test]
fn the_form_is_the_documented_one() {
    let pose = Pose::from_translation([0.0, 0.0, 0.5]);
    let rotation = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let expected = json!({"rotation": rotation, "translation": [0.0, 0.0, 0.5]});
    assert_eq!(to_value(pose).unwrap(), expected);

    let twist = Twist {
        linear: [1.0, 0.0, 0.0],
        angular: [0.0, 0.0, 2.0],
    };
    let expected = json!({"linear": [1.0, 0.0, 0.0], "angular": [0.0, 0.0, 2.0]});
    assert_eq!(to_value(twist).unwrap(), expected);
    let wrench = Wrench {
        force: [1.0, 0.0, 0.0],
        moment: [0.0, 0.0, 2.0],
    };
    let expected = json!({"force": [1.0, 0.0, 0.0], "moment": [0.0, 0.0, 2.0]});
    assert_eq!(to_value(wrench).unwrap(), expected);

    let solution = Solution {
        q: [0.5, -1.0],
        residual: 0.0,
        branch: 3,
        singular: false,
    };
    let expected = json!({"q": [0.5, -1.0], "residual": 0.0, "branch": 3, "singular": false});
    assert_eq!(to_value(solution).unwrap(), expected);

    let stops = json!({"revolute": {"lower": -1.0, "upper": 1.0}});
    assert_eq!(to_value(JointLimit::revolute(-1.0, 1.0)).unwrap(), stops);
    let open = JointLimit::prismatic(f64::NEG_INFINITY, 1.0);
    let stops = json!({"prismatic": {"lower": null, "upper": 1.0}});
    assert_eq!(to_value(open).unwrap(), stops);
    assert_eq!(
        to_value(JointLimit::Continuous).unwrap(),
        json!("continuous")
    );
    for target in Target::ALL {
        assert_eq!(to_value(target).unwrap(), json!(target.word()));
        assert_eq!(from_value::<Target>(json!(target.word())).unwrap(), target);
    }
}

#[test]
fn what_is_read_back_is_the_same_to_the_last_bit() {
    let pose = Scara.fk(&Q);
    assert_eq!(from_str::<Pose>(&to_string(&pose).unwrap()).unwrap(), pose);
    let jacobian = Scara.geometric_jacobian(&Q);
    let text = to_string(&jacobian).unwrap();
    assert_eq!(from_str::<Jacobian<4>>(&text).unwrap(), jacobian);
    let solutions = Scara.ik(&pose);
    let read: Vec<Solution<4>> = from_str(&to_string(&solutions).unwrap()).unwrap();
    assert!(read.len() == 2 && read[..] == *solutions);
    let open = JointLimit::prismatic(f64::NEG_INFINITY, f64::INFINITY);
    for limit in Scara::LIMITS
        .into_iter()
        .chain([open, JointLimit::Continuous])
    {
        let text = to_string(&limit).unwrap();
        assert_eq!(from_str::<JointLimit>(&text).unwrap(), limit);
    }
    let rounded = kinematics::single::Pose::from(pose);
    let text = to_string(&rounded).unwrap();
    assert_eq!(
        from_str::<kinematics::single::Pose>(&text).unwrap(),
        rounded
    );
    // A robot at run time says the same, and how many there are before it says them, as formats
    // without brackets have it.
    let robot = Robot::from_yaml("../robots/scara.yaml").unwrap();
    assert_eq!(
        to_value(robot.ik(&pose)).unwrap(),
        to_value(solutions).unwrap()
    );
    assert_eq!(robot.ik(&pose).iter().len(), 2);
}

#[test]
fn a_solution_of_another_arm_is_none() {
    let solution =
        |q: &[f64]| -> Value { json!({"q": q, "residual": 0.0, "branch": 0, "singular": false}) };
    assert!(from_value::<Solution<2>>(solution(&[1.0, 2.0])).is_ok());
    for q in [&[1.0][..], &[1.0, 2.0, 3.0]] {
        let error = from_value::<Solution<2>>(solution(q))
            .unwrap_err()
            .to_string();
        assert!(
            error.contains("2 numbers") || error.contains("2 elements"),
            "{error}"
        );
    }
}

#[test]
fn a_limit_without_two_stops_in_order_is_none() {
    let why = |text: &str| from_str::<JointLimit>(text).unwrap_err().to_string();
    for (text, expected) in [
        (
            r#"{"revolute": {"lowr": -1, "upper": 1}}"#,
            "unknown field `lowr`",
        ),
        (r#"{"prismatic": {"upper": 1}}"#, "missing field `lower`"),
        (r#"{"revolute": {}}"#, "missing field `lower`"),
        (
            r#"{"revolute": {"lower": 2, "upper": -1}}"#,
            "the lower stop of a joint is not above the upper one",
        ),
    ] {
        assert!(why(text).contains(expected), "{text}: {}", why(text));
    }
    for (lower, upper) in [
        (f64::NAN, 1.0),
        (-1.0, f64::NAN),
        (f64::INFINITY, f64::INFINITY),
        (f64::NEG_INFINITY, f64::NEG_INFINITY),
        (1.0, -1.0),
    ] {
        let refused = to_string(&JointLimit::revolute(lower, upper));
        assert!(refused.unwrap_err().to_string().contains("stop of a joint"));
    }
}
