#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""P2 force of a run over a dipped joint beside the same masses, springs and beam without a mesh, and Jenkins' formula.

    contrib/plot/p2-force.py RUN [--picture FILE] [--element MM] [--step US]

The lumped model: unsprung mass, Hertz's spring and the suspension with the sprung mass above, on a Timoshenko beam on pads,
rigid sleepers and ballast with the ends of the run; endless ones go on for as many spans beyond the cells. The wheel's centre follows the rail top as far as a circle of its radius can.
It is integrated in time (central differences, beam elements that are exact at rest), and starts 1.5 m before the joint.
All numbers are those of the run's parameters.prm.

Jenkins et al. (1974): P2 = P0 + 2 alpha V sqrt(Mu/(Mu + Mt)) (1 - pi Ct/(4 sqrt(Kt (Mu + Mt)))) sqrt(Kt Mu), with Kt, Mt and Ct fitted
to the dynamic stiffness of the same beam under the joint between 10 Hz and the frequency at which wheel and track swing.
"""

from __future__ import annotations

import os
from collections.abc import Mapping

import numpy as np

from tread.commands import command_parser, run_command
from tread.files import DataError
from tread.loads import static_load
from tread.runs import Run

SHEAR_COEFFICIENT = 10 * 1.3 / (12 + 11 * 0.3)  # of a rectangle, nu = 0.3 (Cowper 1966)


class Track:
    """A bar on pads, sleepers and ballast as a Timoshenko beam. SI."""

    def __init__(self, p: Mapping[str, str], element: float):
        def number(name: str) -> float:
            return float(p[name])

        if p["Rail/Shape"] != "block" or p["Track/Foundation"] != "two-layer" or p["Track/Sleepers"] != "mass":
            raise DataError("the beam of this script is a block on two layers with sleepers of mass")
        width, height, crown = (1e-3 * number(f"Rail/{name} (mm)") for name in ("Block width", "Block height", "Crown radius"))
        young, nu, density = 1e9 * number("Rail/Young's modulus (GPa)"), number("Rail/Poisson's ratio"), number("Rail/Density (kg per m3)")
        # The crown takes away strips whose height grows from the middle to the sides.
        y = (np.arange(2000) + 0.5) / 2000 * width - width / 2
        top = np.sqrt(crown**2 - y**2) - crown + height
        area = width * np.mean(top)
        centre = width * np.mean(top**2) / 2 / area
        second = width * np.mean(top**3) / 3 - area * centre**2
        self.bending, self.shear = young * second, SHEAR_COEFFICIENT * young / (2 * (1 + nu)) * area
        self.mass, self.rotary = density * area, density * second
        if p["Rail/Ends"] == "absorbing":
            raise DataError("the beam of this script has symmetric or endless ends")
        spacing, first = number("Track/Sleeper spacing (m)"), 1e-3 * number("Track/Support 0 (mm)")
        beyond = spacing * number("Rail/Spans beyond") if p["Rail/Ends"] == "endless" else 0.0
        begin, length = 1e-3 * number("Rail/Begin (mm)") - beyond, 1e-3 * number("Rail/Length (mm)") + 2 * beyond
        n = round(length / element)
        self.x, self.h = np.linspace(begin, begin + length, n + 1), length / n
        supports = [first + spacing * i for i in range(-1000, 1000) if begin <= first + spacing * i <= begin + length]
        self.support = np.array([round((s - begin) / self.h) for s in supports])
        if max(abs(self.x[self.support] - supports)) > 1e-6:
            raise DataError("--element: supports must lie on the nodes of the beam")
        along = number("Track/Points along")
        self.pad, self.pad_damping = 1e6 * number("Track/Pad stiffness (MN per m)"), 1e3 * number("Track/Pad damping (kN s per m)")
        # Points in the middles of equal parts of the pad hold the slope as well.
        self.radius2 = (1e-3 * number("Track/Pad length (mm)"))**2 * (1 - 1 / along**2) / 12
        self.sleeper = number("Track/Sleeper mass (kg)")
        self.ballast = 1e6 * number("Track/Ballast stiffness (MN per m)")
        self.ballast_damping = 1e3 * number("Track/Ballast damping (kN s per m)")
        # With the bending of an element in series its linear shape functions are exact at the nodes.
        self.shear_of_element = 1 / (1 / self.shear + self.h**2 / (12 * self.bending))
        ends = np.ones(n + 1)
        ends[[0, -1]] = 0.5
        self.node_mass, self.node_rotary = self.mass * self.h * ends, self.rotary * self.h * ends

    def forces(self, w: np.ndarray, turn: np.ndarray, sleeper: np.ndarray, v: np.ndarray, spin: np.ndarray,
               sleeper_v: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """On deflections, rotations and sleepers."""
        strain = (w[1:] - w[:-1]) / self.h - 0.5 * (turn[1:] + turn[:-1])
        shear = self.shear_of_element * strain
        moment = self.bending * (turn[1:] - turn[:-1]) / self.h
        force, torque = np.zeros_like(w), np.zeros_like(w)
        force[:-1] += shear
        force[1:] -= shear
        torque[:-1] += moment + 0.5 * self.h * shear
        torque[1:] += -moment + 0.5 * self.h * shear
        s = self.support
        in_pad = self.pad * (w[s] - sleeper) + self.pad_damping * (v[s] - sleeper_v)
        force[s] -= in_pad
        torque[s] -= self.radius2 * (self.pad * turn[s] + self.pad_damping * spin[s])
        torque[[0, -1]] = 0.0  # symmetry
        return force, torque, in_pad - self.ballast * sleeper - self.ballast_damping * sleeper_v

    def dynamic_stiffness(self, omega: np.ndarray, place: float) -> np.ndarray:
        """(n,) complex: force over deflection at x, exp(i omega t). What lies to each side is condensed node by node."""
        n = len(self.x)
        g, b, h = self.shear_of_element, self.bending / self.h, self.h
        element = g / h * np.array([[1, h / 2, -1, h / 2], [h / 2, h * h / 4, -h / 2, h * h / 4], [-1, -h / 2, 1, -h / 2],
                                    [h / 2, h * h / 4, -h / 2, h * h / 4]])
        element += b * np.array([[0, 0, 0, 0], [0, 1, 0, -1], [0, 0, 0, 0], [0, -1, 0, 1]])
        own = np.zeros((n, len(omega), 2, 2), dtype=complex)
        own[:-1] += element[:2, :2]
        own[1:] += element[2:, 2:]
        own[..., 0, 0] -= np.outer(self.node_mass, omega**2)
        own[..., 1, 1] -= np.outer(self.node_rotary, omega**2)
        pad = self.pad + 1j * omega * self.pad_damping
        below = self.ballast + 1j * omega * self.ballast_damping - omega**2 * self.sleeper
        own[self.support, :, 0, 0] += pad * below / (pad + below)
        own[self.support, :, 1, 1] += self.radius2 * pad
        own[[0, -1], :, 1, 1] += 1e6 * b  # symmetry
        i = int(np.argmin(abs(self.x - place)))
        all_at_place = -own[i]
        for nodes, to, back in ((range(i), element[2:, :2], element[:2, 2:]), (range(n - 1, i, -1), element[:2, 2:], element[2:, :2])):
            beside = np.zeros_like(own[0])  # of the nodes on this side, felt by the next one
            for node in nodes:
                beside = -to @ np.linalg.inv(own[node] + beside) @ back
            all_at_place += own[i] + beside
        return 1 / np.linalg.inv(all_at_place)[:, 0, 0]


class Wheel:
    def __init__(self, p: Mapping[str, str], folder: str):
        def number(name: str) -> float:
            return float(p[name])

        load = static_load(p)
        if load is None:
            raise DataError(f"{folder}: parameters.prm does not say what the load of the wheel is")
        self.load, self.unsprung = 1e3 * load, number("Wheel/Mass (kg)")
        self.sprung = self.load / number("Vehicle/Gravity (m per s2)") - self.unsprung
        self.suspension = 1e3 * number("Vehicle/Suspension stiffness (kN per m)")
        self.suspension_damping = number("Vehicle/Suspension damping (N s per m)")
        self.radius, self.speed = 1e-3 * number("Wheel/Radius (mm)"), number("Motion/Speed (km per h)") / 3.6
        modulus = 1e9 / sum((1 - number(f"{body}/Poisson's ratio")**2) / number(f"{body}/Young's modulus (GPa)") for body in ("Wheel", "Rail"))
        self.hertz = hertz_coefficient(0.5 / self.radius, 500 / number("Rail/Crown radius (mm)"), modulus)
        name = p["Defect/Profile file"]
        path = next((f for f in (name, os.path.join(folder, name)) if os.path.exists(f)), None)
        if path is None:
            raise DataError(f"{name}: not found here or in {folder}; --profiles names its folder")
        x, z = 1e-3 * np.loadtxt(path).T
        along = np.arange(-1.0, 1.0, 1e-4)
        rail = np.interp(along, x - x[0] + 1e-3 * number("Defect/Position (mm)"), z)
        # How high a circle stands that touches the rail top.
        reach = np.arange(-200, 201)
        sag = (1e-4 * reach)**2 / (2 * self.radius)
        padded = np.pad(rail, 200, mode="edge")
        self.along = along
        self.height = np.max([padded[200 + r:200 + r + len(rail)] - s for r, s in zip(reach, sag)], axis=0)
        self.joint = along[np.argmin(self.height)]
        slopes = np.diff(z) / np.diff(x)
        self.angle = np.max(np.diff(slopes))


def hertz_coefficient(a: float, b: float, modulus: float) -> float:
    """K of F = K approach^1.5 for the gap a x^2 + b y^2 (Hertz 1882; Johnson 1985, eqs. 4.25 to 4.28)."""
    a, b = min(a, b), max(a, b)
    t = (np.arange(4000) + 0.5) / 4000 * np.pi / 2

    def integrals(m: float) -> tuple[float, float, float]:
        root = np.sqrt(1 - m * np.sin(t)**2)
        return (np.pi / 2 * np.mean(1 / root), np.pi / 2 * np.mean(np.sin(t)**2 / root), np.pi / 2 * np.mean(np.cos(t)**2 / root))

    low, high = 0.0, 1 - 1e-9
    for _ in range(80):
        m = 0.5 * (low + high)
        _, d, c = integrals(m)
        low, high = (m, high) if b / a > c / d / (1 - m) else (low, m)
    k, d, _ = integrals(m)
    # p0 = 1.5 F/(pi A B), a = p0 B D/(E* A^2), approach = p0 B K/E*, B = A sqrt(1 - m).
    axis = (1.5 * d / (np.pi * modulus * a))**(1 / 3)  # for F = 1
    return (1.5 * k / (np.pi * axis * modulus))**-1.5


def integrate(track: Track, wheel: Wheel, end: float, step: float) -> tuple[np.ndarray, np.ndarray]:
    """Position of the wheel and contact force until it is at `end`."""
    start = wheel.joint - 1.5
    w, turn = np.zeros_like(track.x), np.zeros_like(track.x)
    sleeper = np.zeros(len(track.support))
    v, spin, sleeper_v = w.copy(), w.copy(), sleeper.copy()
    z = z_sprung = vz = vz_sprung = 0.0
    approach = approach0 = (wheel.load / wheel.hertz)**(2 / 3)

    def place(x: float) -> tuple[int, float]:
        s = (x - track.x[0]) / track.h
        i = min(int(s), len(track.x) - 2)
        return i, s - i

    # At rest: heavily damped, and with the load as it stands.
    i, s = place(start)
    for phase in (0, 1):
        x, t, positions, forces = start, 0.0, [], []
        n_steps = int(0.15 / step) if phase == 0 else int((end - start) / wheel.speed / step)
        for n in range(n_steps):
            if phase == 1:
                x = start + wheel.speed * n * step
                i, s = place(x)
                sunk = z - (1 - s) * w[i] - s * w[i + 1] + approach0 + np.interp(x, wheel.along, wheel.height)
                force = wheel.hertz * max(sunk, 0.0)**1.5
            else:
                force = wheel.load
            f, m, g = track.forces(w, turn, sleeper, v, spin, sleeper_v)
            f[i] += (1 - s) * force
            f[i + 1] += s * force
            if phase == 0:
                f, m, g = f - 400 * track.node_mass * v, m - 400 * track.node_rotary * spin, g - 400 * track.sleeper * sleeper_v
            v += step * f / track.node_mass
            spin += step * m / track.node_rotary
            sleeper_v += step * g / track.sleeper
            w += step * v
            turn += step * spin
            sleeper += step * sleeper_v
            if phase == 1:
                spring = wheel.suspension * (z - z_sprung) + wheel.suspension_damping * (vz - vz_sprung)
                vz += step * (wheel.load - force - spring) / wheel.unsprung
                vz_sprung += step * spring / wheel.sprung
                z += step * vz
                z_sprung += step * vz_sprung
                positions.append(x)
                forces.append(force)
        if phase == 0:
            # z counts downwards from here.
            v[:], spin[:], sleeper_v[:] = 0, 0, 0
            approach0 = approach + (1 - s) * w[i] + s * w[i + 1]
    return np.array(positions), np.array(forces)


def integrate_two_masses(k: float, m: float, c: float, wheel: Wheel, end: float, step: float) -> tuple[np.ndarray, np.ndarray]:
    """The same for a track that is one mass, spring and damper under the wheel."""
    start = wheel.joint - 1.5
    approach0 = (wheel.load / wheel.hertz)**(2 / 3)
    w = v = z = vz = z_sprung = vz_sprung = 0.0  # from rest, downwards
    x = start + wheel.speed * step * np.arange(int((end - start) / wheel.speed / step))
    heights = np.interp(x, wheel.along, wheel.height)
    forces = []
    for height in heights.tolist():
        force = wheel.hertz * max(z - w + approach0 + height, 0.0)**1.5
        v += step * (force - wheel.load - k * w - c * v) / m
        spring = wheel.suspension * (z - z_sprung) + wheel.suspension_damping * (vz - vz_sprung)
        vz += step * (wheel.load - force - spring) / wheel.unsprung
        vz_sprung += step * spring / wheel.sprung
        w += step * v
        z += step * vz
        z_sprung += step * vz_sprung
        forces.append(force)
    return x, np.array(forces)


def jenkins(track: Track, wheel: Wheel) -> tuple[float, float, float, float, float]:
    """Kt, Mt, Ct and the formula's force."""
    frequencies = np.linspace(10, 60, 11)
    for _ in range(5):
        omega = 2 * np.pi * frequencies
        stiffness = track.dynamic_stiffness(omega, wheel.joint)
        (k, m), *_ = np.linalg.lstsq(np.stack([np.ones_like(omega), -omega**2], 1), stiffness.real, rcond=None)
        c = np.sum(stiffness.imag * omega) / np.sum(omega**2)
        frequencies = np.linspace(10, np.sqrt(k / (wheel.unsprung + m)) / (2 * np.pi), 11)
    total = wheel.unsprung + m
    force = wheel.load + wheel.angle * wheel.speed * np.sqrt(wheel.unsprung / total) * (
        1 - np.pi * c / (4 * np.sqrt(k * total))) * np.sqrt(k * wheel.unsprung)
    return k, m, c, force, frequencies[-1]


