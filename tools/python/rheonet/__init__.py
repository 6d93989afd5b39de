"""Simulates 1-D mechanical networks: springs, dashpots, masses and friction along a line or about an axis.

    import rheonet

    scene = rheonet.load("pad.toml", {"pad.slip.coulomb": "2 N"})
    result = scene.run(accuracy=1e-8)
    result["pad.force"]     # NumPy array, one value for each time in result.time
    result.units            # {"plate.position": "m", "pad.force": "N"}

Every value is in SI units, as in the CSV files of the command `rheonet run`.
"""

import functools
import itertools
import json
import os
import pathlib
import warnings
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from . import _parallel, _rheonet
from ._values import coordinate, setting, toml_of

__version__ = _rheonet.__version__
__all__ = ["Diagnostic", "Event", "NetlistError", "NetlistWarning", "Result", "Scene", "SimulationError", "load", "loads"]


class Diagnostic(NamedTuple):
    """A mistake in a netlist, or a warning."""

    severity: str  #: "error" or "warning"
    file: str | None  #: None for a value of `changes` or a measure, which stand in no file
    line: int | None  #: counts from 1
    column: int | None  #: counts from 1, in characters
    message: str  #: what was found and what was expected
    hint: str  #: the remedy; may be empty
    text: str  #: all of this with an excerpt of the file, as the command `rheonet` prints it


class Event(NamedTuple):
    """A change of the mode of an element."""

    time: float  #: [s]
    element: str
    event: str  #: "stick", "slip", "reversal", ...
    direction: int  #: of the motion after the event, or of the jump of a signal: 1, -1, or 0 at rest


class _Located(Exception):
    """An error with its place in a netlist: the attributes of Diagnostic, for the first of `diagnostics`."""

    def __init__(self, diagnostics):
        self.diagnostics = diagnostics
        first = next(d for d in diagnostics if d.severity == "error")
        self.file, self.line, self.column = first.file, first.line, first.column
        self.message, self.hint = first.message, first.hint

    def __str__(self):
        return "\n".join(diagnostic.text for diagnostic in self.diagnostics)


class NetlistError(_Located, ValueError):
    """A netlist has mistakes. `diagnostics` lists all of them; `file`, `line`, `column`, `message` and `hint` are those of the first."""


class SimulationError(_Located, RuntimeError):
    """A scene cannot be simulated, or its run ended early. `result` holds the rows up to there; the other attributes are those of
    NetlistError. `file`, `line` and `column` are None if the cause is at no place in the netlist."""

    def __init__(self, diagnostics, result):
        super().__init__(diagnostics)
        self.result = result


class NetlistWarning(UserWarning):
    """A likely mistake in a netlist that can be simulated."""


def load(source, changes={}):
    """Reads a netlist.

    source: path of a TOML file, or the netlist as a dictionary of tables.
    changes: values in place of the netlist's, by path. Numbers are in SI; text is read as after `--set` of the command:
        {"k1.stiffness": "2 N/mm", "m1.mass": 0.5}.

    Raises NetlistError if the netlist has a mistake, TypeError for a value that a netlist cannot hold.
    """
    if isinstance(source, Mapping):
        return _scene(_rheonet.Source("<dictionary>", toml_of(source), "."), changes)
    return _scene(_rheonet.Source(os.fspath(source), None, ""), changes)


def loads(text, changes={}, name="<text>", folder="."):
    """Reads a netlist from text. `name` stands for the file in messages; included files and tables are searched for in `folder`.
    The rest is as for load()."""
    return _scene(_rheonet.Source(name, text, os.fspath(folder)), changes)


