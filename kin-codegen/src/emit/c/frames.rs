//! The links that are fixed to others, and the function that says where they are.

use super::forward;
use super::language::numbers;
use super::text::string;
use crate::arm::CompiledArm;
use crate::emit::curly::data::rows;
use crate::geometry::without_noise;

/// The names, which are data.
pub fn names(compiled: &CompiledArm) -> String {
    let frames = &compiled.model.frames;
    let names = frames.iter().map(|frame| string(&frame.name));
    names.collect::<Vec<_>>().join(",\n    ")
}

/// The function and its table; the joints that carry frames and follow others have their
/// links' poses by a function of their own.
pub fn function(compiled: &CompiledArm) -> String {
    let model = &compiled.model;
    let leads = model.leaders();
    let carriers = model.frames.iter().filter_map(|frame| frame.joint);
    let mut following: Vec<usize> = carriers.filter(|&joint| !leads[joint]).collect();
    following.sort_unstable();
    following.dedup();
    let n = model.variables.len();
    let mut carried = Vec::new();
    let mut poses = Vec::new();
    for frame in &model.frames {
        let carrier = frame.joint.map(|joint| match leads[joint] {
            true => model.joints[joint].variable,
            false => n + following.iter().position(|&j| j == joint).unwrap_or(0),
        });
        carried.push(carrier.map_or("-1".into(), |carrier| carrier.to_string()));
        poses.push(numbers(rows(&without_noise(&frame.pose))));
    }
    let of_following = match following.len() {
        0 => String::new(),
        _ => forward::following(compiled, &following) + "\n",
    };
    let all = n + following.len();
    let more = match following.len() {
        0 => "",
        _ => "    kin_fk_following(q, poses + 12 * KIN_JOINTS);\n",
    };
    let (carried, poses) = (carried.join(", "), poses.join(",\n        "));
    format!(
        "{of_following}int kin_fk_frame(const double q[KIN_JOINTS], int frame, double pose[12])\n{{\n    \
         /* What carries a frame: a link, or -1 for the base; and where it is there. */\n    \
         static const int carriers[KIN_FRAMES] = {{{carried}}};\n    \
         static const double fixed[KIN_FRAMES][12] = {{\n        {poses}\n    }};\n    \
         double poses[12 * {all}];\n    \
         const double *carrier, *on;\n    \
         if (frame < 0 || frame >= KIN_FRAMES) {{\n        return KIN_NO_SUCH_FRAME;\n    }}\n    \
         on = fixed[frame];\n    \
         if (carriers[frame] < 0) {{\n        for (int i = 0; i < 12; ++i) {{\n            \
         pose[i] = on[i];\n        }}\n        return 0;\n    }}\n    \
         kin_fk_links(q, poses);\n{more}    \
         carrier = poses + 12 * carriers[frame];\n    \
         for (int i = 0; i < 12; i += 4) {{\n        for (int j = 0; j < 4; ++j) {{\n            \
         pose[i + j] = carrier[i] * on[j] + carrier[i + 1] * on[4 + j] + carrier[i + 2] * on[8 + j]\n                \
         + (j == 3 ? carrier[i + 3] : 0.0);\n        }}\n    }}\n    return 0;\n}}\n"
    )
}
