"""What particle fields may look like besides, each near to something that is wrong."""

from __future__ import annotations

from collections.abc import Callable

from .model import Attribute, Layer, Prim, overs
from .subjects import ParticleSubject, Subject

_ARRAYS = (
    *("positions", "orientations", "scales", "opacities"),
    "radiance:sphericalHarmonicsCoefficients",
)
_HALF_TYPES = {"point3f[]": "point3h[]", "quatf[]": "quath[]", "float3[]": "half3[]"}

_SCALES = "ParticleFieldScaleAttributeAPI"
_RADIANCE = "ParticleFieldSphericalHarmonicsAttributeAPI"
_OTHER_KERNELS = ("GaussianEllipsoid", "ConstantSurflet")


def hide_below(subject: Subject, path: str, name: str, attribute: Attribute) -> Prim:
    """Puts the subject below a stronger layer that authors this attribute at the path; its over."""
    prim = over_above(subject, path)
    prim.properties[name] = attribute
    return prim


def over_above(subject: Subject, path: str) -> Prim:
    """Puts the subject below a stronger layer with nothing but an over at the path."""
    topmost, prim = overs(path)
    layer = Layer(f"{subject.root.name}_over.usda", [topmost])
    layer.add_sublayer(subject.layer.path)
    subject.content.layers.append(layer)
    subject.layer = layer
    return prim


def born_in_halves(subject: ParticleSubject) -> None:
    """Half arrays that begin empty, as they may."""
    properties = subject.prim.properties
    for name in _ARRAYS:
        if name in properties:
            single = properties.pop(name)
            assert isinstance(single, Attribute)
            single.type = _HALF_TYPES.get(single.type, "half[]")
            properties[f"{name}h"] = single
        if f"{name}h" in properties:
            _begin(subject.prim.attribute(f"{name}h"))


def _begin(attribute: Attribute) -> None:
    samples = attribute.samples or {1: attribute.value}
    attribute.samples = {0: [], **samples}


def gone_in_the_end(subject: ParticleSubject) -> None:
    """Arrays that end empty."""
    for name in _ARRAYS:
        if any(each in subject.prim.properties for each in (name, f"{name}h")):
            attribute = subject.array(name)
            attribute.samples = {**(attribute.samples or {1: attribute.value}), 9: []}


def one_opacity_for_all(subject: ParticleSubject) -> None:
    if "opacities" in subject.prim.properties or "opacitiesh" in subject.prim.properties:
        for values in subject.lists("opacities"):
            values[:] = [0.625] * len(values)


def millimetres(subject: ParticleSubject) -> None:
    """A scan in a small unit: all sizes are above 1."""
    for name in ("positions", "scales"):
        if any(each in subject.prim.properties for each in (name, f"{name}h")):
            for values in subject.lists(name):
                values[:] = [tuple(1000 * number for number in each) for each in values]
    corners = [(-2000, -2000, -2000), (2000, 2000, 2000)]
    subject.prim.properties["extent"] = Attribute("float3[]", corners)


def parked_far_away(subject: ParticleSubject) -> None:
    """The last particle is a slot without use: too faint to be seen, and far off."""
    properties = subject.prim.properties
    for values in subject.lists("positions"):
        values[-1] = (60000.0, 0.0, 0.0)
    if "opacities" in properties or "opacitiesh" in properties:
        for values in subject.lists("opacities"):
            values[-1] = 0.001
    else:
        sizes = [len(values) for values in subject.lists("positions")]
        times = list(subject.array("positions").samples)
        faint = [[*([1.0] * (size - 1)), 0.001] for size in sizes]
        opacities = Attribute("float[]")
        if times:
            opacities.samples = dict(zip(times, faint, strict=True))
        else:
            opacities.value = faint[0]
        properties["opacities"] = opacities
    properties["extent"] = Attribute("float3[]", [(-2, -2, -2), (60000, 2, 2)])


def static_extent_over_an_animated_one(subject: ParticleSubject) -> None:
    corners = subject.prim.attribute("extent").value
    smaller = [(-2, -2, -2), (2, 2, 1.5)]
    subject.prim.properties["extent"] = Attribute("float3[]", samples={1: corners, 2: smaller})
    hide_below(subject, subject.path, "extent", Attribute("float3[]", corners))


def apis_in_two_lists(subject: ParticleSubject) -> None:
    subject.prim.metadata.append((f'append apiSchemas = ["{_SCALES}", "{_RADIANCE}"]',))


def dropped_list_without_loss(subject: ParticleSubject) -> None:
    """USD drops a list with a name twice; the type or another list has what was in it."""
    subject.prim.metadata.append((f'append apiSchemas = ["{_SCALES}", "{_SCALES}"]',))


def needless_api_deleted_above(subject: ParticleSubject) -> None:
    over = over_above(subject, subject.path)
    over.metadata.append(('delete apiSchemas = ["MaterialBindingAPI"]',))


def kernel_exchanged_above(subject: ParticleSubject) -> None:
    """By a stronger layer, where the type has none built in, which no list takes away."""
    if subject.prim.type == "ParticleField":
        over = over_above(subject, subject.path)
        deleted = ", ".join(f'"ParticleFieldKernel{kernel}API"' for kernel in _OTHER_KERNELS)
        over.metadata += [
            (f"delete apiSchemas = [{deleted}]",),
            ('prepend apiSchemas = ["ParticleFieldKernelGaussianSurfletAPI"]',),
        ]


LOOKS: dict[str, Callable[[ParticleSubject], None]] = {
    each.__name__.replace("_", " "): each
    for each in (
        born_in_halves,
        gone_in_the_end,
        one_opacity_for_all,
        millimetres,
        parked_far_away,
        static_extent_over_an_animated_one,
        apis_in_two_lists,
        dropped_list_without_loss,
        needless_api_deleted_above,
        kernel_exchanged_above,
    )
}
"""By name, what changes a particle field that is right into one that is right too."""
