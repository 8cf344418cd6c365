"""Texts as crates, written in a process that USD may crash."""

from __future__ import annotations

import multiprocessing
import tempfile
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from functools import cache
from pathlib import Path


def crate(text: str) -> bytes:
    """A text as a crate; empty if USD does not read it, or crashes."""
    try:
        return _process().submit(_crate, text).result()
    except BrokenProcessPool:
        _process.cache_clear()
        return b""


@cache
def _process() -> ProcessPoolExecutor:
    return ProcessPoolExecutor(1, multiprocessing.get_context("spawn"))


def _crate(text: str) -> bytes:
    from pxr import Sdf, Tf

    layer = Sdf.Layer.CreateAnonymous(".usdc")
    with tempfile.TemporaryDirectory(prefix="usdvol-fuzz-") as folder:
        path = Path(folder) / "a.usdc"
        try:
            if layer.ImportFromString(text) and layer.Export(str(path)):
                return path.read_bytes()
        except Tf.ErrorException:
            pass
    return b""
