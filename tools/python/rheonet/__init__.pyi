# Types of the package for editors and type checkers; rheonet/__init__.py describes what each function does.

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple, NoReturn, Protocol, TypeVar, overload

import numpy as np
import numpy.typing as npt
import pandas
import xarray

__version__: str

_Value = str | bool | int | float | np.generic | npt.NDArray[Any] | Sequence[Any] | Mapping[str, Any]

class _Column(Protocol):  # a Series of pandas, a DataArray of xarray
    def __len__(self) -> int: ...
    def __iter__(self) -> Iterator[Any]: ...
    def __array__(self) -> npt.NDArray[Any]: ...

_Values = Sequence[_Value] | npt.NDArray[Any] | _Column
_Numbers = Sequence[float] | npt.NDArray[Any] | _Column
_Array = npt.NDArray[np.float64]
_Path = str | os.PathLike[str]
_Progress = Callable[[float], object] | None
_Texts = str | Sequence[str]

class _HasPlot(Protocol):
    def plot(self, *args: Any, **options: Any) -> Any: ...
    def set(self, **options: Any) -> Any: ...

_Axes = TypeVar("_Axes", bound=_HasPlot)  # of matplotlib

# Classes whose __init__ takes NoReturn are made by functions and methods, not by their names.

class Diagnostic(NamedTuple):
    severity: str
    file: str | None
    line: int | None
    column: int | None
    message: str
    hint: str
    text: str

class Event(NamedTuple):
    time: float
    element: str
    event: str
    direction: int

class _Located(Exception):
    def __init__(self, diagnostics: list[Diagnostic]) -> None: ...
    diagnostics: list[Diagnostic]
    file: str | None
    line: int | None
    column: int | None
    message: str
    hint: str

class NetlistError(_Located, ValueError): ...

class SimulationError(_Located, RuntimeError):
    def __init__(self, diagnostics: list[Diagnostic], result: Result | None) -> None: ...
    result: Result | None

class NetlistWarning(UserWarning): ...

def load(source: str | os.PathLike[str] | Mapping[str, Any], changes: Mapping[str, _Value] = ...) -> Scene: ...
def loads(text: str, changes: Mapping[str, _Value] = ..., name: str = ..., folder: str | os.PathLike[str] = ...) -> Scene: ...

