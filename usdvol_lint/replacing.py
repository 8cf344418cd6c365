"""Replaces a file as a whole or not at all, through one beside it that nobody can foresee."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import BinaryIO


@contextmanager
def replacing(file: Path) -> Iterator[BinaryIO]:
    """A stream to what is in the place of a file once it was written; raises OSError.

    Who may read the file stays as it was.
    """
    target = Path(os.path.realpath(file))
    temporary = target.with_name(f".usdvol-lint-{os.urandom(8).hex()}.tmp")
    # Exclusively: no link that somebody put there is followed.
    with open(temporary, "xb") as stream:
        try:
            with suppress(OSError):  # there may be no such file
                shutil.copymode(target, temporary)
            yield stream
            stream.close()
            temporary.replace(target)
        except BaseException:
            with suppress(OSError):  # a full disk takes what is left in the buffer no more
                stream.close()
            temporary.unlink(missing_ok=True)
            raise
