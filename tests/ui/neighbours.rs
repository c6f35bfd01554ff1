//! Several robots in one module, one in a function, one by a macro, and some among
//! items that have the names of Rust, of what generated code takes in, and of its
//! variables.

kinematics::kinematics!("robots/planar.yaml");
kinematics::kinematics!("robots/planar.yaml", name = Other, ik = none);

/// Constants and unit structs are patterns where a variable has their name, and
/// functions and statics stand in its place: none reaches generated code.
#[allow(dead_code, non_camel_case_types, non_upper_case_globals)]
mod captured {
    const t1: f64 = 0.25;
    const s1: f64 = 0.25;
    const q1: f64 = 0.25;
    const e1: f64 = 0.25;
    const px: f64 = 0.25;
    const r11: f64 = 0.25;
    const invalid: f64 = 0.25;
    static branches: f64 = 0.25;
    static place: f64 = 0.25;
    static t2: f64 = 0.25;
    struct actuated;
    struct found;
    struct name;
    struct platform;
    struct pose;
    struct q;
    struct rates;
    struct residual;
    struct seed;
    struct self_;
    struct solutions;
    struct target;
    fn k() {}
    fn c1() {}
    ::kinematics::kinematics!("robots/planar.yaml");
    ::kinematics::kinematics!("robots/five_bar.yaml");
    pub fn local() -> kinematics::Pose {
        struct q;
        const t1: f64 = 0.25;
        ::kinematics::kinematics!("robots/planar.yaml", name = Local);
        Local.fk(&[0.3, 0.4])
    }
}

/// A macro that hands the robot on.
macro_rules! arm {
    ($name:ident) => {
        kinematics::kinematics!(
            "robots/planar.yaml",
            name = $name,
            crate = $crate::robotics::kinematics
        );
    };
}
arm!(Forwarded);
// As the parameters of generated functions.
arm!(A);
arm!(T);

/// Nothing of Rust's prelude is asked for.
#[no_implicit_prelude]
mod bare {
    ::kinematics::kinematics!("robots/planar.yaml");
}

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
    assert_eq!(captured::local(), Planar.fk(&q));
    assert_eq!(captured::Planar.ik(&Planar.fk(&q)).len(), 2);
    assert_eq!(captured::FiveBar::ACTUATED, crowded::FiveBar::ACTUATED);
    assert_eq!(Forwarded.fk(&q), Planar.fk(&q));
    assert_eq!(A.ik(&A.fk(&q)), Planar.ik(&Planar.fk(&q)));
    assert_eq!(T.ik(&T.fk(&q)), bare::Planar.ik(&bare::Planar.fk(&q)));
}
