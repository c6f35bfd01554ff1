// What a planner asks of an arm, by its generated C: no part of MoveIt.
//
//     kin generate --lang c ur5e.urdf -o .
//
// Another arm: another header, and its name in place of `ur5e`.
#ifndef KINEMATICS_EXAMPLE_SOLVER_HPP
#define KINEMATICS_EXAMPLE_SOLVER_HPP

#include "ur5e.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace solver {

using Joints = std::array<double, UR5E_JOINTS>;
// Three rows of the rotation with the translation, metres, behind each.
using Pose = std::array<double, 12>;

// From a quaternion, which need not be of unit length, and a position.
inline Pose pose_of(double x, double y, double z, double w, double px, double py, double pz)
{
    const double s = 2.0 / (x * x + y * y + z * z + w * w);
    return Pose{{1.0 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w), px,
                 s * (x * y + z * w), 1.0 - s * (x * x + z * z), s * (y * z - x * w), py,
                 s * (x * z - y * w), s * (y * z + x * w), 1.0 - s * (x * x + y * y), pz}};
}

// The quaternion of a pose: x, y, z, w, of which the largest is found first.
inline std::array<double, 4> quaternion_of(const Pose &pose)
{
    const double diagonal[3] = {pose[0], pose[5], pose[10]};
    const double trace = diagonal[0] + diagonal[1] + diagonal[2];
    const std::size_t i = static_cast<std::size_t>(
        std::max_element(diagonal, diagonal + 3) - diagonal);
    std::array<double, 4> q;
    if (trace > diagonal[i]) {
        q = {{pose[9] - pose[6], pose[2] - pose[8], pose[4] - pose[1], 1.0 + trace}};
    } else {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        q[i] = 1.0 + 2.0 * diagonal[i] - trace;
        q[j] = pose[4 * i + j] + pose[4 * j + i];
        q[k] = pose[4 * i + k] + pose[4 * k + i];
        q[3] = pose[4 * k + j] - pose[4 * j + k];
    }
    const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (double &x : q) {
        x /= norm;
    }
    return q;
}

inline double distance(const Joints &a, const Joints &b)
{
    double square = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        square += (a[i] - b[i]) * (a[i] - b[i]);
    }
    return std::sqrt(square);
}

// All solutions within the limits, the one nearest to the seed first, which full turns of
// joints may have brought there.
inline std::vector<Joints> solutions(const Pose &pose, const Joints &seed)
{
    ur5e_solution found[UR5E_MAX_SOLUTIONS], nearest;
    const bool is_any = ur5e_ik_nearest(pose.data(), seed.data(), &nearest) == 1;
    const int count = ur5e_ik_seeded(pose.data(), seed.data(), found);
    std::vector<Joints> inside;
    for (int i = 0; i < count; ++i) {
        Joints q;
        const bool is_nearest = is_any && found[i].branch == nearest.branch;
        if (ur5e_within_limits(is_nearest ? nearest.q : found[i].q, q.data())) {
            inside.push_back(q);
        }
    }
    std::sort(inside.begin(), inside.end(), [&seed](const Joints &a, const Joints &b) {
        return distance(a, seed) < distance(b, seed);
    });
    return inside;
}

// The pose of the tip, of a link that a joint moves, or of a frame that is fixed to one.
inline bool pose_of_link(const std::string &link, const Joints &q, Pose &pose)
{
    if (link == ur5e_tip) {
        ur5e_fk(q.data(), pose.data());
        return true;
    }
    for (std::size_t i = 0; i < UR5E_JOINTS; ++i) {
        if (link == ur5e_link_names[i]) {
            double poses[12 * UR5E_JOINTS];
            ur5e_fk_links(q.data(), poses);
            std::copy(poses + 12 * i, poses + 12 * i + 12, pose.begin());
            return true;
        }
    }
    for (int frame = 0; frame < UR5E_FRAMES; ++frame) {
        if (link == ur5e_frame_names[frame]) {
            return ur5e_fk_frame(q.data(), frame, pose.data()) == 0;
        }
    }
    return false;
}

}  // namespace solver

#endif
