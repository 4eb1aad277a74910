"""Traces rays through a lens: compares their foci with the paraxial focus, and makes the spot diagram there.

The lens is a solid with exact surfaces. Each ray finds its next crossing, is refracted by Snell's law, and continues
on the surface that it has hit (`Leaving`). So no ray is lost, and no epsilon is needed. Normals are in float64: those
in float32 would hide the aberration of the ray next to the axis.
"""

import sys

import numpy as np
import raylane


def refract(directions, normals, ratio):
    """Returns refracted unit directions. ``normals``: unit, against the rays. ``ratio``: index before / behind."""
    cosine = -np.einsum("ij,ij->i", directions, normals)
    root = np.sqrt(1 - ratio**2 * (1 - cosine**2))
    return ratio * directions + (ratio * cosine - root)[:, None] * normals


def trace(tracer, origins, directions, index):
    """Traces rays through the lens. Returns their points on the last surface and their directions behind it."""
    leaving = None
    for surface in range(2):
        crossings = tracer.crossings(origins, directions, leaving=leaving, most=1, normals_double=True)
        assert (crossings.counts() == 1).all()
        origins = origins + crossings.t[:, None] * directions
        entering = crossings.entering[:, None]
        normals = np.where(entering, 1, -1) * crossings.normal_double
        directions = refract(directions, normals, 1 / index if surface == 0 else index)
        leaving = raylane.Leaving(crossings.shape_id, crossings.face, crossings.entering)
    return origins, directions


def focal_length(radii, thickness, index):
    """Returns the paraxial (effective, back) focal lengths of a thick lens in air."""
    r1, r2 = radii
    power = (index - 1) * (1 / r1 - 1 / r2 + (index - 1) * thickness / (index * r1 * r2))
    return 1 / power, (1 - (index - 1) * thickness / (index * r1)) / power


def main(picture=None):
    radii, thickness, aperture, index = (50.0, -80.0), 6.0, 12.0, 1.5168
    builder = raylane.SceneBuilder()
    glass = builder.add_material(transmission=1.0, index=index)
    builder.add_solid(raylane.Solid.lens((0, 0, 0), (0, 0, 1), radii, thickness, aperture), material=glass)
    tracer = raylane.Tracer(builder.build())

    effective, back = focal_length(radii, thickness, index)
    print(f"paraxial: focal length {effective:.4f}, {back:.4f} behind the lens")
    for height in (0.01, 1.0, 3.0, 6.0, 9.0):
        points, directions = trace(tracer, np.array([[0.0, height, -10.0]]), np.array([[0.0, 0.0, 1.0]]), index)
        focus = points[0, 2] - points[0, 1] * directions[0, 2] / directions[0, 1] - thickness
        print(f"ray at {height:5.2f}: meets the axis {focus:.4f} behind the lens")
        # Spherical aberration is in proportion to the square of the height.
        assert 3e-4 < (1 - focus / back) / height**2 < 4e-4

    rings = [(r, a) for r in np.linspace(0.5, 9, 12) for a in np.linspace(0, 2 * np.pi, int(8 * r) + 8, endpoint=False)]
    radius, angle = np.array(rings).T
    origins = np.stack([radius * np.cos(angle), radius * np.sin(angle), np.full_like(radius, -10)], axis=1)
    spots = []
    for degrees in (0.0, 3.0):
        slope = np.radians(degrees)
        directions = np.tile([0.0, np.sin(slope), np.cos(slope)], (len(origins), 1))
        points, after = trace(tracer, origins, directions, index)
        at = (thickness + back - points[:, 2]) / after[:, 2]
        spot = (points + at[:, None] * after)[:, :2]
        spots.append(spot - [0, effective * np.tan(slope)])
        print(f"{degrees} degrees: spot of {np.sqrt((spots[-1]**2).sum(axis=1).mean()):.4f} (root mean square)")
    if picture:
        import matplotlib

        matplotlib.use("agg")
        import matplotlib.pyplot as plt

        figure, axes = plt.subplots(1, 2, figsize=(8, 4), sharex=True, sharey=True)
        for ax, spot, name in zip(axes, spots, ("on the axis", "3 degrees")):
            ax.plot(*spot.T, ".", markersize=2)
            ax.set_aspect("equal")
            ax.set_title(name)
        figure.savefig(picture, dpi=80)


if __name__ == "__main__":
    main(*sys.argv[1:2])
