"""Images."""

import os
import shutil
import signal
import subprocess
import sys
import textwrap
import zlib

import numpy as np
import pytest
import raylane


def test_the_same_bits_as_the_tool(birthday, scenes, tmp_path):
    image = raylane.render(birthday, width=96, height=72, grid=2)
    assert image.rgb.shape == (72, 96, 3) and image.rgb.dtype == np.float32
    assert (image.width, image.height) == (96, 72)
    image.save(tmp_path / "a.pfm")
    tool = os.environ.get("RAYLANE_TOOL")
    if not tool:
        pytest.skip("RAYLANE_TOOL does not say where the tool is")
    command = [tool, "render", str(scenes / "birthday.json"), "--size", "96x72", "--spp", "4", "-o", str(tmp_path / "b.pfm")]
    subprocess.run(command, check=True)
    assert (tmp_path / "a.pfm").read_bytes() == (tmp_path / "b.pfm").read_bytes()


def test_options(birthday):
    settings = birthday.settings
    settings.width, settings.height = 64, 48
    whole = raylane.render(birthday, settings)
    assert np.array_equal(whole.rgb, birthday.render(width=64, height=48, threads=1).rgb)
    part = raylane.render(birthday, settings, crop=(10, 5, 20, 15), aovs=True)
    assert np.array_equal(part.rgb, whole.rgb[5:20, 10:30])
    aovs = part.aovs
    assert aovs.depth.shape == aovs.shape_id.shape == aovs.material.shape == aovs.samples.shape == (15, 20)
    assert aovs.normal.shape == (15, 20, 3)
    assert whole.aovs is None and whole.alpha is None
    clear = raylane.render(birthday, settings, alpha=True)
    assert clear.alpha.shape == (48, 64) and clear.to_bytes().shape == (48, 64, 4)
    assert np.asarray(whole) is whole.rgb
    for wrong in ({"width": 0}, {"filter": "none"}, {"precision": "best"}, {"crop": (5000, 0, 20, 20)}, {"threads": -1}, {"grid": "2"}, {"crop": (1, 2)}):
        with pytest.raises(ValueError):
            raylane.render(birthday, **wrong)
    with pytest.raises(TypeError):
        raylane.render(birthday, widht=100)


