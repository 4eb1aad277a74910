"""Interactive view of a scene in a notebook: the kernel renders, the browser shows the image."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np

from ._image import render
from ._scene import Scene
from ._values import Camera


def turned(camera: Camera, azimuth: float, elevation: float, distance: float = 1.0) -> Camera:
    """Returns a camera that has moved around its point ``at``.

    ``azimuth``: degrees about ``up``. ``elevation``: degrees towards ``up``; the result is limited to -89 to 89.
    ``distance``: factor of the distance to ``at``.
    """
    at, up = np.array(camera.at, float), np.array(camera.up, float)
    up /= np.linalg.norm(up)
    away = np.asarray(camera.position, float) - at
    length = np.linalg.norm(away)
    flat = away - (away @ up) * up
    if np.linalg.norm(flat) < 1e-6 * length:  # the line of sight is along `up`: any side is suitable
        flat = np.eye(3)[np.argmin(np.abs(up))]
        flat -= (flat @ up) * up
    flat /= np.linalg.norm(flat)
    side = np.cross(up, flat)
    height = np.clip(np.degrees(np.arcsin(away @ up / length)) + elevation, -89.0, 89.0)
    around, above = np.radians(azimuth), np.radians(height)
    way = np.cos(above) * (np.cos(around) * flat + np.sin(around) * side) + np.sin(above) * up
    x, y, z = (at + distance * length * way).tolist()
    return dataclasses.replace(
        camera,
        position=(x, y, z),
        height=camera.height * distance,  # orthographic: a smaller height magnifies
        focus_distance=camera.focus_distance * distance,
    )


def orbit(scene: Scene, width: int = 480, height: int = 360, **settings: Any) -> Any:
    """Returns a widget with an image of a scene and sliders that move the camera. Requires ipywidgets, in a notebook.

    ``settings``: keyword arguments of :func:`raylane.render`.
    """
    import ipywidgets

    azimuth = ipywidgets.FloatSlider(min=-180, max=180, step=5, description="around")
    elevation = ipywidgets.FloatSlider(min=-90, max=90, step=5, description="above")
    distance = ipywidgets.FloatSlider(value=1, min=0.2, max=3, step=0.1, description="distance")
    view = ipywidgets.Image(format="png", width=width, height=height)

    def update(_: Any = None) -> None:
        camera = turned(scene.camera, azimuth.value, elevation.value, distance.value)
        image = render(scene, camera=camera, width=width, height=height, **settings)
        view.value = image._repr_png_()

    for slider in (azimuth, elevation, distance):
        slider.observe(update, "value")
    update()
    return ipywidgets.VBox([view, azimuth, elevation, distance])
