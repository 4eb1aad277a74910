"""Tomography of balls: compares the lengths of rays inside with the Radon transform, and reconstructs a slice.

A ray at distance d from the centre of a ball of radius r has the length 2 sqrt(r^2 - d^2) inside. Filtered
back-projection of the lengths from all angles reconstructs the slice.
"""

import sys

import numpy as np
import raylane

BALLS = [((0.0, 0.0, 0.0), 0.6), ((1.0, 0.5, 0.0), 0.25), ((-0.8, 0.7, 0.0), 0.3), ((0.2, -1.1, 0.0), 0.35)]


def main(picture=None, angles=180, width=256):
    builder = raylane.SceneBuilder()
    water = builder.add_material()
    centers, radii = np.array([c for c, _ in BALLS]), np.array([r for _, r in BALLS])
    builder.add_spheres(centers, radii, material=water)
    tracer = raylane.Tracer(builder.build())

    offsets = np.linspace(-2, 2, width)
    sinogram = np.empty((angles, width))
    expected = np.zeros((angles, width))
    for i, angle in enumerate(np.arange(angles) * np.pi / angles):
        along, across = np.array([np.cos(angle), np.sin(angle), 0]), np.array([-np.sin(angle), np.cos(angle), 0])
        sinogram[i] = tracer.path_lengths(offsets[:, None] * across - 3 * along, along).total()
        for center, radius in BALLS:
            distance = offsets - np.dot(center, across)
            expected[i] += 2 * np.sqrt(np.maximum(radius**2 - distance**2, 0))
    # The formula suffers from cancellation at grazing rays; the traced lengths are within 1 ulp.
    print(f"lengths of {sinogram.size} rays: off by {np.abs(sinogram - expected).max():.1e} at most from Radon's formula")
    assert np.abs(sinogram - expected).max() < 1e-6

    step = offsets[1] - offsets[0]
    frequencies = np.abs(np.fft.fftfreq(2 * width, step))
    filtered = np.fft.ifft(np.fft.fft(sinogram, 2 * width, axis=1) * frequencies, axis=1).real[:, :width]
    x, y = np.meshgrid(offsets, offsets)
    image = np.zeros_like(x)
    for row, angle in zip(filtered, np.arange(angles) * np.pi / angles):
        image += np.interp(-x * np.sin(angle) + y * np.cos(angle), offsets, row)
    image *= np.pi / angles
    inside = np.stack([x, y, np.zeros_like(x)], axis=-1).reshape(-1, 3)
    truth = (tracer.contains(inside).counts() > 0).reshape(x.shape)
    print(f"the slice again: {image[truth].mean():.3f} inside, {image[~truth].mean():.3f} outside")
    assert abs(image[truth].mean() - 1) < 0.05 and abs(image[~truth].mean()) < 0.05
    if picture:
        raylane.Image(np.repeat(np.clip(image[::-1, :, None], 0, 1), 3, axis=2)).save(picture)


if __name__ == "__main__":
    main(*sys.argv[1:2])
