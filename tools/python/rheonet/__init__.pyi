# Types of the package for editors and type checkers; rheonet/__init__.py describes what each function does.

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
import pandas
import xarray

__version__: str

_Value = str | bool | int | float | Sequence[Any] | Mapping[str, Any]
_Array = npt.NDArray[np.float64]

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
    diagnostics: list[Diagnostic]
    file: str | None
    line: int | None
    column: int | None
    message: str
    hint: str

class NetlistError(_Located, ValueError): ...

class SimulationError(_Located, RuntimeError):
    result: Result | None

class NetlistWarning(UserWarning): ...

def load(source: str | os.PathLike[str] | Mapping[str, Any], changes: Mapping[str, _Value] = ...) -> Scene: ...
def loads(text: str, changes: Mapping[str, _Value] = ..., name: str = ..., folder: str | os.PathLike[str] = ...) -> Scene: ...

class Scene:
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
        progress: Callable[[float], object] | None = ...,
    ) -> Result: ...
    def sweep(
        self,
        changes: Mapping[str, Sequence[_Value]],
        measure: str | Sequence[str] | None = ...,
        accuracy: float | None = ...,
        jobs: int | None = ...,
        client: Any = ...,
    ) -> xarray.Dataset: ...
    def explain(self) -> dict[str, Any]: ...

class Result(Mapping[str, _Array]):
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
