//! The links that are fixed to others, as a constant.

use super::straight::signed;
use super::{matrix, text};
use crate::model::{Frame, Model};
use kin_runtime::Pose;
use proc_macro2::{Literal, TokenStream};
use quote::quote;

/// `FRAMES`, in the order of the file. Behind a joint that follows others there
/// is no link to refer to but the tip.
pub fn constant(model: &Model) -> TokenStream {
    let frames = model.frames.iter().filter_map(|frame| one(model, frame));
    quote! {
        /// The other links that do not move against the base or one of
        /// [`Self::LINK_NAMES`]: see [`Self::fk_frame`].
        pub const FRAMES: &'static [Frame] = &[#(#frames),*];
    }
}

fn one(model: &Model, frame: &Frame) -> Option<TokenStream> {
    let name = text::literal(&frame.name);
    let Some(joint) = frame.joint else {
        let pose = pose(&frame.pose);
        return Some(quote!(Frame::on_base(#name, #pose)));
    };
    let variable = model.joints[joint].variable;
    if model.joint_of(variable) == joint {
        let (link, pose) = (Literal::usize_unsuffixed(variable), pose(&frame.pose));
        return Some(quote!(Frame::on_link(#name, #link, #pose)));
    }
    let is_last = joint + 1 == model.joints.len();
    let at_tip = model.home.inverse() * model.joints[joint].frame * frame.pose;
    let pose = pose(&at_tip);
    is_last.then(|| quote!(Frame::on_tip(#name, #pose)))
}

/// A pose without the digits that composing frames has left behind.
fn pose(pose: &Pose) -> TokenStream {
    let pose = crate::geometry::without_noise(pose);
    let [x, y, z] = pose.translation.map(signed);
    if pose == Pose::IDENTITY {
        quote!(Pose::IDENTITY)
    } else if pose.rotation == Pose::IDENTITY.rotation {
        quote!(Pose::from_translation([#x, #y, #z]))
    } else {
        let rotation = matrix(pose.rotation.map(|row| row.map(signed)));
        quote!(Pose { rotation: #rotation, translation: [#x, #y, #z] })
    }
}
