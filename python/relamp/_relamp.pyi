import os
from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple, Union

import numpy.typing as npt

_Array = npt.NDArray[Any]
_Path = Union[str, "os.PathLike[str]"]
_Watcher = Callable[[str, float], object]

__version__: str
DOUBTS: Tuple[str, ...]
ALL_LIGHT: int

class Error(RuntimeError): ...

class Scan:
    def __init__(
        self,
        positions: _Array,
        triangles: _Array,
        uv: _Array,
        texture: _Array,
        *,
        name: str = ...,
        up: str = ...,
        scale: float = ...,
    ) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def file(self) -> os.PathLike[str]: ...
    @property
    def warnings(self) -> List[str]: ...
    @property
    def triangle_count(self) -> int: ...
    @property
    def page_count(self) -> int: ...

def read_scan(
    file: _Path,
    *,
    up: str = ...,
    scale: float = ...,
    transfer: str = ...,
    skip_mesh: Sequence[str] = ...,
    allow_outside: bool = ...,
    allow_overlap: bool = ...,
    longest_side: int = ...,
    progress: Optional[_Watcher] = ...,
) -> Scan: ...

class Lights:
    @property
    def fixtures(self) -> List[Dict[str, Any]]: ...
    @property
    def sun(self) -> Optional[Dict[str, Any]]: ...
    @property
    def ambient(self) -> Tuple[float, float, float]: ...
    def to_json(self) -> str: ...

class Decomposition:
    @property
    def lights(self) -> Lights: ...
    @property
    def page_count(self) -> int: ...
    @property
    def name(self) -> str: ...
    @property
    def warnings(self) -> List[str]: ...
    @property
    def cross_validation(self) -> Dict[str, Any]: ...
    @property
    def openings(self) -> List[Dict[str, Any]]: ...
    @property
    def camera(self) -> Dict[str, Any]: ...
    def layers(self, page: int, threads: int, progress: Optional[_Watcher]) -> Dict[str, _Array]: ...
    def fixtures(self, page: int, threads: int) -> _Array: ...
    def correction(self, page: int, threads: int) -> Optional[_Array]: ...
    def geometry(self, page: int, threads: int) -> Tuple[_Array, _Array]: ...
    def save(
        self, folder: _Path, force: bool, usd: bool, threads: int, progress: Optional[_Watcher]
    ) -> str: ...

class Lighter:
    def __init__(self, room: Decomposition, threads: int, progress: Optional[_Watcher]) -> None: ...
    def relight(
        self, text: str, file: _Path, settings: Sequence[str], threads: int, progress: Optional[_Watcher]
    ) -> Relit: ...

class Relit:
    @property
    def warnings(self) -> List[str]: ...
    def radiance(self, page: int) -> _Array: ...
    def picture(
        self,
        camera: Optional[Tuple[Any, ...]],
        size: Tuple[int, int],
        view: str,
        exposure: Optional[float],
        antialias: int,
        linear: bool,
        threads: int,
        progress: Optional[_Watcher],
    ) -> _Array: ...

class FilmArguments:
    def __init__(
        self,
        camera: Optional[Tuple[Any, ...]],
        size: Tuple[int, int],
        view: str,
        exposure: Optional[float],
        antialias: int,
        turntable: int,
        fps: float,
        force: bool,
    ) -> None: ...

def write_film(
    lighter: Lighter,
    target: _Path,
    text: str,
    file: _Path,
    settings: Sequence[str],
    timeline: _Path,
    arguments: FilmArguments,
    threads: int,
    progress: Optional[_Watcher],
) -> List[str]: ...
def inspect(scan: Scan, threads: int, progress: Optional[_Watcher]) -> Dict[str, Any]: ...
def verify(
    folder: _Path,
    samples: int,
    places: int,
    seed: int,
    scan: _Path,
    allow_outside: bool,
    threads: int,
    progress: Optional[_Watcher],
) -> Dict[str, Any]: ...

class Options:
    def __init__(self, given: Dict[str, Any]) -> None: ...

def delight(
    scan: Scan,
    options: Options,
    lights: _Path,
    response: _Path,
    threads: int,
    progress: Optional[_Watcher],
) -> Tuple[Decomposition, List[str]]: ...
