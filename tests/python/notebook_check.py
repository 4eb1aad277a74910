"""Checks a real notebook in a headless browser: a scene is shown as an image, and sliders turn it. By .ci/run.

    PYTHONPATH=build/release/python python3 tests/python/notebook_check.py [PICTURE]

Needs Debian's jupyter-notebook, jupyter-nbextension-jupyter-js-widgets, python3-ipykernel, chromium-driver and
python3-selenium. PICTURE: a screenshot of the browser at the end.
"""

import base64
import json
import os
import pathlib
import socket
import subprocess
import sys
import tempfile
import urllib.request

import raylane
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from chromium import browser, wait  # noqa: E402

SCENE = str(pathlib.Path(__file__).parents[2] / "scenes" / "birthday.json")
CELLS = [
    f"import raylane\nscene = raylane.load({SCENE!r})",
    "raylane.render(scene, width=200, height=150)",
    "raylane.orbit(scene, 160, 120)",
    "scene.show(width=80, height=60)",
    "print('rea' + 'dy')",
]


def notebook(path):
    cells = [
        {"cell_type": "code", "execution_count": None, "metadata": {}, "outputs": [], "source": source}
        for source in CELLS
    ]
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    path.write_text(json.dumps({"cells": cells, "metadata": {"kernelspec": kernel}, "nbformat": 4, "nbformat_minor": 4}))


def free_port():
    with socket.socket() as server:
        server.bind(("127.0.0.1", 0))
        return server.getsockname()[1]


def answers(url):
    try:
        return urllib.request.urlopen(url + "/api", timeout=2).status == 200
    except OSError:
        return False


def errors(driver):
    return [each.text for each in driver.find_elements(By.CSS_SELECTOR, ".output_error")]


def look(driver, url, picture):
    driver.get(url + "/notebooks/a.ipynb")
    wait("a kernel", lambda: driver.execute_script("return window.Jupyter && Jupyter.notebook && Jupyter.notebook.kernel && Jupyter.notebook.kernel.is_connected()"))
    driver.execute_script("Jupyter.notebook.execute_all_cells()")
    wait("all cells", lambda: "ready" in driver.find_element(By.TAG_NAME, "body").text or errors(driver))
    assert not errors(driver), errors(driver)

    def pictures(width):
        images = driver.find_elements(By.CSS_SELECTOR, ".output img, .widget-image, .widget-subarea img")
        return [i for i in images if i.get_property("naturalWidth") == width]

    [plain] = wait("the cell's picture", lambda: pictures(200))
    assert plain.get_property("naturalHeight") == 150
    shown = base64.b64decode(plain.get_attribute("src").split("base64,")[1])
    assert shown == raylane.render(raylane.load(SCENE), width=200, height=150)._repr_png_(), "not what the kernel has drawn"
    assert len(wait("what is shown", lambda: pictures(80))) == 1
    turning = wait("the sliders' picture", lambda: pictures(160))[0]

    def bits():
        return driver.execute_async_script(
            "const done = arguments[1]; fetch(arguments[0].src).then(r => r.arrayBuffer())"
            ".then(b => done(btoa(String.fromCharCode(...new Uint8Array(b)))));",
            turning,
        )

    before = bits()
    handle = driver.find_elements(By.CSS_SELECTOR, ".ui-slider-handle")[0]
    driver.execute_script("arguments[0].scrollIntoView()", handle)
    handle.send_keys(*[Keys.ARROW_RIGHT] * 4)
    wait("another picture", lambda: bits() != before)
    camera = raylane._orbit.turned(raylane.load(SCENE).camera, 20, 0)
    expected = raylane.render(raylane.load(SCENE), camera=camera, width=160, height=120)._repr_png_()
    wait("the turned picture", lambda: base64.b64decode(bits()) == expected, 20)
    if picture:
        driver.save_screenshot(picture)
    wrong = [e for e in driver.get_log("browser") if e["level"] == "SEVERE" and "favicon" not in e["message"]]
    assert not [e for e in wrong if "raylane" in e["message"] or "widget" in e["message"].lower()], wrong


def main(picture=None):
    with tempfile.TemporaryDirectory() as folder:
        notebook(pathlib.Path(folder) / "a.ipynb")
        port = free_port()
        url = f"http://127.0.0.1:{port}"
        # A relative PYTHONPATH starts from this folder, but the kernel runs in another one.
        module = str(pathlib.Path(raylane.__file__).resolve().parents[1])
        environment = {**os.environ, "PYTHONPATH": module, "HOME": folder, "JUPYTER_RUNTIME_DIR": folder + "/runtime", "IPYTHONDIR": folder + "/ipython"}
        command = ["/usr/bin/jupyter-notebook", "--no-browser", "--allow-root", f"--port={port}", "--NotebookApp.token=", "--NotebookApp.password=", f"--notebook-dir={folder}"]
        with open(folder + "/log", "w") as log:
            server = subprocess.Popen(command, stdout=log, stderr=log, env=environment)
            try:
                wait("the server", lambda: answers(url))
                driver = browser(folder, "--window-size=1000,1400")
                try:
                    look(driver, url, picture)
                finally:
                    if picture:
                        driver.save_screenshot(picture)
                    driver.quit()
            except BaseException:
                print(pathlib.Path(folder + "/log").read_text()[-3000:], file=sys.stderr)
                raise
            finally:
                server.terminate()
                server.wait(20)
    print("a notebook shows what is drawn, and turns it")


if __name__ == "__main__":
    main(*sys.argv[1:2])
