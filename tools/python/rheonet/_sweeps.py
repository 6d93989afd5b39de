"""Runs of a scene for many values, as a data set."""

import functools
import itertools
import warnings

import numpy as np

from . import _arguments, _parallel, _rheonet, _runs
from ._errors import NetlistError, SimulationError, diagnostics_of
from ._result import free_name
from ._values import coordinate, setting


def sweep(scene, changes, measure, accuracy, jobs, client, on_error):
    import xarray

    paths = list(_arguments.mapping("changes", changes, '{"k1.stiffness": ["1 N/mm", "2 N/mm"]}'))
    values = [_arguments.values(path, changes[path]) for path in paths]
    shape = [len(axis) for axis in values]
    measures = _measures(measure)
    combinations = list(itertools.product(*values))
    if not combinations:
        raise ValueError("a sweep needs at least one value of each parameter")
    coordinates = {path: coordinate(path, axis) for path, axis in zip(paths, values)}

    for value in itertools.chain(*values):
        setting(value)  # refuses, before any run, what a netlist cannot hold

    runs = _Runs(scene, paths, combinations, measures, accuracy, jobs, client, on_error)
    if measures:
        variables = runs.measured(paths, shape)
    else:
        times, variables = runs.rows(paths, shape)
        coordinates["time"] = ("time", times, {"units": "s"})
    return xarray.Dataset(variables | runs.errors(paths, shape, variables), coordinates, {"title": scene.title})


def sample(scene, values, count, measure, kind, seed, correlations, accuracy, jobs, client, on_error):
    import xarray

    if kind not in ("random", "latin", "sobol"):
        raise ValueError(f"kind must be 'random', 'latin' or 'sobol', but is {kind!r}")
    paths = list(_arguments.mapping("values", values, '{"k1.stiffness": "normal(1 N/mm, 5 %)"}'))
    measures = _measures(measure)
    if not measures or not paths:
        raise ValueError("a Monte Carlo needs a distribution of at least one value, and at least one measure")
    vary = [f"{path}={_arguments.text(f'the distribution of {path!r}', values[path]).strip()}" for path in paths]
    count, seed = _arguments.count("count", count), _arguments.count("seed", seed, least=0, most=10**9)
    points = _rheonet.DrawnPoints(vary, kind, count, seed, _arguments.correlations(correlations))
    coordinates = {path: _drawn(points, k) for k, path in enumerate(paths)}
    coordinates["run"] = np.arange(1, len(points) + 1)

    runs = _Runs(scene, paths, points, measures, accuracy, jobs, client, on_error)
    variables = runs.measured(["run"], [len(points)])
    return xarray.Dataset(variables | runs.errors(["run"], [len(points)], variables), coordinates, {"title": scene.title})


def _drawn(points, place):
    """The coordinate of a drawn value, from one block of points after the other, because texts need more memory than numbers."""
    blocks = [coordinate("run", [point[place] for point in points[first : first + 4096]]) for first in range(0, len(points), 4096)]
    if any(block[2:] != blocks[0][2:] or isinstance(block[1][0], str) for block in blocks):
        return coordinate("run", [point[place] for point in points])
    return ("run", np.concatenate([block[1] for block in blocks]), *blocks[0][2:])


def _measures(measure):
    return [] if measure is None else _arguments.texts("measure", measure, ["max(k1.force)"])


