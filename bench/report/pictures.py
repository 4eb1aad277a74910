"""Sets of images of one size, packed for the page. src/pictures.js unpacks them."""

import base64
import dataclasses
import zlib

import numpy as np


@dataclasses.dataclass
class Picture:
    name: str
    title: str
    rgb: np.ndarray
    """(height, width, 3), linear, float32."""
    numbers: dict = dataclasses.field(default_factory=dict)


@dataclasses.dataclass
class Map:
    """A number below 65,536 for each pixel."""

    name: str
    title: str
    values: np.ndarray
    labels: list = dataclasses.field(default_factory=list)


def deflated(array):
    return base64.b64encode(zlib.compress(np.ascontiguousarray(array).tobytes(), 9)).decode()


def planes_of(rgb):
    return np.ascontiguousarray(rgb.transpose(2, 0, 1), "<f4").view("<u4").ravel()


@dataclasses.dataclass
class Set:
    name: str
    title: str
    pictures: list
    maps: list = dataclasses.field(default_factory=list)
    reference: str = ""
    """The image with which the others are compared; empty for no comparison."""

    def packed(self):
        """Returns the set as JSON data. Each image is XORed with the image before it and split into planes of bytes."""
        height, width = self.pictures[0].rgb.shape[:2]
        packed, last = [], None
        for number, picture in enumerate(self.pictures):
            words = planes_of(picture.rgb)
            bits = words if last is None else words ^ last
            data = deflated(bits.view(np.uint8).reshape(-1, 4).T)
            packed.append(
                {
                    "name": picture.name,
                    "title": picture.title,
                    "numbers": picture.numbers,
                    "base": None if last is None else number - 1,
                    "data": data,
                }
            )
            last = words
        maps = []
        for each in self.maps:
            entry = {"name": each.name, "title": each.title, "data": deflated(each.values.astype("<u2"))}
            maps.append({**entry, "labels": each.labels} if each.labels else entry)
        result = {"name": self.name, "title": self.title, "width": width, "height": height, "pictures": packed, "maps": maps}
        return {**result, "reference": self.reference} if self.reference else result


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
    return np.repeat(rgb, 3, axis=2) if channels == 1 else rgb


def linear(encoded):
    return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4).astype(np.float32)


def encoded(rgb):
    """Returns sRGB bytes."""
    x = np.clip(rgb, 0, 1)
    return np.rint(255 * np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)).astype(np.uint8)


def read_png(path):
    from PIL import Image

    try:
        image = Image.open(path)
        if image.mode not in ("L", "P", "RGB"):
            raise ValueError(f"{path}: expected 8 bits without alpha; use PFM for other images")
        return linear(np.asarray(image.convert("RGB")) / 255)
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
        if len({picture.rgb.shape for picture in pictures}) > 1:
            raise ValueError(f"{each}: images of several sizes")
        sets.append(Set(f"own/{each.name}", each.name, pictures))
    return sets
