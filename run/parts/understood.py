"""Results that are there but are not what a run writes."""

import traceback
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from pounding.results import UNREADABLE, ResultError


@contextmanager
def understood(what: Path | str) -> Iterator[None]:
    """Around what is made of results whose files could be read: values that no run writes are one line, ResultError,
    with the place in the command that they did not suit."""
    try:
        yield
    except OSError:
        raise
    except UNREADABLE as error:
        place = traceback.extract_tb(error.__traceback__)[-1]
        raise ResultError(f"{what}: holds something that no run of this version writes ({type(error).__name__}: "
                          f"{' '.join(str(error).split())}, at {Path(place.filename).name} line {place.lineno})") from error
