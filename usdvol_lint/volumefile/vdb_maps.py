"""OpenVDB's maps: from index space to the world space of a file."""

from __future__ import annotations

from collections.abc import Callable
from itertools import chain
from struct import Struct

from usdvol_lint.volumefile.model import invalid, quoted_short
from usdvol_lint.volumefile.transform import (
    Frustum,
    Matrix,
    Transform,
    finite,
    rows,
    scale_translate,
)
from usdvol_lint.volumefile.window import Window

_LONGEST_NAME = 1 << 8
_FRUSTUM = Struct("<8d")
_FRUSTUM_MAP = "NonlinearFrustumMap"
# The values after scale and translation are derived from them.
_SCALE = Struct("<3d96x"), scale_translate
_TRANSLATE_SCALE = Struct("<6d96x"), lambda numbers: scale_translate(numbers[3:], numbers[:3])
_MAPS: dict[str, tuple[Struct, Callable[[tuple[float, ...]], Matrix]]] = {
    "AffineMap": (Struct("<16d"), rows),
    "UnitaryMap": (Struct("<16d"), rows),
    "ScaleMap": _SCALE,
    "UniformScaleMap": _SCALE,
    "ScaleTranslateMap": _TRANSLATE_SCALE,
    "UniformScaleTranslateMap": _TRANSLATE_SCALE,
    "TranslationMap": (Struct("<3d"), lambda numbers: scale_translate((1, 1, 1), numbers)),
}


def read_transform(window: Window) -> Transform:
    """The transform at the window's position."""
    at = window.position
    map_type = window.string(_LONGEST_NAME)
    if map_type != _FRUSTUM_MAP:
        return Transform(map_type, _read_linear_map(window, map_type, at))
    numbers = window.unpack(_FRUSTUM)
    frustum = Frustum(numbers[0:3], numbers[3:6], numbers[6], numbers[7])
    if not frustum.valid:
        raise invalid("a frustum without extent, or of no finite size", at)
    at = window.position
    matrix = _read_linear_map(window, window.string(_LONGEST_NAME), at)
    return Transform(map_type, matrix, frustum)


def _read_linear_map(window: Window, map_type: str, at: int) -> Matrix:
    """The numbers of a map whose name, at byte `at`, was just read."""
    if map_type not in _MAPS:
        raise invalid(f"unknown transform {quoted_short(map_type)}", at)
    form, matrix_of = _MAPS[map_type]
    matrix = matrix_of(window.unpack(form))
    if not finite(chain.from_iterable(matrix)):
        raise invalid(f"the {map_type} holds numbers that are not finite", at)
    return matrix
