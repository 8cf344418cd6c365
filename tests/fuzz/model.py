"""What an input is: files in a folder of its own, and how the command line is given them."""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum
from typing import NamedTuple


class Role(Enum):
    """What the file to try is for the command line."""

    STAGE = "stage"
    CONFIG = "config"
    PYPROJECT = "pyproject"
    BASELINE = "baseline"


class Input(NamedTuple):
    """One input; `kind` is what the table has a line for.

    `root` is the file to try among `files`; where that is no stage, `STAGE` is linted with it.
    `is_layer` says that the hostile bytes are those of a layer, which USD may open or not.
    """

    kind: str
    files: Mapping[str, bytes]
    root: str
    role: Role = Role.STAGE
    is_layer: bool = False


STAGE = "stage.usda"


def volume(name: str, kind: str = "OpenVDBAsset", more: str = "") -> bytes:
    """A stage with a Volume whose one field names a file."""
    return f"""#usda 1.0
def Volume "cloud"
{{
    float3[] extent = [(0, 0, 0), (1, 1, 1)]
    rel field:density = </cloud/density>
    def {kind} "density"
    {{
        token fieldName = "density"
        token fieldDataType = "float"
        asset filePath = @./{name}@
        {more}
    }}
}}
""".encode("utf-8", "surrogateescape")
