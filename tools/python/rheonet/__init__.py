"""Simulates 1-D mechanical networks: springs, dashpots, masses and friction along a line or about an axis.

    import rheonet

    scene = rheonet.load("pad.toml", {"pad.slip.coulomb": "2 N"})
    result = scene.run(accuracy=1e-8)
    result["pad.force"]     # NumPy array, one value for each time in result.time
    result.units            # {"plate.position": "m", "pad.force": "N"}

Every value is in SI units, as in the CSV files of the command `rheonet run`.
"""

import json
import warnings
from collections.abc import Mapping

from . import _arguments, _pictures, _rheonet, _runs, _sweeps
from ._errors import Diagnostic, NetlistError, NetlistWarning, SimulationError, diagnostics_of
from ._pictures import Figure, Report
from ._result import Event, Result
from ._studies import Comparison, Difference, Effects, Model, Precision, Price, Sensitivities
from ._values import setting, toml_of

__version__ = _rheonet.__version__
__all__ = [
    "Comparison", "Diagnostic", "Difference", "Effects", "Event", "Figure", "Model", "NetlistError", "NetlistWarning", "Precision",
    "Price", "Report", "Result", "Scene", "Sensitivities", "SimulationError", "load", "loads",
]  # fmt: skip
for _name in set(__all__) & set(globals()):
    globals()[_name].__module__ = __name__  # as messages and help() name it


def load(source, changes={}):
    """Reads a netlist.

    source: path of a TOML file, or the netlist as a dictionary of tables.
    changes: values in place of the netlist's, by path. Numbers are in SI; text is read as after `--set` of the command:
        {"k1.stiffness": "2 N/mm", "m1.mass": 0.5}.

    Raises NetlistError if the netlist has a mistake, TypeError for a value that a netlist cannot hold.
    """
    if isinstance(source, str) and "\n" in source:
        raise ValueError("load() takes the path of a file, or a dictionary: loads() reads a netlist from text")
    if isinstance(source, Mapping):
        return _scene(_rheonet.Source("<dictionary>", toml_of(source), "."), changes)
    return _scene(_rheonet.Source(_arguments.file("source", source), None, ""), changes)