class Scene:
    """A netlist that has been read and checked. It never changes: several threads may use it at once."""

    def __init__(self, source, changes, reading):
        """Made by load() and loads()."""
        self._source = source
        self._changes = changes
        self._reading = reading

    @property
    def title(self):
        """The title of the netlist; may be empty."""
        return self._reading.title

    @property
    def start(self):
        """Time at which the run starts [s]."""
        return self._reading.start

    @property
    def stop(self):
        """Time at which the run stops [s]."""
        return self._reading.stop

    @property
    def accuracy(self):
        """The accuracy that the netlist asks for: allowed error of each record, relative to its largest magnitude in the run."""
        return self._reading.accuracy

    @property
    def names(self):
        """The records, in the order of the netlist: ["plate.position", "pad.force"]."""
        return list(self.units)

    @property
    def units(self):
        """The SI unit of each record: {"plate.position": "m"}; "1" for a number."""
        return self._reading.units

    @property
    def warnings(self):
        """Likely mistakes, as a list of Diagnostic. load() also issues each as a NetlistWarning."""
        return _diagnostics(self._reading)

    def run(self, accuracy=None, certify=False, threads=1, progress=None):
        """Simulates the scene.

        accuracy: allowed error of each record, relative to its largest magnitude in the run, from 1e-12 to 0.1; None: the netlist's.
        certify: estimates the error, and tightens until the accuracy is met: see Result.certificate. Costs at least two runs.
        threads: largest number of threads for independent parts of the scene.
        progress: called at intervals with the fraction of the run that is completed, from 0 to 1. An exception that it raises
            ends the run.

        Returns a Result. Raises SimulationError, or KeyboardInterrupt on Ctrl-C. The interpreter lock is released: runs in
        several Python threads use several processors.
        """
        return _run(self._reading, accuracy, certify, threads, progress)

    def sweep(self, changes, measure=None, accuracy=None, jobs=None, client=None):
        """Simulates the scene for all combinations of values.

        changes: the values of each parameter, by path: {"k1.stiffness": ["1 N/mm", "2 N/mm"], "m1.mass": [0.1, 1, 10]}.
        measure: figures of each run in place of its rows, as after `--measure` of the command: ["max(k1.force)"].
        accuracy: as for run().
        jobs: number of runs at a time; None: one for each processor.
        client: a dask.distributed.Client, on whose workers the runs are simulated; they have to find the same files.

        Returns an xarray.Dataset with a dimension and a coordinate for each parameter: numbers if all values have one unit (in
        the attribute "units"; absent for numbers without a unit, which are SI), else text. It holds either the measures, or
        the records with the further dimension "time". Raises NetlistError and SimulationError like load() and run(), and
        ValueError if the rows of two runs are at different times.
        """
        import xarray

        paths = list(changes)
        values = [list(changes[path]) for path in paths]
        shape = [len(axis) for axis in values]
        measures = [measure] if isinstance(measure, str) else list(measure or ())
        combinations = list(itertools.product(*values))
        if not combinations:
            raise ValueError("a sweep needs at least one value of each parameter")

        if client is None:
            run = functools.partial(_outcome, self._source, self._changes, paths, measures, accuracy)
            outcomes = _parallel.in_threads(run, combinations, jobs)
        else:
            source = _parallel.everywhere(*self._source.arguments)
            run = functools.partial(_portable_outcome, source, self._changes, paths, measures, accuracy)
            outcomes = _parallel.on_dask(client, run, combinations)
        coordinates = {path: coordinate(path, axis) for path, axis in zip(paths, values)}
        if measures:
            variables = {
                name: (paths, np.reshape([figures[k]["found"] for figures in outcomes], shape), {"units": outcomes[0][k]["unit"]})
                for k, name in enumerate(measures)
            }
            return xarray.Dataset(variables, coordinates, {"title": self.title})
        time = outcomes[0].time
        for combination, result in zip(combinations, outcomes):
            if not np.array_equal(result.time, time):
                raise ValueError(
                    f"the rows of the runs {combinations[0]} and {combination} are at different times; "
                    "give `measure`, or let `simulate.output` and `simulate.stop` be the same in all runs"
                )
        coordinates["time"] = ("time", time, {"units": "s"})
        variables = {
            name: ([*paths, "time"], np.reshape([result[name] for result in outcomes], [*shape, len(time)]), {"units": unit})
            for name, unit in outcomes[0].units.items()
        }
        return xarray.Dataset(variables, coordinates, {"title": self.title})

    def explain(self):
        """What will be simulated, and why: what `rheonet explain --json` prints, as a dictionary. Raises SimulationError, without a
        `result`, for a scene that cannot start."""
        explained, failure = self._reading.explain()
        if failure is not None:
            raise SimulationError([Diagnostic(**failure)], None)
        return json.loads(explained)

    def _repr_svg_(self):
        """The schematic, for Jupyter; None if the network is too large to be drawn."""
        return self._reading.schematic()

    def __repr__(self):
        return f"<rheonet.Scene {self.title or self._source.file!r}: {len(self.names)} records, {self.start:g} s to {self.stop:g} s>"


