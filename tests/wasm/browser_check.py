"""Checks the page in a headless browser: a scene is shown and turns, with a native raylane's bytes. tests/wasm.sh calls it.

    python3 tests/wasm/browser_check.py PAGE RAYLANE [FOLDER]

Needs Debian's chromium-driver and python3-selenium. FOLDER: keeps screenshots of the page.
"""

import base64
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import time

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.actions.wheel_input import ScrollOrigin
from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import Select

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from chromium import browser, wait  # noqa: E402

SCENES = pathlib.Path(__file__).parents[2] / "scenes"


class Page:
    def __init__(self, driver, url):
        self.driver = driver
        driver.get("about:blank")  # a change after # alone would not load the page
        driver.get(url)
        self.done()

    def state(self):
        return self.driver.execute_script("return document.body.dataset.state")

    def text(self, id):
        return self.driver.find_element(By.ID, id).text

    def done(self):
        state = wait("a picture", lambda: self.state() in ("done", "failed") and self.state(), 120)
        assert state == "done", self.text("message")

    def canvas(self):
        return self.driver.find_element(By.ID, "picture")

    def rgb(self):
        packed = self.driver.execute_script(
            "const {data} = context.getImageData(0, 0, canvas.width, canvas.height); let text = '';"
            "for (let i = 0; i < data.length; i += 8192) text += String.fromCharCode(...data.subarray(i, i + 8192));"
            "return btoa(text);"
        )
        rgba = base64.b64decode(packed)
        assert set(rgba[3::4]) == {255}
        return bytes(byte for i, byte in enumerate(rgba) if i % 4 != 3)

    def shown(self):
        return self.driver.execute_script("return shown")

    def frames(self, seconds):
        """Returns the frames per second that the page reports after some seconds."""
        time.sleep(seconds)
        return float(self.text("frames"))


def native(raylane, scene, shown, folder):
    """Returns a native raylane's bytes of the image on the page."""
    text = (SCENES / f"{scene}.json").read_text()
    camera = shown["camera"]
    numbers = {key: camera[key] for key in ("from", "at", "up", "field_of_view")}
    text, count = re.subn(r'"camera": *{[^}]*}', lambda _: '"camera": ' + json.dumps(numbers), text)
    assert count == 1, scene
    path, picture = folder / f"{scene}.json", folder / "picture.ppm"
    path.write_text(text)
    size = shown["width"], shown["height"]
    samples = ["--spp", str(shown["grid"] ** 2)] if shown["grid"] else []
    subprocess.run([raylane, "render", "-q", path, "--size", "%dx%d" % size, *samples, "-o", picture], check=True)
    return picture.read_bytes()[-3 * size[0] * size[1] :]


def check(page, raylane, scene, folder, what):
    page.done()
    shown = page.shown()
    assert page.rgb() == native(raylane, scene, shown, folder), f"{scene}: not a native raylane's bytes: {shown}"
    print(f"{scene}, {what}: a native raylane's bytes, {page.text('samples')} samples a pixel")
    return shown


def look(driver, url, raylane, folder, pictures):
    page = Page(driver, url)
    first = check(page, raylane, "sphere", folder, "as the scene says")
    if pictures:
        driver.save_screenshot(str(pictures / "page.png"))

    ActionChains(driver).move_to_element(page.canvas()).click_and_hold().move_by_offset(90, 40).release().perform()
    wait("a change", lambda: page.state() != "done" or page.shown() != first, 10)
    dragged = check(page, raylane, "sphere", folder, "dragged")
    a, b = first["camera"], dragged["camera"]
    # A drag over the image's height is half a turn. The scene follows the pointer.
    sizes = driver.execute_script("return [canvas.clientWidth, canvas.clientHeight]")
    expected = driver.execute_script(
        "return turned(scene.camera, -90 * 180 / arguments[0][1], 40 * 180 / arguments[0][1])", sizes
    )
    assert b == expected and a != b, (a, b, expected)

    ActionChains(driver).scroll_from_origin(ScrollOrigin.from_element(page.canvas()), 0, -240).perform()
    wait("a change", lambda: page.state() != "done" or page.shown() != dragged, 10)
    nearer = check(page, raylane, "sphere", folder, "nearer")

    def distance(camera):
        return sum((x - y) ** 2 for x, y in zip(camera["from"], camera["at"])) ** 0.5

    assert distance(nearer["camera"]) < 0.8 * distance(b), (nearer, b)
    if pictures:
        driver.save_screenshot(str(pictures / "turned.png"))

    Select(driver.find_element(By.ID, "size")).select_by_visible_text("256")
    for scene in ("glass-block", "birthday"):
        before = page.shown()
        Select(driver.find_element(By.ID, "scene")).select_by_value(scene)
        wait("another scene", lambda: page.shown() != before, 60)
        check(page, raylane, scene, folder, "chosen")


def measure(driver, url, workers):
    page = Page(driver, f"{url}#steady&workers={workers}")
    for seconds in (4, 4):  # the first ones while the engine still compiles
        driver.find_element(By.ID, "turn").click()
        rate = page.frames(seconds)
        shown = page.shown()
        speed = page.text("speed")
        driver.find_element(By.ID, "turn").click()
    print(f"sphere, {shown['width']} x {shown['height']}, {workers} workers: {rate:.1f} frames a second, {speed} rays a second")
    return rate, shown


def main(page, raylane, pictures=None):
    url = pathlib.Path(page).resolve().as_uri()
    pictures = pictures and pathlib.Path(pictures)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        driver = browser(folder, "--window-size=1100,900")
        try:
            look(driver, url, raylane, folder, pictures)
            for workers in (1, 2):
                measure(driver, url, workers)
            if pictures:
                driver.set_window_size(500, 900)  # the smallest width that the browser takes
                driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": 375, "height": 812, "deviceScaleFactor": 2, "mobile": True})
                driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": "dark"}]})
                Page(driver, f"{url}#scene=birthday")
                driver.save_screenshot(str(pictures / "phone.png"))
            wrong = [each for each in driver.get_log("browser") if each["level"] == "SEVERE"]
            assert not wrong, wrong
        finally:
            driver.quit()
    print("the page shows what a native raylane draws, and turns it")


if __name__ == "__main__":
    main(*sys.argv[1:])
