"""The results of the commands `compare`, `effects` and `precision` as data."""

import dataclasses

from . import _arguments
from ._result import free_name


@dataclasses.dataclass(frozen=True)
class Difference:
    """The difference between a record in two runs. All values are in SI units."""

    largest: float  #: largest magnitude of the difference
    time: float  #: time of the largest difference [s]
    first: float  #: the value of the first run at that time
    second: float  #: the value of the other run at that time
    rms: float  #: root mean square
    scale: float  #: largest magnitude of either record in the run: the reference of relative differences
    relative: float  #: largest / scale
    relative_rms: float  #: rms / scale


class _Study:
    def __reduce__(self):
        name = type(self).__name__
        tables = " or ".join(f"{table}()" for table in ("to_xarray", "to_dataframe") if hasattr(self, table))
        raise TypeError(f"a {name} cannot be pickled or copied: use what its {tables} returns")


def _frame(rows, **attributes):
    import pandas

    frame = pandas.DataFrame(rows)
    frame.attrs.update(attributes)
    return frame


class Comparison(_Study):
    """Scenes on one time base, and how far each is from the first. str() of it is what `rheonet compare` prints."""

    def __init__(self, study, titles):
        """Made by Scene.compare()."""
        self._study, self._titles = study, titles
        self._pairings = study.pairings

    @property
    def names(self):
        """The records that are compared, as the first scene calls them."""
        return [pairing[0] for pairing in self._pairings]

    @property
    def units(self):
        """The SI unit of each of `names`."""
        return dict(zip(self.names, self._study.units))

    @property
    def differences(self):
        """For each scene but the first a dictionary from `names` to Difference."""
        return [{name: Difference(**found) for name, found in zip(self.names, of_scene)} for of_scene in self._study.differences]

    @property
    def furthest(self):
        """The largest relative difference of all records and scenes."""
        return max(difference.relative for of_scene in self.differences for difference in of_scene.values())

    @property
    def dissipated(self):
        """The energy that each scene dissipates [J]."""
        return self._study.dissipated

    def to_dataframe(self):
        """A pandas.DataFrame with a row for each scene but the first and each record: "scene" (its place, from 1), "record" (its name in that
        scene), "unit", and the attributes of Difference. The index is the record of the first scene."""
        rows = [
            {"compared": pairing[0], "scene": place, "record": pairing[place], "unit": self.units[pairing[0]]} | dataclasses.asdict(of_scene[pairing[0]])
            for place, of_scene in enumerate(self.differences, 1)
            for pairing in self._pairings
        ]
        return _frame(rows).set_index("compared")

    def to_xarray(self):
        """An xarray.Dataset with a variable for each of `names` over the dimensions "scene" and "time": all rows of all scenes. A
        record of such a name keeps it: the dimension is then called "scene_"."""
        import xarray

        scene, title = free_name("scene", self.names), free_name("title", self.names)
        variables = {name: ((scene, "time"), self._study.rows(k), {"units": self.units[name]}) for k, name in enumerate(self.names)}
        coordinates = {"time": ("time", self._study.time, {"units": "s"}), title: (scene, self._titles)}
        return xarray.Dataset(variables, coordinates)

    def __str__(self):
        return self._study.text

    def __repr__(self):
        return f"<rheonet.Comparison: {len(self._titles)} scenes, {len(self.names)} records, relative difference up to {self.furthest:.3g}>"


@dataclasses.dataclass(frozen=True)
class Model:
    """A scene without some of its effects."""

    without: tuple[str, ...]  #: the effects that are left out, in the order of leaving out
    differences: dict[str, Difference]  #: of each record, from the full model; empty if the model cannot be simulated
    steps: int
    cpu_seconds: float  #: median of the runs
    failure: str  #: why the model cannot be simulated; "" if it can

    @property
    def relative(self):
        """The largest relative difference of all records from the full model; NaN if the model cannot be simulated."""
        if self.failure:
            return float("nan")
        return max((difference.relative for difference in self.differences.values()), default=0.0)


def _model(found):
    return Model(**found | {"differences": {record: Difference(**values) for record, values in found["differences"].items()}})


class Effects(_Study):
    """The contribution of each physical effect to the records of a scene. str() of it is the output of `rheonet effects`."""

    def __init__(self, study, units):
        """Made by Scene.effects()."""
        self._study, self._units = study, units

    @property
    def effects(self):
        """The effects in the scene: ["inertia", "friction", ...]."""
        return self._study.effects

    @property
    def full(self):
        """The full Model."""
        return _model(self._study.full)

    @property
    def each(self):
        """For each of `effects` the Model without that one alone."""
        return [_model(model) for model in self._study.each]

    @property
    def steps(self):
        """A list of Model, each without one effect more than the last: first those that contribute least."""
        return [_model(model) for model in self._study.steps]

    def barest(self, within=0.01):
        """The Model with the fewest effects of which no record differs from the full model by more than `within` times its largest
        magnitude; None if no effect can be left out."""
        place = self._study.barest(_arguments.number("within", within))
        return None if place is None else self.steps[place]

    def to_dataframe(self):
        """A pandas.DataFrame with a row for each model and record: "without", "record", "unit", the attributes of Difference, "cpu_seconds",
        "steps" and "failure". A model that cannot be simulated has one row, without a record."""
        models = [self.full, *self.each, *(model for model in self.steps if len(model.without) > 1)]
        nothing = dict.fromkeys((field.name for field in dataclasses.fields(Difference)), float("nan"))
        rows = [
            {"without": " ".join(model.without), "record": record, "unit": self._units.get(record, "")}
            | (dataclasses.asdict(difference) if difference else nothing)
            | {"cpu_seconds": model.cpu_seconds, "steps": model.steps, "failure": model.failure}
            for model in models
            for record, difference in (model.differences or {"": None}).items()
        ]
        return _frame(rows)

    def __str__(self):
        return self._study.text(None)

    def __repr__(self):
        return f"<rheonet.Effects: {', '.join(self.effects) or 'none'}>"