class Result(Mapping):
    """The rows of a run, as a mapping from records to arrays: `result["k1.force"]` is a read-only array with the value of the record
    at each time, in SI units. Arrays are views of memory that the result owns; they keep it alive. Call .copy() on one to change it."""

    __eq__ = object.__eq__  # two results are not compared value by value
    __hash__ = object.__hash__

    def __init__(self, run, scene_units, title):
        """Made by Scene.run()."""
        self._run = run
        self._units = scene_units
        self._title = title
        self._columns = {name: k for k, name in enumerate(scene_units)}

    @property
    def time(self):
        """Times of the rows [s]: a read-only array of shape (rows,). Two equal times are the two sides of an event."""
        return self._run.time

    @property
    def names(self):
        """The records, in the order of the netlist."""
        return list(self._units)

    @property
    def units(self):
        """The SI unit of each record; "1" for a number."""
        return dict(self._units)

    def __getitem__(self, name):
        """The record at each time: a read-only array of shape (rows,). Raises KeyError if `name` was not recorded."""
        try:
            return self._run.column(self._columns[name])
        except KeyError:
            raise KeyError(f"{name!r} was not recorded; `simulate.record` names what is; recorded: {', '.join(self._units)}") from None

    def __iter__(self):
        return iter(self._units)

    def __len__(self):
        """The number of records."""
        return len(self._units)

    @property
    def events(self):
        """A list of Event, sorted by time."""
        return [Event(*event) for event in self._run.events]

    @property
    def summary(self):
        """A dictionary of the run's statistics: "rows", "unknowns", "parts", "steps", "arc_steps" (of the steps, those in closed
        form), "rejected_steps", "residual_evaluations", "jacobian_evaluations", "restarts", "events", "switched" (events of each
        element), "ended" (time at which `simulate.stop_when` ended the run [s], or None), "wall_seconds", "cpu_seconds",
        "notes" (remarks on the result), and

        "energy_supplied", "energy_stored", "energy_dissipated": the energy account [J]; "energy_missing" is its defect;
        "claims": for each claim of `[expect]` a dictionary of its "name", the figure "found" and its "unit", what is "claimed",
            and whether it "holds".
        """
        return self._run.summary

    @property
    def certificate(self):
        """None without `certify`. A dictionary: whether the accuracy "holds" for every record, the estimated "errors" of each
        record ("largest" in SI, its "time" [s], "relative" to the largest magnitude), the "obstacle" to a tighter run
        ("" if there was none), the number of "runs", and "cpu_seconds" of all of them."""
        return self._run.certificate

    def to_dataframe(self):
        """A pandas.DataFrame with a column for each record and the time as its index. attrs["units"] holds the units."""
        import pandas

        frame = pandas.DataFrame(dict(self), pandas.Index(self.time, name="time"))
        frame.attrs.update(title=self._title, units=self.units)
        return frame

    def to_xarray(self):
        """An xarray.Dataset with a variable for each record over the dimension "time", and its unit in the attribute "units"."""
        import xarray

        variables = {name: ("time", self[name], {"units": unit}) for name, unit in self._units.items()}
        return xarray.Dataset(variables, {"time": ("time", self.time, {"units": "s"})}, {"title": self._title})

    def _repr_html_(self):
        """A table of the smallest, largest and last value of each record, for Jupyter."""
        import html

        head = "<tr><th>record</th><th>unit</th><th>smallest</th><th>largest</th><th>last</th></tr>"
        rows = "".join(
            f"<tr><td>{html.escape(name)}</td><td>{html.escape(self._units[name])}</td>"
            + "".join(f"<td>{value:.6g}</td>" for value in (values.min(), values.max(), values[-1]))
            + "</tr>"
            for name, values in (self.items() if len(self.time) else ())
        )
        return f"<table><caption>{html.escape(repr(self)[1:-1])}</caption><thead>{head}</thead><tbody>{rows}</tbody></table>"

    def __repr__(self):
        return f"<rheonet.Result {self._title!r}: {len(self)} records, {len(self.time)} rows>"


