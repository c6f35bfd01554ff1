//! A parallel mechanism: its chains as arms, and which of their joints are driven.

use super::arm::arm;
use super::language::{array, numbers, object, signed};
use super::text::string;
use crate::emit::curly::data::rows;
use crate::mechanism::{Aim, CompiledMechanism, LegForm};

/// The expression that is a mechanism.
pub fn mechanism(compiled: &CompiledMechanism) -> String {
    let mechanism = &compiled.mechanism;
    let actuated = mechanism.actuated();
    let aim = match compiled.inverse.as_ref().map(|inverse| inverse.aim) {
        Some(Aim::Pose) => "\"pose\"".into(),
        Some(Aim::Translation) => "\"translation\"".into(),
        Some(Aim::Lead(lead)) => lead.to_string(),
        _ => "null".into(),
    };
    let fields = [
        ("name", string(&mechanism.name)),
        ("file", string(&compiled.file)),
        ("base", string(&mechanism.base)),
        ("platform", string(&mechanism.platform)),
        ("home", numbers(rows(&mechanism.home()))),
        ("length", signed(mechanism.generic().length())),
        ("mobility", compiled.freedom.mobility.to_string()),
        ("freedom", compiled.freedom.platform.to_string()),
        ("actuated", array(actuated.iter().map(usize::to_string))),
        ("aim", aim),
        (
            "chains",
            array((0..compiled.legs.len()).map(|i| chain(compiled, i))),
        ),
    ];
    format!("$mechanism({})", object(&fields))
}

fn chain(compiled: &CompiledMechanism, i: usize) -> String {
    let mut fields = vec![
        ("name", string(&compiled.mechanism.legs[i].name)),
        ("arm", arm(&compiled.legs[i])),
    ];
    let form = compiled.inverse.as_ref().map(|inverse| &inverse.legs[i]);
    if let Some(LegForm::Split(split)) = form {
        fields.push(("head", arm(&split.head)));
        fields.push(("tail", arm(&split.tail)));
        fields.push(("point", numbers(split.point)));
    }
    object(&fields)
}
