// A skeleton of a MoveIt 2 kinematics plugin around generated C, to be copied into a ROS
// package. The project's tests compile and run `solver.hpp`; this file needs MoveIt, which they
// do not have: it is written after its headers, and nobody has compiled it here.
#include "solver.hpp"

#include <moveit/kinematics_base/kinematics_base.h>
#include <pluginlib/class_list_macros.hpp>

namespace kinematics_example {

using geometry_msgs::msg::Pose;
using kinematics::KinematicsQueryOptions;
using moveit_msgs::msg::MoveItErrorCodes;

class Plugin : public kinematics::KinematicsBase {
public:
    bool initialize(
        const rclcpp::Node::SharedPtr &node, const moveit::core::RobotModel &model,
        const std::string &group, const std::string &base, const std::vector<std::string> &tips,
        double discretization) override
    {
        node_ = node;
        storeValues(model, group, base, tips, discretization);
        joints_.assign(ur5e_joint_names, ur5e_joint_names + UR5E_JOINTS);
        links_.assign(1, ur5e_tip);
        // The group has to be the chain that was compiled.
        const auto *joints = model.getJointModelGroup(group);
        return joints && joints->getActiveJointModelNames() == joints_ && base == ur5e_base
            && tips.size() == 1 && tips.front() == ur5e_tip;
    }

    const std::vector<std::string> &getJointNames() const override { return joints_; }
    const std::vector<std::string> &getLinkNames() const override { return links_; }

    bool getPositionFK(
        const std::vector<std::string> &links, const std::vector<double> &angles,
        std::vector<Pose> &poses) const override
    {
        poses.clear();
        for (const auto &link : links) {
            solver::Pose pose;
            if (angles.size() != UR5E_JOINTS
                || !solver::pose_of_link(link, joints(angles), pose)) {
                return false;
            }
            poses.push_back(message(pose));
        }
        return true;
    }

    bool getPositionIK(
        const Pose &pose, const std::vector<double> &seed, std::vector<double> &solution,
        MoveItErrorCodes &code, const KinematicsQueryOptions &options) const override
    {
        return solve(pose, seed, {}, solution, IKCallbackFn(), code, options);
    }

    // There is nothing to search: all solutions are there at once, and the time is not used.
    bool searchPositionIK(
        const Pose &pose, const std::vector<double> &seed, double, std::vector<double> &solution,
        MoveItErrorCodes &code, const KinematicsQueryOptions &options) const override
    {
        return solve(pose, seed, {}, solution, IKCallbackFn(), code, options);
    }

    bool searchPositionIK(
        const Pose &pose, const std::vector<double> &seed, double,
        const std::vector<double> &consistency, std::vector<double> &solution,
        MoveItErrorCodes &code, const KinematicsQueryOptions &options) const override
    {
        return solve(pose, seed, consistency, solution, IKCallbackFn(), code, options);
    }

    bool searchPositionIK(
        const Pose &pose, const std::vector<double> &seed, double, std::vector<double> &solution,
        const IKCallbackFn &accept, MoveItErrorCodes &code,
        const KinematicsQueryOptions &options) const override
    {
        return solve(pose, seed, {}, solution, accept, code, options);
    }

    bool searchPositionIK(
        const Pose &pose, const std::vector<double> &seed, double,
        const std::vector<double> &consistency, std::vector<double> &solution,
        const IKCallbackFn &accept, MoveItErrorCodes &code,
        const KinematicsQueryOptions &options) const override
    {
        return solve(pose, seed, consistency, solution, accept, code, options);
    }

private:
    std::vector<std::string> joints_, links_;

    static solver::Joints joints(const std::vector<double> &values)
    {
        solver::Joints q;
        std::copy(values.begin(), values.end(), q.begin());
        return q;
    }

    static Pose message(const solver::Pose &pose)
    {
        const auto q = solver::quaternion_of(pose);
        Pose out;
        out.position.x = pose[3];
        out.position.y = pose[7];
        out.position.z = pose[11];
        out.orientation.x = q[0];
        out.orientation.y = q[1];
        out.orientation.z = q[2];
        out.orientation.w = q[3];
        return out;
    }

    bool solve(
        const Pose &pose, const std::vector<double> &seed, const std::vector<double> &consistency,
        std::vector<double> &solution, const IKCallbackFn &accept, MoveItErrorCodes &code,
        const KinematicsQueryOptions &) const
    {
        code.val = MoveItErrorCodes::NO_IK_SOLUTION;
        if (seed.size() != UR5E_JOINTS) {
            return false;
        }
        const auto &q = pose.orientation;
        const auto &p = pose.position;
        const auto target = solver::pose_of(q.x, q.y, q.z, q.w, p.x, p.y, p.z);
        for (const auto &found : solver::solutions(target, joints(seed))) {
            bool is_near = true;
            for (std::size_t i = 0; i < consistency.size() && i < found.size(); ++i) {
                is_near = is_near && std::abs(found[i] - seed[i]) <= consistency[i];
            }
            if (!is_near) {
                continue;
            }
            solution.assign(found.begin(), found.end());
            code.val = MoveItErrorCodes::SUCCESS;
            if (accept) {
                accept(pose, solution, code);
            }
            if (code.val == MoveItErrorCodes::SUCCESS) {
                return true;
            }
        }
        solution.clear();
        code.val = MoveItErrorCodes::NO_IK_SOLUTION;
        return false;
    }
};

}  // namespace kinematics_example

PLUGINLIB_EXPORT_CLASS(kinematics_example::Plugin, kinematics::KinematicsBase)