@dataclasses.dataclass(frozen=True)
class Price:
    """Cost and error of a run with one setting."""

    accuracy: float
    method: str  #: "order up to 5", "exact arcs", or the name of a model
    order: int  #: largest order of the integration method
    error: float  #: largest error of all records, relative to the largest magnitude of the record
    record: str | None  #: the record with that error
    errors: dict[str, float]  #: relative error of each record
    meets: bool  #: every record is as accurate as the scene asks
    cpu_seconds: float  #: median of the runs
    cpu_lower_quartile: float
    cpu_upper_quartile: float
    steps: int
    rejected_steps: int
    residual_evaluations: int
    jacobian_evaluations: int
    restarts: int
    failure: str  #: why the run ended early; "" if it did not. The figures above are void then


class Precision(_Study):
    """What accuracy costs in a scene. str() of it is what `rheonet precision` prints."""

    def __init__(self, study):
        """Made by Scene.precision()."""
        self._study = study

    @property
    def prices(self):
        """A list of Price: by method, then from the loosest accuracy to the tightest."""
        return [Price(**price) for price in self._study.prices]

    @property
    def cheapest(self):
        """The Price with the least CPU time that meets the accuracy of the scene; None if none does."""
        place = self._study.cheapest
        return None if place is None else self.prices[place]

    @property
    def own(self):
        """The Price of the scene's own accuracy; None if that run failed."""
        place = self._study.own
        return None if place is None else self.prices[place]

    @property
    def doubt(self):
        """For each record, how well the reference is known by which errors are measured, relative to the largest magnitude. 0 for a record with
        a closed form. Errors below twice this figure are not known."""
        return self._study.doubt

    def to_dataframe(self):
        """A pandas.DataFrame with a row for each of `prices`, and a column for each attribute but `errors`, of which each record has a
        column "error RECORD"."""
        rows = []
        for price in self.prices:
            row = dataclasses.asdict(price)
            rows.append(row | {f"error {record}": error for record, error in row.pop("errors").items()})
        return _frame(rows)

    def __str__(self):
        return self._study.text

    def __repr__(self):
        return f"<rheonet.Precision: {len(self.prices)} prices>"


class Sensitivities(_Study):
    """How the records of a scene change with values of its netlist. All derivatives are p dr/dp, with the value p and the record r: they have
    the unit of r, and 1 % more of p changes r by a hundredth of them. str() of it is the table that `rheonet run --sensitivities` prints."""

    def __init__(self, study, values, units, title):
        """Made by Scene.sensitivities()."""
        self._study, self._values, self._units, self._title = study, values, units, title

    @property
    def values(self):
        """The paths of the values."""
        return list(self._values)

    @property
    def units(self):
        """The SI unit of each record, and of its derivatives."""
        return dict(self._units)

    @property
    def time(self):
        """Times of the rows [s]: an array of shape (rows,)."""
        return self._study.time

    def __getitem__(self, name):
        """The derivatives of a record by each of `values`: an array of shape (values, rows). Raises KeyError if `name` was not recorded."""
        if name not in self._units:
            raise KeyError(f"{name!r} was not recorded; recorded: {', '.join(self._units)}")
        return self._study.rows(list(self._units).index(name))

    def __iter__(self):
        """The names of the records."""
        return iter(self._units)

    def __len__(self):
        """The number of records."""
        return len(self._units)

    def __contains__(self, name):
        return name in self._units

    def to_xarray(self):
        """An xarray.Dataset with a variable for each record over the dimensions "value" and "time" ("value_" if a record has
        that name)."""
        import xarray

        value = free_name("value", self._units)
        variables = {name: ((value, "time"), self[name], {"units": unit}) for name, unit in self._units.items()}
        return xarray.Dataset(variables, {value: self._values, "time": ("time", self.time, {"units": "s"})}, {"title": self._title})

    def to_dataframe(self):
        """A pandas.DataFrame with a row for each value and record: "value", "record", "unit", the "largest" magnitude of the derivative, its
        "time" [s], and the estimated "error" of the derivative."""
        rows = [
            {"value": value, "record": record, "unit": unit, "largest": largest, "time": time, "error": error}
            for value, of_value in zip(self._values, self._study.largest)
            for (record, unit), (largest, time, error) in zip(self._units.items(), of_value)
        ]
        return _frame(rows)

    def __str__(self):
        return self._study.text

    def __repr__(self):
        return f"<rheonet.Sensitivities: {len(self._units)} records by {', '.join(self._values)}>"
