/* Times a solver that IKFast has generated, `SOLVER`, on configurations from the standard input.
 * Writes nanoseconds for a pose and for all solutions, the medians of all rounds, and behind them
 * the number of solutions to every target, each with its joint values. */
#define IKFAST_NO_MAIN
#include SOLVER
#include <chrono>
#include <cstdio>

enum { ROUNDS = 41 };

struct Pose {
    double rotation[9], translation[3];
};

static double now()
{
    const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now().time_since_epoch();
    return time.count();
}

static double median(std::vector<double> times)
{
    std::sort(times.begin(), times.end());
    return times[times.size() / 2];
}

int main()
{
    const std::size_t joints = GetNumJoints();
    std::vector<std::vector<double>> all;
    for (double x; std::scanf("%lf", &x) == 1;) {
        if (all.empty() || all.back().size() == joints) {
            all.emplace_back();
        }
        all.back().push_back(x);
    }
    const auto fk = [](const std::vector<double> &q) {
        Pose pose;
        ComputeFk(q.data(), pose.translation, pose.rotation);
        return pose;
    };
    std::vector<Pose> poses;
    for (const auto &q : all) {
        poses.push_back(fk(q));
    }
    /* The joint whose value is given, if any. */
    const auto given = [&](std::size_t i) {
        return GetNumFreeParameters() > 0 ? all[i].data() + GetFreeParameters()[0] : nullptr;
    };
    std::vector<double> forward, inverse, solution(joints);
    volatile double sink = 0.0;
    for (int round = 0; round < ROUNDS; ++round) {
        double start = now();
        for (const auto &q : all) {
            sink = sink + fk(q).translation[0];
        }
        forward.push_back((now() - start) / all.size());
        start = now();
        for (std::size_t i = 0; i < all.size(); ++i) {
            IkSolutionList<double> solutions;
            ComputeIk(poses[i].translation, poses[i].rotation, given(i), solutions);
            for (std::size_t k = 0; k < solutions.GetNumSolutions(); ++k) {
                solutions.GetSolution(k).GetSolution(solution.data(), given(i));
                sink = sink + solution[0];
            }
        }
        inverse.push_back((now() - start) / all.size());
    }
    std::printf("%g %g\n", median(forward), median(inverse));
    for (std::size_t i = 0; i < all.size(); ++i) {
        IkSolutionList<double> solutions;
        ComputeIk(poses[i].translation, poses[i].rotation, given(i), solutions);
        std::printf("%zu\n", solutions.GetNumSolutions());
        for (std::size_t k = 0; k < solutions.GetNumSolutions(); ++k) {
            solutions.GetSolution(k).GetSolution(solution.data(), given(i));
            for (double x : solution) {
                std::printf("%.17g ", x);
            }
        }
    }
    return 0;
}
