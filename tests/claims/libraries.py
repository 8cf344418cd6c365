"""Asks OpenVDB and NanoVDB, where their tools and the Python module of the system are installed."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest

_PYTHON = "/usr/bin/python3"
_SECONDS = 60

_ASK = """
import json, os, pyopenvdb
path = %r
def tried(read):
    try:
        return read()
    except Exception as error:
        return str(error)
print("\\n" + json.dumps(%s), flush=True)
os._exit(0)
"""


def _has_module() -> bool:
    probe = [_PYTHON, "-c", "import pyopenvdb"]
    return Path(_PYTHON).exists() and not subprocess.run(probe, capture_output=True).returncode


with_vdb_print = pytest.mark.skipif(
    shutil.which("vdb_print") is None, reason="no vdb_print, which libopenvdb-tools installs"
)
with_openvdb = pytest.mark.skipif(
    not _has_module(), reason="no pyopenvdb, which python3-openvdb installs"
)
with_nanovdb = pytest.mark.skipif(
    shutil.which("nanovdb_convert") is None,
    reason="no nanovdb_convert, which libnanovdb-tools installs",
)


def printed(*command: str | Path) -> str:
    """What a tool of the libraries says."""
    done = subprocess.run(
        [str(part) for part in command], capture_output=True, check=False, timeout=_SECONDS
    )
    return (done.stdout + done.stderr).decode("utf-8", "replace")


def asked(path: Path, expression: str) -> Any:
    """What pyopenvdb says of the file at `path`; `tried(…)` gives the error in words.

    Without delayed loading, which the library has given up: with it, it maps the file.
    """
    done = subprocess.run(
        [_PYTHON, "-c", _ASK % (str(path), expression)],
        capture_output=True,
        check=True,
        timeout=_SECONDS,
        env={**os.environ, "OPENVDB_DISABLE_DELAYED_LOAD": "1"},
    )
    return json.loads(done.stdout.decode().splitlines()[-1])
