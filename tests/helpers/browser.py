# SPDX-License-Identifier: GPL-3.0-or-later
"""A browser without a window, whose messages and requests are kept."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import pytest


def opened(*arguments: str) -> Iterator[object]:
    """Yield a browser that is started with these arguments; skips without one."""
    webdriver = pytest.importorskip("selenium.webdriver", reason="needs python3-selenium")
    if not Path("/usr/bin/chromedriver").exists():
        pytest.skip("needs chromium-driver")
    options = webdriver.ChromeOptions()
    for argument in ("--headless=new", "--no-sandbox", "--window-size=1000,900", *arguments):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    driver = webdriver.Chrome(
        options=options, service=webdriver.chrome.service.Service("/usr/bin/chromedriver")
    )
    yield driver
    driver.quit()


def shown(browser: object, file: Path) -> list[str]:
    """Open a page; return the addresses that it asked for."""
    browser.get_log("performance")
    browser.get_log("browser")
    browser.get(file.as_uri())
    events = [json.loads(line["message"])["message"] for line in browser.get_log("performance")]
    sent = [event for event in events if event["method"] == "Network.requestWillBeSent"]
    return [event["params"]["request"]["url"] for event in sent]


def slide(browser: object, name: str, position: object) -> None:
    """Give an element a value, as the pointer would."""
    browser.execute_script(
        "const s = document.getElementById(arguments[0]); s.value = arguments[1];"
        "s.dispatchEvent(new Event('input'));",
        name,
        position,
    )
