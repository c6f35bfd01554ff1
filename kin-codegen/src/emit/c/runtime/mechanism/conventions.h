/* Joint values are radians, and metres of joints that slide, in the order of kin_joint_names:
 * chain after chain, each from base to platform. A pose is twelve numbers, three rows of four: a
 * row of the rotation, and the coordinate of the translation behind it, metres; the upper three
 * rows of the homogeneous matrix. Matrices are written row by row; rates of lengths are in metres
 * per radian of joints that turn. Every chain is an arm with functions of its own, below. Arrays
 * are the caller's and do not overlap. Nothing is allocated, no function has a state, all may be
 * called from several threads. Compile without -ffast-math and its parts, and with -O2 (GCC 12,
 * Clang) or -O3 so that loops over branches become vector instructions; on x86-64 those of AVX2 are
 * taken where the processor has them. */