def loads(text, changes={}, name="<text>", folder="."):
    """Reads a netlist from text. `name` stands for the file in messages; included files and tables are searched for in `folder`.
    The rest is as for load()."""
    source = _rheonet.Source(_arguments.text("name", name), _arguments.text("the netlist", text), _arguments.file("folder", folder))
    return _scene(source, changes)


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
        return diagnostics_of(self._reading)

    def run(self, accuracy=None, certify=False, threads=1, progress=None):
        """Simulates the scene.

        accuracy: allowed error of each record, relative to its largest magnitude in the run, from 1e-12 to 0.1; None: the netlist's.
        certify: estimates the error, and tightens until the accuracy is met: see Result.certificate. Costs at least two runs.
        threads: largest number of threads for independent parts of the scene.
        progress: called with the fraction of the run that is completed, at intervals of 20 ms and, if it was called at all, at the end
            with 1. An exception that it raises ends the run.

        Returns a Result. Raises SimulationError, or KeyboardInterrupt on Ctrl-C. The interpreter lock is released: runs in
        several Python threads use several processors.
        """
        return _runs.run(self, accuracy, certify, threads, progress)

    def sweep(self, changes, measure=None, accuracy=None, jobs=None, client=None, on_error="nan"):
        """Simulates the scene for all combinations of values.

        changes: the values of each parameter, by path: {"k1.stiffness": ["1 N/mm", "2 N/mm"], "m1.mass": [0.1, 1, 10]}.
        measure: figures of each run in place of its rows, as after `--measure` of the command: ["max(k1.force)"].
        accuracy: as for run().
        jobs: number of runs at a time; None: one for each processor.
        client: a dask.distributed.Client, on whose workers the runs are simulated. They get the files as they were when the scene was loaded;
            files that only some values name they have to find themselves.
        on_error: "nan" for NaN where a run cannot be read or simulated, with a RuntimeWarning and the reasons in the variable "error";
            "raise" to raise the error of the run that fails first in time.

        Returns an xarray.Dataset with a dimension and a coordinate for each parameter: numbers if all values have one unit (in
        the attribute "units"; absent for numbers and expressions without a unit, which are SI), else text. It holds either the measures, or
        the records with the further dimension "time". Raises NetlistError for mistakes that concern all runs, NetlistError and SimulationError if
        all runs fail, and ValueError if the rows of two runs are at different times.
        """
        return _sweeps.sweep(self, changes, measure, accuracy, jobs, client, on_error)

    def sample(self, values, count, measure, kind="random", seed=1, correlations={}, accuracy=None, jobs=None, client=None,
               on_error="nan"):  # fmt: skip
        """Simulates the scene at points that are drawn from distributions: a Monte Carlo.

        values: the distribution of each value, by path, as after `--vary` of the command: {"k1.stiffness": "normal(1 N/mm, 5 %)",
            "s1.coulomb": "lognormal(1 N, 0.1)", "m1.mass": "1 kg:2 kg"} (uniform; "1 kg:2 kg:log" in the logarithm).
        count: number of points.
        measure: figures of each run, as for sweep().
        kind: "random" for independent points, "latin" for a Latin hypercube, "sobol" for Sobol's sequence.
        seed: the same seed draws the same points, those of the command.
        correlations: coefficients for pairs of normal scores: {("k1.stiffness", "s1.coulomb"): 0.5}.
        accuracy, jobs, client, on_error: as for sweep().

        Returns an xarray.Dataset over the dimension "run", with the values as coordinates. Raises ValueError for a distribution that cannot be
        read, and otherwise what sweep() raises.
        """
        return _sweeps.sample(self, values, count, measure, kind, seed, correlations, accuracy, jobs, client, on_error)

    def explain(self):
        """What will be simulated, and why: what `rheonet explain --json` prints, as a dictionary. Raises SimulationError, without a
        `result`, for a scene that cannot start."""
        return json.loads(self._reading.explain())

    def compare(self, *others, pairs={}, progress=None):
        """Simulates this scene and others on one time base, that of this scene as far as the shortest run goes, and takes the differences.

        others: one or more scenes.
        pairs: records that the scenes call otherwise, {"k1.force": "m.spring1.force"}: the record of this scene, and that of the other ones,
            or a list with one for each. Then only these are compared. Without it all records of the same name are compared.
        progress: as for run().

        Returns a Comparison. Raises ValueError for scenes that cannot be compared: of translation and of rotation, say, or with
        records that are different quantities. Raises NetlistError for a pair that names nothing, and SimulationError.
        """
        if not others:
            raise TypeError("compare() takes at least one other scene")
        _check_scenes(others)
        scenes = [self, *others]
        _arguments.mapping("pairs", pairs, '{"k1.force": "m.spring1.force"}')
        pairs = {own: _arguments.texts("pairs", other, "m.spring1.force") if not isinstance(other, str) else other for own, other in pairs.items()}
        pairings = [[own, *([other] * len(others) if isinstance(other, str) else other)] for own, other in pairs.items()]
        for pairing in pairings:
            if len(pairing) != len(scenes):
                raise ValueError(f"`pairs` names {len(pairing)} records of {pairing[0]!r} for {len(scenes)} scenes")
        readings = [scene._read_again(records=[pairing[k] for pairing in pairings]) for k, scene in enumerate(scenes)]
        return Comparison(_rheonet.Comparison(readings, pairings, _arguments.progress(progress)), [scene.title for scene in scenes])

    def effects(self, runs=5, progress=None):
        """Leaves out each physical effect (inertia, friction, ...) alone, then more and more of them together, and simulates each of these models.

        runs: timed runs of each model, at least 1.
        progress: as for run().

        Returns Effects: the change of every record, and the cost. Raises SimulationError if the full model cannot be simulated.
        """
        return Effects(_rheonet.Effects(self._read_again(), _arguments.count("runs", runs), _arguments.progress(progress)), self.units)

    def precision(self, accuracies=(), runs=5, variants=False, certified=False, models={}, pairs={}, progress=None):
        """Simulates the scene to several accuracies, and measures error and cost of each run.

        accuracies: from 1e-12 to 0.1; empty: 1e-2, 1e-3, ... 1e-11. The scene's own accuracy is always among them.
        runs: timed runs of each, at least 1.
        variants: also lower orders of the method, events not located, reductions switched off, smoothed sliders.
        certified: also certified runs, with the cost of all runs that the certificate takes.
        models: other scenes that describe the same, by name: their errors against this scene are errors of modelling.
        pairs: records that the models call otherwise, {"k1.force": "m.spring1.force"}.
        progress: as for run().

        Returns Precision. Raises SimulationError if the reference run fails, ValueError for models that cannot be compared.
        """
        _check_scenes(_arguments.mapping("models", models, '{"thick oil": scene}').values())
        unique = sorted(set(_arguments.accuracies(accuracies)), reverse=True)
        for record, other in _arguments.mapping("pairs", pairs, '{"k1.force": "m.spring1.force"}').items():
            _arguments.text(f"the pair of {record!r}", other)
            if record not in self.units:
                raise ValueError(f"`pairs` names {record!r}, which the scene does not record")
        runs, variants, certified = _arguments.count("runs", runs), _arguments.flag("variants", variants), _arguments.flag("certified", certified)
        records = [pairs.get(record, record) for record in self.names]
        others = [(name, model._read_again(records=records)) for name, model in models.items()]
        of_models = [records] * len(others)
        return Precision(
            _rheonet.Precision(self._read_again(), unique, runs, variants, certified, others, of_models, _arguments.progress(progress))
        )

    def sensitivities(self, values, accuracy=None, progress=None):
        """Differentiates every record by values of the netlist, across events too, as `rheonet run --sensitivities` does.

        values: the path of a value, or a list of them: "k1.stiffness", "parameters.mu".
        accuracy: as for run(); runs are more accurate where the derivatives need it.
        progress: as for run(), called with the share of the runs that are done.

        Returns Sensitivities. Raises NetlistError for a path without a value that can be multiplied, SimulationError, also where a derivative
        does not exist because any change of the value leads to other events.
        """
        accuracy, progress = _arguments.accuracy(accuracy), _arguments.progress(progress)
        paths = _arguments.texts("values", values, ["k1.stiffness"])
        if not paths:
            raise ValueError("sensitivities() takes the path of at least one value")
        overrides, library = _runs.overrides(self._changes), _runs.folders_of_laws()
        for path in paths:
            _runs.complete(self._source.read([*overrides, f"{path}*=1"], [], library, [], False))
        study = _rheonet.Sensitivities(self._source, overrides, library, paths, accuracy, progress)
        return Sensitivities(study, paths, self.units, self.title)

    def plot(self, y=(), *, accuracy=None, progress=None, ax=None, **options):
        """Simulates the scene and draws it as `rheonet plot` does, with upright jumps. `y` and `options` are those of Result.plot(), but may name
        everything that can be recorded. Returns a Figure, or `ax`.

        Raises NetlistError for a record that the scene cannot have, ValueError for curves that cannot be drawn, SimulationError."""
        options = _pictures.plot_options(y, **options)
        records = _rheonet.records_to_plot(**options)
        reading = self._read_again(records=records, plotted=not records)
        result = _runs.run(Scene(self._source, self._changes, reading), accuracy, progress=progress, both_sides=True)
        return _pictures.plot(result._run, self._source.file, result.units, ax, options)

    def report(self, *others, title=None, accuracy=None, certify=False, precision=False, progress=None):
        """Simulates the scene, and others beside it, and makes one page of them, as `rheonet report` does: schematic, equations, plots to zoom
        into, energy account, events.

        title: of the page; None: that of the scene.
        accuracy: as for run().
        certify: also how accurate the result is.
        precision: also what accuracy costs.
        progress: as for run(), called with the share of the scenes that are done; the simulations of one scene are not divided.

        Returns a Report. Raises RuntimeError if rheonet was built without the web pages, SimulationError if the scene is to be certified and
        cannot be simulated. A run that ends early is shown up to there: see Report.failures.
        """
        accuracy, progress = _arguments.accuracy(accuracy), _arguments.progress(progress)
        certify, precision = _arguments.flag("certify", certify), _arguments.flag("precision", precision)
        _check_scenes(others)
        scenes = [self, *others]
        readings = [scene._read_again(plotted=True, measures=None) for scene in scenes]
        heading = _arguments.text("title", title) if title is not None else self.title or self._source.file
        return Report(*_rheonet.report(readings, accuracy, heading, certify, precision, progress))

    def _read_again(self, records=(), plotted=False, measures=()):
        """Without the claims of the netlist, unless `measures` is None: they are about the scene as it stands, alone."""
        return _runs.read(self._source, self._changes, measures, records, plotted)

    def _repr_html_(self):
        """The schematic, for Jupyter; None if the network is too large to be drawn."""
        svg = self._reading.schematic()
        return svg and _pictures.image(svg, f"schematic of {self.title or self._source.file}")

    def __reduce__(self):
        """A copy in another process has the texts of the files as they were when the scene was loaded."""
        return _scene_again, (self._source, self._changes)

    def __copy__(self):
        return self

    def __deepcopy__(self, _):
        return self

    def __repr__(self):
        return f"<rheonet.Scene {self.title or self._source.file!r}: {len(self.names)} records, {self.start:g} s to {self.stop:g} s>"


def _scene_again(source, changes):
    return Scene(source, changes, _runs.read(source, changes))


def _scene(source, changes):
    _arguments.mapping("changes", changes, '{"k1.stiffness": "2 N/mm"}')
    changes = {path: setting(value) for path, value in changes.items()}  # text: a list or an array may change later
    scene = _scene_again(source, changes)
    for diagnostic in scene.warnings:
        warnings.warn(diagnostic.text, NetlistWarning, stacklevel=3)
    return scene


def _check_scenes(scenes):
    for scene in scenes:
        if not isinstance(scene, Scene):
            raise TypeError(f"expected a Scene, made by load() or loads(), found {scene!r}")
