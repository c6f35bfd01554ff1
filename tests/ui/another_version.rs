//! A checked-in file that another version of the compiler generated, with a
//! name that this version does not know.

const _: () = {
    ::kinematics::__private::generated_by!(0.0);
    #[allow(unused_imports)]
    use ::kinematics::__private::no_longer_there;
};

fn main() {}
