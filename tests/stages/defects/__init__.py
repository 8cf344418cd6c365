"""Every known kind of defect: each changes one thing of a scene that is right.

Add one by writing a function in the module of its family, with a decorator of `declaration`.
"""

from importlib import import_module
from pkgutil import iter_modules

from .declaration import Defect

DEFECTS = tuple(
    each
    for module in sorted(iter_modules(__path__), key=lambda module: module.name)
    for each in vars(import_module(f"{__name__}.{module.name}")).values()
    if isinstance(each, Defect)
)
