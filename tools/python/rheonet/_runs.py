"""Reading a netlist, and one run of it."""

import os
import pathlib

from . import _arguments
from ._errors import Diagnostic, NetlistError, SimulationError, diagnostics_of
from ._result import Result


def overrides(changes):
    return [f"{path}={value}" for path, value in changes.items()]


def read(source, changes, measures=None, records=(), plotted=False):
    """Reads a netlist. `changes`: text by path. `measures` take the place of its claims."""
    return complete(source.read(overrides(changes), measures, folders_of_laws(), list(records), plotted))


def complete(reading):
    """The reading; raises NetlistError if there are mistakes in it."""
    if not reading.complete:
        raise NetlistError(diagnostics_of(reading))
    return reading


def run(scene, accuracy=None, certify=False, threads=1, progress=None, both_sides=False):
    accuracy, certify = _arguments.accuracy(accuracy), _arguments.flag("certify", certify)
    run = scene._reading.run(accuracy, certify, _arguments.count("threads", threads), both_sides, _arguments.progress(progress))
    result = Result(run, scene, accuracy, None)
    if run.failure is not None:
        raise SimulationError([Diagnostic(**run.failure)], result)
    return result


def folders_of_laws():
    """The folder that `include = ["library/..."]` falls back on: that of RHEONET_LIBRARY, of this package, or of the prefix that
    the package is installed in (PREFIX/lib/python3/dist-packages/rheonet)."""
    if chosen := os.environ.get("RHEONET_LIBRARY"):
        return [chosen]
    package = pathlib.Path(__file__).parent
    folders = [package / "netlists", *(parent / "share/rheonet/netlists" for parent in package.parents[3:4])]
    return [str(folder) for folder in folders if folder.is_dir()][:1]