def smoothed(x: np.ndarray, force: np.ndarray, width: float) -> tuple[np.ndarray, np.ndarray]:
    """Places and mean force over `width` of the path."""
    even = np.arange(x[0], x[-1], 1e-4)
    n = round(width / 1e-4)
    mean = np.convolve(np.interp(even, x, force), np.ones(n) / n, mode="valid")
    return even[:len(mean)] + 0.5 * width, mean


def largest_behind(x: np.ndarray, force: np.ndarray, place: float) -> tuple[float, float]:
    """(force, x)."""
    chosen = np.where(x > place)[0]
    if not len(chosen):
        raise DataError(f"the run does not reach {1e3 * place:.1f} mm, where the force is looked for behind the joint")
    best = chosen[np.argmax(force[chosen])]
    return force[best], x[best]


def main() -> None:
    parser = command_parser(__doc__)
    parser.add_argument("run")
    parser.add_argument("--profiles", default="prm/verification", help="folder of the profile")
    parser.add_argument("--picture")
    parser.add_argument("--element", type=float, default=25, help="of the beam, mm")
    parser.add_argument("--mean", type=float, default=100, help="of the path, mm; about a period of the contact's vibration")
    parser.add_argument("--step", type=float, default=3, help="us")
    arguments = parser.parse_args()
    run = Run(arguments.run)
    track, wheel = Track(run.parameters, 1e-3 * arguments.element), Wheel(run.parameters, arguments.profiles)
    history = run.table("history.csv", ("position_m", "normal_force_N"))
    x, force = history["position_m"], history["normal_force_N"]
    beam_x, beam_force = integrate(track, wheel, x[-1], 1e-6 * arguments.step)
    width = 1e-3 * arguments.mean
    k, m, c, formula, frequency = jenkins(track, wheel)
    two_x, two_force = integrate_two_masses(k, m, c, wheel, x[-1], 1e-6 * arguments.step)
    runs = [(x, force), (beam_x, beam_force), (two_x, two_force)]
    # P1 and the mean over its own vibration end so far behind the joint.
    behind = wheel.joint + 1.5 * width
    p1 = [largest_behind(*run, wheel.joint) for run in runs]
    p2 = [largest_behind(*smoothed(*run, width), behind) for run in runs]
    print(f"track under the joint: Kt {1e-6 * k:.2f} MN/m, Mt {m:.1f} kg, Ct {1e-3 * c:.2f} kNs/m; wheel on track {frequency:.1f} Hz")
    print(f"P1 is the largest force, P2 the largest mean over {arguments.mean:g} mm of the path that begins {arguments.mean:g} mm or more behind the joint.")
    print("| | cells | beam, sleepers and Hertz's spring | difference | two masses and Hertz's spring | Jenkins' formula |")
    print("|---|---|---|---|---|---|")
    for name, (cells, model, two), text in (("P1", p1, ""), ("P2", p2, f"{1e-3 * formula:.1f}")):
        print(f"| {name}, kN | {1e-3 * cells[0]:.2f} | {1e-3 * model[0]:.2f} | {100 * (cells[0] / model[0] - 1):+.2f} % | {1e-3 * two[0]:.2f} | {text} |")
        print(f"| {name}: behind the joint, mm | {1e3 * (cells[1] - wheel.joint):.0f} | {1e3 * (model[1] - wheel.joint):.0f} | | "
              f"{1e3 * (two[1] - wheel.joint):.0f} | |")
    for name, runs_of in (("force", runs), (f"mean over {arguments.mean:g} mm", [smoothed(*run, width) for run in runs])):
        (place, values), (model_place, model_values) = runs_of[:2]
        off = values - np.interp(place, model_place, model_values)
        print(f"| {name}, whole path: least, largest, kN | {1e-3 * values.min():.1f}, {1e-3 * values.max():.1f} | "
              f"{1e-3 * model_values[model_place > x[0]].min():.1f}, {1e-3 * model_values.max():.1f} | "
              f"at most {1e-3 * abs(off).max():.2f}, RMS {1e-3 * np.sqrt(np.mean(off**2)):.2f} kN | | |")
    if arguments.picture:
        from tread.plots import BLUE, RED, legend_beside, save, subplots, use_style

        use_style()
        figure, axis = subplots(figsize=(10, 3.8))
        axis.plot(1e3 * (x - wheel.joint), 1e-3 * force, color=BLUE, label="cells")
        shown = beam_x > x[0]
        axis.plot(1e3 * (beam_x[shown] - wheel.joint), 1e-3 * beam_force[shown], "--", color=RED, label="lumped model")
        axis.axhline(1e-3 * formula, color="grey", linewidth=0.8, label="Jenkins' formula")
        axis.set(xlabel="wheel behind the joint [mm]", ylabel="normal force [kN]")
        legend_beside(axis)
        save(figure, arguments.picture)


if __name__ == "__main__":
    run_command(main)
