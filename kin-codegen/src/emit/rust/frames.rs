//! The links that are fixed to others, as a constant.

use super::language::{matrix, signed};
use crate::emit::text;
use crate::model::{Frame, Joint, Model};
use kin_runtime::Pose;
use proc_macro2::{Literal, TokenStream};
use quote::quote;

/// `FRAMES`, in the order of the file.
pub fn constant(model: &Model) -> TokenStream {
    let leads = model.leaders();
    let frames = model.frames.iter().map(|frame| one(model, &leads, frame));
    quote! {
        /// The other links that do not move against the base or one of
        /// [`Self::LINK_NAMES`]: see [`Self::fk_frame`].
        pub const FRAMES: &'static [Frame] = &[#(#frames),*];
    }
}

fn one(model: &Model, leads: &[bool], frame: &Frame) -> TokenStream {
    let name = text::literal(&frame.name);
    let Some(joint) = frame.joint else {
        let pose = pose(&frame.pose);
        return quote!(Frame::on_base(#name, #pose));
    };
    if leads[joint] {
        let link = Literal::usize_unsuffixed(model.joints[joint].variable);
        let pose = pose(&frame.pose);
        return quote!(Frame::on_link(#name, #link, #pose));
    }
    let home = model.joints[joint].frame * frame.pose;
    if joint + 1 == model.joints.len() {
        let pose = pose(&(model.home.inverse() * home));
        return quote!(Frame::on_tip(#name, #pose));
    }
    let before = (0..joint).rev().find(|&j| leads[j]);
    let (from, link) = match before {
        Some(j) => {
            let link = Literal::usize_unsuffixed(model.joints[j].variable);
            (model.joints[j].frame, quote!(Some(#link)))
        }
        None => (Pose::IDENTITY, quote!(None)),
    };
    let joints = &model.joints[before.map_or(0, |j| j + 1)..=joint];
    let joints = joints.iter().map(|joint| following(joint, &from));
    let pose = pose(&(from.inverse() * home));
    quote!(Frame::following(#name, #link, &[#(#joints),*], #pose))
}

/// A joint that follows others, in the frame `from`.
fn following(joint: &Joint, from: &Pose) -> TokenStream {
    let twist = from.adjoint_inverse(&joint.twist());
    let [linear, angular] = [twist.linear, twist.angular].map(|v| {
        let cleaned = crate::geometry::without_noise(&Pose::from_translation(v));
        let [x, y, z] = cleaned.translation.map(signed);
        quote!([#x, #y, #z])
    });
    let coordinate = Literal::usize_unsuffixed(joint.variable);
    let (multiplier, offset) = (signed(joint.multiplier), signed(joint.offset));
    quote!(Following {
        twist: Twist { linear: #linear, angular: #angular },
        coordinate: #coordinate,
        multiplier: #multiplier,
        offset: #offset
    })
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
