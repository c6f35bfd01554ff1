//! Several robots in one module, one in a function, and some among items that
//! have the names of Rust and of what generated code takes in.

kinematics::kinematics!("robots/planar.yaml");
kinematics::kinematics!("robots/planar.yaml", name = Other, ik = none);

/// The crate `kinematics`, as another hands it on.
mod robotics {
    pub use kinematics;
}

#[allow(dead_code, non_camel_case_types)]
mod crowded {
    mod core {}
    mod std {}
    mod kinematics {}
    mod lanes {}
    mod math {}

    struct bool;
    struct f64;
    struct str;
    struct u32;
    struct u8;
    struct usize;

    struct Acceptance;
    struct Jacobian;
    struct Kinematics;
    struct Pose;
    struct Solutions;
    struct Target;
    trait Iterator {}

    fn fk() {}
    fn q() {}
    fn target() {}
    fn widen() {}

    ::kinematics::kinematics!("robots/planar.yaml");
    ::kinematics::kinematics!("robots/planar.yaml", name = r#Raw);
    // Of Rust's prelude, but for macros and values.
    ::kinematics::kinematics!("robots/planar.yaml", name = Clone);
    ::kinematics::kinematics!("robots/planar.yaml", name = Debug);
    ::kinematics::kinematics!("robots/planar.yaml", name = Default);
    ::kinematics::kinematics!("robots/planar.yaml", name = Into);
    ::kinematics::kinematics!("robots/planar.yaml", name = None);
    ::kinematics::kinematics!("robots/planar.yaml", name = Option);
    ::kinematics::kinematics!("robots/planar.yaml", name = Some);
    ::kinematics::kinematics!("robots/planar.yaml", name = F64);
    ::kinematics::kinematics!("robots/planar.yaml", name = Arm, crate = crate::robotics::kinematics);
    ::kinematics::kinematics!("robots/five_bar.yaml", crate = "::kinematics");
}

fn main() {
    kinematics::kinematics!("robots/planar.yaml", name = Local);
    let q = [0.3, 0.4];
    assert_eq!(Planar.fk(&q), Other.fk(&q));
    assert_eq!(Planar.ik(&Local.fk(&q)).len(), 2);
    assert_eq!(crowded::Raw.ik(&crowded::Arm.fk(&q)).len(), 2);
    assert_eq!(crowded::Option.ik(&crowded::None.fk(&q)).len(), 2);
    assert_eq!(crowded::FiveBar::PLATFORM, "tool");
}
