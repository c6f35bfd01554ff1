"""The UR5e in packages from PyPI, on the inputs of the other benchmarks.

    python3 -m venv venv && venv/bin/pip install pin casadi eaik ssik urchin
    venv/bin/python python_peers.py

Results are compared before anything is timed. Every package is called from Python, as
its users do, once for each input; what an empty call takes is a row of its own. EAIK
and CasADi also have a call for many inputs.
"""

import importlib.util
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import casadi
import numpy as np
import pinocchio
from eaik.IK_HP import HPRobot

HERE = Path(__file__).parent
URDF = str(HERE.parent / "robots/ur5e.urdf")
ROUNDS = 7


def inputs():
    command = ["cargo", "run", "--quiet", "--release", "--bin", "inputs"]
    first, *rows = subprocess.check_output(command, cwd=HERE, text=True).splitlines()
    table = np.array([[float(x) for x in row.split()] for row in rows])
    poses = np.tile(np.eye(4), (len(table), 1, 1))
    poses[:, :3, :] = table[:, 6:18].reshape(-1, 3, 4)
    ours = [float(x) for x in first.split()]
    return ours, table[:, :6].copy(), poses, table[:, 18].astype(int)


def nanoseconds(count, work):
    times = []
    for _ in range(ROUNDS):
        start = time.perf_counter_ns()
        work()
        times.append((time.perf_counter_ns() - start) / count)
    return statistics.median(times)


def each(items, call):
    def work():
        for item in items:
            call(item)

    return nanoseconds(len(items), work)


def main():
    (our_fk, our_ik), q, poses, counts = inputs()
    model = pinocchio.buildModelFromUrdf(URDF)
    data, tip = model.createData(), model.getFrameId("tool0")

    def pin_fk(angles):
        pinocchio.framesForwardKinematics(model, data, angles)
        return data.oMf[tip]

    for angles, pose in zip(q, poses):
        assert np.abs(pin_fk(angles).homogeneous - pose).max() < 1e-9, angles

    many = in_casadi(model, tip).map(len(q))
    found = np.array(many(q.T)).T.reshape(-1, 4, 3).transpose(0, 2, 1)
    assert np.abs(found - poses[:, :3, :]).max() < 1e-9

    rows = [
        ("an empty call from Python", each(list(q), lambda angles: None), ""),
        ("this crate, `fk`", our_fk, ""),
        ("Pinocchio, `framesForwardKinematics`", each(list(q), pin_fk), ""),
        ("CasADi, all in one `map`", nanoseconds(len(q), lambda: many(q.T)), ""),
        ("this crate, `ik`", our_ik, f"{counts.sum()} solutions"),
    ]
    rows += inverse_rows(model, pin_fk, poses, counts)
    print("\n| UR5e | ns | |\n|---|---|---|")
    for name, time_each, note in rows:
        print(f"| {name} | {time_each:.0f} | {note} |")


def in_casadi(model, tip):
    """Forward kinematics as the graph that CasADi makes of the joints' placements."""
    q = casadi.SX.sym("q", 6)
    pose = casadi.SX.eye(4)
    for i in range(1, 7):
        c, s = casadi.cos(q[i - 1]), casadi.sin(q[i - 1])
        turn = casadi.SX.eye(4)
        turn[:2, :2] = casadi.vertcat(casadi.horzcat(c, -s), casadi.horzcat(s, c))
        pose = pose @ casadi.sparsify(casadi.DM(model.jointPlacements[i].homogeneous)) @ turn
    pose = pose @ casadi.DM(model.frames[tip].placement.homogeneous)
    return casadi.Function("fk", [q], [casadi.reshape(pose[:3, :], 12, 1)])


def inverse_rows(model, pin_fk, poses, counts):
    """Of each solver how many solutions it has, and for how many targets all of ours."""
    eaik = eaik_robot(model)
    at_home = pin_fk(np.zeros(6)).homogeneous.copy()
    at_home[:3, 3] = 0.0
    # Its tool frame is the base frame at home.
    theirs = poses @ np.linalg.inv(at_home)
    built = ssik_module()

    def eaik_found(pose):
        answer = eaik.IK(pose)
        return [angles for angles, ls in zip(answer.Q, answer.is_LS) if not ls]

    def ssik_solve(pose):
        # Without full turns, which are ours to add as well.
        return built.solve(pose, respect_limits=False, enumerate_windings=False)

    def ssik_found(pose):
        return [solution.q for solution in ssik_solve(pose)]

    rows = []
    for name, find, solve, targets in [
        ("EAIK", eaik_found, eaik.IK, theirs),
        ("ssik", ssik_found, ssik_solve, poses),
    ]:
        same, total = 0, 0
        for target, pose, count in zip(targets, poses, counts):
            found = find(target)
            total += len(found)
            reach = all(
                np.abs(pin_fk(np.asarray(angles)).homogeneous - pose).max() < 1e-6
                for angles in found
            )
            same += reach and len(found) == count
        note = f"{total} solutions; as many as ours, all right, for {same} of {len(poses)}"
        rows.append((f"{name}, one by one", each(list(targets), solve), note))
    batch = list(theirs)
    together = nanoseconds(len(batch), lambda: eaik.IK_batched(batch, 1))
    rows.append(("EAIK, `IK_batched` on one thread", together, ""))
    return rows


def ssik_module():
    """What it builds of the arm once, as its users do."""
    command = str(Path(sys.executable).parent / "ssik")
    with tempfile.TemporaryDirectory() as folder:
        out = str(Path(folder) / "ur5e_ik.py")
        arguments = ["build", URDF, "--base", "base_link", "--ee", "tool0", "--out", out]
        subprocess.run([command, *arguments], check=True, capture_output=True)
        spec = importlib.util.spec_from_file_location("ur5e_ik", out)
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
    return module


def eaik_robot(model):
    """Axes and steps of the joints at home, as EAIK takes them."""
    data = model.createData()
    pinocchio.framesForwardKinematics(model, data, np.zeros(6))
    places = [data.oMi[i] for i in range(1, 7)]
    axes = np.array([place.rotation[:, 2] for place in places])
    points = [place.translation for place in places]
    points.append(data.oMf[model.getFrameId("tool0")].translation)
    steps = np.diff(np.array([np.zeros(3), *points]), axis=0)
    return HPRobot(axes, steps)


if __name__ == "__main__":
    main()
