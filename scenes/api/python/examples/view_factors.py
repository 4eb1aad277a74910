"""Computes view factors between two discs by rays and compares them with the closed form.

The view factor is the fraction of the rays that leave the first disc diffusely and hit the second.
"""

import sys

import numpy as np
import raylane


def closed_form(r1, r2, distance):
    """Returns the view factor of coaxial parallel discs (Howell's catalogue of view factors, C-41)."""
    a, b = r1 / distance, r2 / distance
    x = 1 + (1 + b**2) / a**2
    return 0.5 * (x - np.sqrt(x**2 - 4 * (b / a) ** 2))


def by_rays(r1, r2, distance, count, between=None, seed=1):
    builder = raylane.SceneBuilder()
    black = builder.add_material()
    target = builder.add_discs([0.0, 0, distance], [0.0, 0, -1], r2, material=black)
    if between is not None:
        builder.add_spheres([0.0, 0, distance / 2], between, material=black)
    tracer = raylane.Tracer(builder.build())

    random = np.random.default_rng(seed)
    u = random.random((4, count))
    radius, angle = r1 * np.sqrt(u[0]), 2 * np.pi * u[1]
    sine, around = np.sqrt(u[2]), 2 * np.pi * u[3]
    # Arrays with contiguous columns are read in place, without a copy.
    origins = np.stack([radius * np.cos(angle), radius * np.sin(angle), np.zeros(count)]).T
    directions = np.stack([sine * np.cos(around), sine * np.sin(around), np.sqrt(1 - sine**2)]).T
    return np.mean(tracer.intersect(origins, directions).shape_id == target[0])


def main(count=1 << 20):
    for r1, r2, distance in ((1.0, 1.0, 1.0), (1.0, 0.5, 2.0), (0.5, 2.0, 1.0), (1.0, 1.0, 0.1)):
        exact, found = closed_form(r1, r2, distance), by_rays(r1, r2, distance, int(count))
        deviation = np.sqrt(exact * (1 - exact) / int(count))
        print(f"radii {r1}, {r2}, distance {distance}: {exact:.6f}, by rays {found:.6f} +- {deviation:.6f}")
        assert abs(found - exact) < 5 * deviation
    hidden = by_rays(1.0, 1.0, 1.0, int(count), between=0.25)
    print(f"with a ball between them: {hidden:.6f}, which has no closed form")
    assert hidden < closed_form(1.0, 1.0, 1.0)


if __name__ == "__main__":
    main(*sys.argv[1:2])