def _read(source, changes, measures=None):
    """Reads a netlist; `measures` take the place of its claims."""
    overrides = [f"{path}={setting(value)}" for path, value in changes.items()]
    reading = source.read(overrides, measures, _library())
    if not reading.complete:
        raise NetlistError(_diagnostics(reading))
    return reading


def _scene(source, changes):
    scene = Scene(source, dict(changes), _read(source, changes))
    for diagnostic in scene.warnings:
        warnings.warn(diagnostic.text, NetlistWarning, stacklevel=3)
    return scene


def _run(reading, accuracy=None, certify=False, threads=1, progress=None):
    finest, coarsest = 1e-12, 0.1  # as core/netlist/simulate_table.cpp
    if accuracy is not None and not finest <= accuracy <= coarsest:
        raise ValueError(f"accuracy must be from 1e-12 to 0.1, but is {accuracy!r}")
    if threads < 1:
        raise ValueError(f"threads must be at least 1, but is {threads!r}")
    if progress is not None and not callable(progress):
        raise TypeError(f"progress must be a function of the fraction completed, but is {progress!r}")
    run = reading.run(accuracy, certify, threads, progress)
    result = Result(run, reading.units, reading.title)
    if run.failure is not None:
        raise SimulationError([Diagnostic(**run.failure)], result)
    return result


def _outcome(source, changes, paths, measures, accuracy, combination, progress=None):
    """A run of a sweep: its measures, or its Result."""
    changed = dict(zip(paths, combination))
    try:
        result = _run(_read(source, {**changes, **changed}, measures), accuracy, progress=progress)
    except (NetlistError, SimulationError) as error:
        error.add_note(f"in the run with {changed}")
        raise
    return result.summary["claims"] if measures else result


def _portable_outcome(*arguments):
    try:
        outcome = _outcome(*arguments)
    except SimulationError as error:
        portable = SimulationError(error.diagnostics, None)  # its rows stay where they are
        portable.__notes__ = error.__notes__
        raise portable from None
    return _parallel.Rows(outcome) if isinstance(outcome, Result) else outcome


def _diagnostics(reading):
    return [Diagnostic(**diagnostic) for diagnostic in reading.diagnostics]


def _library():
    """The folder that `include = ["library/..."]` falls back on: that of RHEONET_LIBRARY, of this package, or of the prefix that
    the package is installed in (PREFIX/lib/python3/dist-packages/rheonet)."""
    if chosen := os.environ.get("RHEONET_LIBRARY"):
        return [chosen]
    package = pathlib.Path(__file__).parent
    folders = [package / "netlists", *(parent / "share/rheonet/netlists" for parent in package.parents[3:4])]
    return [str(folder) for folder in folders if folder.is_dir()][:1]
