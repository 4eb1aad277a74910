"""Exact ray tracing of quadrics, on arrays of rays and shapes.

>>> import raylane
>>> scene = raylane.parse('{"camera": "auto", "materials": {"m": {}}, "objects":'
...                       ' [{"type": "sphere", "center": [0, 0, 0], "radius": 1, "material": "m"}]}')
>>> raylane.render(scene, width=64, height=48)
<raylane.Image: 64 x 48>
"""

import sys as _sys

from ._atoms import frames, from_ase, from_atoms, from_mdanalysis, from_mdtraj
from ._errors import BadInput, InputError, InvalidValue, SystemRefused
from ._group import Group
from ._image import Cancelled, Image, Aovs, imshow, render
from ._orbit import orbit
from ._raylane import Texture
from ._raylane import version as __version__
from ._renamed import renamed_class as _renamed_class
from ._scene import Scene, SceneBuilder, load, parse
from ._shapes import Shapes
from ._solids import Solid, Transform
from ._tracer import (
    NO_SHAPE,
    Cells,
    Closest,
    Crossings,
    CrossingStatistics,
    Hits,
    Leaving,
    Lengths,
    SolidLengths,
    Solids,
    Tracer,
)
from ._values import AutoCamera, Camera, Fog, Light, Material, Outline, Pattern, Sellmeier, Settings

__all__ = [
    "NO_SHAPE",
    "AutoCamera",
    "BadInput",
    "Camera",
    "Cancelled",
    "Cells",
    "Closest",
    "CrossingStatistics",
    "Crossings",
    "Fog",
    "Group",
    "Hits",
    "Image",
    "InputError",
    "InvalidValue",
    "Aovs",
    "Leaving",
    "Lengths",
    "Light",
    "Material",
    "Outline",
    "Pattern",
    "Scene",
    "SceneBuilder",
    "Sellmeier",
    "Settings",
    "Shapes",
    "Solid",
    "SolidLengths",
    "Solids",
    "SystemRefused",
    "Texture",
    "Tracer",
    "Transform",
    "__version__",
    "frames",
    "from_ase",
    "from_atoms",
    "from_mdanalysis",
    "from_mdtraj",
    "imshow",
    "load",
    "orbit",
    "parse",
    "render",
]


def __getattr__(name: str) -> object:
    if name == "Layers":
        return _renamed_class("Layers", Aovs)
    raise AttributeError(f'module "raylane" has no attribute "{name}"')


if "ase" in _sys.modules:
    from . import ase_viewer as _ase_viewer  # noqa: F401
