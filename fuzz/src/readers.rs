//! What holds of every file, whatever is in it: it is read or refused, and a
//! refusal has a place, a reason and a remedy that can be shown.

use kin_codegen::mechanism::Mechanism;
use kin_codegen::model::Model;
use kin_codegen::spec::{Diagnostic, Diagnostics, Source, Spec, bounds};

/// A screen or two.
const LONGEST_MESSAGE: usize = 100_000;

/// Reads a file up to its chains. Whether it is one of a robot.
pub fn read(path: &str, text: &str) -> bool {
    let source = Source {
        path: path.into(),
        text: text.into(),
    };
    let spec = match Spec::parse(&source) {
        Ok(spec) => spec,
        Err(refused) => return refusal(&refused, text),
    };
    spec.warnings()
        .iter()
        .for_each(|warning| shown(warning, text));
    match spec {
        Spec::Arm(arm) => match Model::new(&arm, None, None) {
            Ok(model) => sound(&model),
            Err(refused) => return refusal(&refused, text),
        },
        Spec::Mechanism(mechanism) => match Mechanism::new(&mechanism, None, None) {
            Ok(mechanism) => mechanism.legs.iter().for_each(|leg| sound(&leg.model)),
            Err(refused) => return refusal(&refused, text),
        },
    }
    true
}

fn refusal(refused: &Diagnostics, text: &str) -> bool {
    refused
        .iter()
        .for_each(|diagnostic| shown(diagnostic, text));
    let message = refused.to_string();
    assert!(message.len() < LONGEST_MESSAGE, "{message}");
    assert!(message.contains("\nhelp: "), "{message}");
    let control = message
        .chars()
        .find(|c| c.is_control() && !matches!(c, '\n' | '\t'));
    assert_eq!(control, None, "{message:?}");
    false
}

/// A reason and a remedy, and a place that is in the text.
fn shown(diagnostic: &Diagnostic, text: &str) {
    assert!(!diagnostic.reason.is_empty(), "{diagnostic:?}");
    assert!(!diagnostic.remedy.is_empty(), "{diagnostic:?}");
    if let Some(at) = diagnostic.at {
        let lines = text.split('\n').count();
        assert!((1..=lines).contains(&(at.line as usize)), "{diagnostic:?}");
        assert!(at.column >= 1, "{diagnostic:?}");
    }
}

/// Numbers are numbers, axes directions, and names short.
fn sound(model: &Model) {
    let finite = |v: &[f64]| v.iter().all(|x| x.is_finite());
    assert!(!model.joints.is_empty());
    for joint in &model.joints {
        let length: f64 = joint.axis.iter().map(|x| x * x).sum();
        assert!((length - 1.0).abs() < 1e-9, "{joint:?}");
        assert!(
            finite(&joint.point) && finite(&joint.frame.translation),
            "{joint:?}"
        );
        assert!(finite(&[joint.multiplier, joint.offset]), "{joint:?}");
        assert!(joint.variable < model.variables.len(), "{joint:?}");
        assert!(joint.name.chars().count() <= bounds::NAME, "{joint:?}");
    }
    assert!(finite(&model.home.translation), "{model:?}");
    assert!(finite(model.home.rotation.as_flattened()), "{model:?}");
    for variable in &model.variables {
        let ordered = variable.limits.is_none_or(|[lower, upper]| lower <= upper);
        assert!(ordered, "{variable:?}");
    }
}