class _Runs:
    """The outcome of a run at each point: its measures, its rows, or the reason why it failed."""

    def __init__(self, scene, paths, points, measures, accuracy, jobs, client, on_error):
        if on_error not in ("nan", "raise"):
            raise ValueError(f"on_error must be 'nan' or 'raise', but is {on_error!r}")
        accuracy = _arguments.accuracy(accuracy)
        jobs = jobs if jobs is None else _arguments.count("jobs", jobs)
        if client is not None:
            _arguments.client(client)
        self._points, self._measures = points, measures
        self._found = np.full((len(measures), len(points)), np.nan)
        self._kept = None  # the number of a run that is kept, its units and, of rows, their times: those of all
        self._results = {}
        self._reasons = {}
        self._first_failure = None  # the number and the error of the first run that failed
        run = functools.partial(_outcome, scene, paths, measures, accuracy, on_error == "raise", client is not None)
        if client is None:
            _parallel.in_threads(run, points, jobs, self._keep)
        else:
            _parallel.on_dask(client, run, points, self._keep)
        self._tell_failures(paths)

    def _keep(self, number, outcome):
        if isinstance(outcome, Exception):
            if self._first_failure is None or number < self._first_failure[0]:
                self._first_failure = number, outcome  # of the others only the message is kept, for an error may hold rows
            self._reasons[number] = outcome.message
        elif self._measures:
            self._compare(number, {name: claim["unit"] for name, claim in zip(self._measures, outcome)})
            self._found[:, number] = [claim["found"] for claim in outcome]
        else:
            self._compare(number, outcome.units, outcome.time)
            self._results[number] = outcome

    def _compare(self, number, units, times=()):
        """Raises an error if a run does not fit in a data set with another one."""
        if self._kept is None:
            self._kept = number, units, times
        first, units_of_first, times_of_first = self._kept
        if list(units.items()) == list(units_of_first.items()) and np.array_equal(times, times_of_first):
            return
        runs = "the runs {} and {}".format(*(self._points[place] for place in sorted((first, number))))
        if list(units) != list(units_of_first):
            raise ValueError(f"{runs} have different records; give `measure`")
        for name, unit in units.items():
            if unit != units_of_first[name]:
                raise ValueError(f"{name!r} has the unit {units_of_first[name]} in one of {runs}, and {unit} in the other")
        raise ValueError(
            f"the rows of {runs} are at different times; give `measure`, or let `simulate.output` and `simulate.stop` be the same in all runs"
        )

    def _tell_failures(self, paths):
        if not self._reasons:
            return
        number, error = self._first_failure
        if len(self._reasons) == len(self._points):
            if len(self._points) > 1:
                error.add_note(f"and all other runs of {len(self._points)} failed as well")
            raise error
        warnings.warn(
            f"{len(self._reasons)} of {len(self._points)} runs failed, as the one with {dict(zip(paths, self._points[number]))}: "
            f"{error.message}; the variable `error` has the reasons",
            RuntimeWarning,
            stacklevel=5,
        )

    def measured(self, dimensions, shape):
        _, units, _ = self._kept
        return {name: (dimensions, np.reshape(found, shape), {"units": units[name]}) for name, found in zip(self._measures, self._found)}

    def rows(self, dimensions, shape):
        """The times of the rows, and a variable for each record."""
        _, units, times = self._kept
        variables = {}
        for name, unit in units.items():
            values = np.full((len(self._points), len(times)), np.nan)
            for place, result in self._results.items():
                values[place] = result[name]
            # A varied signal may be a record as well: "push.force".
            attributes = {"units": unit} | ({"long_name": name} if name in dimensions else {})
            variables[free_name(name, dimensions)] = ([*dimensions, "time"], np.reshape(values, [*shape, len(times)]), attributes)
        return times, variables

    def errors(self, dimensions, shape, taken):
        """A variable with the reason why each run failed, if any did."""
        if not self._reasons:
            return {}
        reasons = np.full(len(self._points), "", dtype=object)  # not of a fixed width, which each run would take
        reasons[list(self._reasons)] = list(self._reasons.values())
        return {free_name("error", taken): (dimensions, np.reshape(reasons, shape))}


def _outcome(scene, paths, measures, accuracy, raising, portable, point, progress=None):
    kept = {path: value for path, value in scene._changes.items() if path not in paths}  # a varied value comes after all others
    changes = {**kept, **dict(zip(paths, map(setting, point)))}
    reading = scene._source.read(_runs.overrides(changes), measures, _runs.folders_of_laws(), [], False)
    try:
        result = _runs.run(type(scene)(scene._source, changes, _runs.complete(reading)), accuracy, progress=progress)
    except (NetlistError, SimulationError) as error:
        if portable and isinstance(error, SimulationError):
            error.result = None  # its rows stay where they are
        error.add_note(f"in the run with {dict(zip(paths, point))}")
        if raising or (not reading.complete and _concerns_all(scene, reading, measures, list(changes), paths)):
            raise
        return error.with_traceback(None)
    if measures:
        return result.summary["claims"]
    return _parallel.Rows(result) if portable else result


def _concerns_all(scene, reading, measures, changed, paths):
    """Whether a mistake is one of every run: in the path of a varied value, in another change, or in a measure of the scene itself."""
    for place, in_path in reading.mistakes_in_changes:
        in_measure = not 0 <= place < len(changed)
        if in_measure:
            as_loaded = scene._source.read(_runs.overrides(scene._changes), measures, _runs.folders_of_laws(), [], False)
            if not as_loaded.complete:
                return True
        elif in_path or changed[place] not in paths:
            return True
    return False
