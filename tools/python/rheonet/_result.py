"""The rows of a run."""

import html
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from . import _pictures


class Event(NamedTuple):
    """A change of the mode of an element."""

    time: float  #: [s]
    element: str
    event: str  #: "stick", "slip", "reversal", ...
    direction: int  #: of the motion after the event, or of the jump of a signal: 1, -1, or 0 at rest


def free_name(name, taken):
    """A name of a dimension, coordinate or variable that no record in `taken` has. (No record is called "time".)"""
    while name in taken:
        name += "_"
    return name


def _result_again(scene, accuracy, time, columns, kept):
    return Result(scene._reading.run_with(time, columns), scene, accuracy, kept)


class Result(Mapping):
    """The rows of a run, as a mapping from records to arrays: `result["k1.force"]` is a read-only array with the value of the record
    at each time, in SI units. Arrays are views of memory that the result owns; they keep it alive. Call .copy() on one to change it."""

    __eq__ = object.__eq__  # two results are not compared value by value
    __hash__ = object.__hash__

    def __init__(self, run, scene, accuracy, kept):
        """Made by Scene.run(). `kept`: events, summary and certificate of a run in another process, or None."""
        self._run = run
        self._kept = kept
        self._scene = scene
        self._accuracy = accuracy
        self._units = scene.units
        self._columns = {name: k for k, name in enumerate(self._units)}

    @property
    def scene(self):
        """The Scene that was simulated."""
        return self._scene

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
        return [Event(*event) for event in (self._kept["events"] if self._kept else self._run.events)]

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
        return self._kept["summary"] if self._kept else self._run.summary

    @property
    def certificate(self):
        """None without `certify`. A dictionary: whether the accuracy "holds" for every record, the estimated "errors" of each
        record ("largest" in SI, its "time" [s], "relative" to the largest magnitude), the "obstacle" to a tighter run
        ("" if there was none), the number of "runs", and "cpu_seconds" of all of them."""
        return self._kept["certificate"] if self._kept else self._run.certificate

    def to_dataframe(self):
        """A pandas.DataFrame with a column for each record and the time as its index. attrs["units"] holds the units."""
        import pandas

        frame = pandas.DataFrame(dict(self), pandas.Index(self.time, name="time"))
        frame.attrs.update(title=self._scene.title, units=self.units)
        return frame

    def to_xarray(self):
        """An xarray.Dataset with a variable for each record over the dimension "time", and its unit in the attribute "units"."""
        import xarray

        variables = {name: ("time", self[name], {"units": unit}) for name, unit in self._units.items()}
        return xarray.Dataset(variables, {"time": ("time", self.time, {"units": "s"})}, {"title": self._scene.title})

    def plot(self, y=(), *, ax=None, **options):
        """Draws the rows as `rheonet plot` draws a CSV file with them. Scene.plot() simulates, and can draw upright jumps and other records.

        y: one or several records, over `x`. Without any curves the `[plot]` table of the netlist says what is drawn, or else all records are
            drawn over time.
        x: a record; "time" if not given.
        loop, flow, phase, decay: names of elements (`phase`: of nodes), one or several: force over displacement, force over velocity, velocity
            over position, magnitude of force over time.
        units: units of the axes: ["mm", "N"]. names: of the curves. title, x_label, y_label: texts.
        x_range, y_range: (low, high), in the units of the axes. log: "x", "y" or "xy". magnitudes: draws abs(y). marks: marks each row.
        size: (width, height) in px.
        ax: axes of matplotlib to draw on, in SI units; `units`, `names`, ranges and `size` are then those of matplotlib.

        Returns a Figure, which shows itself in Jupyter; or `ax`. Raises ValueError for curves that cannot be drawn: its text says why, and names
        the nearest record. What is left out is a warning.
        """
        options = _pictures.plot_options(y, **options)
        return _pictures.plot(self._run, self._scene.title or "the result", self._units, ax, options)

    def report(self, *others, title=None, certify=False, precision=False, progress=None):
        """The report of the scene, and of other scenes, simulated to the accuracy of this result: see Scene.report()."""
        return self._scene.report(*others, title=title, accuracy=self._accuracy, certify=certify, precision=precision, progress=progress)

    def __reduce__(self):
        kept = {"events": [tuple(event) for event in self.events], "summary": self.summary, "certificate": self.certificate}
        return _result_again, (self._scene, self._accuracy, np.array(self.time), [np.array(column) for column in self.values()], kept)

    def _repr_html_(self):
        """A table of the smallest, largest and last value of each record, for Jupyter."""
        head = "<tr><th>record</th><th>unit</th><th>smallest</th><th>largest</th><th>last</th></tr>"
        rows = "".join(
            f"<tr><td>{html.escape(name)}</td><td>{html.escape(self._units[name])}</td>"
            + "".join(f"<td>{value:.6g}</td>" for value in (values.min(), values.max(), values[-1]))
            + "</tr>"
            for name, values in (self.items() if len(self.time) else ())
        )
        return f"<table><caption>{html.escape(repr(self)[1:-1])}</caption><thead>{head}</thead><tbody>{rows}</tbody></table>"

    def __repr__(self):
        return f"<rheonet.Result {self._scene.title!r}: {len(self)} records, {len(self.time)} rows>"
