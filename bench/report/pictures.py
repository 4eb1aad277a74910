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


def read(path):
    try:
        image = Image.open(path)
        if image.mode not in ("L", "P", "RGB"):
            raise ValueError(f"{path}: expected 8 bits without alpha")
        return np.asarray(image.convert("RGB"))
    except (OSError, Image.DecompressionBombError) as error:
        raise ValueError(f"{path}: {error}") from None


def of_folder(folder):
    """Returns one set for each subfolder that has images."""
    sets = []
    for each in sorted(folder.iterdir()) if folder.is_dir() else []:
        files = [file for file in sorted(each.iterdir()) if file.suffix.lower() == ".png"] if each.is_dir() else []
        if not files:
            continue
        pictures = [Picture(file.name, file.name, read(file)) for file in files]
        if len({picture.srgb.shape for picture in pictures}) > 1:
            raise ValueError(f"{each}: images of several sizes")
        sets.append(Set(f"own/{each.name}", each.name, pictures, pictures[-1].name))
    return sets
