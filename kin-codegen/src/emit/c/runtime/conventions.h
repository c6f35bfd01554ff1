/* Joint values are radians, and metres of joints that slide, in the order of kin_joint_names:
 * from base to tip. A pose is twelve numbers, three rows of four: a row of the rotation, and
 * the coordinate of the translation behind it, metres; the upper three rows of the homogeneous
 * matrix. Jacobians are 6 rows by KIN_JOINTS columns, row by row: three rows of linear and
 * three of angular velocity, in metres and without unit per radian, or per metre of joints that
 * slide. Arrays are the caller's and do not overlap. Nothing is allocated, no function has a
 * state, all may be called from several threads. Compile without -ffast-math and its parts, and
 * with -O2 (GCC 12, Clang) or -O3 so that loops over branches become vector instructions; on
 * x86-64 those of AVX2 are taken where the processor has them. */
