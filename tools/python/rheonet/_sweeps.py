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

    runs = _Runs(scene, paths, combinations, measures, accuracy, jobs, client, on_error)
    if measures:
        variables = runs.measured(paths, shape)
    else:
        coordinates["time"] = ("time", runs.first.time, {"units": "s"})
        variables = runs.rows(paths, shape)
    return xarray.Dataset(variables | runs.errors(paths, shape, variables), coordinates, {"title": scene.title})


def sample(scene, values, count, measure, kind, seed, correlations, accuracy, jobs, client, on_error):
    import xarray

    if kind not in ("random", "latin", "sobol"):
        raise ValueError(f"kind must be 'random', 'latin' or 'sobol', but is {kind!r}")
    paths = list(_arguments.mapping("values", values, '{"k1.stiffness": "normal(1 N/mm, 5 %)"}'))
    measures = _measures(measure)
    if not measures or not paths:
        raise ValueError("a Monte Carlo needs a distribution of at least one value, and at least one measure")
    vary = [f"{path}={_arguments.text(f'the distribution of {path!r}', values[path])}" for path in paths]
    count, seed = _arguments.count("count", count), _arguments.count("seed", seed, least=0, most=2**64 - 1)
    points = _rheonet.drawn_points(vary, kind, count, seed, _arguments.correlations(correlations))
    coordinates = {path: coordinate("run", [point[k] for point in points]) for k, path in enumerate(paths)}
    coordinates["run"] = np.arange(1, len(points) + 1)

    runs = _Runs(scene, paths, points, measures, accuracy, jobs, client, on_error)
    variables = runs.measured(["run"], [len(points)])
    return xarray.Dataset(variables | runs.errors(["run"], [len(points)], variables), coordinates, {"title": scene.title})


def _measures(measure):
    return [] if measure is None else _arguments.texts("measure", measure, ["max(k1.force)"])


class _Runs:
    """The outcome of a run at each point: its measures, its rows, or the error that it failed with."""

    def __init__(self, scene, paths, points, measures, accuracy, jobs, client, on_error):
        if on_error not in ("nan", "raise"):
            raise ValueError(f"on_error must be 'nan' or 'raise', but is {on_error!r}")
        accuracy = _arguments.accuracy(accuracy)
        jobs = jobs if jobs is None else _arguments.count("jobs", jobs)
        if client is not None:
            _arguments.client(client)
        self._points, self._measures = points, measures
        settings = [tuple(map(setting, point)) for point in points]  # before any run: refuses what a netlist cannot hold
        items = list(zip(points, settings))
        run = functools.partial(_outcome, scene, paths, measures, accuracy, on_error == "raise", client is not None)
        self._outcomes = _parallel.in_threads(run, items, jobs) if client is None else _parallel.on_dask(client, run, items)
        failures = [outcome for outcome in self._outcomes if isinstance(outcome, Exception)]
        if len(failures) == len(points):
            if len(points) > 1:
                failures[0].add_note(f"and all other runs of {len(points)} failed as well")
            raise failures[0]
        if failures:
            place = self._outcomes.index(failures[0])
            warnings.warn(
                f"{len(failures)} of {len(points)} runs failed, as the one with {dict(zip(paths, points[place]))}: {failures[0].message}; "
                "the variable `error` has the reasons",
                RuntimeWarning,
                stacklevel=4,
            )
        self._failed = bool(failures)
        self.first = next(outcome for outcome in self._outcomes if not isinstance(outcome, Exception))

    def measured(self, dimensions, shape):
        def found(outcome, k):
            return np.nan if isinstance(outcome, Exception) else outcome[k]["found"]

        return {
            name: (dimensions, np.reshape([found(outcome, k) for outcome in self._outcomes], shape), {"units": self.first[k]["unit"]})
            for k, name in enumerate(self._measures)
        }

    def rows(self, dimensions, shape):
        time_of_first, units = self.first.time, self.first.units
        place_of_first = self._outcomes.index(self.first)
        for point, result in zip(self._points, self._outcomes):
            if isinstance(result, Exception):
                continue
            runs = f"the runs {self._points[place_of_first]} and {point}"
            if list(result.units.items()) != list(units.items()):
                raise ValueError(f"{runs} have different records; give `measure`")
            if not np.array_equal(result.time, time_of_first):
                raise ValueError(
                    f"the rows of {runs} are at different times; give `measure`, or let `simulate.output` and `simulate.stop` be the same in all runs"
                )
        nothing = np.full(len(time_of_first), np.nan)

        def rows_of(outcome, name):
            return nothing if isinstance(outcome, Exception) else outcome[name]

        return {
            name: (
                [*dimensions, "time"],
                np.reshape([rows_of(outcome, name) for outcome in self._outcomes], [*shape, len(time_of_first)]),
                {"units": unit},
            )
            for name, unit in units.items()
        }

    def errors(self, dimensions, shape, taken):
        """A variable with the reason why each run failed, if any did."""
        if not self._failed:
            return {}
        reasons = [outcome.message if isinstance(outcome, Exception) else "" for outcome in self._outcomes]
        return {free_name("error", taken): (dimensions, np.reshape(reasons, shape))}


def _outcome(scene, paths, measures, accuracy, raising, portable, item, progress=None):
    point, settings = item
    changes = {**scene._changes, **dict(zip(paths, settings))}
    reading = scene._source.read(_runs.overrides(changes), measures, _runs.folders_of_laws(), [], False)
    try:
        result = _runs.run(type(scene)(scene._source, changes, _runs.complete(reading)), accuracy, progress=progress)
    except (NetlistError, SimulationError) as error:
        if portable and isinstance(error, SimulationError):
            error.result = None  # its rows stay where they are
        error.add_note(f"in the run with {dict(zip(paths, point))}")
        if raising or (not reading.complete and _concerns_all(reading, list(changes), paths)):
            raise
        return error.with_traceback(None)
    if measures:
        return result.summary["claims"]
    return _parallel.Rows(result) if portable else result


def _concerns_all(reading, changed, paths):
    """Whether a mistake is one of every run: in the path of a varied value, in another change, or in a measure."""
    return any(
        in_path or not 0 <= place < len(changed) or changed[place] not in paths for place, in_path in reading.mistakes_in_changes
    )