def png_pixels(data):
    """Returns the pixels of a PNG of 8 bits that is not interlaced."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, chunks = 8, {}
    while at < len(data):
        size = int.from_bytes(data[at : at + 4], "big")
        chunks[data[at + 4 : at + 8]] = chunks.get(data[at + 4 : at + 8], b"") + data[at + 8 : at + 8 + size]
        at += 12 + size
    header = chunks[b"IHDR"]
    width, height = int.from_bytes(header[:4], "big"), int.from_bytes(header[4:8], "big")
    channels = {2: 3, 6: 4}[header[9]]
    raw = np.frombuffer(zlib.decompress(chunks[b"IDAT"]), np.uint8).reshape(height, 1 + width * channels)
    rows = np.zeros((height, width, channels), np.int64)
    for y in range(height):
        filter_, line = raw[y, 0], raw[y, 1:].reshape(width, channels).astype(np.int64)
        above = rows[y - 1] if y else np.zeros((width, channels), np.int64)
        for x in range(width):
            left = rows[y, x - 1] if x else np.zeros(channels, np.int64)
            corner = above[x - 1] if x else np.zeros(channels, np.int64)
            guess = left + above[x] - corner
            distances = np.abs([guess - left, guess - above[x], guess - corner])
            paeth = np.choose(np.argmin(distances, axis=0), [left, above[x], corner])
            rows[y, x] = (line[x] + [0, left, above[x], (left + above[x]) // 2, paeth][filter_]) % 256
    return rows


@pytest.mark.parametrize("alpha", [False, True])
def test_bytes_are_those_of_the_png(birthday, alpha):
    image = raylane.render(birthday, width=32, height=24, alpha=alpha)
    assert np.array_equal(png_pixels(image._repr_png_()), image.to_bytes())
    assert birthday._repr_png_()[:4] == b"\x89PNG"


def test_files(birthday, tmp_path):
    image = raylane.render(birthday, width=16, height=12)
    for ending in ("png", "tga", "bmp", "ppm", "hdr", "pfm"):
        image.save(tmp_path / f"a.{ending}")
        assert (tmp_path / f"a.{ending}").stat().st_size > 100
    with pytest.raises(ValueError):
        image.save(tmp_path / "a.gif")
    with pytest.raises(OSError):
        image.save(tmp_path / "nowhere" / "a.png")
    own = raylane.Image(np.linspace(0, 1, 5 * 4 * 3).reshape(4, 5, 3))
    own.save(tmp_path / "own.png")
    assert np.array_equal(png_pixels((tmp_path / "own.png").read_bytes()), own.to_bytes())
    with pytest.raises(ValueError):
        raylane.Image(np.zeros((4, 5))).save(tmp_path / "flat.png")
    with pytest.raises(raylane.InvalidValue, match="alpha"):
        raylane.Image(np.zeros((4, 5, 3)), np.zeros((5, 4))).save(tmp_path / "turned.png")


def test_print_sizes(birthday, tmp_path):
    for size, width, height in ("12x8", 12, 8), ((12, 8), 12, 8), ("1cm", 12, 12), ("10x7 mm", 12, 8), ("0.4inx.25in", 12, 8):
        image = birthday.render(size=size, dpi=30, grid=1)
        assert (image.width, image.height) == (width, height), size
    assert birthday.render(size="1mm", grid=1).dpi == 300.0
    for size in ("12", "1.5x2", "cm", "1,5cm", "3ft", "1x2x3cm", ""):
        with pytest.raises(raylane.InvalidValue, match="size: must be pixels such as 800x600, or 8.5cm"):
            birthday.render(size=size)
    with pytest.raises(TypeError, match='qualty: must be an argument of render or a setting, did you mean "quality"?'):
        birthday.render(qualty=40)

    image.save(tmp_path / "a.png")
    data = (tmp_path / "a.png").read_bytes()
    at = data.index(b"pHYs") + 4
    assert int.from_bytes(data[at : at + 4], "big") == round(30 / 0.0254)
    image.save(tmp_path / "b.png", bits=16, dpi=600)
    data = (tmp_path / "b.png").read_bytes()
    assert data[24] == 16
    at = data.index(b"pHYs") + 4
    assert int.from_bytes(data[at : at + 4], "big") == round(600 / 0.0254)
    image.save(tmp_path / "a.pfm")
    with pytest.raises(raylane.InvalidValue, match="dpi: must be 0, except in .png"):
        image.save(tmp_path / "b.pfm", dpi=300)


def test_cameras_as_view_prints_them(birthday):
    camera = raylane.Camera(position=(3, 2, 9), at=(0, 1, 0), field_of_view=30)
    expected = birthday.render(width=12, height=8, grid=1, camera=camera).rgb
    text = '{"from": [3, 2, 9], "at": [0, 1, 0], "field_of_view": 30}'
    for one in (text, '"camera": ' + text, {"camera": {"from": [3, 2, 9], "at": [0, 1, 0], "field_of_view": 30}}, {"position": (3, 2, 9), "at": (0, 1, 0), "field_of_view": 30}):
        assert np.array_equal(birthday.render(width=12, height=8, grid=1, camera=one).rgb, expected)
    flat = raylane.Camera.from_json('{"type": "orthographic", "from": [0, 0, 9], "at": [0, 0, 0], "height": 4}')
    assert flat == raylane.Camera(projection="orthographic", position=(0.0, 0.0, 9.0), at=(0.0, 0.0, 0.0), height=4)
    with pytest.raises(raylane.InvalidValue, match="camera: must be a Camera or its JSON"):
        birthday.seen_by("front")
    with pytest.raises(TypeError, match="fild_of_view"):
        birthday.seen_by({"fild_of_view": 3})


def test_tiff(birthday, tmp_path):
    image = birthday.render(width=12, height=8, grid=1, alpha=True)
    tifffile = pytest.importorskip("tifffile")
    for bits in (8, 16):
        image.save(tmp_path / "a.tif", bits=bits, dpi=600)
        with tifffile.TiffFile(tmp_path / "a.tif") as file:
            page = file.pages[0]
            assert page.tags["XResolution"].value == (600, 1) and page.tags["ResolutionUnit"].value == 2
            assert page.asarray().shape == (8, 12, 4) and page.asarray().dtype == np.dtype(f"uint{bits}")
            if bits == 8:
                assert np.array_equal(page.asarray(), image.to_bytes())
    assert os.listdir(tmp_path) == ["a.tif"]
    for wrong in ({"bits": 12}, {"dpi": 0.5}):
        with pytest.raises(raylane.InvalidValue):
            image.save(tmp_path / "b.tif", **wrong)
    tool = os.environ.get("RAYLANE_TOOL")
    if tool:
        image.save(tmp_path / "a.png", bits=16)
        subprocess.run([tool, "compare", str(tmp_path / "a.png"), str(tmp_path / "a.tif")], check=True)


def test_tiff_without_its_library(ball, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "tifffile", None)
    with pytest.raises(raylane.SystemRefused, match="TIFF needs tifffile"):
        ball.render(width=2, height=2).save(tmp_path / "a.tif")


def test_what_cannot_be_drawn_says_where(ball, tmp_path):
    """Errors name settings by their keywords, whichever function refuses them."""
    for options, text in (
        ({"height": 0}, "height: must be from 1 to 65535, got 0"),
        ({"height": "0"}, "height: must be a whole number, got '0'"),
        ({"width": 2**40}, "width: must be a whole number from -2147483648 to 2147483647, got 1099511627776"),
        ({"settings": raylane.Settings(height=0)}, "height: must be from 1 to 65535, got 0"),
        ({"outline": None}, "outline/width: is missing in None"),
        ({"outline": raylane.Outline(width=99)}, "outline/width: must be"),
        ({"alpha": "no"}, "alpha: must be True or False, got 'no'"),
        ({"camera": raylane.Camera(field_of_view=0)}, "camera/field_of_view: must be"),
        ({"camera": raylane.Camera(field_of_view="0")}, "camera/field_of_view: must be a number, got '0'"),
        ({"precision": None}, 'precision: must be one of "fast", "robust", "exact", "double", got None'),
        ({"threads": "2"}, "threads: must be a whole number, got '2'"),
        ({"threads": 2**40}, "threads: must be a whole number from 0 to 4096, got 1099511627776"),
        ({"aovs": "no"}, "aovs: must be True or False, got 'no'"),
        ({"crop": (0, 0, 2**40, 1)}, "crop: must be four whole numbers"),
    ):
        with pytest.raises(raylane.InvalidValue) as error:
            raylane.render(ball, **options)
        assert str(error.value).startswith(text)
    for image in (raylane.Image("rgb"), raylane.Image(np.zeros((4, 5))), raylane.Image(np.zeros((4, 5, 3), complex))):
        with pytest.raises(raylane.InvalidValue, match="rgb: must"):
            image.save(tmp_path / "a.png")
    with pytest.raises(raylane.InvalidValue, match="alpha: must be an array of numbers"):
        raylane.Image(np.zeros((4, 5, 3)), "alpha").save(tmp_path / "a.png")
    for transfer in ("gamma", None):
        with pytest.raises(raylane.InvalidValue, match='transfer: must be one of "srgb", "linear", got'):
            raylane.Image(np.zeros((4, 5, 3)), transfer=transfer).save(tmp_path / "a.png")


def test_progress(birthday):
    told = []
    raylane.render(birthday, width=300, height=300, grid=4, progress=lambda done, total: told.append((done, total)))
    assert told and told[-1] == (90_000, 90_000) and told == sorted(told)
    for no in (False, 0, np.False_):
        with pytest.raises(raylane.Cancelled):
            raylane.render(birthday, width=900, height=900, grid=8, progress=lambda done, total: no)
    with pytest.raises(raylane.Cancelled):  # at the last call, too
        raylane.render(birthday, width=32, height=32, progress=lambda done, total: done < total)

    def refuse(done, total):
        raise KeyError(done)

    with pytest.raises(KeyError):
        raylane.render(birthday, width=900, height=900, grid=8, progress=refuse)


def test_a_bar(birthday, capsys):
    pytest.importorskip("tqdm")
    raylane.render(birthday, width=64, height=64, progress=True)
    assert "4.10k" in capsys.readouterr().err


def run(code, **options):
    return subprocess.Popen([sys.executable, "-c", textwrap.dedent(code)], stdout=subprocess.PIPE, text=True, **options)


@pytest.mark.parametrize(
    "work",
    [
        "raylane.render(scene, width=4000, height=4000, grid=16, threads=1)",
        "raylane.Tracer(scene, 1).intersect(many, [0, 0, -1], double=True)",
        "raylane.Tracer(scene, 1).intersect(columns, [0, 0, -1], double=True)",
        "raylane.Tracer(scene, 1).crossings(many, [0, 0, -1])",
        "raylane.Tracer(scene, 1).contains(many)",
        "deep.path_lengths(many, [0, 0, -1])",  # 262,144 of these rays take an hour
    ],
)
def test_ctrl_c_stops_a_call(scenes, work):
    process = run(
        f"""
        import raylane, numpy as np, sys, threading
        scene = raylane.load({str(scenes / 'birthday.json')!r})
        many = np.broadcast_to(np.array([0, -2, 30.0]), (1 << 25, 3))
        columns = np.zeros((3, 1 << 25)).T
        shells = raylane.SceneBuilder()
        shells.add_spheres(np.zeros((20_000, 3)), np.arange(1, 20_001), material=shells.add_material())
        deep = raylane.Tracer(shells.build(), 1)
        may_say = threading.Event()

        def say():
            may_say.wait()
            print("begins", flush=True)

        threading.Thread(target=say).start()
        sys.setswitchinterval(1e6)  # the thread waits until a call lets go of the interpreter's lock
        try:
            may_say.set()
            while True:
                {work}
        except KeyboardInterrupt:
            print("ends", flush=True)
        """
    )
    assert process.stdout.readline() == "begins\n"
    process.send_signal(signal.SIGINT)
    assert process.stdout.readline() == "ends\n"
    assert process.wait() == 0


def test_show(birthday, tmp_path, monkeypatch):
    """Without a notebook, show() opens a file with the system's viewer."""
    opened = []
    monkeypatch.setattr(shutil, "which", lambda name: "/bin/" + name)
    monkeypatch.setattr(subprocess, "run", lambda command, **_: opened.append(command))
    birthday.show(width=16, height=16)
    assert opened[0][0] in ("/bin/xdg-open", "/bin/open") and open(opened[0][1], "rb").read(4) == b"\x89PNG"
    monkeypatch.setattr(shutil, "which", lambda name: None)
    with pytest.raises(RuntimeError, match="save"):
        birthday.show(width=16, height=16)


