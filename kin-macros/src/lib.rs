//! The `kinematics!` macro. Users have it from the crate `kinematics`.

mod arguments;
mod debug;
mod dependency;
mod expand;

use proc_macro::TokenStream;

/// Compiles a robot file to a type with its kinematics.
///
/// ```ignore
/// kinematics!("arm.urdf");
/// kinematics!("cell.urdf", name = LeftArm, base = "left_base", tip = "left_tool0");
/// ```
///
/// The path of the URDF or YAML file is absolute, or relative to the directory
/// of the crate's `Cargo.toml`. The crate is compiled anew when the file
/// changes. What is wrong with the file is a compile error at the path, with
/// line, column and a remedy.
///
/// The macro leaves a zero-sized `pub struct`. Its own documentation tells the
/// plan step by step and what its branches are called; its methods are
/// those of the trait `Kinematics`, and need no import.
///
/// # Options
///
/// They follow the path, in any order.
///
/// - **`name = Arm`**: the name of the type, with a capital letter in it. By
///   default the file's stem in UpperCamelCase: `kr6_r900.yaml` makes `Kr6R900`.
/// - **`base = "base_link"`**: the link that the chain begins at and that poses
///   are given in: any link, such as a foot, or a hand for the other as the tip.
///   By default the root of the robot, or what stands on it by a floating or
///   planar joint.
/// - **`tip = "tool0"`**: the link that the chain ends at and that poses are
///   of. By default the end of the joints that move, fingers left out: the
///   link there that is called `tool0`, `tcp`, `flange`, `ee_link` or the like,
///   or the only leaf. If several chains could be meant, the error lists them.
/// - **`tool = [0, 0, 0.1, 0, 0.8, 0]`**: the frame of a tool in that of the tip,
///   x, y and z in metres, then roll, pitch and yaw in radians, as a URDF's
///   `<origin>` has them. Poses are the tool's, and so are the point and the axis
///   of partial targets. One that is known only at run time is put on by
///   `WithTool`, for targets that it leaves as they are.
/// - **`ik = none`**: forward kinematics and Jacobians alone. By default
///   (`ik = closed_form`) an arm that has neither a closed form nor a polynomial
///   in one of its joints is an error that says why.
/// - **`target = position`**: what of a target inverse kinematics reaches; the
///   rest is whatever comes of it. `pose` is all of it, `position` the tip's
///   origin, `position_axis` that with the direction of the tip's z axis,
///   `position_yaw` that with the turn about the first axis (SCARA), `planar`
///   the position across the first axis with the turn about it, `direction` the
///   tip's z axis, `orientation` the rotation. By default `position` for arms
///   of up to three joints whose position fixes them, such as a planar 2R arm,
///   and `pose` for all others.
/// - **`free = "joint"`**: the joint whose value `ik_at` takes beside a target, of an
///   arm with more joints than its targets have coordinates; several in brackets,
///   `free = ["rail", "joint"]`. `free = "swivel"` is the swivel angle of an arm with a
///   spherical shoulder and a spherical wrist, and what such an arm is given by default;
///   of others it is the joint that leaves the others about the cheapest closed form with a
///   solution to all singular targets that are tried, which the type's documentation tells; with
///   `target = position_axis` the turn of the tool comes before any joint.
/// - **`scalar = f32`**: numbers of single precision, for processors without a unit for
///   more; the types are those of `kinematics::single`. By default `f64`.
/// - **`strict = true`**: what is odd in the file and changes nothing of the
///   robot is an error too. By default the type's documentation lists it.
/// - **`crate = ::robotics`**: the path under which the code finds the crate
///   `kinematics`, from any module: for a dependency of another name
///   (`robotics = { package = "kinematics", .. }`), and for one that another
///   crate hands on (`crate = ::robotics::kinematics`; in that crate's own
///   macros, `crate = $crate::kinematics`). By default `::kinematics`.
/// - **`debug = true`**: the code is formatted and written to a file, which the
///   macro includes. Compiler errors, backtraces and debuggers then point into
///   that file. It is `kinematics/<crate>/<Name>-<hash>.rs` in the `OUT_DIR` of
///   the crate if it has a build script, and otherwise below
///   `target/<profile>/build/kin-macros-<hash>/out`.
#[proc_macro]
pub fn kinematics(input: TokenStream) -> TokenStream {
    expand::expand(input.into())
        .unwrap_or_else(syn::Error::into_compile_error)
        .into()
}
