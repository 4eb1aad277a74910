"""Rendering and images."""

from __future__ import annotations

import atexit
import dataclasses
import inspect
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any, Callable, Dict, Optional, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _raylane
from ._errors import InvalidValue, SystemRefused
from ._fields import Fields, suggestion
from ._renamed import renamed, take_renamed
from ._scene import Scene, _warn, inner
from ._values import Camera, Outline, Precision, Settings

OnProgress = Callable[[int, int], Optional[bool]]
"""Called with the numbers of finished and of all pixels. Returning False cancels the rendering."""


class Cancelled(Exception):
    """Raised by :func:`render` if its callback has returned False."""


@renamed("shape", "shape_id")
class Aovs:
    """AOVs (render outputs): the first visible surface on the ray through the centre of each pixel.

    ``shape_id``, ``material`` and ``samples`` have the shape (height, width). ``shape_id`` is ``NO_SHAPE`` and
    ``material`` is 4294967295 where nothing is hit. ``samples``: number of samples in the pixel's colour.
    """

    def __init__(self, arrays: Any) -> None:
        self.depth: NDArray[np.float32] = arrays["depth"]
        """(height, width): distance along the ray, in units of length; infinite where nothing is hit."""
        self.normal: NDArray[np.float32] = arrays["normal"]
        """(height, width, 3): unit shading normal on the visible side; 0 where nothing is hit."""
        self.shape_id: NDArray[np.uint32] = arrays["shape"]
        self.material: NDArray[np.uint32] = arrays["material"]
        self.samples: NDArray[np.uint32] = arrays["samples"]