def test_matplotlib(birthday):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots()
    image = raylane.render(birthday, width=32, height=24)
    shown = raylane.imshow(image, axes)
    assert np.array_equal(shown.get_array(), image.to_bytes()) and not axes.axison
    assert raylane.imshow(birthday, width=32, height=24).axes is axes
    with pytest.raises(TypeError):
        raylane.imshow(image, width=32)
    plt.close(figure)


def test_orbit(birthday):
    """The camera orbits, and the widget renders as sliders move."""
    from raylane._orbit import turned

    camera = raylane.Camera(position=(0.0, 0.0, 4.0))
    for angles, place in (((90, 0), (4, 0, 0)), ((0, 30), (0, 2, 12**0.5)), ((-90, 0, 0.5), (-2, 0, 0)), ((0, 0), (0, 0, 4))):
        assert np.allclose(turned(camera, *angles).position, place)
    assert turned(camera, 0, 90).position[1] < 4  # not along the camera's up
    up = np.array([0.0, 2.0, 0.0])
    above = turned(raylane.Camera(position=(0.0, 5.0, 0.0), up=up), 10, 0)
    assert np.isfinite(above.position).all() and np.isclose(np.linalg.norm(above.position), 5) and up[1] == 2
    widgets = pytest.importorskip("ipywidgets")
    box = raylane.orbit(birthday, 40, 30)
    picture, around, above, distance = box.children
    assert isinstance(picture, widgets.Image)
    first = picture.value
    assert first == raylane.render(birthday, width=40, height=30)._repr_png_()
    around.value = 45.0
    assert picture.value != first
    around.value = 0.0
    assert picture.value == first


def test_images_of_atoms_have_the_bits_of_the_tool_in_any_size(tmp_path):
    tool = os.environ.get("RAYLANE_TOOL")
    if not tool:
        pytest.skip("RAYLANE_TOOL does not say where the tool is")
    path = tmp_path / "a.xyz"
    path.write_text("3\n\nO 0 0 0\nC 3 0 0\nN 6 1 2\n")
    for width, height in ((40, 60), (80, 20), (48, 36)):
        subprocess.run(
            [tool, "render", path, "-o", tmp_path / "a.pfm", "--look", "print", "--zoom", "0.9", "--size", f"{width}x{height}"],
            check=True,
        )
        ours = raylane.load(path, look="print", zoom=0.9).render(width=width, height=height)
        ours.save(tmp_path / "b.pfm")
        assert (tmp_path / "b.pfm").read_bytes() == (tmp_path / "a.pfm").read_bytes()
