"""Renders a peptide and computes its solvent-accessible surface area.

Each atom becomes a sphere whose radius is larger by the probe's radius. The accessible surface is the part of these
spheres outside of all other spheres. `Tracer.contains` decides for points on the spheres which solids they are in.
"""

import sys

import numpy as np
import raylane

# An alanine dipeptide: element, x, y, z in angstrom.
ATOMS = """
H 2.000 1.000 0.000  C 2.000 2.090 0.000  H 1.486 2.454 0.890  H 1.486 2.454 -0.890  C 3.427 2.641 0.000
O 4.391 1.877 0.000  N 3.555 3.970 0.000  H 2.733 4.556 0.000  C 4.853 4.614 0.000  H 5.408 4.316 0.890
C 5.661 4.221 -1.232  H 5.123 4.521 -2.131  H 6.630 4.719 -1.206  H 5.809 3.141 -1.241  C 4.713 6.129 0.000
O 3.601 6.653 0.000  N 5.846 6.835 0.000  H 6.737 6.359 0.000  C 5.846 8.284 0.000  H 4.819 8.648 0.000
H 6.360 8.648 0.890  H 6.360 8.648 -0.890
""".split()
RADII = {"H": 1.2, "C": 1.7, "N": 1.55, "O": 1.52}  # van der Waals radii in angstrom (Bondi)


def sphere_points(count):
    """Returns points, (count, 3), evenly distributed on the unit sphere: a spiral by the golden angle."""
    i = np.arange(count) + 0.5
    z = 1 - 2 * i / count
    angle = np.pi * (1 + np.sqrt(5)) * i
    return np.stack([np.sqrt(1 - z**2) * np.cos(angle), np.sqrt(1 - z**2) * np.sin(angle), z], axis=1)


def accessible_areas(centers, radii, points=2000):
    """Returns the accessible area of each sphere, in squared units of length. ``points``: samples per sphere."""
    builder = raylane.SceneBuilder()
    builder.add_spheres(centers, radii, material=builder.add_material())
    tracer = raylane.Tracer(builder.build())
    directions = sphere_points(points)
    asked = (centers[:, None] + radii[:, None, None] * directions).reshape(-1, 3)
    owner = np.repeat(np.arange(len(centers)), points)
    solids = tracer.contains(asked)
    others = solids.shape_id != owner[solids.of()]
    covered = np.bincount(solids.of()[others], minlength=len(asked)) > 0
    return 4 * np.pi * radii**2 * np.bincount(owner[~covered], minlength=len(centers)) / points


def main(picture="protein.png", size=480):
    symbols, centers = ATOMS[::4], np.array([ATOMS[i::4] for i in (1, 2, 3)], float).T
    radii = np.array([RADII[s] for s in symbols]) + 1.4
    areas = accessible_areas(centers, radii)
    print(f"accessible: {areas.sum():.1f} square angstrom")
    for symbol in "CNOH":
        print(f"  {symbol}: {areas[[s == symbol for s in symbols]].sum():.1f}")
    # The areas of two equal spheres have a closed form, which checks the error of the samples.
    pair = accessible_areas(np.array([[0.0, 0, 0], [0, 0, 1.5]]), np.array([1.0, 1.0]), 20_000)
    assert np.allclose(pair, 2 * np.pi * (1 + 0.75), rtol=1e-3)
    assert 300 < areas.sum() < 450

    try:
        import ase
    except ImportError:
        scene = raylane.from_atoms(symbols, centers)
    else:
        scene = raylane.from_ase(ase.Atoms(symbols, centers))
    raylane.render(scene, width=size, height=size, quality=40).save(picture)


if __name__ == "__main__":
    main(*sys.argv[1:2])
