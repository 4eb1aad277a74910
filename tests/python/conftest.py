import pathlib

import numpy as np
import pytest
import raylane

SCENES = pathlib.Path(__file__).parents[2] / "scenes"


@pytest.fixture
def scenes():
    return SCENES


@pytest.fixture
def birthday():
    return raylane.load(SCENES / "birthday.json")


@pytest.fixture
def random():
    return np.random.default_rng(7)


@pytest.fixture
def ball():
    """A sphere of radius 1 around the origin, and one of radius 1/2 in it, of another material."""
    builder = raylane.SceneBuilder()
    for color, radius in (((1, 0, 0), 1.0), ((0, 0, 1), 0.5)):
        builder.add_spheres([0, 0, 0], radius, material=builder.add_material(color=color))
    builder.add_light(position=(3, 4, 5))
    return builder.build()
