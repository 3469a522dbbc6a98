"""Who is told how far a long call has come."""

from __future__ import annotations

from typing import Callable, Optional, Union

Watcher = Callable[[str, float], object]
#: None: nobody; True: a bar by tqdm; or called with a stage's name and its share done, 0..1.
Progress = Union[None, bool, Watcher]


def watcher_of(progress: Progress) -> Optional[Watcher]:
    """The function that the library calls."""
    if progress is None or progress is False:
        return None
    if callable(progress):
        return progress
    try:
        from tqdm.auto import tqdm  # type: ignore[import]
    except ImportError:
        raise ValueError(
            "progress=True shows a bar by tqdm, which is not there; install python3-tqdm, or give a function"
        ) from None
    bar = tqdm(total=100, unit="%", bar_format="{desc:>18} {percentage:3.0f} % |{bar}| {elapsed}")

    def show(stage: str, share: float) -> None:
        bar.set_description_str(stage, refresh=False)
        bar.n = round(100 * share)
        bar.refresh()

    return show
