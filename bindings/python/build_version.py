"""The version of the package, which is that of the Cargo workspace."""

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
MANIFEST = (ROOT / "Cargo.toml").read_text(encoding="utf-8")
__version__ = re.search(r'\[workspace\.package\]\nversion = "(.*?)"', MANIFEST)[1]
