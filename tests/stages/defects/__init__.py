"""Every known kind of defect: each changes one thing of a scene that is right.

Add one by writing a function in the module of its family, with a decorator of `declaration`.
"""

from dataclasses import replace
from importlib import import_module
from pkgutil import iter_modules

from .declaration import Defect

DEFECTS = tuple(
    replace(each, title=title)
    for module in sorted(iter_modules(__path__), key=lambda module: module.name)
    for title, each in vars(import_module(f"{__name__}.{module.name}")).items()
    if isinstance(each, Defect)
)
