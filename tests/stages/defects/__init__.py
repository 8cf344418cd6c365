"""Every kind of defect, by the family of the rule that finds it.

Add one by writing a function in the module of its family, with a decorator of `declaration`.
"""

from . import array, asset, elsewhere, field, grid, particle, schema, stage, undefined, volume
from .declaration import Defect

DEFECTS = tuple(
    each
    for module in (volume, field, asset, grid, schema, particle, array, stage, undefined, elsewhere)
    for each in vars(module).values()
    if isinstance(each, Defect)
)