class Scene:
    def __init__(self, source: NoReturn, changes: NoReturn, reading: NoReturn) -> None: ...
    def __copy__(self) -> Scene: ...
    def __deepcopy__(self, _: Any) -> Scene: ...
    @property
    def title(self) -> str: ...
    @property
    def start(self) -> float: ...
    @property
    def stop(self) -> float: ...
    @property
    def accuracy(self) -> float: ...
    @property
    def names(self) -> list[str]: ...
    @property
    def units(self) -> dict[str, str]: ...
    @property
    def warnings(self) -> list[Diagnostic]: ...
    def run(
        self,
        accuracy: float | None = ...,
        certify: bool = ...,
        threads: int = ...,
        progress: _Progress = ...,
    ) -> Result: ...
    def sweep(
        self,
        changes: Mapping[str, _Values],
        measure: str | Sequence[str] | None = ...,
        accuracy: float | None = ...,
        jobs: int | None = ...,
        client: Any = ...,
        on_error: Literal["nan", "raise"] = ...,
    ) -> xarray.Dataset: ...
    def sample(
        self,
        values: Mapping[str, str],
        count: int,
        measure: _Texts,
        kind: Literal["random", "latin", "sobol"] = ...,
        seed: int = ...,
        correlations: Mapping[tuple[str, str], float] = ...,
        accuracy: float | None = ...,
        jobs: int | None = ...,
        client: Any = ...,
        on_error: Literal["nan", "raise"] = ...,
    ) -> xarray.Dataset: ...
    def explain(self) -> dict[str, Any]: ...
    def compare(self, *others: Scene, pairs: Mapping[str, _Texts] = ..., progress: _Progress = ...) -> Comparison: ...
    def effects(self, runs: int = ..., progress: _Progress = ...) -> Effects: ...
    def precision(
        self,
        accuracies: _Numbers = ...,
        runs: int = ...,
        variants: bool = ...,
        certified: bool = ...,
        models: Mapping[str, Scene] = ...,
        pairs: Mapping[str, str] = ...,
        progress: _Progress = ...,
    ) -> Precision: ...
    def sensitivities(self, values: _Texts, accuracy: float | None = ..., progress: _Progress = ...) -> Sensitivities: ...
    @overload
    def plot(
        self,
        y: _Texts = ...,
        *,
        x: str = ...,
        loop: _Texts = ...,
        flow: _Texts = ...,
        phase: _Texts = ...,
        decay: _Texts = ...,
        units: _Texts = ...,
        names: _Texts = ...,
        title: str = ...,
        x_label: str = ...,
        y_label: str = ...,
        x_range: tuple[float, float] | None = ...,
        y_range: tuple[float, float] | None = ...,
        log: str = ...,
        magnitudes: bool = ...,
        marks: bool = ...,
        size: tuple[float, float] | None = ...,
        accuracy: float | None = ...,
        progress: _Progress = ...,
        ax: None = ...,
    ) -> Figure: ...
    @overload
    def plot(
        self,
        y: _Texts = ...,
        *,
        x: str = ...,
        loop: _Texts = ...,
        flow: _Texts = ...,
        phase: _Texts = ...,
        decay: _Texts = ...,
        units: _Texts = ...,
        names: _Texts = ...,
        title: str = ...,
        x_label: str = ...,
        y_label: str = ...,
        x_range: tuple[float, float] | None = ...,
        y_range: tuple[float, float] | None = ...,
        log: str = ...,
        magnitudes: bool = ...,
        marks: bool = ...,
        size: tuple[float, float] | None = ...,
        accuracy: float | None = ...,
        progress: _Progress = ...,
        ax: _Axes,
    ) -> _Axes: ...
    def report(
        self,
        *others: Scene,
        title: str | None = ...,
        accuracy: float | None = ...,
        certify: bool = ...,
        precision: bool = ...,
        progress: _Progress = ...,
    ) -> Report: ...

class Result(Mapping[str, _Array]):
    def __init__(self, run: NoReturn, scene: NoReturn, accuracy: NoReturn, kept: NoReturn) -> None: ...
    @property
    def scene(self) -> Scene: ...
    @property
    def time(self) -> _Array: ...
    @property
    def names(self) -> list[str]: ...
    @property
    def units(self) -> dict[str, str]: ...
    def __getitem__(self, name: str) -> _Array: ...
    def __iter__(self) -> Iterator[str]: ...
    def __len__(self) -> int: ...
    @property
    def events(self) -> list[Event]: ...
    @property
    def summary(self) -> dict[str, Any]: ...
    @property
    def certificate(self) -> dict[str, Any] | None: ...
    def to_dataframe(self) -> pandas.DataFrame: ...
    def to_xarray(self) -> xarray.Dataset: ...
    @overload
    def plot(
        self,
        y: _Texts = ...,
        *,
        x: str = ...,
        loop: _Texts = ...,
        flow: _Texts = ...,
        phase: _Texts = ...,
        decay: _Texts = ...,
        units: _Texts = ...,
        names: _Texts = ...,
        title: str = ...,
        x_label: str = ...,
        y_label: str = ...,
        x_range: tuple[float, float] | None = ...,
        y_range: tuple[float, float] | None = ...,
        log: str = ...,
        magnitudes: bool = ...,
        marks: bool = ...,
        size: tuple[float, float] | None = ...,
        ax: None = ...,
    ) -> Figure: ...
    @overload
    def plot(
        self,
        y: _Texts = ...,
        *,
        x: str = ...,
        loop: _Texts = ...,
        flow: _Texts = ...,
        phase: _Texts = ...,
        decay: _Texts = ...,
        units: _Texts = ...,
        names: _Texts = ...,
        title: str = ...,
        x_label: str = ...,
        y_label: str = ...,
        x_range: tuple[float, float] | None = ...,
        y_range: tuple[float, float] | None = ...,
        log: str = ...,
        magnitudes: bool = ...,
        marks: bool = ...,
        size: tuple[float, float] | None = ...,
        ax: _Axes,
    ) -> _Axes: ...
    def report(
        self,
        *others: Scene,
        title: str | None = ...,
        certify: bool = ...,
        precision: bool = ...,
        progress: _Progress = ...,
    ) -> Report: ...

