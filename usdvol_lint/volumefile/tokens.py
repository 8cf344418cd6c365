"""UsdVol's tokens for the types, classes and vector types of grids."""

from __future__ import annotations

from typing import Final, Literal, NamedTuple

DATA_TYPES: Final[dict[str, str]] = {
    **{name: name for name in ("half", "float", "double", "int64", "bool", "mask", "string")},
    **{name: name.replace("mat", "matrix") for name in ("mat3d", "mat4d")},
    **{
        f"vec{n}{letter}": f"{name}{n}"
        for n in (2, 3)
        for letter, name in (
            ("h", "half"),
            ("s", "float"),
            ("d", "double"),
            ("i", "int"),
        )
    },
    "int32": "int",
    "uint32": "uint",
    "quatd": "quatd",
}
"""The `fieldDataType` of a value type, as values are in memory; many types have none."""

HALF_TYPES: Final[dict[str, str]] = {
    "float": "half",
    "double": "half",
    **{f"vec{n}{letter}": f"half{n}" for n in (2, 3) for letter in "sd"},
}
"""The `fieldDataType` that also fits a value type if values are saved as half."""

FIELD_CLASSES: Final[dict[str, str]] = {
    "level set": "levelSet",
    "fog volume": "fogVolume",
    "staggered": "staggered",
}


class RoleHints(NamedTuple):
    """The `vectorDataRoleHint`s that fit a vector type.

    `strength` is weak for vector types that prove little, such as the default one.
    """

    fitting: tuple[str, ...]
    strength: Literal["weak", "strong"]


ROLE_HINTS: Final[dict[str, RoleHints]] = {
    "invariant": RoleHints(("None", "Color"), "weak"),
    "covariant": RoleHints(("Normal", "Vector"), "weak"),
    "covariant normalize": RoleHints(("Normal",), "strong"),
    "contravariant relative": RoleHints(("Vector",), "strong"),
    "contravariant absolute": RoleHints(("Point",), "strong"),
}


def data_types(value_type: str, half: bool = False) -> tuple[str, ...]:
    """The `fieldDataType`s that fit, the best one first; none if UsdVol has no token for it."""
    if value_type not in DATA_TYPES:
        return ()
    tokens = [DATA_TYPES[value_type]]
    if half and value_type in HALF_TYPES:
        tokens.append(HALF_TYPES[value_type])
    return tuple(tokens)


def field_class(grid_class: str) -> str:
    return FIELD_CLASSES.get(grid_class, "unknown")


def role_hints(vector_type: str) -> RoleHints:
    return ROLE_HINTS.get(vector_type, ROLE_HINTS["invariant"])
