"""Pictures."""

from __future__ import annotations

import atexit
import dataclasses
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any, Callable, Optional, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _raylane
from ._fields import Fields
from ._scene import Scene, inner
from ._values import Camera, Precision, Settings

OnProgress = Callable[[int, int], Optional[bool]]
"""Called with pixels that are done, and all; what returns False cancels."""


class Cancelled(Exception):
    """By the callback of :func:`render`."""


class Layers:
    """What the ray through the middle of each pixel sees first."""

    def __init__(self, arrays: Any) -> None:
        self.depth: NDArray[np.float32] = arrays["depth"]
        """(height, width): along the ray, in units of length; infinite where there is nothing."""
        self.normal: NDArray[np.float32] = arrays["normal"]
        """(height, width, 3): unit, on the side that is seen."""
        self.shape: NDArray[np.uint32] = arrays["shape"]
        self.material: NDArray[np.uint32] = arrays["material"]
        self.samples: NDArray[np.uint32] = arrays["samples"]


class Image(Fields):
    """A picture in linear float RGB. Components are >= 0 and may exceed 1."""

    rgb: NDArray[np.float32]
    """(height, width, 3): rows from the top down."""
    alpha: Optional[NDArray[np.float32]]
    """(height, width) in [0, 1], which colours are multiplied by; or None."""
    layers: Optional[Layers]
    """If they were asked for."""
    transfer: str

    def __init__(
        self,
        rgb: NDArray[Any],
        alpha: Optional[NDArray[Any]] = None,
        layers: Optional[Layers] = None,
        transfer: str = "srgb",
    ) -> None:
        self.rgb = rgb
        self.alpha = alpha
        self.layers = layers
        self.transfer = transfer

    @property
    def width(self) -> int:
        return int(self.rgb.shape[1])

    @property
    def height(self) -> int:
        return int(self.rgb.shape[0])

    def save(self, path: Union[str, os.PathLike[str]]) -> None:
        """.png, .tga, .bmp, .ppm, .hdr or .pfm. The file appears whole or not at all."""
        _raylane.write_image(os.fspath(path), self.rgb, self.alpha, self.transfer)

    def to_bytes(self) -> NDArray[np.uint8]:
        """(height, width, 3), or 4 with an alpha: 8 bits through the transfer curve, as a PNG has them."""
        linear, alpha = self.rgb.astype(np.float64), None
        if self.alpha is not None:
            alpha = self.alpha.astype(np.float64)[..., None]
            linear = np.divide(linear, alpha, out=np.zeros_like(linear), where=alpha > 0)
        linear = np.clip(linear, 0.0, 1.0)
        if self.transfer == "srgb":
            linear = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
        planes = linear if alpha is None else np.concatenate([linear, np.clip(alpha, 0.0, 1.0)], axis=-1)
        rounded: NDArray[np.uint8] = np.floor(planes * 255.0 + 0.5).astype(np.uint8)
        return rounded

    def __array__(self, dtype: Any = None) -> NDArray[Any]:
        return self.rgb if dtype is None else self.rgb.astype(dtype)

    def _repr_png_(self) -> bytes:
        with tempfile.TemporaryDirectory(prefix="raylane-") as folder:
            path = Path(folder) / "picture.png"
            self.save(path)
            return path.read_bytes()

    def show(self) -> None:
        """In a notebook, or else as the desktop shows pictures (``xdg-open``), as long as Python runs."""
        if "IPython" in sys.modules:
            from IPython import get_ipython
            from IPython.display import display

            if get_ipython() is not None and hasattr(get_ipython(), "kernel"):
                display(self)
                return
        opener = shutil.which("open" if sys.platform == "darwin" else "xdg-open")
        if opener is None:
            raise RuntimeError("there is no notebook here, and no desktop: save() the picture")
        folder = tempfile.mkdtemp(prefix="raylane-")
        atexit.register(shutil.rmtree, folder, ignore_errors=True)
        path = Path(folder) / "picture.png"
        self.save(path)
        subprocess.run([opener, str(path)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)

    def __repr__(self) -> str:
        return f"<raylane.Image: {self.width} x {self.height}>"


class _Bar:
    """tqdm's bar over pixels."""

    def __init__(self, tqdm: Any) -> None:
        self._bar = tqdm(unit=" pixels", unit_scale=True)

    def __call__(self, done: int, total: int) -> None:
        self._bar.total = total
        self._bar.update(done - self._bar.n)

    def close(self) -> None:
        self._bar.close()


def _bar() -> Optional[_Bar]:
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return None
    return _Bar(tqdm)


def render(
    scene: Scene,
    settings: Optional[Settings] = None,
    *,
    camera: Optional[Camera] = None,
    threads: int = 0,
    precision: Precision = "exact",
    crop: Optional[Tuple[int, int, int, int]] = None,
    layers: bool = False,
    progress: Union[bool, OnProgress] = False,
    **changed: Any,
) -> Image:
    """The picture of a scene: the same bits for the same scene and settings, whatever the threads and processor.

    ``settings`` are the scene's unless they are given; further arguments change them: ``render(scene,
    width=800, height=600, grid=4)``. ``camera``: another one (:meth:`Scene.seen_by`). ``crop`` is a part of the picture: x, y, width, height. ``progress`` is
    called with pixels that are done, and all, every now and then; True: tqdm's bar, if that is installed. If it
    returns False, even at last, :class:`Cancelled` is raised; Ctrl-C stops at once.
    """
    inner(scene)
    chosen = dataclasses.replace(scene.settings if settings is None else settings, **changed)
    if camera is not None:
        scene = scene.seen_by(camera)
    bar = _bar() if progress is True else None
    on_progress = bar if isinstance(progress, bool) else progress
    try:
        arrays = _raylane.render(scene._scene, chosen, threads, precision, crop, layers, on_progress)
    finally:
        if bar is not None:
            bar.close()
    if arrays is None:
        raise Cancelled
    return Image(arrays["rgb"], arrays["alpha"], Layers(arrays) if layers else None, chosen.transfer)


def imshow(picture: Union[Scene, Image], ax: Any = None, **options: Any) -> Any:
    """Shows a picture, or that of a scene, in matplotlib's axes, with its colours as they are."""
    if ax is None:
        import matplotlib.pyplot as plt

        ax = plt.gca()
    if isinstance(picture, Scene):
        picture = render(picture, **options)
    elif options:
        raise TypeError("a picture that is there takes no options of render")
    ax.set_axis_off()
    return ax.imshow(picture.to_bytes(), interpolation="nearest")
