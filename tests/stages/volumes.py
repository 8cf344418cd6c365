"""Volumes that are right, of every kind that a seed can draw."""

from __future__ import annotations

from collections.abc import Sequence
from random import Random
from typing import Any

from .files import FIELD3D, FRAME, SOURCES, Grid, Point, Source
from .model import ABSENT, Attribute, Expression, File, Prim, Relationship
from .sequences import PATTERNS, add_clips, add_sequence, version_of
from .subjects import Choice, FieldPart, VolumeSubject, new_layer

FILES = (
    *("static", "several", "versions", "sequence", "own sequence"),
    *("clips", "template clips", "field3d"),
)
"""Where the files come from."""

PLACES = ("below", "group", "beside")
"""Where the fields are: below the Volume, in a group there, or outside of it."""

MOVEMENTS = ("none", "volume", "group", "field")
"""What has a transform; a group of the Volume and its fields moves them together."""

_NAMES = ("density", "heat", "temperature", "velocity", "flame", "fuel", "smoke_2", "Cd")


def choose(rng: Random, needs: dict[str, Any]) -> Choice:
    """Drawn, but for what a defect needs: a tuple to choose from, or a value."""
    drawn: dict[str, Any] = {
        "files": rng.choice(FILES),
        "place": rng.choice(("below", *PLACES)),
        "fields": rng.choice((1, 1, 2, 2, 3, 4)),
        "pattern": rng.choice(("plain", *PATTERNS)),
        "movement": rng.choice(("none", *MOVEMENTS)),
        "twin": rng.random() < 0.3,
    }
    for name, wanted in needs.items():
        if name in drawn:
            drawn[name] = rng.choice(wanted) if isinstance(wanted, tuple) else wanted
    return Choice(**drawn)


def volume(rng: Random, name: str, needs: dict[str, Any]) -> VolumeSubject:
    """A Volume with one to four fields, right in every way that the rules know of."""
    choice = choose(rng, needs)
    layer = new_layer(rng, name)
    if choice.place == "beside" and choice.movement != "group":
        choice = choice._replace(movement="none")
    is_root = choice.place != "beside" and choice.movement != "group" and rng.random() < 0.3
    prim = Prim(f"{name}_cloud", "Volume")
    kind = "Xform" if choice.movement == "group" else rng.choice(("Xform", "Scope"))
    layer.prims = [prim if is_root else Prim(name, kind)]
    if not is_root:
        layer.prims[0].children.append(prim)
    path = f"/{prim.name}" if is_root else f"/{name}/{prim.name}"
    subject = VolumeSubject(layer, prim, path, choice=choice)
    subject.content.layers.append(layer)
    _add_fields(subject, choice, rng)
    _add_extent(subject, choice, rng)
    if choice.twin and not is_root and choice.movement != "volume":
        _add_twin(subject)
    _decorate(subject, rng)
    return subject


def _add_fields(subject: VolumeSubject, choice: Choice, rng: Random) -> None:
    parent, above = _parent(subject, choice)
    names = rng.sample(_NAMES, choice.fields)
    sources = _sources(choice, rng)
    for number, name in enumerate(names):
        source = sources[number % len(sources)]
        grid = rng.choice(source.grids)
        prim = Prim(name, source.prim_type, properties=_said(grid, source, rng))
        parent.children.append(prim)
        part = FieldPart(prim, f"{above}/{name}", f"field:{name}", source)
        subject.fields.append(part)
        targets = [_forwarded(subject, part, rng)]
        subject.prim.properties[part.relationship] = Relationship(targets, rng.random() < 0.3)
        if choice.files == "versions":
            prim.properties["filePath"] = Attribute("asset", version_of(subject, source, rng))
        if choice.files in ("static", "several", "field3d"):
            named = rng.choice((File, File, File, Expression))(source.path)
            prim.properties["filePath"] = Attribute("asset", named)
    if choice.files.endswith("sequence"):
        add_sequence(subject, choice, rng)
    elif choice.files.endswith("clips"):
        add_clips(subject, choice, rng)


def _parent(subject: VolumeSubject, choice: Choice) -> tuple[Prim, str]:
    """The prim that holds the fields, and its path."""
    if choice.place == "beside":
        return subject.root, f"/{subject.root.name}"
    if choice.place == "below":
        return subject.prim, subject.path
    group = Prim("fields", "Scope")
    subject.prim.children.append(group)
    return group, f"{subject.path}/fields"