@renamed("layers", "aovs")
class Image(Fields):
    """An image in linear float RGB. Components are >= 0 and may exceed 1."""

    rgb: NDArray[np.float32]
    """(height, width, 3): rows from the top down."""
    alpha: Optional[NDArray[np.float32]]
    """(height, width), in [0, 1], or None. The colours are premultiplied by it."""
    aovs: Optional[Aovs]
    """The AOVs, or None if :func:`render` was called without ``aovs=True``."""
    transfer: str
    dpi: Optional[float]
    """Pixels per inch on paper, which :meth:`save` stores, or None."""

    def __init__(
        self,
        rgb: NDArray[Any],
        alpha: Optional[NDArray[Any]] = None,
        aovs: Optional[Aovs] = None,
        transfer: str = "srgb",
        dpi: Optional[float] = None,
    ) -> None:
        self.rgb = rgb
        self.alpha = alpha
        self.aovs = aovs
        self.transfer = transfer
        self.dpi = dpi

    @property
    def width(self) -> int:
        return int(self.rgb.shape[1])

    @property
    def height(self) -> int:
        return int(self.rgb.shape[0])

    def save(self, path: Union[str, os.PathLike[str]], *, bits: int = 8, dpi: Optional[float] = None) -> None:
        """Writes a file in the format of its ending: .png, .tif, .tga, .bmp, .ppm, .hdr or .pfm.

        ``bits``: per component, 8 or 16 in .png and .tif. ``dpi``: the print resolution that these store; default:
        ``self.dpi``. TIFF needs tifffile (Debian: python3-tifffile). The file appears complete or not at all. Raises
        :class:`BadInput` for another ending, :class:`InvalidValue` for arrays of wrong shapes and for values that the
        format lacks, and :class:`SystemRefused`.
        """
        name = os.fspath(path)
        ending = os.path.splitext(name)[1].lower()
        if dpi is None and ending in (".png", ".tif", ".tiff"):
            dpi = self.dpi
        if ending in (".tif", ".tiff"):
            self._save_tiff(name, bits, dpi)
        else:
            _raylane.write_image(name, self.rgb, self.alpha, self.transfer, bits, dpi or 0.0)

    def _save_tiff(self, name: str, bits: int, dpi: Optional[float]) -> None:
        try:
            import tifffile
        except ImportError:
            raise SystemRefused(f"{name}: cannot write: TIFF needs tifffile (Debian: python3-tifffile)") from None
        if bits not in (8, 16):
            raise InvalidValue("bits", f"must be 8 or 16, got {bits}")
        if dpi is not None and not 1 <= dpi <= 10000:
            raise InvalidValue("dpi", f"must be from 1 to 10000, or None, got {dpi}")
        with tempfile.TemporaryDirectory(prefix=".raylane-", dir=os.path.dirname(name) or ".") as folder:
            part = os.path.join(folder, "image.tif")
            tifffile.imwrite(
                part,
                self._codes(bits),
                photometric="rgb",
                compression="zlib",
                extrasamples=None if self.alpha is None else ["unassalpha"],
                resolution=None if dpi is None else (dpi, dpi),
                resolutionunit=None if dpi is None else "inch",
                software="raylane",
                metadata=None,
            )
            os.replace(part, name)

    def to_bytes(self) -> NDArray[np.uint8]:
        """Returns the 8-bit values of a PNG, through the transfer curve: (height, width, 3), or 4 with an alpha."""
        return self._codes(8)

    def _codes(self, bits: int) -> NDArray[Any]:
        """Returns values of 8 or 16 bits through the transfer curve, as :meth:`to_bytes` does."""
        linear, alpha = self.rgb.astype(np.float64), None
        if self.alpha is not None:
            alpha = self.alpha.astype(np.float64)[..., None]
            linear = np.divide(linear, alpha, out=np.zeros_like(linear), where=alpha > 0)
        linear = np.clip(linear, 0.0, 1.0)
        if self.transfer == "srgb":
            linear = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
        planes = linear if alpha is None else np.concatenate([linear, np.clip(alpha, 0.0, 1.0)], axis=-1)
        codes: NDArray[Any] = np.floor(planes * (2.0**bits - 1.0) + 0.5).astype(f"u{bits // 8}")
        return codes

    def __array__(self, dtype: Any = None, copy: Optional[bool] = None) -> NDArray[Any]:
        dtype = self.rgb.dtype if dtype is None else np.dtype(dtype)
        if copy is False and dtype != self.rgb.dtype:
            raise ValueError(f"the image needs a copy to become {dtype}")
        return self.rgb.astype(dtype, copy=bool(copy))

    def _repr_png_(self) -> bytes:
        with tempfile.TemporaryDirectory(prefix="raylane-") as folder:
            path = Path(folder) / "image.png"
            self.save(path)
            return path.read_bytes()

    def show(self) -> None:
        """Shows the image in a notebook, otherwise in the desktop's viewer (``xdg-open``, or ``open`` on macOS).

        The viewer's file exists until Python ends. Raises RuntimeError without a notebook and a desktop.
        """
        if "IPython" in sys.modules:
            from IPython import get_ipython
            from IPython.display import display

            if get_ipython() is not None and hasattr(get_ipython(), "kernel"):
                display(self)
                return
        opener = shutil.which("open" if sys.platform == "darwin" else "xdg-open")
        if opener is None:
            raise RuntimeError("no notebook and no desktop: use save()")
        folder = tempfile.mkdtemp(prefix="raylane-")
        atexit.register(shutil.rmtree, folder, ignore_errors=True)
        path = Path(folder) / "image.png"
        self.save(path)
        subprocess.run([opener, str(path)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)

    def __repr__(self) -> str:
        return f"<raylane.Image: {self.width} x {self.height}>"


class _Bar:
    """A progress bar of tqdm that counts pixels."""

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
    camera: Union[None, Camera, str, Dict[str, Any]] = None,
    threads: int = 0,
    precision: Precision = "exact",
    crop: Optional[Tuple[int, int, int, int]] = None,
    aovs: bool = False,
    progress: Union[bool, OnProgress] = False,
    annotations: Optional[Union[str, os.PathLike[str]]] = None,
    on_remark: Callable[[str], object] = _warn,
    size: Union[None, str, Tuple[int, int]] = None,
    dpi: Optional[float] = None,
    **changed: Any,
) -> Image:
    """Renders the image of a scene. With ``precision="exact"`` the bits depend on the scene and settings alone.

    ``settings``: default is those of the scene. Further arguments change single settings: ``render(scene, width=800,
    height=600, grid=4)``. ``size``: both of ``width`` and ``height``, as (800, 600) or "800x600"; or on paper, as
    "8.5cm", "85x60mm" or "3.3in", at ``dpi`` pixels per inch, 300 by default. Files of the image store ``dpi``. For
    other proportions than those of the scene, an automatic camera is placed again.
    ``camera``: replaces the scene's (:meth:`Scene.seen_by`). ``threads``: maximum, 1 to 4096;
    0 is the value of RAYLANE_THREADS, or all processors. ``crop``: the part of the image to render, as x, y, width,
    height in pixels. ``aovs=True`` adds :class:`Aovs`. ``progress``: called from time to time with the numbers of
    finished and of all pixels; True shows a bar of tqdm, if that is installed.

    The image has the annotations of a scene of atoms (:func:`from_atoms`), which needs Pango when raylane is built.
    ``annotations="labels.svg"`` writes them to an SVG file of the size of the whole image, and leaves them off the image.
    Calls ``on_remark`` for annotations that are left out, too small or too large; default: a warning. Raises
    :class:`BadInput` for a scale bar that is not in the image, and :class:`SystemRefused` if raylane was built without
    Pango, or if the file cannot be written.

    Raises :class:`InvalidValue` if an argument is out of range, and :class:`Cancelled` if ``progress`` returns False,
    even in its last call. Ctrl-C stops the rendering at once. Other Python threads run meanwhile.
    """
    inner(scene)
    aovs = take_renamed(changed, "layers", "aovs", aovs)
    chosen = scene.settings if settings is None else settings
    if size is not None:
        pixels, dpi = _pixels_of(size, dpi, chosen)
        changed = {**pixels, **changed}
    try:
        chosen = dataclasses.replace(chosen, **changed)
    except TypeError:
        unknown = [name for name in changed if not hasattr(chosen, name)]
        if not unknown:
            raise
        known = [*vars(chosen), *inspect.signature(render).parameters]
        meant = suggestion(unknown[0], known)
        raise TypeError(f"{unknown[0]}: must be an argument of render or a setting{meant}") from None
    if scene._has_look and settings is None and "outline" not in changed and isinstance(chosen.height, int):
        chosen.outline = _scaled(chosen.outline, chosen.height, scene.settings.height)
    if camera is not None:
        scene = scene.seen_by(camera)
    bar = _bar() if progress is True else None
    on_progress = bar if isinstance(progress, bool) else progress
    name = None if annotations is None else os.fspath(annotations)
    try:
        arrays = _raylane.render(scene._scene, chosen, threads, precision, crop, aovs, on_progress, name, on_remark)
    finally:
        if bar is not None:
            bar.close()
    if arrays is None:
        raise Cancelled
    return Image(arrays["rgb"], arrays["alpha"], Aovs(arrays) if aovs else None, chosen.transfer, dpi)


