"""The package holds the licence of everything that is in it."""

import re
from pathlib import Path

import pytest
import roundel

PACKAGE = Path(roundel.__file__).parent


def test_the_package_has_both_of_its_licences():
    assert "MIT License" in (PACKAGE / "LICENSE-MIT").read_text(encoding="utf-8")
    assert "Apache License" in (PACKAGE / "LICENSE-APACHE").read_text(encoding="utf-8")


def test_the_package_has_the_text_of_the_licence_of_every_crate():
    texts = PACKAGE / "THIRD-PARTY-LICENCES.txt"
    if not texts.exists():
        pytest.skip("the wheel was built without cargo")
    table = (PACKAGE / "THIRD-PARTY.md").read_text(encoding="utf-8")
    crates = re.findall(r"^\| (\S+) \| (\d\S*) \|", table, re.MULTILINE)
    assert len(crates) > 100
    # Each text follows a line that names its crates, between two rules.
    lines = texts.read_text(encoding="utf-8").splitlines()
    named = {name for line in lines for name in line.split(", ")}
    for name, version in crates:
        assert f"{name} {version}" in named
