"""USD's methods, looked up once: a look-up on an object takes as long as most of the methods."""

from __future__ import annotations

from typing import Any

from pxr import Sdf, Usd

has_prefix: Any = Sdf.Path.HasPrefix
parent_path: Any = Sdf.Path.GetParentPath
prim_path: Any = Sdf.Path.GetPrimPath

own_attribute: Any = Sdf.PrimSpec.GetAttributeAtPath
own_relationship: Any = Sdf.PrimSpec.GetRelationshipAtPath
type_of_spec: Any = Sdf.AttributeSpec.typeName.fget

count_samples: Any = Usd.Attribute.GetNumTimeSamples
get_value: Any = Usd.Attribute.Get
has_value: Any = Usd.Attribute.HasAuthoredValue

get_name: Any = Usd.Object.GetName
get_path: Any = Usd.Object.GetPath
get_prim: Any = Usd.Object.GetPrim
get_stage: Any = Usd.Object.GetStage

get_applied: Any = Usd.Prim.GetAppliedSchemas
get_attribute: Any = Usd.Prim.GetAttribute
get_children: Any = Usd.Prim.GetFilteredChildren
get_index: Any = Usd.Prim.GetPrimIndex
get_parent: Any = Usd.Prim.GetParent
get_prim_stack: Any = Usd.Prim.GetPrimStack
get_properties: Any = Usd.Prim.GetAuthoredProperties
get_property_names: Any = Usd.Prim.GetAuthoredPropertyNames
get_relationship: Any = Usd.Prim.GetRelationship
get_type: Any = Usd.Prim.GetTypeName
has_metadata: Any = Usd.Prim.HasAuthoredMetadata
has_specifier: Any = Usd.Prim.HasDefiningSpecifier
is_defined: Any = Usd.Prim.IsDefined
is_in_prototype: Any = Usd.Prim.IsInPrototype
is_instance_proxy: Any = Usd.Prim.IsInstanceProxy
is_prototype: Any = Usd.Prim.IsPrototype
is_pseudo_root: Any = Usd.Prim.IsPseudoRoot

get_property_stack: Any = Usd.Property.GetPropertyStack
get_stack_with_offsets: Any = Usd.Property.GetPropertyStackWithLayerOffsets

get_targets: Any = Usd.Relationship.GetForwardedTargets
own_targets: Any = Usd.Relationship.GetTargets

prim_at: Any = Usd.Stage.GetPrimAtPath


def holder_of(spec: Any) -> Any:
    """The prim's spec that a property's is in; its `owner` is another kind of spec in a variant."""
    return spec.layer.GetPrimAtPath(spec.path.GetPrimOrPrimVariantSelectionPath())


ARCS = ("references", "payload", "inheritPaths", "specializes")
"""The metadata of a spec that bring it the opinions of other prims."""

COMPOSED: Any = Usd.PrimIsActive & Usd.PrimIsLoaded & ~Usd.PrimIsAbstract
"""As USD's default predicate, which does without prims that nothing defines."""
DRAWN_BELOW: Any = COMPOSED & Usd.PrimHasDefiningSpecifier
"""What is drawn below a prim that is drawn, also where an `over` hides both from traversals."""
WITH_INSTANCES: Any = Usd.TraverseInstanceProxies(DRAWN_BELOW)
"""A predicate for `get_children`: what is drawn, and the children of instances too."""
