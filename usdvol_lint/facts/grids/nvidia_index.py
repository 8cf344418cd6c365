"""The fields of NVIDIA IndeX, which has importers of its own on prims of the type FieldAsset."""

from __future__ import annotations

from typing import Any

_NAMESPACE = "nvindex"


def is_for_index(field: Any) -> bool:
    """Whether a field or the prim above it has settings of IndeX."""
    settings = field.GetCustomData() or {}  # None where it holds a key that is not UTF-8
    has_settings = any(key.partition(".")[0] == _NAMESPACE for key in settings)
    return has_settings or any(
        prim.GetAuthoredPropertiesInNamespace(_NAMESPACE) for prim in (field, field.GetParent())
    )