class Figure:
    def __init__(self, svg: NoReturn) -> None: ...
    @property
    def svg(self) -> str: ...
    def save(self, path: _Path) -> None: ...

class Report:
    def __init__(self, text: NoReturn, failures: NoReturn) -> None: ...
    @property
    def html(self) -> str: ...
    @property
    def failures(self) -> list[str]: ...
    def save(self, path: _Path) -> None: ...

@dataclass(frozen=True)
class Difference:
    largest: float
    time: float
    first: float
    second: float
    rms: float
    scale: float
    relative: float
    relative_rms: float

class Comparison:
    def __init__(self, study: NoReturn, titles: NoReturn) -> None: ...
    @property
    def names(self) -> list[str]: ...
    @property
    def units(self) -> dict[str, str]: ...
    @property
    def differences(self) -> list[dict[str, Difference]]: ...
    @property
    def furthest(self) -> float: ...
    @property
    def dissipated(self) -> list[float]: ...
    def to_dataframe(self) -> pandas.DataFrame: ...
    def to_xarray(self) -> xarray.Dataset: ...

@dataclass(frozen=True)
class Model:
    without: tuple[str, ...]
    differences: dict[str, Difference]
    steps: int
    cpu_seconds: float
    failure: str
    @property
    def relative(self) -> float: ...

class Effects:
    def __init__(self, study: NoReturn, units: NoReturn) -> None: ...
    @property
    def effects(self) -> list[str]: ...
    @property
    def full(self) -> Model: ...
    @property
    def each(self) -> list[Model]: ...
    @property
    def steps(self) -> list[Model]: ...
    def barest(self, within: float = ...) -> Model | None: ...
    def to_dataframe(self) -> pandas.DataFrame: ...

@dataclass(frozen=True)
class Price:
    accuracy: float
    method: str
    order: int
    error: float
    record: str | None
    errors: dict[str, float]
    meets: bool
    cpu_seconds: float
    cpu_lower_quartile: float
    cpu_upper_quartile: float
    steps: int
    rejected_steps: int
    residual_evaluations: int
    jacobian_evaluations: int
    restarts: int
    failure: str

class Precision:
    def __init__(self, study: NoReturn) -> None: ...
    @property
    def prices(self) -> list[Price]: ...
    @property
    def cheapest(self) -> Price | None: ...
    @property
    def own(self) -> Price | None: ...
    @property
    def doubt(self) -> dict[str, float]: ...
    def to_dataframe(self) -> pandas.DataFrame: ...

class Sensitivities:
    def __init__(self, study: NoReturn, values: NoReturn, units: NoReturn, title: NoReturn) -> None: ...
    @property
    def values(self) -> list[str]: ...
    @property
    def units(self) -> dict[str, str]: ...
    @property
    def time(self) -> _Array: ...
    def __getitem__(self, name: str) -> _Array: ...
    def __iter__(self) -> Iterator[str]: ...
    def __len__(self) -> int: ...
    def __contains__(self, name: object) -> bool: ...
    def to_xarray(self) -> xarray.Dataset: ...
    def to_dataframe(self) -> pandas.DataFrame: ...
