"""The bindings of a Volume: the properties in its `field:` namespace, and what they target."""

from __future__ import annotations

import builtins
from collections.abc import Container, Iterator
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

    `name` is what follows `field:`; `targets` are those after forwarding.
    A relationship without targets has an `emptiness`; `lost` are its specs whose targets did not
    survive composition, strongest first; `forwards_to` is the path that it targets itself, if any.
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
        """The last part of the name, by which USD and renderers know the field."""
        return self.name.rpartition(":")[2]

    @builtins.property
    def losing_arc(self) -> Any:
        """The spec with the arc that loses the first of the targets, or the spec of the target."""
        from usdvol_lint.facts.usd.bringing import arc_losing  # few bindings lose a target

        spec = self.lost[0]
        first = spec.targetPathList.GetAddedOrExplicitItems()[0]
        return arc_losing(self.property.GetPrim(), spec, first) or spec

    @builtins.property
    def target(self) -> Target | None:
        """The target if there is exactly one: USD ignores a relationship with several."""
        return self.targets[0] if len(self.targets) == 1 else None

    @builtins.property
    def is_bound(self) -> bool:
        """Whether USD and renderers read a field through it."""
        return self.target is not None and self.target.state is TargetState.FIELD


class FieldBindings(NamedTuple):
    """The bindings of one Volume, sorted by name.

    `undeclared` are relationships outside the namespace that were probably intended as bindings:
    a bare `rel field`, or one that no schema declares and that targets a field prim which no
    binding targets.
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

    def properties_of(self, fields: Container[str]) -> Iterator[Any]:
        """The properties that bind some fields, given by their paths as the stage shows them."""
        return (binding.property for binding, field in self.with_files() if field.shown in fields)

    def with_files(self) -> Iterator[tuple[Binding, Target]]:
        """The bindings of fields that may name files, with those fields."""
        for binding, target in self.with_target(TargetState.FIELD):
            if schema.FIELD_ASSET in target.schemas:
                yield binding, target

    def outside(self, volume: Any) -> Iterator[tuple[Binding, Target]]:
        """The bindings of fields that are not below the Volume, with those fields."""
        for binding, target in self.with_target(TargetState.FIELD):
            if not target.path.HasPrefix(volume.GetPath()):
                yield binding, target

    def marks(self, volume: Any) -> frozenset[Enum]:
        """The states of all targets, and what else preconditions test (`BindingMark`)."""
        marks: set[Enum] = set()
        own = get_path(volume)
        for _, name, is_relationship, targets, emptiness, *_ in self.bindings:
            if emptiness:
                marks.add(emptiness)
            elif not is_relationship:
                marks.add(BindingMark.ATTRIBUTE)
            elif len(targets) > 1:
                marks.add(BindingMark.SEVERAL_TARGETS)
            else:
                marks.add(targets[0].state)
                if not has_prefix(targets[0].path, own):
                    marks.add(BindingMark.OUTSIDE)
            if ":" in name:
                marks.add(BindingMark.NESTED)
        if len(self.bindings) != 1:
            marks.add(BindingMark.SEVERAL if self.bindings else BindingMark.NONE)
        if self.undeclared:
            marks.add(BindingMark.UNDECLARED)
        return frozenset(marks)

    @property
    def is_sound(self) -> bool:
        """Whether there are bindings and each binds a field."""
        return bool(self.bindings) and all(binding.is_bound for binding in self.bindings)

    def target_paths(self) -> set[Any]:
        """The paths of all prims that these relationships target, as the walk meets them."""
        prims = [target.prim for binding in self.bindings for target in binding.targets]
        for relationship in self.undeclared:
            stage = relationship.GetStage()
            paths = relationship.GetForwardedTargets()
            prims += [stage.GetPrimAtPath(path.GetPrimPath()) for path in paths]
        return {in_prototype(prim).GetPath() for prim in prims if prim}


class BoundFields(NamedTuple):
    """The bindings of a Volume in brief.

    `marks` are those of `FieldBindings.marks`; `slots` are those of the live fields that are
    targeted.  `bindings` is None where each relationship targets one live field right below the
    Volume: then the slots say it all.
    """

    marks: frozenset[Enum]
    slots: tuple[Slot, ...]
    bindings: FieldBindings | None = None
