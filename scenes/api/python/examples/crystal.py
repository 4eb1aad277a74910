"""Renders a crystal and its cell, with atoms as ellipsoids of thermal motion, as in crystallography.

U is the covariance of an atom's displacements. The atom is inside of its ellipsoid half of the time.
"""

import sys

import numpy as np
import raylane

HALF_OF_THE_TIME = 1.5382  # radius, in standard deviations, of the ball with half of a 3D normal distribution


def axes_of(U):
    """Returns semi-axes as rows, (n, 3, 3), of the ellipsoids of n covariances U, (n, 3, 3)."""
    values, vectors = np.linalg.eigh(U)
    return HALF_OF_THE_TIME * np.sqrt(values)[:, :, None] * np.swapaxes(vectors, 1, 2)


def main(picture="crystal.png", size=480):
    cell, repeat = 4.2, 3
    corners = np.stack(np.meshgrid(*[np.arange(repeat + 1)] * 3, indexing="ij"), axis=-1).reshape(-1, 3) * cell
    centers = corners[(corners < cell * repeat - 1e-9).all(axis=1)] + cell / 2
    random = np.random.default_rng(4)

    builder = raylane.SceneBuilder()
    metal = builder.add_material(color=(0.55, 0.35, 0.9), specular=0.4, exponent=60)
    halide = builder.add_material(color=(0.25, 0.75, 0.25), specular=0.4, exponent=60)
    bar = builder.add_material(color=(0.15, 0.15, 0.15))
    for places, material, motion in ((corners, metal, 0.12), (centers, halide, 0.2)):
        spread = random.normal(size=(len(places), 3, 3)) * 0.35 + np.eye(3)
        U = motion * spread @ np.swapaxes(spread, 1, 2)
        builder.add_ellipsoids(places, axes_of(U), material=material)
    for axis in range(3):
        starts = corners[corners[:, axis] < cell * repeat - 1e-9]
        builder.add_cylinders(starts, cell * np.eye(3)[axis], 0.05, material=bar)
    middle = np.full(3, cell * repeat / 2)
    builder.camera = raylane.Camera(position=tuple(middle + [16, 11, 27]), at=tuple(middle), field_of_view=36)
    builder.background = (1, 1, 1)
    builder.add_light(kind="directional", direction=(-2, -3, -2.5), color=(0.8, 0.8, 0.8))
    builder.add_light(kind="sky", color=(0.6, 0.6, 0.65), ground=(0.4, 0.4, 0.4))
    scene = builder.build()
    print(scene)
    image = raylane.render(scene, width=size, height=size, quality=40)
    image.save(picture)


if __name__ == "__main__":
    main(*sys.argv[1:2])
