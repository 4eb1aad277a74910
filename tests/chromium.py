"""Debian's headless Chromium, for checks of pages. Needs chromium-driver and python3-selenium."""

import time

from selenium import webdriver
from selenium.webdriver.chrome.service import Service


def browser(folder, *arguments):
    """Returns a browser that keeps its state in a folder, and its console's messages."""
    options = webdriver.ChromeOptions()
    options.binary_location = "/usr/bin/chromium"
    for each in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", f"--user-data-dir={folder}/browser", *arguments):
        options.add_argument(each)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)


def wait(what, found, seconds=90):
    """Waits until found() returns a true value, and returns that."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        value = found()
        if value:
            return value
        time.sleep(0.1)
    raise AssertionError(f"{what}: not within {seconds} s")
