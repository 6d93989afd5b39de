#!/usr/bin/env python3
"""The swing of tools/bench/peers by Moreau and Jean's time stepping: Siconos.

    with_siconos.py swing FOLDER STEP ...

writes FOLDER/Siconos Moreau-Jean@STEP.csv: CPU time [s] in a first line `# cpu ...`, then rows of time and the scene's
records. A STEP is a part of an output interval.
"""
import sys
import time

import numpy as np
import siconos.kernel as sk

INTERVALS, STOP = 500, 7.0
MASS, STIFFNESS, COULOMB = 0.7, 90.0, 0.05


def integrate(parts):
    h = STOP / INTERVALS / parts
    block = sk.LagrangianLinearTIDS(np.array([40.5 * COULOMB / STIFFNESS]), np.array([0.0]), np.array([[MASS]]),
                                    np.array([[STIFFNESS]]), np.array([[0.0]]))
    # A multiplier is the impulse of a step. The relation has to count as closed, wherever the block is: hence the offset.
    friction = sk.Interaction(sk.RelayNSL(1, -COULOMB * h, COULOMB * h), sk.LagrangianLinearTIR(np.array([[1.0]]), np.array([-1e3])))
    system = sk.NonSmoothDynamicalSystem(0, STOP)
    system.insertDynamicalSystem(block)
    system.link(friction, block)
    stepping = sk.TimeStepping(system, sk.TimeDiscretisation(0, h), sk.MoreauJeanOSI(0.5), sk.Relay())
    begin = time.process_time()
    rows = [[0.0, STIFFNESS * block.q()[0], 0.0]]
    for step in range(1, INTERVALS * parts + 1):
        stepping.computeOneStep()
        stepping.nextStep()
        if step % parts == 0:
            rows.append([step * h, STIFFNESS * block.q()[0], block.velocity()[0]])
    return time.process_time() - begin, rows


def main():
    for parts in sys.argv[3:]:
        seconds, rows = integrate(int(parts))
        with open(f"{sys.argv[2]}/Siconos Moreau-Jean@{parts}.csv", "w") as out:
            out.write(f"# cpu {seconds}\n")
            out.writelines(",".join(repr(float(x)) for x in row) + "\n" for row in rows)


if sys.argv[1] != "swing":
    sys.exit("only the swing")
main()