def _scaled(outline: Outline, height: int, of_height: int) -> Outline:
    """Returns an outline of images ``of_height`` pixels high for another height, as raylane render scales it."""
    width = np.float32(outline.width) * np.float32(height) / np.float32(of_height)
    return dataclasses.replace(outline, width=min(32.0, float(width)))


_PIXELS = re.compile(r"(\d+)x(\d+)")
_ON_PAPER = re.compile(r"(\d+\.?\d*|\.\d+)(?:(?:cm|mm|in)?x(\d+\.?\d*|\.\d+))?(cm|mm|in)")
_INCHES = {"cm": 1 / 2.54, "mm": 1 / 25.4, "in": 1.0}


def _pixels_of(
    size: Union[str, Tuple[int, int]], dpi: Optional[float], settings: Settings
) -> Tuple[Dict[str, int], Optional[float]]:
    """Returns the width and height of a size in the words of the command line, and its resolution."""
    if not isinstance(size, str):
        width, height = size
        return {"width": width, "height": height}, dpi
    text = size.replace(" ", "").lower()
    if found := _PIXELS.fullmatch(text):
        return {"width": int(found[1]), "height": int(found[2])}, dpi
    found = _ON_PAPER.fullmatch(text)
    if found is None:
        raise InvalidValue("size", f'must be pixels such as 800x600, or 8.5cm, 85x60mm or 3.3in, got "{size}"')
    dpi = 300.0 if dpi is None else dpi
    scale = _INCHES[found[3]] * dpi
    across = round(scale * float(found[1]))
    upward = across * settings.height / settings.width if found[2] is None else scale * float(found[2])
    return {"width": across, "height": round(upward)}, dpi


def imshow(image: Union[Scene, Image], ax: Any = None, **options: Any) -> Any:
    """Shows an image in matplotlib's axes with unchanged colours. Renders a scene with ``options`` first."""
    if ax is None:
        import matplotlib.pyplot as plt

        ax = plt.gca()
    if isinstance(image, Scene):
        image = render(image, **options)
    elif options:
        raise TypeError("an existing image takes no options of render")
    ax.set_axis_off()
    return ax.imshow(image.to_bytes(), interpolation="nearest")