def _forwarded(subject: VolumeSubject, part: FieldPart, rng: Random) -> str:
    """The target of a relationship: the field, or another relationship that targets it."""
    if rng.random() < 0.9:
        return part.path
    name = f"to:{part.prim.name}"
    subject.prim.properties[name] = Relationship([part.path], True)
    return f"{subject.path}.{name}"


def _sources(choice: Choice, rng: Random) -> Sequence[Source]:
    if choice.files == "field3d":
        return FIELD3D
    if choice.files in ("static", "versions"):
        return [rng.choice(SOURCES)]
    return rng.sample(SOURCES, 3) if choice.files == "several" else [FRAME]


def _said(grid: Grid, source: Source, rng: Random) -> dict[str, Attribute | Relationship]:
    """What a field says of its grid; some of it may be left out."""
    said: dict[str, Attribute | Relationship] = {
        "fieldName": Attribute("token", grid.name),
        "fieldDataType": Attribute("token", rng.choice(grid.data_types)),
    }
    if source.prim_type == "OpenVDBAsset" and rng.random() < 0.8:
        said["fieldClass"] = Attribute("token", grid.field_class)
    if grid.roles and rng.random() < 0.7:
        said["vectorDataRoleHint"] = Attribute("token", rng.choice(grid.roles))
    if grid.field_index is not None or rng.random() < 0.1:
        said["fieldIndex"] = Attribute("int", grid.field_index or 0)
    return said


def _add_twin(subject: VolumeSubject) -> None:
    """Another Volume of the same fields: they are shared, wherever they are."""
    twin = Prim(f"{subject.prim.name}_twin", "Volume")
    twin.properties["extent"] = subject.prim.properties["extent"]
    for part in subject.fields:
        twin.properties[part.relationship] = Relationship([part.path])
    subject.root.children.append(twin)


def _add_extent(subject: VolumeSubject, choice: Choice, rng: Random) -> None:
    """An extent that encloses all grids, from their writers' bounds; fields do not move."""
    grids = [
        grid
        for part in subject.fields
        for grid in part.source.grids
        if grid.name == part.prim.attribute("fieldName").value
    ]
    low: Point = tuple(min(grid.low[axis] for grid in grids) for axis in range(3))  # type: ignore[assignment]
    high: Point = tuple(max(grid.high[axis] for grid in grids) for axis in range(3))  # type: ignore[assignment]
    if choice.files == "sequence":
        low, high = (0, 0, 0), (1, 1, 1)
    slack = rng.choice((0.001, 0.01, 1, 1000))
    if choice.movement == "field":
        low, high = _move_field(subject, low, high)
    corners = [tuple(x - slack for x in low), tuple(x + slack for x in high)]
    extent = Attribute("float3[]", corners)
    if choice.files.endswith("sequence") and rng.random() < 0.3:
        times = subject.fields[0].prim.attribute("filePath").samples
        extent = Attribute("float3[]", ABSENT, dict.fromkeys(times, corners))
    subject.prim.properties["extent"] = extent


def _move_field(subject: VolumeSubject, low: Point, high: Point) -> tuple[Point, Point]:
    """One field moves within its Volume, and the bounds grow along."""
    _translate(subject.fields[0].prim)
    moved = [tuple(x + by for x, by in zip(corner, _MOVED, strict=True)) for corner in (low, high)]
    lows, highs = zip(low, moved[0], strict=True), zip(high, moved[1], strict=True)
    return tuple(map(min, lows)), tuple(map(max, highs))  # type: ignore[return-value]


_MOVED = (1.5, -2, 0.25)


def _translate(prim: Prim) -> None:
    prim.properties["xformOp:translate"] = Attribute("double3", _MOVED)
    order = Attribute("token[]", ["xformOp:translate"], is_uniform=True)
    prim.properties["xformOpOrder"] = order


def _decorate(subject: VolumeSubject, rng: Random) -> None:
    """What else a Volume may carry, and what does not matter to the rules."""
    properties = subject.prim.properties
    if rng.random() < 0.3:
        purpose = rng.choice(("render", "default"))
        properties["purpose"] = Attribute("token", purpose, is_uniform=True)
    if subject.choice.movement in ("volume", "group"):
        _translate(subject.prim if subject.choice.movement == "volume" else subject.root)
    if rng.random() < 0.2:
        properties["primvars:displayColor"] = Attribute("color3f[]", [(0.2, 0.3, 0.9)])
    if rng.random() < 0.2:
        subject.root.metadata.append(('kind = "component"',))
    if rng.random() < 0.2:
        subject.prim.metadata.append(('doc = "Smoke from the chimney"',))
    if rng.random() < 0.2:
        subject.fields[0].prim.properties["studio:voxels"] = Attribute("int", 125)
