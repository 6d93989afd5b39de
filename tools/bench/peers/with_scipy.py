#!/usr/bin/env python3
"""Scenes of tools/bench/peers by SciPy's integrators, with events where sliders switch.

    with_scipy.py SCENE FOLDER TOLERANCE ...

writes FOLDER/METHOD@TOLERANCE.csv for BDF, Radau and LSODA: CPU time [s] in a first line `# cpu ...` (the least of three),
then rows of time and the scene's records.
"""
import sys
import time

import numpy as np
from scipy.integrate import solve_ivp
from scipy.sparse import lil_matrix

INTERVALS = 500
TOO_LONG = 20.0  # s: then no tighter tolerance is tried


class Smooth:
    """y' = A y + drive(t)."""

    switches = False

    def __init__(self, stop, scale, matrix, drive, row, start):
        self.stop, self.scale, self.matrix, self.drive, self.row, self.start = stop, scale, matrix, drive, row, start

    def rate(self, t, y):
        return self.matrix @ y + self.drive(t)


class Block(Smooth):
    """x' = v, m v' = k (V t - x) - friction; sticks or slips (mode 0, +-1) between events."""

    switches = True

    def __init__(self, stop, scale, m, k, pull, x0, coulomb, breakaway):
        self.stop, self.scale, self.m, self.k, self.V, self.coulomb, self.breakaway = stop, scale, m, k, pull, coulomb, breakaway
        self.start = np.array([x0, 0.0])
        self.choose(0.0, self.start)

    def spring(self, t, y):
        return self.k * (self.V * t - y[0])

    def choose(self, t, y):
        f = self.spring(t, y)
        self.mode = 0 if abs(f) <= self.breakaway else 1 if f > 0 else -1

    def rate(self, t, y):
        return np.array([y[1], (self.spring(t, y) - self.mode * self.coulomb) / self.m if self.mode else 0.0])

    def event(self, t, y):
        return self.mode * y[1] if self.mode else self.breakaway - abs(self.spring(t, y))

    def change(self, t, y):
        y = y.copy()
        if self.mode:
            y[1] = 0.0
            self.choose(t, y)
        else:
            self.mode = 1 if self.spring(t, y) > 0 else -1
        return y

    def row(self, t, y):
        return [self.spring(t, y) if self.V else self.k * y[0], y[1]]


def ladder():
    n, m, k, c = 100, 1e-3, 1e3, 1.0
    a = lil_matrix((2 * n, 2 * n))
    for i in range(n):
        a[2 * i, 2 * i + 1] = 1
        for j in (i - 1, i + 1):
            if j < 0:
                continue
            for column, value in ((0, k), (1, c)):
                a[2 * i + 1, 2 * i + column] -= value / m
                if j < n:
                    a[2 * i + 1, 2 * j + column] += value / m
    force = np.zeros(2 * n)
    force[1] = 1 / m
    return Smooth(0.1, 1e-2, a.tocsc(), lambda t: force, lambda t, y: [k * (y[0] - y[2]), y[1]], np.zeros(2 * n))


def problem(scene):
    if scene == "maxwell":
        k, b, w = 1000.0, 50.0, 2 * np.pi
        return Smooth(10.0, 50.0, np.array([[-k / b]]), lambda t: np.array([k * np.sin(w * t)]), lambda t, y: [y[0], 0.0], np.zeros(1))
    if scene == "resonance":
        m, k, f = 0.7, 90.0, 0.02
        w = np.sqrt(k / m)
        return Smooth(16.6, 0.01, np.array([[0, 1], [-k / m, 0]]), lambda t: np.array([0, f / m * np.sin(w * t)]),
                      lambda t, y: [k * y[0], y[1]], np.zeros(2))
    if scene == "stick-slip":
        return Block(100.0, 0.1, 1.0, 10.0, 0.1, 0.0, 1.0, 1.5)
    if scene == "swing":
        return Block(7.0, 0.02, 0.7, 90.0, 0.0, 40.5 * 0.05 / 90, 0.05, 0.05)
    if scene == "ladder":
        return ladder()
    sys.exit(f"no scene {scene}")


def integrate(scene, method, tolerance):
    p = problem(scene)
    times = np.arange(INTERVALS + 1) * p.stop / INTERVALS
    rows, t, y = [], 0.0, p.start
    options = {} if p.switches or method == "LSODA" else {"jac": p.matrix}
    if p.switches:
        event = lambda t, y: p.event(t, y)
        event.terminal, event.direction = True, -1
        options["events"] = event
    while t < p.stop:
        wanted = times[(times >= t) & (len(rows) <= np.arange(len(times)))]
        s = solve_ivp(p.rate, (t, p.stop), y, method, wanted, rtol=max(tolerance, 3e-14), atol=tolerance * p.scale, **options)
        if s.status < 0:
            raise RuntimeError(s.message)
        rows += [[at] + p.row(at, state) for at, state in zip(s.t, s.y.T)]
        if s.status == 0:
            break
        t, y = s.t_events[0][0], p.change(s.t_events[0][0], s.y_events[0][0])
    return rows


def main():
    scene, folder, tolerances = sys.argv[1], sys.argv[2], sys.argv[3:]
    for method in ("BDF", "Radau", "LSODA"):
        for tolerance in tolerances:
            seconds = []
            try:
                for _ in range(3):
                    begin = time.process_time()
                    rows = integrate(scene, method, float(tolerance))
                    seconds.append(time.process_time() - begin)
                    if seconds[-1] > 1:
                        break
            except RuntimeError as error:
                print(f"{method} at {tolerance}: {error}", file=sys.stderr)
                break
            with open(f"{folder}/SciPy {method}@{tolerance}.csv", "w") as out:
                out.write(f"# cpu {min(seconds)}\n")
                out.writelines(",".join(repr(float(x)) for x in row) + "\n" for row in rows)
            if seconds[-1] > TOO_LONG:
                break


main()
