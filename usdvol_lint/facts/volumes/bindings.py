"""What a Volume's `field:` namespace really binds, and what only looks as if it did."""

from __future__ import annotations

import builtins
from collections.abc import Iterator
from enum import Enum
from typing import TYPE_CHECKING, Any, NamedTuple

from usdvol_lint import schema
from usdvol_lint.facts.usd.calls import get_path, has_prefix
from usdvol_lint.facts.usd.instances import in_prototype
from usdvol_lint.facts.volumes.states import BindingMark, Emptiness, TargetState
from usdvol_lint.facts.volumes.targets import Target

if TYPE_CHECKING:
    from usdvol_lint.facts.prims.tables import Slot


class Binding(NamedTuple):
    """One property of the `field:` namespace.

    `name` is what follows `field:`; USD keys the field by `key`, the last part of it.
    `emptiness` is None where there are targets; `lost` are specs whose targets did not survive
    composition, strongest first; `forwards_to` is the relationship that one without targets
    forwards to.
    """

    property: Any
    name: str
    is_relationship: bool
    targets: tuple[Target, ...] = ()
    emptiness: Emptiness | None = None
    lost: tuple[Any, ...] = ()
    forwards_to: str = ""

    @builtins.property
    def key(self) -> str:
        return self.name.rpartition(":")[2]

    @builtins.property
    def target(self) -> Target | None:
        """The target if there is exactly one: USD drops the relationship if there are several."""
        return self.targets[0] if len(self.targets) == 1 else None

    @builtins.property
    def is_bound(self) -> bool:
        """Whether USD and renderers get a field from it."""
        return self.target is not None and self.target.state is TargetState.FIELD


class FieldBindings(NamedTuple):
    """The bindings of one Volume, by name.

    `undeclared` are relationships outside the namespace that a reader would take for fields: a bare
    `rel field`, or any other, unless a schema declares it, that targets a field prim which no
    relationship in the namespace does.
    """

    bindings: tuple[Binding, ...]
    undeclared: tuple[Any, ...]

    @property
    def relationships(self) -> tuple[Binding, ...]:
        return tuple(binding for binding in self.bindings if binding.is_relationship)

    def with_target(self, *states: TargetState) -> Iterator[tuple[Binding, Target]]:
        """The bindings whose one target is in one of these states, with that target."""
        for binding in self.bindings:
            if binding.target and binding.target.state in states:
                yield binding, binding.target

    def with_files(self) -> Iterator[tuple[Binding, Target]]:
        """The bindings of fields that name files, with those fields."""
        for binding, target in self.with_target(TargetState.FIELD):
            if schema.FIELD_ASSET in target.schemas:
                yield binding, target

    def outside(self, volume: Any) -> Iterator[tuple[Binding, Target]]:
        """The bindings of fields that do not lie below the Volume, with those fields."""
        for binding, target in self.with_target(TargetState.FIELD):
            if not target.path.HasPrefix(volume.GetPath()):
                yield binding, target

    def marks(self, volume: Any) -> frozenset[Enum]:
        """What there is to say of the bindings of a Volume, if there is anything."""
        found: set[Enum] = set()
        for _, name, is_relationship, targets, emptiness, *_ in self.bindings:
            if emptiness:
                found.add(emptiness)
            elif not is_relationship:
                found.add(BindingMark.ATTRIBUTE)
            elif len(targets) > 1:
                found.add(BindingMark.SEVERAL_TARGETS)
            else:
                found.add(targets[0].state)
                if not has_prefix(targets[0].path, get_path(volume)):
                    found.add(BindingMark.OUTSIDE)
            if ":" in name:
                found.add(BindingMark.NESTED)
        if len(self.bindings) != 1:
            found.add(BindingMark.SEVERAL if self.bindings else BindingMark.NONE)
        if self.undeclared:
            found.add(BindingMark.UNDECLARED)
        return frozenset(found)

    @property
    def is_sound(self) -> bool:
        """Whether there are fields and each is bound."""
        return bool(self.bindings) and all(binding.is_bound for binding in self.bindings)

    def target_paths(self) -> set[Any]:
        """The paths of the prims that any of these relationships targets, as the walk met them."""
        prims = [target.prim for binding in self.bindings for target in binding.targets]
        for relationship in self.undeclared:
            stage = relationship.GetStage()
            paths = relationship.GetForwardedTargets()
            prims += [stage.GetPrimAtPath(path.GetPrimPath()) for path in paths]
        return {in_prototype(prim).GetPath() for prim in prims if prim}


class Bound(NamedTuple):
    """What there is to know of the bindings of a Volume that have no faults.

    `marks` say what is remarkable about them, `fields` are the places of the live fields that they
    target.  `looked_at` are the bindings themselves where they had to be looked at: elsewhere each
    is one of these fields, right below the Volume.
    """

    marks: frozenset[Enum]
    fields: tuple[Slot, ...]
    looked_at: FieldBindings | None = None
