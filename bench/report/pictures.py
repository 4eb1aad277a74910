"""Sets of images of one size, as PNG for the page."""

import base64
import dataclasses
import io

import numpy as np
from PIL import Image


@dataclasses.dataclass
class Picture:
    name: str
    title: str
    srgb: np.ndarray
    """(height, width, 3), bytes."""
    numbers: dict = dataclasses.field(default_factory=dict)

    def packed(self):
        file = io.BytesIO()
        Image.fromarray(self.srgb).save(file, "PNG", optimize=True)
        data = "data:image/png;base64," + base64.b64encode(file.getvalue()).decode()
        return {"name": self.name, "title": self.title, "numbers": self.numbers, "png": data}


@dataclasses.dataclass
class Set:
    name: str
    title: str
    pictures: list
    reference: str
    """The image with which the others are compared first."""

    def packed(self):
        pictures = [each.packed() for each in self.pictures]
        return {"name": self.name, "title": self.title, "reference": self.reference, "pictures": pictures}


def read_pfm(path):
    with open(path, "rb") as file:
        words = []
        while len(words) < 4:
            line = file.readline(80)
            words += line.split()
            if not line.endswith(b"\n"):
                raise ValueError(f"{path}: expected a PFM file")
        rest = file.read()
    try:
        channels = {b"PF": 3, b"Pf": 1}[words[0]]
        width, height, scale = int(words[1]), int(words[2]), float(words[3])
    except (KeyError, ValueError):
        raise ValueError(f"{path}: expected a PFM file") from None
    if width < 1 or height < 1 or len(rest) != 4 * channels * width * height:
        raise ValueError(f"{path}: the number of pixels differs from the header")
    rgb = np.frombuffer(rest, "<f4" if scale < 0 else ">f4").reshape(height, width, channels)[::-1].astype(np.float32)
    return encoded(np.repeat(rgb, 3, axis=2) if channels == 1 else rgb)


def encoded(rgb):
    """Returns sRGB bytes."""
    x = np.clip(rgb, 0, 1)
    return np.rint(255 * np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)).astype(np.uint8)


def read_png(path):
    try:
        image = Image.open(path)
        if image.mode not in ("L", "P", "RGB"):
            raise ValueError(f"{path}: expected 8 bits without alpha; use PFM for other images")
        return np.asarray(image.convert("RGB"))
    except (OSError, Image.DecompressionBombError) as error:
        raise ValueError(f"{path}: {error}") from None


def of_folder(folder):
    """Returns one set for each subfolder that has images."""
    readers = {".pfm": read_pfm, ".png": read_png}
    sets = []
    for each in sorted(folder.iterdir()) if folder.is_dir() else []:
        files = [file for file in sorted(each.iterdir()) if file.suffix.lower() in readers] if each.is_dir() else []
        if not files:
            continue
        pictures = [Picture(file.name, file.name, readers[file.suffix.lower()](file)) for file in files]
        if len({picture.srgb.shape for picture in pictures}) > 1:
            raise ValueError(f"{each}: images of several sizes")
        sets.append(Set(f"own/{each.name}", each.name, pictures, pictures[-1].name))
    return sets
